#!/usr/bin/env python3
"""A service returns within its limit and holds nothing else up."""

import json
import os
import subprocess
import sys
import time
import unittest

import rospy
from frontseat_driver.msg import Behavior, ControlStatus, Drive
from frontseat_driver.srv import Abort, ModifyBehavior, SetDatum, SetLogging
from nav_msgs.msg import Odometry
from std_srvs.srv import SetBool, Trigger

from driver_under_test import Collector, NodeDriver, Publisher, parameters_for, row, run
from fake_vehicle import boat, navigation, shark, wait_until

ACK_TIMEOUT_S = 1.0
# A call needs a connection and a thread on each side, on a machine that does other things too.
NOISE_S = 1.0
CALLERS = 32
MOST_DELAY_S = 0.02
ATTEMPTS = 4


def silent(_connection, _line):
    """A vehicle that acknowledges nothing."""


class Services(unittest.TestCase):
    namespace = None

    def start(self, vehicle, **parameters):
        self.vehicle = vehicle
        self.addCleanup(vehicle.stop)
        self.driver = NodeDriver(self.namespace, parameters_for(vehicle, **parameters))
        self.addCleanup(self.driver.stop)

    def call(self, name, service_type, *arguments):
        """The answer, and how long it took."""
        name = self.namespace + "/" + name
        rospy.wait_for_service(name, 10.0)
        began = time.monotonic()
        answer = rospy.ServiceProxy(name, service_type)(*arguments)
        return answer, time.monotonic() - began

    def wait_for_permission(self):
        Collector(self.namespace + "/control", ControlStatus).wait_until(
            lambda status: status.grant == ControlStatus.GRANTED)


class LinkDown(Services):
    namespace = "/link_down"

    def test_every_service_answers_at_once(self):
        vehicle = boat()
        vehicle.stop()
        self.start(vehicle)
        rows = (("abort", Abort, ("leak", True), False),
                ("modify_behavior", ModifyBehavior, (Behavior(),), False),
                ("set_logging", SetLogging, ("DVL", True), False),
                ("set_datum", SetDatum, (42.35, -71.1), True),
                ("set_datum", SetDatum, (91.0, 0.0), False),
                ("enable_commands", SetBool, (True,), True),
                ("stop", Trigger, (), True))
        for name, service_type, arguments, success in rows:
            with row(name=name, arguments=arguments):
                answer, took_s = self.call(name, service_type, *arguments)
                self.assertEqual(success, answer.success, answer.message)
                self.assertLess(took_s, NOISE_S)
                self.assertNotEqual("", answer.message)
                if name in ("abort", "modify_behavior", "set_logging"):
                    self.assertIn("no connection", answer.message)


class AcksWithheld(Services):
    namespace = "/withheld"

    def test_the_limit_is_the_parameter(self):
        self.start(shark(silent), ack_timeout=ACK_TIMEOUT_S)
        self.wait_for_permission()
        rows = (("abort", Abort, ("leak", True)),
                ("set_logging", SetLogging, ("DVL", True)),
                ("modify_behavior", ModifyBehavior, (Behavior(vertical_mode=1, vertical=2.0),)))
        for name, service_type, arguments in rows:
            with row(name=name):
                answer, took_s = self.call(name, service_type, *arguments)
                self.assertFalse(answer.success)
                self.assertIn("did not acknowledge it within 1.0 s", answer.message)
                self.assertGreater(took_s, ACK_TIMEOUT_S - 0.01)
                self.assertLess(took_s, ACK_TIMEOUT_S + NOISE_S)


class TooLate(Services):
    """The driver comes to every call later than its caller waits."""
    namespace = "/too_late"
    command_timeout_s = 5.0

    def test_what_ends_commanding_is_done_and_what_begins_it_is_not(self):
        vehicle = boat()
        self.start(vehicle, ack_timeout=1e-9, command_timeout=self.command_timeout_s)
        connection = vehicle.wait_for_connection()
        self.wait_for_permission()
        control = Collector(self.namespace + "/control", ControlStatus)
        self.addCleanup(control.close)
        commands = Publisher(self.namespace + "/cmd_drive", Drive)
        for name, service_type, arguments in (("stop", Trigger, ()),
                                              ("enable_commands", SetBool, (False,))):
            with row(name=name):
                since = time.monotonic()
                commands.publish(Drive(left=0.5, right=0.5))
                wait_until(lambda: connection.since(since, "DIR,50,50"), "thrust")
                self.call(name, service_type, *arguments)
                zeros = wait_until(lambda: connection.since(since, "DIR,0,0"), "zero thrust")
                self.assertLess(zeros[0][0] - since, self.command_timeout_s - NOISE_S)
        answer, _ = self.call("enable_commands", SetBool, True)
        self.assertFalse(answer.success)
        self.assertIn("nothing was done", answer.message)
        self.assertFalse(control.messages[-1].commands_enabled)


class ManyCallers(Services):
    namespace = "/many"

    def test_hold_up_nobody(self):
        self.start(shark(silent), ack_timeout=ACK_TIMEOUT_S, send_spacing=0.005)
        self.wait_for_permission()
        self.odometry = Collector(self.namespace + "/odom", Odometry).wait_for_publisher()
        self.commands = Publisher(self.namespace + "/cmd_behavior", Behavior)
        added = []
        for attempt in range(ATTEMPTS):  # one is enough: what blocks blocks each time
            alone = self.delays()
            together = self.delays(self.callers())
            added.append([with_callers - without for with_callers, without
                          in zip(together, alone)])
            print("delays of odometry and commands: alone %s, with callers %s"
                  % (alone, together), flush=True)
            if max(added[-1]) < MOST_DELAY_S:
                return
        self.fail("callers added %s s" % added)

    @staticmethod
    def callers():
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "callers.py")
        process = subprocess.Popen([sys.executable, script, ManyCallers.namespace + "/set_logging",
                                    str(CALLERS)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        process.stdout.readline()
        return process

    def delays(self, callers=None):
        """The longest from a sentence to its odometry and from a command to its sentence, both
        while the callers wait for the vehicle."""
        odometry, commands = self.said_while(callers)
        arrived = {round(-message.pose.pose.position.z, 3): at
                   for at, message in list(self.odometry.received)}
        heard = {line.split(",")[3]: at for at, line in
                 reversed(self.vehicle.connections[-1].since(0.0, "RMB"))}
        odometry_s = [arrived[depth] - at for depth, at in odometry.items()]
        commands_s = [heard[depth] - at for depth, at in commands.items() if depth in heard]
        self.assertGreater(len(commands_s), 0.8 * len(commands))
        return round(max(odometry_s), 4), round(max(commands_s), 4)

    def said_while(self, callers):
        """The vehicle says 100 times a second how deep it is, and every fifth time a command is
        published; each is known by its depth."""
        odometry, commands = {}, {}
        number = len(self.odometry.received)
        end = time.monotonic() + ACK_TIMEOUT_S
        if callers:
            callers.stdin.write(b"\n")
            callers.stdin.flush()
        due = time.monotonic()
        while time.monotonic() < end:
            wait_until(lambda: time.monotonic() >= due, "the next")
            due += 0.01
            number += 1
            odometry[round(number * 0.001, 3)] = time.monotonic()
            self.vehicle.connections[-1].send(navigation(depth="%.3f" % (number * 0.001)))
            if number % 5 == 0:
                commands["%.3f" % (number * 0.001)] = time.monotonic()
                self.commands.publish(Behavior(vertical_mode=1, vertical=number * 0.001))
        self.odometry.wait_for(number)
        if callers:
            self.check(json.loads(callers.communicate(timeout=20.0)[0].decode()))
        return odometry, commands

    def check(self, answers):
        self.assertEqual(CALLERS, len(answers))
        for answer in answers:
            self.assertFalse(answer["success"])
            self.assertIn("within 1.0 s", answer["message"])
            self.assertLess(answer["seconds"], ACK_TIMEOUT_S + 2 * NOISE_S)


if __name__ == "__main__":
    run("services")
