#!/usr/bin/env python3
"""What every user sees, with nmea_node and with the nodelet in a manager."""

import time
import unittest

import rospy
import tf2_msgs.msg
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from frontseat_driver.msg import (ControlStatus, InterfaceVersion, LinkStatus, MissionStatus,
                                  Sentence, ShutdownNotice)
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from driver_under_test import Collector, NodeDriver, NodeletDriver, parameters_for, run
from fake_vehicle import (FakeVehicle, acknowledge_all, control, navigation, sentence,
                          time_of_day, velocity, wait_until)

NAMESPACE = "/scenario"
HALF_ROOT = 0.7071067811865476

# At the second position, 0.1' north and 0.1' east of the datum: over Earth-centred coordinates.
EAST_M, NORTH_M = 137.3217051482869, 185.13484655893862
# Grid heading 90, roll 10 and pitch 5 degrees; by the series for zone 19 the grid's north lies
# 1.41395 degrees west of true north there. Velocity 1 m/s east, 0.5 m/s north. Over matrices.
ORIENTATION = (0.08760232, -0.04237573, 0.01608149, 0.99512387)
BODY_VELOCITY = (1.00818223, 0.45263665, -0.16937727)

STATUS_NAMES = {"link", "data", "decoding", "clock", "control", "commands", "battery"}


def greeting():
    now = time_of_day()
    return (sentence("BFVER,%s,SS_0.0" % now) + sentence("BFMIS,%s,survey.dive,Ready," % now)
            + sentence("BFSHT,%s" % now) + control(True))


def quaternion(value):
    return (value.x, value.y, value.z, value.w)


def vector(value):
    return (value.x, value.y, value.z)


class Scenario(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = FakeVehicle(greeting, acknowledge_all)
        kind = {"node": NodeDriver, "nodelet": NodeletDriver}[rospy.get_param("~kind")]
        cls.driver = kind(NAMESPACE, parameters_for(cls.vehicle, datum=[42.35, -71.1],
                                                     max_jump=1e6))
        cls.connection = cls.vehicle.wait_for_connection()

    @classmethod
    def tearDownClass(cls):
        cls.driver.stop()
        cls.vehicle.stop()

    def collect(self, topic, message_type):
        if not topic.startswith("/"):
            topic = NAMESPACE + "/" + topic
        collector = Collector(topic, message_type).wait_for_publisher()
        self.addCleanup(collector.close)
        return collector

    def assert_near(self, expected, actual, tolerance=1e-6):
        self.assertEqual(len(expected), len(actual))
        for one, other in zip(expected, actual):
            self.assertAlmostEqual(one, other, delta=tolerance, msg="%s" % (actual,))

    def move(self):
        self.connection.send(
            velocity(east="1", north="0.5"),
            navigation(latitude="4221.100000,N", longitude="07105.900000,W", roll="10", pitch="5",
                       depth="3.5"))

    def test_asks_for_its_sentences_in_order(self):
        self.connection.wait_for("LOG", 5)
        bodies = [body for body in self.connection.bodies() if not body.startswith("BPSTS")]
        self.assertRegex(bodies[0], r"^BPVER,\d{6}\.\d{3},0\.1$")
        self.assertEqual(["BPLOG,%s,ON" % name for name in ("ACK", "NVG", "NVR", "MIS", "CTL")],
                         bodies[1:6])

    def test_odometry_and_tf(self):
        odometry = self.collect("odom", Odometry)
        frames = self.collect("/tf", tf2_msgs.msg.TFMessage)
        self.move()
        odom = odometry.wait_for()[0]
        self.assertEqual(("odom", "base_link"), (odom.header.frame_id, odom.child_frame_id))
        self.assert_near((EAST_M, NORTH_M, -3.5), vector(odom.pose.pose.position))
        self.assert_near(ORIENTATION, quaternion(odom.pose.pose.orientation))
        self.assert_near(BODY_VELOCITY, vector(odom.twist.twist.linear))
        frame = frames.wait_for()[0].transforms[0]
        self.assertEqual(("odom", "base_link"), (frame.header.frame_id, frame.child_frame_id))
        self.assertEqual(odom.header.stamp, frame.header.stamp)
        self.assert_near((EAST_M, NORTH_M, -3.5), vector(frame.transform.translation))
        self.assert_near(ORIENTATION, quaternion(frame.transform.rotation))

    def test_imu(self):
        imus = self.collect("imu/data", Imu)
        self.move()
        self.connection.send(velocity())
        imu = imus.wait_for(2)[1]
        self.assertEqual("base_link", imu.header.frame_id)
        self.assert_near(ORIENTATION, quaternion(imu.orientation))
        self.assertEqual(-1.0, imu.linear_acceleration_covariance[0])

    def test_static_frames_for_a_late_subscriber(self):
        found = {}
        for message in self.collect("/tf_static", tf2_msgs.msg.TFMessage).wait_for():
            for frame in message.transforms:
                found[frame.header.frame_id, frame.child_frame_id] = frame.transform
        self.assertEqual({("base_link", "base_link_frd"), ("odom", "odom_ned")}, set(found))
        self.assert_near((1, 0, 0, 0), quaternion(found["base_link", "base_link_frd"].rotation))
        self.assert_near((HALF_ROOT, HALF_ROOT, 0, 0),
                         quaternion(found["odom", "odom_ned"].rotation))

    def test_latched_topics_for_a_late_subscriber(self):
        mission = self.collect("mission_status", MissionStatus).wait_for()[0]
        self.assertEqual((MissionStatus.READY, "Ready", "survey.dive"),
                         (mission.state, mission.status, mission.dive_file))
        grant = self.collect("control", ControlStatus).wait_for()[0]
        self.assertEqual((ControlStatus.GRANTED, True, False, ""),
                         (grant.grant, grant.commands_enabled, grant.commanding, grant.reason))
        version = self.collect("interface_version", InterfaceVersion).wait_for()[0]
        self.assertEqual(("SS_0.0", "0.1"), (version.vehicle, version.payload))
        notice = self.collect("shutdown", ShutdownNotice).wait_for()[0]
        self.assertEqual(60.0, (notice.earliest_power_off - notice.header.stamp).to_sec())

    def test_link(self):
        links = self.collect("link", LinkStatus)
        before = links.wait_for(2)[1]  # the first may be older than what other tests said
        self.assertGreaterEqual(before.sentences_received, 4)
        self.assertTrue(before.connected)
        self.assertEqual(("127.0.0.1:%d" % self.vehicle.port, "sandshark"),
                         (before.endpoint, before.dialect))
        self.connection.send(b"$BFNVG,1*00\r\n", sentence("BFXYZ,1"), b"$BFNVG,no sum\r\n",
                             b"$" + b"x" * 2000, b"\r\n", sentence("BFCTL,what,1"))
        after = links.wait_until(lambda link: link.oversized > before.oversized)
        grown = {name: getattr(after, name) - getattr(before, name)
                 for name in ("bad_checksums", "unknown", "malformed", "oversized")}
        self.assertEqual(dict(bad_checksums=1, unknown=1, malformed=2, oversized=1), grown)

    def test_diagnostics(self):
        diagnostics = self.collect("/diagnostics", DiagnosticArray)
        self.connection.send(navigation())

        def all_well():
            newest = {status.name.split(": ")[1]: status for message in diagnostics.messages
                      for status in message.status}
            return (len(newest) >= len(STATUS_NAMES) and newest["data"].level == 0
                    and newest["link"].level == 0 and newest)

        newest = wait_until(all_well, "diagnostics without errors")
        self.assertEqual(STATUS_NAMES, set(newest))
        self.assertEqual("127.0.0.1:%d" % self.vehicle.port, newest["link"].hardware_id)
        self.assertEqual(DiagnosticStatus.OK, newest["control"].level)

    @staticmethod
    def heard(record):
        """Without the answers to what the driver says meanwhile."""
        return [message.sentence for message in record.messages
                if not message.sentence.startswith("$BFACK")]

    def test_every_line_is_on_nmea_rx_in_order(self):
        record = self.collect("nmea/rx", Sentence)
        lines = [sentence("BFXYZ,%d" % number) for number in range(3000)]
        lines[500] = b"$BFNVG,wrong*00\r\n"
        lines[1000] = b"$BFNVG,none\r\n"
        lines[1500:1500] = [navigation()]
        self.connection.send(*lines)
        wait_until(lambda: len(self.heard(record)) >= len(lines), "all lines")
        self.assertEqual([line.decode().strip() for line in lines], self.heard(record))
        connections = {message.header.frame_id for message in record.messages}
        self.assertEqual(1, len(connections), connections)
        # By the system clock, with a margin for a machine that sets its own meanwhile.
        connection, _, started = connections.pop().partition("@")
        self.assertRegex(connection, r"^connection_[1-9]\d*$")
        self.assertAlmostEqual(time.time(), float(started), delta=600.0)

    def test_what_is_sent_is_on_nmea_tx(self):
        sent = self.collect("nmea/tx", Sentence)
        status = sent.wait_until(lambda message: message.sentence.startswith("$BPSTS"))
        wait_until(lambda: status.sentence in [line for _, line in self.connection.lines],
                   "the same on the wire")


if __name__ == "__main__":
    run("scenario")
