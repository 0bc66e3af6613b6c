#!/usr/bin/env python3
"""The examples drive a Blueye, one of them without knowing it, and leave it safe however they end."""

import math
import signal
import sys
import time
import unittest

import rospy
import rostest
from frontseat_driver.msg import BlueyeMessage, ControlStatus
from nav_msgs.msg import Odometry

from examples_test import PACKAGE, PATIENCE_S, SLACK_S, STALE_S, start, wait_for

SPEED = 3          # seconds of the drone per second
WATCHDOG_S = 9     # of the drone: the driver's watchdog goes by real seconds
SIDE_M, DEPTH_M = 5.0, 2.0
NEAR_M = 1.8       # arrival counts from 1.5 m on, by an estimate that drifts
PORTS = ("telemetry_port", "request_port", "control_port")


class Drone:
    """A simulated Blueye with its driver, and an example that runs it."""

    def __init__(self, namespace, observer, example, *arguments):
        self.namespace, self.example, self.arguments = namespace, example, arguments
        self.track = []   # time, x, y, depth, speed: the truth
        self.sent = []    # time, name of a control message
        self.granted = None
        place = "__ns:=" + namespace
        for topic, kind, take in (("simulator/odom", Odometry, self._moved),
                                  ("blueye/control_out", BlueyeMessage, self._sent),
                                  ("control", ControlStatus, self._control)):
            rospy.Subscriber(namespace + "/" + topic, kind, take, tcp_nodelay=True)
        self.processes = [start("blueye_simulator", place, "__name:=simulator",
                                "_speed:=%d" % SPEED, "_watchdog_timeout:=%d" % WATCHDOG_S,
                                "_http:=false", *["_%s:=0" % port for port in PORTS])]
        actual = namespace + "/simulator/actual_"
        wait_for(lambda: rospy.has_param(actual + PORTS[0]), "the simulator's ports")
        self.processes.append(start(
            "blueye_node", place, "__name:=driver", "_host:=127.0.0.1",
            "_observer:=%s" % str(observer).lower(),
            *["_%s:=%d" % (port, rospy.get_param(actual + port)) for port in PORTS]))

    def _moved(self, odom):
        at, way = odom.pose.pose.position, odom.twist.twist.linear
        speed = math.sqrt(way.x ** 2 + way.y ** 2 + way.z ** 2)
        self.track.append((time.monotonic(), at.x, at.y, -at.z, speed))

    def _sent(self, message):
        self.sent.append((time.monotonic(), message.type.rpartition(".")[2]))

    def _control(self, control):
        self.granted = control.grant == ControlStatus.GRANTED

    def run(self):
        wait_for(lambda: self.track, self.namespace + " to live")
        self.started = time.monotonic()
        self.program = start(self.example, "__ns:=" + self.namespace, *self.arguments)

    def run_until_it_moves(self):
        self.run()
        wait_for(lambda: self.track[-1][4] > 0.2, self.namespace + " to be driven")

    def end_by(self, number):
        self.program.send_signal(number)
        self.program.wait(PATIENCE_S)

    def arrival(self, x, y, since):
        """When it first came near a point between `since` and the end of the program; or None."""
        for at, px, py, _, _ in list(self.track):
            if since <= at <= self.ended and math.hypot(px - x, py - y) < NEAR_M:
                return at
        return None

    def stop(self):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGINT)
        for process in self.processes:
            process.wait(PATIENCE_S)


class BlueyeExamples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.dive = Drone("/dive", True, "blueye_dive.py", "_side:=%.1f" % SIDE_M,
                         "_depth:=%.1f" % DEPTH_M)
        cls.square = Drone("/square", False, "kingfisher_square.py", "_side:=%.1f" % SIDE_M,
                           "_speed:=0.5")
        cls.all = (cls.dive, cls.square)
        for drone in cls.all:
            drone.run()
            drone.began = drone.started
        for drone in cls.all:
            drone.exit_code = drone.program.wait(2 * PATIENCE_S)
            drone.ended = time.monotonic()

    @classmethod
    def tearDownClass(cls):
        for drone in cls.all:
            drone.stop()

    def visits(self, drone, points):
        self.assertEqual(0, drone.exit_code)
        since = drone.began
        for x, y in points:
            since = drone.arrival(x, y, since)
            self.assertIsNotNone(since, "%s: %.1f, %.1f" % (drone.namespace, x, y))
        return since

    def test_dive(self):
        drone, s = self.dive, SIDE_M
        # The bow is north: ahead, to starboard, back, home.
        deep = [point for point in drone.track if point[3] > DEPTH_M]
        last = self.visits(drone, ((0.0, s), (s, s), (s, 0.0), (0.0, 0.0)))
        depths = [depth for at, _, _, depth, _ in drone.track if deep[0][0] + 1.0 < at < last]
        # Where the program was held up on the way down, the drone comes back from deeper.
        held = [depth for depth in depths if abs(depth - DEPTH_M) < 0.6]
        self.assertGreater(len(held), 0.9 * len(depths), depths)
        names = [name for _, name in drone.sent]
        self.assertEqual(1, names.count("TakePictureCtrl"))
        up = [depth for at, _, _, depth, _ in drone.track if last < at <= drone.ended]
        self.assertLess(min(up), 0.5)

    def test_square_does_not_know_what_it_drives(self):
        s = SIDE_M
        self.visits(self.square, ((s, 0.0), (s, s), (0.0, s), (0.0, 0.0)))

    def test_interrupted_they_stop_it_and_the_dive_gives_control_back(self):
        for drone in self.all:
            drone.run_until_it_moves()
            drone.end_by(signal.SIGINT)
            wait_for(lambda: drone.track[-1][4] < 0.1, "the drone to lie still")
        wait_for(lambda: self.dive.granted is False, "control to be given back")

    def test_killed_they_are_stopped_by_the_driver(self):
        for drone in self.all:
            drone.run_until_it_moves()
            drone.end_by(signal.SIGKILL)
            wait_for(lambda: drone.track[-1][4] < 0.1, "the drone to lie still",
                     PATIENCE_S + STALE_S + SLACK_S)


if __name__ == "__main__":
    rospy.init_node("blueye_examples_test")
    rostest.rosrun(PACKAGE, "blueye_examples", BlueyeExamples, sys.argv)
