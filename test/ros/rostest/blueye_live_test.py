#!/usr/bin/env python3
"""blueye_node and the simulated drone together: control, motion, failures, the way out."""

import math
import signal
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from frontseat_driver.msg import BlueyeMessage, ControlStatus, Gripper, LinkStatus
from frontseat_driver.srv import BlueyeControl, BlueyeRequest, LoadMission, SetFloat
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import FluidPressure, JointState, NavSatFix
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from driver_under_test import PACKAGE, Collector, Process, program
from fake_vehicle import TIMEOUT_S, wait_until

PORTS = ("telemetry_port", "request_port", "control_port")
MOTION = "blueye.protocol.MotionInputCtrl"


def call(name, kind, **request):
    rospy.wait_for_service(name, TIMEOUT_S)
    return rospy.ServiceProxy(name, kind)(**request)


class Pair:
    """A drone and a driver of their own, each in its namespace."""

    def __init__(self, name):
        self.name = "/" + name
        drone = self.name + "/drone"
        rospy.set_param(drone, dict({port: 0 for port in PORTS}, http=False, noise=False))
        self.drone = Process([program(PACKAGE, "blueye_simulator"), "__name:=drone",
                              "__ns:=" + self.name])
        ports = {port: wait_until(lambda port=port: rospy.get_param(drone + "/actual_" + port, 0),
                                  port) for port in PORTS}
        rospy.set_param(self.name + "/driver", dict(ports, host="127.0.0.1", reconnect_min=0.1,
                                                    silence_timeout=60))
        self.control = Collector(self.name + "/control", ControlStatus)
        self.sent = Collector(self.name + "/blueye/control_out", BlueyeMessage)
        self.diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.odom = Collector(self.name + "/odom", Odometry)
        self.truth = Collector(drone + "/odom", Odometry)
        self.driver = Process([program(PACKAGE, "blueye_node"), "__name:=driver",
                               "__ns:=" + self.name])
        self.velocity = rospy.Publisher(self.name + "/cmd_vel", Twist, queue_size=1)
        wait_until(lambda: self.grant() == ControlStatus.DENIED, "the drone's word")

    def stop(self):
        self.driver.stop()
        self.drone.stop()

    def grant(self):
        return self.control.received[-1][1].grant if self.control.received else None

    def diagnosis(self, layer):
        """The newest status of a layer, None before the first."""
        name = "%s/driver: %s" % (self.name, layer)
        found = [status for message in self.diagnostics.messages for status in message.status
                 if status.name in (name, name[1:])]
        return found[-1] if found else None

    def diagnosed(self, layer, text):
        return wait_until(lambda: self.diagnosis(layer) and text in self.diagnosis(layer).message
                          and self.diagnosis(layer), "%s: %s" % (layer, text))

    def speed(self):
        linear = self.truth.received[-1][1].twist.twist.linear
        return math.hypot(linear.x, linear.y)

    def take_control(self):
        answer = call(self.name + "/take_control", Trigger)
        wait_until(lambda: self.grant() == ControlStatus.GRANTED, "control")
        return answer

    def drive(self, until):
        command = Twist()
        command.linear.x = 0.5

        def moved():
            self.velocity.publish(command)
            return until()

        wait_until(moved, "motion")

    def motions(self):
        return [message.data for _, message in self.sent.received if message.type == MOTION]

    def at_rest(self):
        """The last motion sent was zero: an input with no field that is not its default."""
        return bool(self.motions()) and not any(self.motions()[-1][2:])


class BlueyeLive(unittest.TestCase):
    def pair(self, name):
        pair = Pair(name)
        self.addCleanup(pair.stop)
        return pair

    def test_an_observer_moves_nothing(self):
        pair = self.pair("observer")
        tries = []

        def refused():
            command = Twist()
            command.linear.x = 0.5
            pair.velocity.publish(command)
            tries.append(1)
            return len(tries) > 200

        wait_until(refused, "200 commands")
        self.assertEqual([], pair.sent.received)
        self.assertLess(pair.speed(), 0.05)
        answer = call(pair.name + "/blueye/send_control", BlueyeControl, type="LightsCtrl",
                      json='{"lights": {"value": 0.5}}')
        self.assertFalse(answer.success)
        self.assertIn("not in control", answer.message)

    def test_diagnostics_are_green_until_the_drone_is_gone(self):
        pair = self.pair("health")
        for layer, text in (("link", "connected to 127.0.0.1:"),
                            ("control", "service take_control takes it"),
                            ("commands", "nothing is commanded"),
                            ("drone", "no error flags"), ("battery", "%")):
            status = pair.diagnosed(layer, text)
            self.assertEqual(DiagnosticStatus.OK, status.level, status)
            self.assertIn("127.0.0.1:", status.hardware_id)
        command = Twist()
        command.linear.x = 0.5

        def refused():
            pair.velocity.publish(command)
            return "are refused" in pair.diagnosis("commands").message

        wait_until(refused, "a refusal")
        self.assertEqual(DiagnosticStatus.WARN, pair.diagnosed("commands", "take_control").level)
        pair.take_control()
        pair.diagnosed("control", "this driver is in control")
        pair.drive(lambda: "commanding" in pair.diagnosis("commands").message)
        pair.drone.stop()
        self.assertEqual(DiagnosticStatus.ERROR, pair.diagnosed("link", "is the drone on").level)
        self.assertEqual(DiagnosticStatus.OK, pair.diagnosed("battery", "last heard").level)

    def test_pressure_follows_the_density_that_the_drone_was_told(self):
        pair = self.pair("density")
        pressure = Collector(pair.name + "/pressure", FluidPressure)
        depth = Collector(pair.name + "/depth", PoseWithCovarianceStamped)
        pair.take_control()
        command = Twist()
        command.linear.z = -0.5

        def weight():
            """N/m^3, of what came of one message of the drone."""
            pair.velocity.publish(command)
            depths = {message.header.stamp: -message.pose.pose.position.z
                      for message in depth.messages[-5:]}
            found = [message.fluid_pressure / depths[message.header.stamp]
                     for message in pressure.messages[-5:]
                     if depths.get(message.header.stamp, 0.0) > 0.1]
            return found[-1] if found else None

        self.assertAlmostEqual(1025.0 * 9.80665, wait_until(weight, "depth", 30.0), 1)
        answer = call(pair.name + "/set_water_density", SetFloat, data=1000.0)
        self.assertTrue(answer.success, answer.message)
        wait_until(lambda: abs((weight() or 0.0) - 1000.0 * 9.80665) < 0.1, "the other density")
        # As it is, past the service.
        answer = call(pair.name + "/blueye/send_control", BlueyeControl, type="WaterDensityCtrl",
                      json='{"density": {"value": 1040.0}}')
        self.assertTrue(answer.success, answer.message)
        wait_until(lambda: abs((weight() or 0.0) - 1040.0 * 9.80665) < 0.1, "the third density")

    def test_drives_stops_and_answers(self):
        pair = self.pair("drive")
        self.assertTrue(pair.take_control().success)
        pair.drive(lambda: pair.speed() > 0.1)
        self.assertTrue(pair.odom.received)
        wait_until(pair.at_rest, "zero after the last command")  # it is stale by itself
        self.assertTrue(call(pair.name + "/auto_depth", SetBool, data=True).success)
        answer = call(pair.name + "/blueye/request", BlueyeRequest, type="GetBatteryReq")
        self.assertTrue(answer.success, answer.message)
        self.assertEqual("blueye.protocol.GetBatteryRep", answer.type)
        lights = Collector(pair.name + "/lights", Float64)
        publisher = rospy.Publisher(pair.name + "/cmd_lights", Float64, queue_size=1)

        def lit():
            publisher.publish(0.5)
            return lights.received and abs(lights.received[-1][1].data - 0.5) < 0.01

        wait_until(lit, "light")
        self.assertTrue(call(pair.name + "/release_control", Trigger).success)
        wait_until(lambda: pair.grant() == ControlStatus.DENIED, "an observer again")

    def test_what_is_refused_is_refused_whole_counted_and_told_for_each_topic(self):
        pair = self.pair("refused")
        pair.take_control()
        link = Collector(pair.name + "/link", LinkStatus)
        half_good = JointState(name=["guest_port_1_servo", "guest_port_2_servo"],
                               position=[0.1, math.nan])
        wrong = {"cmd_joint": half_good, "cmd_tilt": Float64(2.0), "cmd_gripper": Gripper(grip=2),
                 "cmd_lights": Float64(-1), "cmd_laser": Float64(math.nan),
                 "blueye/control": BlueyeMessage(type="NoSuchCtrl"),
                 "pilot/position": NavSatFix(latitude=91)}
        for topic, message in wrong.items():
            publisher = rospy.Publisher(pair.name + "/" + topic, type(message), queue_size=1)
            wait_until(publisher.get_num_connections, topic)
            publisher.publish(message)
            wait_until(lambda topic=topic: any("refused " + topic + ":" in line
                                               for line in pair.driver.output),
                       "the warning of " + topic)
        wait_until(lambda: link.received and
                   link.received[-1][1].refused_commands == len(wrong), "the count of all")
        self.assertFalse([message.type for _, message in pair.sent.received
                          if message.type.endswith("ServoCtrl")])

    def test_runs_a_mission(self):
        pair = self.pair("mission")
        pair.take_control()
        loaded = call(pair.name + "/mission/load", LoadMission, json="""{"instructions": [
            {"id": 0, "depth_set_point_command": {"depth_set_point": {"depth": 2.0,
             "speed_to_depth": 0.3, "depth_zero_reference": "DEPTH_ZERO_REFERENCE_SURFACE"}}}]}""")
        self.assertTrue(loaded.success, loaded.message)
        run = call(pair.name + "/mission/run", Trigger)
        self.assertTrue(run.success, run.message)
        stopped = call(pair.name + "/stop", Trigger)
        self.assertIn("paused", stopped.message)
        self.assertTrue(call(pair.name + "/mission/clear", Trigger).success)
        broken = call(pair.name + "/mission/load", LoadMission, json="{}")
        self.assertFalse(broken.success)

    def test_a_reboot_leaves_an_observer_that_sends_nothing(self):
        pair = self.pair("reboot")
        pair.take_control()
        pair.drive(lambda: pair.speed() > 0.1)
        self.assertTrue(call(pair.name + "/drone/reboot", Trigger).success)
        wait_until(lambda: pair.grant() != ControlStatus.GRANTED, "the loss")
        before = len(pair.sent.received)
        wait_until(lambda: pair.grant() == ControlStatus.DENIED, "the new connection")
        call(pair.name + "/ping", Trigger)
        self.assertEqual(before, len(pair.sent.received))

    def test_a_driver_that_is_interrupted_leaves_the_drone_at_rest(self):
        pair = self.pair("leave")
        pair.take_control()
        pair.drive(lambda: pair.speed() > 0.1)
        pair.driver.send_signal(signal.SIGINT)
        wait_until(lambda: not pair.driver.runs(), "the end of the driver")
        wait_until(lambda: pair.speed() < 0.05, "rest")


if __name__ == "__main__":
    rospy.init_node("blueye_live_test")
    rostest.rosrun(PACKAGE, "blueye_live", BlueyeLive, sys.argv)
