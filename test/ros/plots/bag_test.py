#!/usr/bin/env python3
"""A mission comes out of a bag as it went in, in ROS units and axes turned to those of the deck."""

import math
import os
import tempfile
import unittest

import numpy as np
import rosbag
import rospy
import rosunit
from frontseat_driver.msg import LinkStatus, Sentence
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Range

from frontseat_driver.plots import bag as plot_bag
from frontseat_driver.plots.errors import Unreadable

START = 1600000000.0


def stamped(message, at):
    message.header.stamp = rospy.Time.from_sec(at)
    return message


def odom(at, x, heading_deg, ahead, unknown=()):
    message = stamped(Odometry(), at)
    message.pose.pose.position.x, message.pose.pose.position.y = x, 2.0 * x
    yaw = math.radians(90.0 - heading_deg)
    q = message.pose.pose.orientation
    q.z, q.w = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    message.twist.twist.linear.x = ahead
    message.pose.covariance = [1e6 if place in unknown else 0.0 for place in range(36)]
    return message


def depth(at, value):
    message = stamped(PoseWithCovarianceStamped(), at)
    message.pose.pose.position.z = -value
    return message


def link(connected=True, received=0, bad=0, malformed=0, since_s=0.1):
    return LinkStatus(connected=connected, sentences_received=received, bad_checksums=bad,
                      malformed=malformed, since_received=rospy.Duration.from_sec(since_s))


class Bag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "dive.bag")

    def write(self, *records):
        """Each a triple of topic, message and seconds after the start."""
        with rosbag.Bag(self.path, "w") as bag:
            for topic, message, at in records:
                bag.write(topic, message, rospy.Time.from_sec(START + at))

    def read(self, namespace=None):
        return plot_bag.read(self.path, namespace)

    def test_values(self):
        self.write(("/odom", odom(START, 0.0, 90.0, 1.5), 0.01),
                   ("/odom", odom(START + 1.0, 3.0, 350.0, 1.0, (35,)), 1.01),
                   ("/depth", depth(START, 4.5), 0.01),
                   ("/altitude", stamped(Range(range=12.0), START), 0.01),
                   ("/altitude", stamped(Range(range=0.0), START + 1.0), 1.01),
                   ("/battery", stamped(BatteryState(voltage=16.5, location="battery_1"), START),
                    0.01))
        mission = self.read()
        self.assertEqual("dive.bag", mission.title)
        self.assertEqual([START, START + 1.0], list(mission.position.t))  # stamps, not arrival
        self.assertEqual([0.0, 3.0], list(mission.position.values[0]))
        self.assertEqual([0.0, 6.0], list(mission.position.values[1]))
        self.assertAlmostEqual(90.0, mission.heading_deg.v[0])
        self.assertTrue(np.isnan(mission.heading_deg.v[1]))
        self.assertEqual([1.5, 1.0], list(mission.speed_m_s.v))
        self.assertEqual([4.5], list(mission.depth_m.v))
        self.assertEqual(12.0, mission.altitude_m.v[0])
        self.assertTrue(np.isnan(mission.altitude_m.v[1]))  # no bottom heard
        self.assertAlmostEqual(16.5, mission.battery_v["battery 1"].v[0])
        self.assertFalse(mission.faults_known)

    def test_stamps_of_another_clock_are_moved_to_the_recording(self):
        self.write(*[("/odom", odom(START - 18000.0 + tick, 0.0, 0.0, 0.0), tick + 0.25)
                     for tick in range(5)])
        self.assertAlmostEqual(START + 0.25, self.read().position.t[0], places=3)

    def test_link(self):
        self.write(("/odom", odom(START, 0.0, 0.0, 0.0), 0.0), ("/link", link(received=100), 0.0),
                   ("/link", link(received=140, bad=1), 1.0),
                   ("/link", link(received=180, bad=3, malformed=1), 2.0),
                   ("/link", link(received=180, bad=3, malformed=1, since_s=1.5), 3.0),
                   ("/link", link(False, 180, 3, 1, since_s=3.5), 5.0),
                   ("/link", link(received=20), 6.0))
        mission = self.read()
        np.testing.assert_allclose([40.0, 40.0, 0.0, 0.0, 0.0, 20.0], mission.rate_hz.v)
        self.assertEqual(100, mission.sentences)
        self.assertEqual([1.0, 2.0], list(mission.bad_checksums.v))
        self.assertEqual([START + 2.0], list(mission.malformed.t))
        self.assertEqual([[START + 1.5, START + 5.0]], mission.gaps.tolist())
        self.assertEqual([[START + 5.0, START + 6.0]], mission.disconnected().tolist())
        self.assertTrue(mission.faults_known)

    def test_reports_of_the_link_recorded_all_at_once(self):
        self.write(("/odom", odom(START, 0.0, 0.0, 0.0), 0.0),
                   *[("/link", stamped(link(received=40 * tick), START + tick), 5.0)
                     for tick in range(5)])
        np.testing.assert_allclose([40.0] * 4, self.read().rate_hz.v)

    def test_sentences_where_there_is_no_link(self):
        self.write(("/odom", odom(START, 0.0, 0.0, 0.0), 0.0),
                   *[("/nmea/rx", stamped(Sentence(sentence="$"), START + at), 20.0)
                     for at in (0.0, 1.0, 5.0)])
        mission = self.read()
        self.assertEqual([[START + 1.0, START + 5.0]], mission.gaps.tolist())
        self.assertEqual(3, mission.sentences)

    def test_a_vehicle_is_chosen_by_namespace(self):
        self.write(("/shark/odom", odom(START, 1.0, 0.0, 0.0), 0.0), ("/shark/link", link(), 0.0),
                   ("/fisher/odom", odom(START, 2.0, 0.0, 0.0), 0.0),
                   ("/fisher/link", link(), 0.0))
        self.assertEqual(2.0, self.read("/fisher").position.values[0][0])
        self.assertEqual(1.0, self.read("shark").position.values[0][0])
        with self.assertRaisesRegex(Unreadable, "--namespace: /fisher/, /shark/"):
            self.read()
        with self.assertRaisesRegex(Unreadable, "no vehicle in namespace whale"):
            self.read("whale")

    def test_the_truth_of_a_simulator_is_no_vehicle(self):
        self.write(("/odom", odom(START, 1.0, 0.0, 0.0), 0.0), ("/link", link(), 0.0),
                   ("/simulator/odom", odom(START, 2.0, 0.0, 0.0), 0.0))
        self.assertEqual(1.0, self.read().position.values[0][0])

    def test_a_bag_of_something_else(self):
        self.write(("/camera", Range(), 0.0))
        with self.assertRaisesRegex(Unreadable, "no topic of the driver"):
            self.read()

    def test_a_bag_that_was_not_closed(self):
        self.write(("/odom", odom(START, 1.0, 0.0, 0.0), 0.0))
        with open(self.path, "rb") as file:
            content = bytearray(file.read())
        at = content.index(b"index_pos=") + len(b"index_pos=")
        content[at:at + 8] = bytes(8)
        with open(self.path, "wb") as file:
            file.write(content)
        with self.assertRaisesRegex(Unreadable, "rosbag reindex"):
            self.read()


if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "plot_bag", Bag)
