#!/usr/bin/env python3
"""What a Blueye at full rate costs and whether any message is lost: blueye_load.py --help

Ten kinds of telemetry at 100 Hz, the fastest that a drone is asked for, and sonar images of 1.05 MB
at 20 Hz from blueye_simulator; blueye_node, or a bare program that publishes what comes over ZeroMQ
and looks into nothing; a subscriber that counts, or rosbag. One JSON object for each run, then a
table; doc/performance.md explains it.
"""

import argparse
import json
import os
import signal
import subprocess
import struct
import sys
import tempfile
import time

from end_to_end import Programs, cpu_s, executable, is_up, memory_mib, ros_call, settle, wait_until

KINDS = ("AltitudeTel", "AttitudeTel", "CalibratedImuTel", "ControlForceTel", "DepthTel",
         "DvlVelocityTel", "Imu1Tel", "Imu2Tel", "PositionEstimateTel", "ReferenceTel")
RATE_HZ, IMAGES_HZ, SIDE = 100, 20, 1024
PORTS = ("telemetry_port", "request_port", "control_port")
TELEMETRY = "/blueye/telemetry"


def set_parameters(programs, node, **parameters):
    import rospy
    ros_call(programs, lambda: [rospy.set_param("%s/%s" % (node, name), value)
                                for name, value in parameters.items()])


def start_drone(programs):
    """The simulator and its ports."""
    import rospy
    set_parameters(programs, "/drone", **dict(
        {port: 0 for port in PORTS}, http=False, rates={kind: RATE_HZ for kind in KINDS},
        multibeam_active=True, multibeam_beams=SIDE, multibeam_ranges=SIDE,
        multibeam_rate=IMAGES_HZ))
    drone = programs.start(executable("blueye_simulator"), "__name:=drone")
    ports = {}

    def known():
        ports.update({port: ros_call(programs, lambda port=port: rospy.get_param(
            "/drone/actual_" + port, 0)) for port in PORTS})
        return all(ports.values())
    wait_until(known, "the simulator")
    return drone, ports


def start_program(programs, program, ports):
    if program == "driver":
        set_parameters(programs, "/driver", host="127.0.0.1", **ports)
    else:
        set_parameters(programs, "/driver", telemetry_port=ports["telemetry_port"])
    return programs.start(executable("blueye_node" if program == "driver" else "bench_blueye_bare"),
                          "__name:=driver")


def start_recorder(programs, bag, topics):
    """Records from before the program is there, so that nothing of its first words is missed."""
    import rosgraph
    if topics:
        words = ["rosbag", "record", "-O", bag, "--tcpnodelay", "-b", "0", "__name:=recorder"]
        recorder = programs.start(*words + topics)
    else:
        recorder = programs.start(sys.executable, os.path.abspath(__file__), "--count",
                                  stdout=subprocess.PIPE)
    wanted = "/rosout" if topics == ["-a"] else TELEMETRY

    def subscribed():
        state = ros_call(programs, rosgraph.Master("/bench").getSystemState)
        return any(topic == wanted and {"/recorder", "/counter"} & set(nodes)
                   for topic, nodes in state[1])
    wait_until(subscribed, "the recorder")
    return recorder


def count():
    """Counts telemetry without a limit to its queue; tells it, and what the driver counted, at the
    end."""
    import rospy
    from diagnostic_msgs.msg import DiagnosticArray
    rospy.init_node("counter", disable_signals=True)
    kinds, stamps, counted = {}, [], {}

    def take(message):  # header: seq, stamp, frame; then the name of the type
        buffer = message._buff
        seconds, nanoseconds, frame = struct.unpack_from("<III", buffer, 4)
        size = struct.unpack_from("<I", buffer, 16 + frame)[0]
        kind = buffer[20 + frame:20 + frame + size].decode().split(".")[-1]
        kinds[kind] = kinds.get(kind, 0) + 1
        stamps.append(seconds + 1e-9 * nanoseconds)

    rospy.Subscriber(TELEMETRY, rospy.AnyMsg, take, buff_size=1 << 24, tcp_nodelay=True)
    rospy.Subscriber("/diagnostics", DiagnosticArray,
                     lambda message: counted.update(link_values(message)))
    signal.sigwait([signal.SIGINT])
    print(json.dumps(summary(kinds, stamps, counted)), flush=True)


def link_values(message):
    return {value.key: int(value.value) for status in message.status
            if status.name.endswith(": link") for value in status.values}


def summary(kinds, stamps, counted):
    return dict(kinds=kinds, messages=len(stamps), took=stamps[-1] - stamps[0], counted=counted,
                disorder=sum(b < a for a, b in zip(stamps, stamps[1:])))


def read_bag(path):
    """Messages by topic and kind, how long telemetry came, and the driver's last count of them."""
    import rosbag
    kinds, stamps, counted = {}, [], {}
    with rosbag.Bag(path) as bag:
        topics = {name: topic.message_count
                  for name, topic in bag.get_type_and_topic_info().topics.items()}
        for topic, message, _ in bag.read_messages([TELEMETRY, "/diagnostics"]):
            if topic == "/diagnostics":
                counted.update(link_values(message))
                continue
            kind = message.type.split(".")[-1]
            kinds[kind] = kinds.get(kind, 0) + 1
            stamps.append(message.header.stamp.to_sec())
    return dict(summary(kinds, stamps, counted), topics=topics)


def one_run(args, program, recorded):
    bag = os.path.join(args.directory, "load.bag")
    programs = Programs()
    try:
        programs.start("rosmaster", "--core", "-p", programs.master_port)
        wait_until(lambda: is_up(programs), "the master")
        topics = {"counted": [], "telemetry": [TELEMETRY, "/diagnostics"], "everything": ["-a"]}
        recorder = None
        if recorded != "nothing":
            recorder = start_recorder(programs, bag, topics[recorded])
        drone, ports = start_drone(programs)
        process = start_program(programs, program, ports)
        settle(process)
        memory, before, began = memory_mib(process.pid), cpu_s(process.pid), time.monotonic()
        time.sleep(args.seconds)
        used, took = cpu_s(process.pid) - before, time.monotonic() - began
        result = dict(program=program, recorded=recorded, cpu_percent=100.0 * used / took,
                      memory_before_mib=memory, memory_mib=memory_mib(process.pid))
        programs.end(drone)
        time.sleep(3.0)  # the driver counts what it has heard once a second
        if recorded == "counted":
            recorder.send_signal(signal.SIGINT)
            result.update(json.loads(recorder.stdout.readline()))
        elif recorder:
            programs.end(recorder)
            wait_until(lambda: os.path.exists(bag), "the end of the record", 300.0)
            result.update(read_bag(bag))
            os.remove(bag)
        print(json.dumps(result), flush=True)
        return result
    finally:
        programs.end_all()


def rate(run):
    return run["messages"] / run["took"]


def table(runs):
    print("\n| program | telemetry is | messages/s | images/s | heard by the driver | arrived | "
          "of all topics | CPU, % of a core | MiB (PSS), start and end |\n" +
          "| --- " * 9 + "|")
    for run in runs:
        print("| %s | %s | %s | %s | %s | %s | %s | %.1f | %.1f, %.1f |" % (
            run["program"], run["recorded"],
            "%.0f" % rate(run) if "messages" in run else "",
            "%.1f" % (run["kinds"]["MultibeamPingTel"] / run["took"]) if "kinds" in run else "",
            (run.get("counted") or {}).get("telemetry messages", ""), run.get("messages", ""),
            sum(run["topics"].values()) if "topics" in run else "",
            run["cpu_percent"], run["memory_before_mib"], run["memory_mib"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0, help="of each run")
    parser.add_argument("--repeats", type=int, default=1, help="of all, in turns")
    parser.add_argument("--count", action="store_true", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.count:
        # Before any thread begins, so that all of them leave it to sigwait().
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        return count()
    runs = []
    with tempfile.TemporaryDirectory() as args.directory:
        for _ in range(args.repeats):
            for program, recorded in (
                    ("bare", "counted"), ("driver", "counted"), ("driver", "nothing"),
                    ("bare", "telemetry"), ("driver", "telemetry"), ("driver", "everything")):
                runs.append(one_run(args, program, recorded))
    table(runs)


if __name__ == "__main__":
    sys.exit(main())
