#!/usr/bin/env python3
"""What a network does to a vehicle at sea, done to real programs. Run by `make netns-test`."""

import os
import signal
import subprocess
import sys
import time
import unittest

import rosgraph
import rospy
from frontseat_driver.msg import Drive, LinkStatus, Sentence
from nav_msgs.msg import Odometry

from driver_under_test import (PACKAGE, Collector, NodeDriver, Process, Publisher, Repeater,
                               program)
from fake_vehicle import wait_until
from network import (BACKSEAT, BACKSEAT_MOVED, TOPSIDE, VEHICLE, VEHICLE_MOVED, Network)

PORT = 29500
SILENCE_S = 2.0
LOST_S = SILENCE_S + 2.0  # until it must be known that the link is lost
BACK_S = 15.0  # until it must be back: an attempt may be under way, and addresses are learnt anew
COMMAND_RATE_HZ = 5.0
THRUST = Drive(left=0.4, right=0.4)


class Commanding(unittest.TestCase):
    """A driver and a simulated boat that lies still until it is commanded."""

    namespace = None

    @classmethod
    def setUpClass(cls):
        cls.start_boat()
        cls.driver = NodeDriver(cls.namespace, {
            "host": "vehicle", "port": PORT, "silence_timeout": SILENCE_S, "connect_timeout": 1.0,
            "reconnect_min": 0.1, "reconnect_max": 1.0})
        cls.links = Collector(cls.namespace + "/link", LinkStatus)
        cls.odometry = Collector(cls.namespace + "/odom", Odometry)
        cls.heard = Collector(cls.namespace + "/nmea/rx", Sentence)
        cls.sent = Collector(cls.namespace + "/nmea/tx", Sentence)
        cls.odometry.wait_for(5, BACK_S)

    @classmethod
    def tearDownClass(cls):
        cls.driver.stop()
        cls.boat.send_signal(signal.SIGKILL)
        cls.boat.wait()

    @classmethod
    def start_boat(cls):
        cls.boat = Process(NETWORK.vehicle.command(
            program(PACKAGE, "nmea_simulator"), "--no-ros", "--dialect=kingfisher",
            "--bind=0.0.0.0", "--port=%d" % PORT, "--loop_corners=[]", "--loop_speed=0",
            "--resume_loop=0"))

    def connected(self):
        return self.links.messages[-1].connected

    def command(self):
        """Until the boat moves; it is commanded until the test stops it or ends."""
        wait_until(self.connected, "a connection", BACK_S)
        repeater = Repeater(Publisher(self.namespace + "/cmd_drive", Drive), THRUST, 10.0)
        self.addCleanup(repeater.stop)
        wait_until(lambda: self.odometry.messages[-1].twist.twist.linear.x > 0.1, "motion", BACK_S)
        return repeater


class Faults(Commanding):
    """Each breaks the link in its way, sees that it is noticed in time, mends it, and sees that
    data are back, that nothing old is sent, and that the boat obeys again."""

    namespace = "/faults"

    def break_and_mend(self, break_link, mend):
        repeater = self.command()
        began = time.monotonic()
        break_link()
        wait_until(lambda: not self.connected(), "the loss", LOST_S)
        noticed_s = time.monotonic() - began
        repeater.stop()
        sent = len(self.sent.messages)
        began = time.monotonic()
        mend()
        wait_until(self.connected, "the connection", BACK_S)
        back_s = time.monotonic() - began
        self.odometry.wait_for(len(self.odometry.received) + 10, BACK_S)
        old = [line.sentence for line in self.sent.messages[sent:]
               if line.sentence.startswith("$PY") and not line.sentence.startswith("$PYDIR,0,0*")]
        self.assertEqual([], old)
        self.command().stop()
        print("  %-48s noticed after %4.1f s, back after %4.1f s"
              % (self.id().split(".test_")[1].replace("_", " "), noticed_s, back_s), flush=True)

    def test_cable_pulled_at_the_vehicle(self):
        self.break_and_mend(lambda: NETWORK.cable.set(0, "down"),
                            lambda: NETWORK.cable.set(0, "up"))

    def test_interface_down_and_up_at_the_backseat(self):
        self.break_and_mend(lambda: NETWORK.cable.set(1, "down"),
                            lambda: NETWORK.cable.set(1, "up"))

    def test_route_dropped(self):
        route = ("blackhole", VEHICLE + "/32")
        self.break_and_mend(lambda: NETWORK.backseat.ip("route", "add", *route),
                            lambda: NETWORK.backseat.ip("route", "del", *route))

    def test_address_of_the_backseat_changes(self):
        for old, new in ((BACKSEAT, BACKSEAT_MOVED), (BACKSEAT_MOVED, BACKSEAT)):
            self.break_and_mend(lambda: self.move(NETWORK.backseat, old, new), lambda: None)

    def test_address_of_the_vehicle_changes(self):
        for old, new in ((VEHICLE, VEHICLE_MOVED), (VEHICLE_MOVED, VEHICLE)):
            self.break_and_mend(lambda: self.move(NETWORK.vehicle, old, new),
                                lambda: NETWORK.backseat.hosts(vehicle=new))

    @staticmethod
    def move(namespace, old, new):
        # In this order: with its first address a network's others go too.
        namespace.ip("address", "del", old + "/24", "dev", "eth0")
        namespace.ip("address", "add", new + "/24", "dev", "eth0")

    def test_small_packets(self):
        self.command()
        connects = self.links.messages[-1].connects
        NETWORK.cable.both("mtu", "576")
        self.addCleanup(NETWORK.cable.both, "mtu", "1500")
        self.heard.wait_for(len(self.heard.received) + 200, BACK_S)
        self.assertEqual(connects, self.links.messages[-1].connects)
        print("  %-48s nothing to notice" % "packets of 576 bytes", flush=True)

    def test_vehicle_computer_hangs(self):
        self.break_and_mend(lambda: self.boat.send_signal(signal.SIGSTOP),
                            lambda: self.boat.send_signal(signal.SIGCONT))

    def test_vehicle_program_is_killed_and_restarted(self):
        self.break_and_mend(lambda: self.boat.send_signal(signal.SIGKILL), type(self).start_boat)


class Topside(Commanding):
    """A computer on deck that records everything hangs, then vanishes: nobody notices."""

    namespace = "/topside"
    WATCH_S = 8.0
    MOST_GAP_S = 0.5  # odometry comes ten times a second; the rest is for a busy computer

    def test_recorder_hangs_and_vanishes(self):
        self.command()
        for namespace in (NETWORK.backseat, NETWORK.topside):
            namespace.small_buffers()
        self.watch("no recorder")
        recorder = subprocess.Popen(
            NETWORK.topside.command(program("rosbag", "record"), "-a", "-O", self.bag(), "--quiet"),
            env=dict(os.environ, ROS_IP=TOPSIDE), stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL)
        self.addCleanup(recorder.wait)
        self.addCleanup(recorder.kill)
        wait_until(self.recorded, "the recorder", BACK_S)
        self.watch("a recorder at work")
        recorder.send_signal(signal.SIGSTOP)
        self.watch("a recorder that hangs")
        self.assertGreater(self.waiting_bytes(), 4096, "nothing waits for the recorder")
        NETWORK.tether.set(1, "down")
        self.addCleanup(NETWORK.tether.set, 1, "up")
        self.watch("topside gone")

    def bag(self):
        path = os.path.join(os.environ["ROS_LOG_DIR"], "topside-%d.bag" % os.getpid())
        self.addCleanup(lambda: [os.remove(path + end) for end in ("", ".active")
                                 if os.path.exists(path + end)])
        return path

    def recorded(self):
        subscribers = rosgraph.Master(rospy.get_name()).getSystemState()[1]
        return any(topic == self.namespace + "/nmea/rx" and any("record" in node for node in nodes)
                   for topic, nodes in subscribers)

    @staticmethod
    def waiting_bytes():
        """That the backseat has sent to the topside and that nobody read."""
        sockets = subprocess.check_output(NETWORK.backseat.command("ss", "-tnH", "dst", TOPSIDE))
        return sum(int(line.split()[2]) for line in sockets.decode().splitlines())

    def watch(self, what):
        """For a while: odometry comes, commands go, and no sentence is lost."""
        odometry, sent, heard = (len(topic.received)
                                 for topic in (self.odometry, self.sent, self.heard))
        end = time.monotonic() + self.WATCH_S
        wait_until(lambda: time.monotonic() > end, "the end", 2 * self.WATCH_S)
        times = [at for at, _ in self.odometry.received[odometry:]]
        gap_s = max(later - earlier for earlier, later in zip(times, times[1:]))
        commands = [at for at, line in self.sent.received[sent:]
                    if line.sentence.startswith("$PYDIR,40,40*")]
        numbers = [line.header.seq for _, line in self.heard.received[heard:]]
        print("  %-48s longest gap %.3f s, %d commands, %d sentences"
              % (what, gap_s, len(commands), len(numbers)), flush=True)
        self.assertLess(gap_s, self.MOST_GAP_S)
        self.assertGreater(len(commands), 0.8 * COMMAND_RATE_HZ * self.WATCH_S)
        self.assertEqual(list(range(numbers[0], numbers[0] + len(numbers))), numbers)


if __name__ == "__main__":
    NETWORK = Network(sys.argv.pop(1))
    rospy.init_node("netns_test", disable_signals=True)
    result = unittest.main(exit=False, warnings="ignore").result
    if not result.wasSuccessful():
        for process in Process.started:
            print("\n".join([" ".join(process.command)] + process.output[-20:]), flush=True)
    sys.exit(not result.wasSuccessful())
