#!/usr/bin/env python3
"""blueye_simulator as a node: its parameters, its truth, its service, and how it ends."""

import json
import math
import sys
import unittest
import urllib.request

import rospy
import rostest
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from driver_under_test import PACKAGE, Collector, Process, program
from fake_vehicle import TIMEOUT_S, wait_until

PORTS = ("telemetry_port", "request_port", "control_port", "http_port")
ANY_PORTS = {port: 0 for port in PORTS}


def simulator(name, **parameters):
    rospy.set_param("/" + name, dict(ANY_PORTS, **parameters))
    return Process([program(PACKAGE, "blueye_simulator"), "__name:=" + name])


def drone_info(name):
    port = wait_until(lambda: rospy.get_param("/%s/actual_http_port" % name, 0), "its port")
    url = "http://127.0.0.1:%d/diagnostics/drone_info" % port
    with urllib.request.urlopen(url, timeout=TIMEOUT_S) as answer:
        return json.loads(answer.read().decode())


class BlueyeSimulator(unittest.TestCase):
    def test_publishes_the_truth_and_its_ports(self):
        yaw = 2.0
        process = simulator("drone", start=[3.0, -4.0, yaw], serial_number="SIM42", noise=False)
        self.addCleanup(process.stop)
        truth = Collector("/drone/odom", Odometry)
        wait_until(lambda: len(truth.received) > 3, "the truth")
        odom = truth.received[-1][1]
        self.assertEqual(("odom", "base_link"), (odom.header.frame_id, odom.child_frame_id))
        self.assertAlmostEqual(3.0, odom.pose.pose.position.x, places=2)
        self.assertAlmostEqual(-4.0, odom.pose.pose.position.y, places=2)
        q = odom.pose.pose.orientation
        self.assertAlmostEqual(yaw, math.remainder(2.0 * math.atan2(q.z, q.w), 2.0 * math.pi),
                               places=3)
        ports = {rospy.get_param("/drone/actual_" + port) for port in PORTS}
        self.assertEqual(len(PORTS), len(ports))
        self.assertEqual("SIM42", drone_info("drone")["serial_number"])
        self.assertTrue(rospy.ServiceProxy("/drone/reboot", Trigger)().success)

    def test_warns_of_parameters_that_nobody_reads(self):
        process = simulator("typo", lose_reply=0.5)
        self.addCleanup(process.stop)
        wait_until(lambda: [line for line in process.warnings() if "lose_replies" in line],
                   "a warning with the nearest name")

    def test_ends_with_one_line_that_names_what_is_wrong(self):
        process = simulator("wrong", dvl_y_axis="up")
        self.addCleanup(process.stop)
        wait_until(lambda: not process.runs(), "the end")
        line = "parameter 'dvl_y_axis' is 'up': accepted is right or left"
        wait_until(lambda: line in process.output, line)

    def test_names_a_port_that_is_taken(self):
        first = simulator("first")
        self.addCleanup(first.stop)
        port = wait_until(lambda: rospy.get_param("/first/actual_telemetry_port", 0), "its port")
        second = simulator("second", telemetry_port=port)
        self.addCleanup(second.stop)
        wait_until(lambda: not second.runs(), "the end")
        wait_until(lambda: any(str(port) in line for line in second.output), "the port's number")


if __name__ == "__main__":
    rospy.init_node("blueye_simulator_test")
    rostest.rosrun(PACKAGE, "blueye_simulator", BlueyeSimulator, sys.argv)
