#!/usr/bin/env python3
"""Measures the driver between a vehicle and a subscriber, beside a bare program: end_to_end.py --help

Writes one JSON object for each run and closes with tables; doc/performance.md explains them. Every
pair of driver and bare program is run in turns, so that what else the machine does hits both.
"""

import argparse
import json
import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time

BUILD = os.environ.get("BUILD_DIR", "build")


def executable(name):
    return os.path.join(BUILD, "devel", "lib", "frontseat_driver", name)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_until(done, what, limit_s=60.0):
    """Polls: nothing here is measured while it waits."""
    end = time.monotonic() + limit_s
    while not done():
        if time.monotonic() > end:
            raise RuntimeError("waited %.0f s for %s" % (limit_s, what))
        time.sleep(0.02)


def cpu_s(pid):
    """Processor time of all threads that live, to the nanosecond."""
    total = 0
    for task in os.listdir("/proc/%d/task" % pid):
        try:
            with open("/proc/%d/task/%s/schedstat" % (pid, task)) as file:
                total += int(file.read().split()[0])
        except OSError:
            pass  # ended meanwhile
    return total * 1e-9


def memory_mib(pid):
    with open("/proc/%d/smaps_rollup" % pid) as file:
        for line in file:
            if line.startswith("Pss:"):
                return int(line.split()[1]) / 1024.0
    return float("nan")


def threads(pid):
    return len(os.listdir("/proc/%d/task" % pid))


NODELET = "/usr/lib/nodelet/nodelet"
if not os.path.exists(NODELET):
    NODELET = "/opt/ros/noetic/lib/nodelet/nodelet"

MASTER_PORT = free_port()  # one for all runs: rospy keeps the first one that it was told


class Programs:
    """Everything that runs, ended in the opposite order."""

    def __init__(self):
        self.running = []
        self.master_port = MASTER_PORT
        self.environment = dict(
            os.environ, ROS_MASTER_URI="http://127.0.0.1:%d" % self.master_port,
            ROS_IP="127.0.0.1", PYTHONUNBUFFERED="1")
        share = os.path.join(os.path.abspath(BUILD), "devel", "share")
        self.environment["ROS_PACKAGE_PATH"] = ":".join(
            [share, os.path.dirname(os.path.dirname(os.path.abspath(__file__))),
             os.environ.get("ROS_PACKAGE_PATH", "")])
        self.environment["LD_LIBRARY_PATH"] = os.path.join(
            os.path.abspath(BUILD), "devel", "lib") + ":" + os.environ.get("LD_LIBRARY_PATH", "")
        self.environment["CMAKE_PREFIX_PATH"] = os.path.join(
            os.path.abspath(BUILD), "devel") + ":" + os.environ.get("CMAKE_PREFIX_PATH", "")

    def start(self, *command, **options):
        process = subprocess.Popen(
            [str(word) for word in command], env=self.environment, universal_newlines=True,
            stdin=options.get("stdin", subprocess.DEVNULL),
            # A shell's background jobs ignore it, and so would their children.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            stdout=options.get("stdout", subprocess.DEVNULL),
            stderr=None if os.environ.get("BENCH_VERBOSE") else subprocess.DEVNULL)
        self.running.append(process)
        return process

    def end(self, process):
        self.running.remove(process)
        process.send_signal(signal.SIGINT)
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe:
                pipe.close()

    def end_all(self):
        for process in reversed(list(self.running)):
            self.end(process)


class Vehicle:
    def __init__(self, programs, times, **options):
        words = [executable("bench_vehicle"), "--times", times]
        for name, value in options.items():
            words += ["--" + name] + ([] if value is True else [value])
        self.process = programs.start(*words, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.port = int(self.line().split()[1])

    def line(self):
        return self.process.stdout.readline().strip()

    def go(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return self.line()


def ros_call(programs, function):
    """ROS's Python is only needed for services; it must not see the environment before."""
    os.environ.update({k: programs.environment[k] for k in ("ROS_MASTER_URI", "ROS_IP")})
    return function()


def report(programs, name="/subscriber/report"):
    import rospy
    from std_srvs.srv import Trigger

    def call():
        rospy.wait_for_service(name, 60)
        return json.loads(rospy.ServiceProxy(name, Trigger)().message)
    return ros_call(programs, call)


def master_state(programs):
    import rosgraph
    return ros_call(programs, lambda: rosgraph.Master("/bench").getSystemState())


def nodes_of(state, topic):
    return [node for name, nodes in state if name == topic for node in nodes]


def connections(pid):
    """Open files: a connection for each topic that somebody is subscribed to, and the rest."""
    return len(os.listdir("/proc/%d/fd" % pid))


def load_nodelet(programs, manager, name, kind, **parameters):
    import rospy
    from nodelet.srv import NodeletLoad

    def call():
        for key, value in parameters.items():
            rospy.set_param("%s/%s" % (name, key), value)
        rospy.wait_for_service(manager + "/load_nodelet", 60)
        answer = rospy.ServiceProxy(manager + "/load_nodelet", NodeletLoad)(
            name=name, type=kind, remap_source_args=[], remap_target_args=[], my_argv=[],
            bond_id="")
        if not answer.success:
            raise RuntimeError("%s was not loaded" % name)
    ros_call(programs, call)


def set_up(programs, args, program, nodelets, times, count, subscription, port, vehicles=0):
    """Starts program and subscriber; returns the process whose cost counts, and the bag's."""
    bag = None
    if nodelets:
        process = programs.start(NODELET, "manager", "__name:=manager")
        if program == "driver":
            load_nodelet(programs, "/manager", "/driver", "frontseat_driver/NmeaNodelet",
                         host="127.0.0.1", port=port)
        else:
            load_nodelet(programs, "/manager", "/driver", "frontseat_driver_bench/Bare", port=port)
    else:
        process = programs.start(executable("nmea_node" if program == "driver" else "bench_bare"),
                                 "__name:=driver", "_host:=127.0.0.1", "_port:=%d" % port)
    if subscription in ("bag", "rx bag"):
        bag = os.path.join(args.directory, "all.bag")
        topics = "-a" if subscription == "bag" else "/nmea/rx"
        programs.start("rosbag", "record", topics, "-O", bag, "--tcpnodelay", "-b", "0",
                       "__name:=recorder")
    everything = subscription == "all" and program == "driver"
    if nodelets and bag is None:
        load_nodelet(programs, "/manager", "/subscriber", "frontseat_driver_bench/Subscriber",
                     times=times, count=count, all=everything, vehicles=vehicles)
    else:
        programs.start(executable("bench_subscriber"), "__name:=subscriber", "_times:=" + times,
                       "_count:=%d" % count, "_all:=%s" % str(everything).lower())
    report(programs)
    return process, bag


def settle(process):
    """Until nothing connects any more: the subscribers are there and the start is over."""
    files = []

    def calm():
        files.append(connections(process.pid))
        time.sleep(0.1)
        return len(files) > 10 and max(files[-10:]) - min(files[-10:]) <= 3
    wait_until(calm, "the subscribers")


def one_run(args, program, nodelets, rate, subscription, bundle=1, seconds=None, count=None):
    times = os.path.join(args.directory, "times")
    if os.path.exists(times):
        os.remove(times)
    seconds = seconds or args.seconds
    count = count or max(int((rate or 50000) * seconds), 20)
    mix = subscription != "odom"
    programs = Programs()
    try:
        programs.start("rosmaster", "--core", "-p", programs.master_port)
        wait_until(lambda: is_up(programs), "the master")
        options = dict(rate=rate, count=count, bundle=bundle)
        if mix:
            options["mix"] = True
        vehicle = Vehicle(programs, times, **options)
        process, bag = set_up(programs, args, program, nodelets, times, count, subscription,
                              vehicle.port)
        if vehicle.line() != "connected":
            raise RuntimeError("the program did not connect")
        settle(process)
        report(programs)
        before, began, memory = cpu_s(process.pid), time.monotonic(), memory_mib(process.pid)
        wrote = vehicle.go()
        took = time.monotonic() - began
        received = {"odom": 0}
        seen = {"odom": -1}

        def all_there():
            seen.update(received)
            part = report(programs)
            for key in ("p50_us", "p99_us", "max_us"):
                received.setdefault(key, part.get(key))
            received["odom"] += part["odom"]
            received["disorder"] = received.get("disorder", 0) + part["disorder"]
            topics = received.setdefault("topics", {})
            for name, messages in part["topics"].items():
                topics[name] = topics.get(name, 0) + messages
            time.sleep(0.2)
            return seen["odom"] == received["odom"]
        wait_until(all_there, "the last message")
        used = cpu_s(process.pid) - before
        result = dict(
            program=program, setup="nodelet" if nodelets else "node", rate=rate, bundle=bundle,
            subscribed=subscription, sentences=count, cpu_us=used / count * 1e6,
            wrote=wrote, seconds=took, memory_mib=memory_mib(process.pid),
            memory_before_mib=memory, threads=threads(process.pid), **received)
        if bag:
            recorder = programs.running[-2]
            programs.end(recorder)
            wait_until(lambda: os.path.exists(bag), "the end of the record", 300.0)
            result["bag"] = read_bag(bag)
            os.remove(bag)
        print(json.dumps(result), flush=True)
        return result
    finally:
        programs.end_all()


def is_up(programs):
    try:
        master_state(programs)
        return True
    except Exception:  # noqa: whatever the library throws while nobody listens
        return False


def read_bag(path):
    """How many of each topic, and whether nmea/rx has every position in order."""
    import rosbag
    last, disorder, missing = -1.0, 0, 0
    with rosbag.Bag(path) as bag:
        topics = bag.get_type_and_topic_info().topics
        counts = {topic: of_topic.message_count for topic, of_topic in topics.items()}
        for _, message, _ in bag.read_messages("/nmea/rx"):
            if "NVG" in message.sentence:
                number = float(message.sentence.split(",")[8])
                step = number - last
                disorder += step <= 0
                missing += last >= 0 and step > 2
                last = number
    return dict(counts=counts, disorder=disorder, gaps=missing)


def medians(runs, key):
    return statistics.median(run[key] for run in runs if run.get(key) is not None)


def table(title, runs):
    print("\n%s\n\n| set-up | sentences/s | subscribed | program | p50 µs | p99 µs | max µs | "
          "CPU µs per sentence |\n| --- | --- | --- | --- | --- | --- | --- | --- |" % title)
    kinds = sorted({(r["setup"], r["rate"], r["subscribed"]) for r in runs})
    for setup, rate, subscribed in kinds:
        for program in ("bare", "driver"):
            same = [r for r in runs if (r["setup"], r["rate"], r["subscribed"], r["program"]) ==
                    (setup, rate, subscribed, program)]
            if same:
                print("| %s | %s | %s | %s | %.0f | %.0f | %.0f | %.1f |" % (
                    setup, "%g" % rate if rate else "flat out", subscribed, program,
                    medians(same, "p50_us"), medians(same, "p99_us"), medians(same, "max_us"),
                    medians(same, "cpu_us")))


def latency(args):
    runs = []
    for nodelets in (False, True):
        for rate in args.rates:
            for _ in range(args.repeats if rate == 1000 else 1):
                for program in ("bare", "driver"):
                    runs.append(one_run(args, program, nodelets, rate, "odom"))
    table("Only odom subscribed", runs)


def everything(args):
    runs = []
    for nodelets in (False, True):
        for subscription in ("all", "bag"):
            runs.append(one_run(args, "driver", nodelets, 1000, subscription))
    table("Everything subscribed, or recorded", runs)
    for run in runs:
        topics = run.get("bag", {}).get("counts") or dict(run["topics"], odom=run["odom"])
        messages = sum(n for topic, n in topics.items() if "rosout" not in topic)
        print("%s, %s: %.2f µs of CPU for each of %d messages" % (
            run["setup"], run["subscribed"], run["cpu_us"] * run["sentences"] / messages, messages))


def endurance(args):
    """20,000 sentences a second, to a subscriber of everything, to a record of the sentences, and to
    a record of everything."""
    for subscription in ("all", "rx bag", "bag"):
        run = one_run(args, "driver", False, 20000, subscription, bundle=20,
                      seconds=args.seconds, count=int(20000 * args.seconds))
        bag = run.get("bag", {})
        received = bag.get("counts", {}).get("/nmea/rx") or run["topics"].get("nmea/rx")
        print("20,000 sentences a second for %.0f s, %s: %d of %d in nmea/rx (the first is the "
              "greeting), %d out of order; memory %.1f -> %.1f MiB" % (
                  args.seconds, subscription, received, run["sentences"] + 1,
                  bag.get("disorder", run["disorder"]), run["memory_before_mib"],
                  run["memory_mib"]))


def fleet(args):
    rows = []
    for vehicles in args.vehicles:
        rows.append(one_fleet(args, vehicles))
    print("\n| vehicles | CPU %% of a core | CPU µs per sentence | MiB (PSS) | threads | p50 µs | p99 µs |"
          "\n| --- | --- | --- | --- | --- | --- | --- |".replace("%%", "%"))
    for r in rows:
        print("| %(vehicles)d | %(cpu_percent).1f | %(cpu_us).1f | %(memory_mib).1f | %(threads)d | "
              "%(p50_us).0f | %(p99_us).0f |" % r)


def one_fleet(args, vehicles):
    """Vehicles at field rates: position and velocity, imu and the rest, 20 sentences a second."""
    times = os.path.join(args.directory, "times")
    if os.path.exists(times):
        os.remove(times)
    rate, seconds = 20, args.seconds
    count = rate * int(seconds)
    programs = Programs()
    try:
        programs.start("rosmaster", "--core", "-p", programs.master_port)
        wait_until(lambda: is_up(programs), "the master")
        vehicle = Vehicle(programs, times, rate=rate, count=count, vehicles=vehicles, bundle=2,
                          mix=True)
        process = programs.start(NODELET, "manager", "__name:=manager")
        for i in range(vehicles):
            load_nodelet(programs, "/manager", "/v%d/driver" % i, "frontseat_driver/NmeaNodelet",
                         host="127.0.0.1", port=vehicle.port, odom_frame="v%d/odom" % i,
                         base_frame="v%d/base_link" % i,
                         silence_timeout=600.0)  # until all the others are loaded
        programs.start(executable("bench_subscriber"), "__name:=subscriber", "_times:=" + times,
                       "_count:=%d" % (count * vehicles), "_vehicles:=%d" % vehicles)
        report(programs)
        if vehicle.line() != "connected":
            raise RuntimeError("not all connected")
        settle(process)
        report(programs)
        before, began = cpu_s(process.pid), time.monotonic()
        vehicle.go()
        took, used = time.monotonic() - began, cpu_s(process.pid) - before
        result = dict(report(programs), vehicles=vehicles, cpu_percent=100.0 * used / took,
                      cpu_us=used / (count * vehicles) * 1e6, memory_mib=memory_mib(process.pid),
                      threads=threads(process.pid), sentences=count * vehicles)
        print(json.dumps(result), flush=True)
        return result
    finally:
        programs.end_all()


def idle(args):
    """What waiting costs without a link, beside a roscpp program that has nothing to do at all."""
    programs = Programs()
    try:
        programs.start("rosmaster", "--core", "-p", programs.master_port)
        wait_until(lambda: is_up(programs), "the master")
        processes = {
            "driver": programs.start(executable("nmea_node"), "__name:=driver",
                                     "_host:=127.0.0.1", "_port:=%d" % free_port()),
            "bare": programs.start(executable("bench_subscriber"), "__name:=subscriber",
                                   "_times:=" + os.path.join(args.directory, "times"))}
        wait_until(lambda: nodes_of(master_state(programs)[0], "/odom"), "the driver")
        for process in processes.values():
            settle(process)
        before = {name: cpu_s(process.pid) for name, process in processes.items()}
        began = time.monotonic()
        time.sleep(args.seconds)
        took = time.monotonic() - began
        for name, process in processes.items():
            print("no link, %s: %.3f %% of a core, %.1f MiB, %d threads" % (
                name, 100.0 * (cpu_s(process.pid) - before[name]) / took,
                memory_mib(process.pid), threads(process.pid)))
    finally:
        programs.end_all()


def start_up(args):
    times_s = {"bare node": [], "bare nodelet": [], "driver": []}
    for _ in range(args.repeats):
        for program in times_s:
            times_s[program].append(one_start(args, program))
    for program, values in times_s.items():
        print("%s: %.0f ms from process start to the first odom (median of %d)" % (
            program, 1e3 * statistics.median(values), len(values)))


def one_start(args, program):
    times = os.path.join(args.directory, "times")
    programs = Programs()
    try:
        programs.start("rosmaster", "--core", "-p", programs.master_port)
        wait_until(lambda: is_up(programs), "the master")
        vehicle = Vehicle(programs, times, rate=200, count=200 * 60)
        programs.start(executable("bench_subscriber"), "__name:=subscriber", "_times:=" + times,
                       "_count:=%d" % 12000)
        report(programs)
        command = {"driver": [executable("nmea_node")], "bare node": [executable("bench_bare")],
                   "bare nodelet": [NODELET, "standalone", "frontseat_driver_bench/Bare"]}
        began = time.monotonic()
        programs.start(*command[program], "__name:=driver", "_host:=127.0.0.1",
                       "_port:=%d" % vehicle.port)
        vehicle.line()
        vehicle.process.stdin.write("\n")
        vehicle.process.stdin.flush()
        wait_until(lambda: report(programs)["odom"] > 0, "the first odometry")
        return time.monotonic() - began
    finally:
        programs.end_all()


def main():
    kinds = dict(latency=latency, everything=everything, endurance=endurance, fleet=fleet,
                 idle=idle, start_up=start_up)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="+", choices=sorted(kinds))
    parser.add_argument("--seconds", type=float, default=3.0, help="of each run")
    parser.add_argument("--repeats", type=int, default=10, help="of each pair, in turns")
    parser.add_argument("--rates", type=float, nargs="+", default=[10, 100, 1000, 0],
                        help="sentences a second; 0: as fast as they are taken")
    parser.add_argument("--vehicles", type=int, nargs="+", default=[1, 10, 100, 300])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as args.directory:
        for kind in args.kinds:
            kinds[kind](args)


if __name__ == "__main__":
    sys.exit(main())
