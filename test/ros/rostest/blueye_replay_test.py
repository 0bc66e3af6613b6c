#!/usr/bin/env python3
"""A record of blueye/telemetry, message by message: what it gives, and that nothing is ever sent."""

import struct
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from frontseat_driver.msg import (BlueyeBatteryDetails, BlueyeMessage, ControlStatus,
                                  LinkStatus)
from frontseat_driver.srv import BlueyeRequest, BlueyeControl
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Imu
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from fake_vehicle import wait_until

PACKAGE = "blueye.protocol."


def field(number, kind, content):
    """One field of a protobuf message: kind 0 varint, 2 bytes, 5 float."""
    return bytes([number << 3 | kind]) + content


def number(index, value):
    return field(index, 5, struct.pack("<f", value))


def inner(index, content):
    return field(index, 2, bytes([len(content)]) + content)


DEPTH = inner(1, number(1, 10.0))
ATTITUDE = inner(1, number(3, 90.0))                       # yaw: bow to the east
ESTIMATE = inner(1, number(1, 3.0) + number(2, 4.0) + number(3, 1.5707964) +
                 number(4, 0.5) + field(9, 0, b"\x01"))    # northing, easting, heading, surge, valid


BATTERY = inner(1, b"\xba\x01\x03Ten")                       # 23: the manufacturer's name
VOLTAGE = inner(1, number(1, 14.5) + number(2, 0.5))         # and level
NAN = float("nan")
UNKNOWN = 1e6


class Heard:
    """The messages of one topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=100)

    def since(self, stamp_s):
        return [message for message in list(self.messages)
                if message.header.stamp.to_sec() >= stamp_s]


def until(claim):
    return wait_until(claim, "the driver")


class BlueyeReplay(unittest.TestCase):
    def setUp(self):
        self.record = rospy.Publisher("blueye/replay", BlueyeMessage, queue_size=100)
        self.assertTrue(until(lambda: self.record.get_num_connections() > 0))

    def play(self, name, data, stamp):
        message = BlueyeMessage(type=PACKAGE + name, data=data)
        message.header.stamp = rospy.Time.from_sec(stamp)
        self.record.publish(message)

    def heard(self, topic, kind):
        heard = Heard(topic, kind)
        self.assertTrue(until(lambda: heard.subscriber.get_num_connections() > 0), topic)
        return heard

    def warm_up(self, played, *heard):
        """Plays until all have heard something: the driver's side of a connection is the later."""
        def all_there():
            for name, data in played:
                self.play(name, data, 1)
            return all(one.messages for one in heard)

        self.assertTrue(until(all_there))

    def test_a_record_gives_what_the_dive_gave(self):
        raw = self.heard("blueye/telemetry", BlueyeMessage)
        depth = self.heard("depth", PoseWithCovarianceStamped)
        odom = self.heard("odom", Odometry)
        imu = self.heard("imu/data", Imu)
        self.warm_up((("DepthTel", DEPTH), ("AttitudeTel", ATTITUDE),
                      ("PositionEstimateTel", ESTIMATE)), raw, depth, odom, imu)
        self.play("DepthTel", DEPTH, 1000)
        self.play("AttitudeTel", ATTITUDE, 1001)
        self.play("PositionEstimateTel", ESTIMATE, 1002)
        self.play("TeleportTel", b"\x01\x02\x03", 1003)
        self.assertTrue(until(lambda: len(raw.since(1000)) >= 4))
        self.assertEqual([PACKAGE + name for name in
                          ("DepthTel", "AttitudeTel", "PositionEstimateTel", "TeleportTel")],
                         [message.type for message in raw.since(1000)])
        self.assertEqual(b"\x01\x02\x03", raw.since(1000)[3].data)
        self.assertTrue(until(lambda: depth.since(1000) and odom.since(1000) and imu.since(1000)))
        self.assertAlmostEqual(-10.0, depth.since(1000)[0].pose.pose.position.z)
        self.assertEqual(1000, depth.since(1000)[0].header.stamp.to_sec())
        pose = odom.since(1000)[0].pose.pose
        self.assertAlmostEqual(4.0, pose.position.x, 5)
        self.assertAlmostEqual(3.0, pose.position.y, 5)
        self.assertAlmostEqual(-10.0, pose.position.z, 5)
        self.assertAlmostEqual(1.0, abs(pose.orientation.w), 5)
        self.assertAlmostEqual(0.5, odom.since(1000)[0].twist.twist.linear.x, 5)
        self.assertAlmostEqual(1.0, abs(imu.since(1000)[0].orientation.w), 5)

    def test_nothing_is_sent_while_a_record_is_played(self):
        control = self.heard("control", ControlStatus)
        sent = self.heard("blueye/control_out", BlueyeMessage)
        commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.assertTrue(until(lambda: commands.get_num_connections() > 0))
        command = Twist()
        command.linear.x = 0.5
        commands.publish(command)
        for name in ("take_control", "release_control"):
            rospy.wait_for_service(name, 30.0)
            answer = rospy.ServiceProxy(name, Trigger)()
            self.assertFalse(answer.success)
            self.assertIn("record", answer.message)
        answer = rospy.ServiceProxy("blueye/request", BlueyeRequest)(type="GetBatteryReq")
        self.assertFalse(answer.success)
        answer = rospy.ServiceProxy("blueye/send_control", BlueyeControl)(
            type="LightsCtrl", json='{"lights": {"value": 0.5}}')
        self.assertFalse(answer.success)
        self.assertTrue(until(lambda: control.messages))
        self.assertFalse(control.messages[-1].commanding)
        self.assertEqual([], sent.messages)

    def test_an_estimate_that_is_no_number_gives_no_odometry(self):
        odom = self.heard("odom", Odometry)
        self.warm_up([("PositionEstimateTel", ESTIMATE)], odom)
        self.play("PositionEstimateTel", ESTIMATE, 3000)
        self.play("PositionEstimateTel", inner(1, number(1, NAN) + field(9, 0, b"\x01")), 3001)
        self.play("PositionEstimateTel", b"", 3002)
        self.play("PositionEstimateTel", inner(1, number(1, NAN)), 3003)  # not valid
        self.play("PositionEstimateTel", ESTIMATE, 3004)

        def stamps():
            return [message.header.stamp.to_sec() for message in odom.since(3000)]

        self.assertTrue(until(lambda: 3004 in stamps()))
        self.assertEqual([3000, 3003, 3004], stamps())
        unknown = odom.since(3000)[1]
        self.assertEqual(0.0, unknown.pose.pose.position.x)
        self.assertEqual(UNKNOWN, unknown.pose.covariance[0])

    def test_a_message_without_content_changes_nothing(self):
        laser = self.heard("laser", Float64)
        details = self.heard("battery/details", BlueyeBatteryDetails)
        diagnostics = self.heard("/diagnostics", DiagnosticArray)
        self.warm_up((("LaserTel", inner(1, number(1, 0.25))), ("BatteryBQ40Z50Tel", BATTERY)),
                     laser, details)
        self.play("ErrorFlagsTel", inner(1, field(3, 0, b"\x01")), 4000)
        for name in ("ErrorFlagsTel", "LaserTel", "BatteryBQ40Z50Tel"):
            self.play(name, b"", 4001)
        self.play("LaserTel", inner(1, number(1, 0.5)), 4002)
        self.play("BatteryBQ40Z50Tel", BATTERY, 4002)
        self.assertTrue(until(lambda: laser.messages[-1].data == 0.5 and details.since(4002)))
        self.assertEqual({0.25, 0.5}, {message.data for message in laser.messages})
        self.assertEqual({"Ten"}, {message.manufacturer for message in details.messages})

        def told(layer):
            statuses = [status for message in diagnostics.messages for status in message.status
                        if status.name.endswith(": " + layer)]
            return statuses[-1] if statuses else None

        self.assertTrue(until(lambda: told("drone") and told("drone").level > 0))
        self.assertIn("look it over", told("drone").message)
        self.assertIn("playing a record from", told("link").message)
        self.assertEqual(DiagnosticStatus.OK, told("link").level)

    def test_a_gauge_without_a_voltage_leaves_the_battery_to_the_other_message(self):
        battery = self.heard("battery", BatteryState)
        details = self.heard("battery/details", BlueyeBatteryDetails)
        self.warm_up((("BatteryTel", VOLTAGE), ("BatteryBQ40Z50Tel", BATTERY)), battery, details)
        self.play("BatteryBQ40Z50Tel", BATTERY, 5000)
        self.play("BatteryTel", VOLTAGE, 5001)
        self.assertTrue(until(lambda: battery.since(5001)))
        self.assertAlmostEqual(14.5, battery.since(5001)[0].voltage)

    def test_a_record_gives_the_same_however_fast_it_is_played(self):
        odom = self.heard("odom", Odometry)
        self.warm_up([("PositionEstimateTel", ESTIMATE)], odom)

        def at(stamp):
            self.assertTrue(until(lambda: odom.since(stamp)))
            return odom.since(stamp)[0]

        def north(distance):
            return inner(1, number(1, distance) + field(9, 0, b"\x01"))

        self.play("PositionEstimateTel", north(3.0), 7000)
        for tenth in range(21):
            self.play("DepthTel", inner(1, number(1, 10.0 + 0.05 * tenth)), 7008 + 0.1 * tenth)
        self.play("PositionEstimateTel", north(30.0), 7010)   # 2.7 m/s: no reset
        self.play("PositionEstimateTel", north(30.0), 7013)   # the depth is too old by then
        self.assertAlmostEqual(30.0, at(7010).pose.pose.position.y, 4)
        self.assertAlmostEqual(-11.0, at(7010).pose.pose.position.z, 4)
        self.assertAlmostEqual(-0.5, at(7010).twist.twist.linear.z, 3)
        self.assertEqual(UNKNOWN, at(7013).pose.covariance[14])
        self.play("PositionEstimateTel", north(3.0), 7000.5)  # the record begins anew
        self.assertTrue(until(lambda: odom.messages[-1].header.stamp.to_sec() == 7000.5))
        self.assertAlmostEqual(3.0, odom.messages[-1].pose.pose.position.y, 4)

    def test_bad_bytes_cost_that_message_alone(self):
        depth = self.heard("depth", PoseWithCovarianceStamped)
        link = self.heard("link", LinkStatus)
        self.warm_up([("DepthTel", DEPTH)], depth, link)
        self.play("DepthTel", b"\xff\xff", 2000)
        self.play("DepthTel", DEPTH, 2001)
        self.assertTrue(until(lambda: depth.since(2000)))
        self.assertEqual(2001, depth.since(2000)[0].header.stamp.to_sec())
        self.play("DepthTel", DEPTH, 2002)

        def counted():
            self.play("DepthTel", DEPTH, 2003)  # a second of the record lets the link be told
            return link.messages and link.messages[-1].malformed > 0

        self.assertTrue(until(counted))


if __name__ == "__main__":
    rospy.init_node("blueye_replay_test")
    rostest.rosrun("frontseat_driver", "blueye_replay", BlueyeReplay)
