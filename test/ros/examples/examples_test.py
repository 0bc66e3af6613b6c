#!/usr/bin/env python3
"""The example programs do what they say, and leave the vehicle safe however they end."""

import math
import signal
import subprocess
import sys
import time
import unittest

import roslib.packages
import rospy
import rostest
from frontseat_driver.msg import ControlStatus, Sentence
from nav_msgs.msg import Odometry

PACKAGE = "frontseat_driver"
SPEED = 4            # seconds of the vehicle per second
CORNER_M = 2.0       # arrival counts from 1.5 m on, by a position with noise
PATIENCE_S = 40.0
STALE_S = 1.0        # command_timeout
SLACK_S = 0.5        # for a busy computer
SIDE_M = 10.0
DEPTH_M, LENGTH_M, SPACING_M = 3.0, 25.0, 10.0


def wait_for(condition, what, timeout_s=PATIENCE_S):
    end = time.monotonic() + timeout_s
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("waited %.1f s for %s" % (timeout_s, what))
        time.sleep(0.01)


def start(name, *arguments):
    path = roslib.packages.find_node(PACKAGE, name)[0]
    return subprocess.Popen([path] + list(arguments), stdin=subprocess.DEVNULL)


class Vehicle:
    """A simulated vehicle with its driver, and an example that runs it."""

    def __init__(self, namespace, dialect, example, *arguments):
        self.namespace, self.example, self.arguments = namespace, example, arguments
        self.track = []       # time, x, y, depth, speed ahead: the truth
        self.sent = []        # time, sentence
        self.commanding = []  # time, whether
        rospy.Subscriber(namespace + "/simulator/odom", Odometry, self._moved, tcp_nodelay=True)
        rospy.Subscriber(namespace + "/nmea/tx", Sentence, self._sent, tcp_nodelay=True)
        rospy.Subscriber(namespace + "/control", ControlStatus, self._control, tcp_nodelay=True)
        place = "__ns:=" + namespace
        self.processes = [start("nmea_simulator", place, "__name:=simulator", "_port:=0",
                                "_dialect:=" + dialect, "_speed:=%d" % SPEED,
                                "_loop_corners:=[]")]
        port = namespace + "/simulator/actual_port"
        wait_for(lambda: rospy.has_param(port), port)
        self.processes.append(start("nmea_node", place, "__name:=driver", "_host:=127.0.0.1",
                                    "_dialect:=" + dialect,
                                    "_port:=%d" % rospy.get_param(port)))

    def _moved(self, odom):
        at = odom.pose.pose.position
        self.track.append((time.monotonic(), at.x, at.y, -at.z, odom.twist.twist.linear.x))

    def _sent(self, line):
        self.sent.append((time.monotonic(), line.sentence))

    def _control(self, control):
        self.commanding.append((time.monotonic(), control.commanding))

    def run(self):
        wait_for(lambda: self.track, self.namespace + " to move")
        self.started = time.monotonic()
        self.program = start(self.example, "__ns:=" + self.namespace, *self.arguments)

    def commands(self, since):
        return [(at, line) for at, line in list(self.sent)
                if at >= since and line.startswith(("$PY", "$BPRMB"))]

    def run_until_it_moves(self):
        self.run()
        wait_for(lambda: len(self.commands(self.started)) > 5 and self.track[-1][4] > 0.4,
                 self.namespace + " to be driven")

    def end_by(self, number):
        """When it was, after the program has ended."""
        self.program.send_signal(number)
        ended = time.monotonic()
        self.program.wait(PATIENCE_S)
        return ended

    def silent_after(self, ended, within_s):
        wait_for(lambda: any(at > ended and not on for at, on in list(self.commanding)),
                 "the end of commanding", within_s + SLACK_S)

    def closest(self, x, y, since):
        """Distance and time of the point of the track nearest to one after `since`."""
        return min((math.hypot(px - x, py - y), at)
                   for at, px, py, _, _ in list(self.track) if at >= since)

    def stop(self):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGINT)
        for process in self.processes:
            process.wait(PATIENCE_S)


def no_thrust(line):
    return line.startswith(("$PYDIR,0,0*", "$PYDEP,0.0000,0*"))


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        square = ("_side:=%.1f" % SIDE_M,)
        cls.square = Vehicle("/square", "kingfisher", "kingfisher_square.py", *square)
        cls.square_cpp = Vehicle("/square_cpp", "kingfisher", "kingfisher_square", *square)
        cls.survey = Vehicle("/survey", "sandshark", "sandshark_survey.py", "_legs:=2",
                             "_depth:=%.1f" % DEPTH_M, "_length:=%.1f" % LENGTH_M,
                             "_spacing:=%.1f" % SPACING_M)
        cls.all = (cls.square, cls.square_cpp, cls.survey)
        for vehicle in cls.all:
            vehicle.run()
        for vehicle in cls.all:
            vehicle.exit_code = vehicle.program.wait(2 * PATIENCE_S)
            vehicle.ended = time.monotonic()

    @classmethod
    def tearDownClass(cls):
        for vehicle in cls.all:
            vehicle.stop()

    def visits(self, vehicle, points, since):
        for x, y in points:
            distance, since = vehicle.closest(x, y, since)
            self.assertLess(distance, CORNER_M, "%s: %.1f, %.1f" % (vehicle.namespace, x, y))

    def test_squares(self):
        for vehicle in (self.square, self.square_cpp):
            self.assertEqual(0, vehicle.exit_code)
            first = vehicle.commands(vehicle.started)[0][0]
            _, x, y, _, _ = [point for point in vehicle.track if point[0] <= first][-1]
            s = SIDE_M
            self.visits(vehicle, ((x + s, y), (x + s, y + s), (x, y + s), (x, y)), first)

    def test_survey(self):
        survey = self.survey
        self.assertEqual(0, survey.exit_code)
        self.assertIn("$BPRMB", survey.commands(survey.started)[0][1])
        deep = [point for point in survey.track
                if point[0] < survey.ended and abs(point[3] - DEPTH_M) < 0.5]
        began, x, y, _, _ = deep[0]
        # North, then back ten metres to the east, between them a turn wider than the corner.
        points = ((x, y + LENGTH_M), (x + SPACING_M, y + LENGTH_M / 2.0), (x + SPACING_M, y))
        self.visits(survey, points, began)
        last = survey.closest(*points[-1], since=began)[1]
        for at, _, _, depth, _ in survey.track:
            if began <= at <= last:
                self.assertAlmostEqual(DEPTH_M, depth, delta=0.7)
        self.assertLess(min(point[3] for point in survey.track if last < point[0]), 0.5)

    def test_squares_interrupted(self):
        for vehicle in (self.square, self.square_cpp):
            vehicle.run_until_it_moves()
            ended = vehicle.end_by(signal.SIGINT)
            wait_for(lambda: any(no_thrust(line) for _, line in vehicle.commands(ended)),
                     "zero thrust", SLACK_S)
            vehicle.silent_after(ended, STALE_S)
            commands = [line for _, line in vehicle.commands(ended)]
            first_zero = [no_thrust(line) for line in commands].index(True)
            self.assertTrue(all(no_thrust(line) for line in commands[first_zero:]), commands)
            self.assertTrue(commands[-1].startswith("$PYDIR,0,0*"), commands)

    def test_squares_killed(self):
        for vehicle in (self.square, self.square_cpp):
            vehicle.run_until_it_moves()
            ended = vehicle.end_by(signal.SIGKILL)
            wait_for(lambda: any(no_thrust(line) for _, line in vehicle.commands(ended)),
                     "zero thrust", STALE_S + SLACK_S)
            vehicle.silent_after(ended, STALE_S)
            wait_for(lambda: abs(vehicle.track[-1][4]) < 0.2, "the boat to lie still")

    def test_survey_interrupted_and_killed(self):
        for number, within_s in ((signal.SIGINT, 0.0), (signal.SIGKILL, STALE_S)):
            self.survey.run_until_it_moves()
            ended = self.survey.end_by(number)
            self.survey.silent_after(ended, within_s)
            stopped = [at for at, on in self.survey.commanding if at > ended and not on][0]
            # Long enough for another repetition to show.
            wait_for(lambda: time.monotonic() > stopped + 0.5, "half a second", 1.0)
            self.assertEqual([], self.survey.commands(stopped + 0.05))


if __name__ == "__main__":
    rospy.init_node("examples_test")
    rostest.rosrun(PACKAGE, "examples", Examples, sys.argv)
