#!/usr/bin/env python3
"""Hours of a commanded boat behind a link that breaks, recorded by rosbag: soak.py HOURS REPORT.

At the end nothing has grown, and no sentence is missing but those that the faults cost. Writes
REPORT.md and REPORT.png.
"""

import collections
import os
import random
import signal
import subprocess
import sys
import threading
import time

import rosbag
import rosgraph
import rospy
from frontseat_driver.msg import Drive, LinkStatus

from driver_under_test import (PACKAGE, Collector, Manager, NodeletDriver, Process, Publisher,
                               Repeater, Usage, program)
from fake_vehicle import wait_until
from fault_proxy import FaultProxy

NAMESPACE = "/soak"
FAULT_EVERY_S = 20.0  # on average, from the end of one to the beginning of the next
MOST_FAULT_S = 8.0
SAMPLE_S = 5.0
WARM_UP_S = 60.0
MORE_KIB, MORE_THREADS, MORE_FILES = 2048, 0, 6
SEED = 2026


def start_boat(port):
    boat = Process([program(PACKAGE, "nmea_simulator"), "--no-ros", "--dialect=kingfisher",
                    "--port=%d" % port, "--loop_corners=[]", "--resume_loop=0"])
    return boat


def free_port():
    import socket
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


class Soak:
    def __init__(self, hours, report):
        self.seconds = hours * 3600.0
        self.report = report
        self.random = random.Random(SEED)
        self.samples = []  # time, Usage, connects
        self.boat_port = free_port()
        self.boat = start_boat(self.boat_port)
        self.proxy = FaultProxy(self.boat_port, SEED)
        self.manager = Manager(NAMESPACE + "_manager")
        self.driver = NodeletDriver(NAMESPACE, {
            "host": "127.0.0.1", "port": self.proxy.port, "dialect": "kingfisher",
            "silence_timeout": 3.0, "reconnect_min": 0.1, "reconnect_max": 1.0}, self.manager)
        self.links = Collector(NAMESPACE + "/link", LinkStatus)
        self.links.wait_until(lambda link: link.connected)
        self.bag = report + ".bag"
        self.recorder = subprocess.Popen(
            [program("rosbag", "record"), "-O", self.bag, "-b", "0", "--tcpnodelay"]
            + [NAMESPACE + "/" + topic for topic in ("nmea/rx", "nmea/tx", "odom", "imu/data",
                                                     "link", "control", "battery")],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        wait_until(self.recording, "the recorder")
        self.recording_since = time.monotonic() + 1.0
        self.commands = Repeater(Publisher(NAMESPACE + "/cmd_drive", Drive),
                                 Drive(left=0.3, right=0.25), 5.0)
        self.sampling = threading.Thread(target=self.sample, daemon=True)
        self.ended = threading.Event()

    @staticmethod
    def recording():
        subscribers = rosgraph.Master(rospy.get_name()).getSystemState()[1]
        return any(topic == NAMESPACE + "/nmea/rx" and any("record" in node for node in nodes)
                   for topic, nodes in subscribers)

    def sample(self):
        began = time.monotonic()
        while not self.ended.wait(SAMPLE_S):
            self.samples.append((time.monotonic() - began, Usage(self.manager.process.pid),
                                 self.links.messages[-1].connects))

    def run(self):
        self.began = time.monotonic()
        self.sampling.start()
        self.pause(WARM_UP_S)
        while time.monotonic() - self.began < self.seconds - 30.0:
            self.break_something()
            self.pause(self.random.expovariate(1.0 / FAULT_EVERY_S) + 2.0)
        self.pause(max(10.0, self.seconds - (time.monotonic() - self.began)))
        self.ended.set()
        self.sampling.join()

    @staticmethod
    def pause(seconds):
        threading.Event().wait(seconds)

    def break_something(self):
        kind = self.random.choice(FaultProxy.KINDS + ("vehicle frozen", "vehicle restarted"))
        seconds = self.random.uniform(0.1, MOST_FAULT_S)
        wait = self.pause
        if kind == "vehicle frozen":
            wait = self.frozen
        if kind == "vehicle restarted":
            wait = self.restarted
        self.proxy.fault(kind, seconds, wait)
        link = len(self.links.received)
        self.links.wait_for(link + 1, 60.0)
        wait_until(lambda: self.links.messages[-1].connected, "the link after " + kind, 60.0)

    def frozen(self, seconds):
        self.boat.send_signal(signal.SIGSTOP)
        self.pause(seconds)
        self.boat.send_signal(signal.SIGCONT)

    def restarted(self, seconds):
        self.boat.send_signal(signal.SIGKILL)
        self.boat.wait()
        self.pause(seconds)
        self.boat = start_boat(self.boat_port)

    def stop(self):
        self.commands.stop()
        self.recording_until = time.monotonic()
        self.pause(2.0)
        self.recorder.send_signal(signal.SIGINT)
        self.recorder.wait(60.0)
        self.driver.unload()
        self.manager.stop()
        self.proxy.stop()
        self.boat.send_signal(signal.SIGKILL)
        self.boat.wait()

    def missing(self):
        """Undisturbed lines that are not in the bag, in order; and how many there were."""
        with rosbag.Bag(self.bag) as bag:
            recorded = collections.deque(message.sentence.encode("ascii", "replace") for _, message, _
                                         in bag.read_messages([NAMESPACE + "/nmea/rx"]))
        total = len(recorded)
        undisturbed = self.proxy.undisturbed(self.recording_since, self.recording_until)
        missing = []
        for line in undisturbed:
            skipped = []
            while recorded and recorded[0] != line:
                skipped.append(recorded.popleft())
            if recorded:
                recorded.popleft()
            else:
                missing.append(line)
                recorded.extend(skipped)
        return missing, len(undisturbed), total

    def judge(self):
        """What is not as it should be, and the report."""
        missing, undisturbed, recorded = self.missing()
        warm = [usage for at, usage, _ in self.samples if at > WARM_UP_S]
        first, last = warm[0], warm[-1]
        kinds = collections.Counter(fault.kind for fault in self.proxy.faults)
        rows = [
            ("time", "%.2f h" % (self.seconds / 3600.0)),
            ("faults", "%d: %s" % (sum(kinds.values()), ", ".join(
                "%s %d" % item for item in sorted(kinds.items())))),
            ("connections", str(self.samples[-1][2])),
            ("sentences recorded", str(recorded)),
            ("of them outside faults", "%d, missing %d" % (undisturbed, len(missing))),
            ("memory, KiB", "%d, at the end %d" % (first.memory_kib, last.memory_kib)),
            ("threads", "%d, at the end %d" % (first.threads, last.threads)),
            ("open files", "%d, at the end %d" % (first.files, last.files)),
        ]
        with open(self.report + ".md", "w", encoding="ascii") as out:
            out.write("| figure | value |\n| --- | --- |\n")
            out.writelines("| %s | %s |\n" % row for row in rows)
        for row in rows:
            print("%-24s %s" % row)
        faults = []
        if missing:
            faults.append("%d sentences are missing, the first: %s" % (len(missing), missing[0]))
        if last.memory_kib > first.memory_kib + MORE_KIB:
            faults.append("memory grew")
        if last.threads > first.threads + MORE_THREADS:
            faults.append("threads were left")
        if last.files > first.files + MORE_FILES:
            faults.append("files were left open")
        return faults

    def plot(self):
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
        figure, axes = pyplot.subplots(3, 1, sharex=True, figsize=(10, 7))
        minutes = [at / 60.0 for at, _, _ in self.samples]
        rows = (("memory, MiB", [usage.memory_kib / 1024.0 for _, usage, _ in self.samples]),
                ("threads, files", [usage.threads for _, usage, _ in self.samples]),
                ("connections", [connects for _, _, connects in self.samples]))
        for axis, (label, values) in zip(axes, rows):
            axis.plot(minutes, values)
            axis.set_ylabel(label)
            axis.grid(alpha=0.3)
            for fault in self.proxy.faults:
                axis.axvspan((fault.began - self.began) / 60.0, (fault.ended - self.began) / 60.0,
                             color="tab:red", alpha=0.15, linewidth=0)
        threads = axes[1].get_lines()[0]
        files, = axes[1].plot(minutes, [usage.files for _, usage, _ in self.samples], "--")
        axes[1].legend([threads, files], ["threads", "open files"])
        axes[-1].set_xlabel("minutes; faults are shaded")
        figure.savefig(self.report + ".png", dpi=80, bbox_inches="tight")


def main():
    hours, report = float(sys.argv[1]), sys.argv[2]
    os.makedirs(os.path.dirname(report), exist_ok=True)
    rospy.init_node("soak", disable_signals=True)
    soak = Soak(hours, report)
    try:
        soak.run()
    finally:
        soak.stop()
    faults = soak.judge()
    soak.plot()
    print("\n".join(faults) or "soak: nothing grew and nothing was lost")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
