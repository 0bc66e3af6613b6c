#!/usr/bin/env python3
"""Bytes of a real vehicle, cut in any way, and bytes that are no sentence at all."""

import io
import os
import random
import threading
import time
import unittest

import rospy
from frontseat_driver.msg import LinkStatus, Sentence
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Imu, NavSatFix, NavSatStatus, Range, TimeReference
from std_srvs.srv import Trigger

from driver_under_test import Collector, NodeDriver, Usage, parameters_for, row, run
from fake_vehicle import FakeVehicle, navigation, sentence, wait_until

CAPTURE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "captures",
                       "heron_2014.nmea")

# What comes of the capture's 14 lines.
TOPICS = {
    "odom": (Odometry, 2),
    "imu/data": (Imu, 1),
    "imu/data_raw": (Imu, 1),
    "compass/data": (Imu, 1),
    "nav/fix": (NavSatFix, 2),
    "nav/velocity": (TwistStamped, 1),
    "depth": (PoseWithCovarianceStamped, 2),
    "altitude": (Range, 0),
    "battery": (BatteryState, 1),
    "gps/fix": (NavSatFix, 2),
    "gps/velocity": (TwistStamped, 2),
    "gps/time_reference": (TimeReference, 2),
    "nmea/rx": (Sentence, 14),
}

MEBIBYTE = 1 << 20


def capture():
    with open(CAPTURE, "rb") as file:
        return file.read()


def whole(connection):
    connection.send(capture())


def byte_by_byte(connection):
    for byte in capture():
        connection.send(bytes([byte]))


def in_random_chunks(connection):
    rest, chance = capture(), random.Random(2014)
    while rest:
        size = chance.randint(1, 90)
        connection.send(rest[:size])
        rest = rest[size:]


class Listener:
    """A driver on a boat that says the capture when it is told to, and all that comes of it."""

    def __init__(self, namespace):
        self.vehicle = FakeVehicle()
        # The capture spans two days and 450 m.
        self.driver = NodeDriver(namespace, parameters_for(self.vehicle, max_jump=1e6))
        self.topics = {name: Collector(namespace + "/" + name, kind)
                       for name, (kind, _) in TOPICS.items()}

    def hear(self, feed):
        for collector in self.topics.values():
            collector.wait_for_publisher()
        feed(self.vehicle.wait_for_connection())
        return {name: self.topics[name].wait_for(count) for name, (_, count) in TOPICS.items()}

    def stop(self):
        self.driver.stop()
        self.vehicle.stop()


def without_stamps(messages):
    """Bytes, so that NaN equals NaN; and without the start of the driver behind a connection."""
    result = []
    for message in messages:
        message.header.seq = 0
        message.header.stamp.secs = message.header.stamp.nsecs = 0
        message.header.frame_id = message.header.frame_id.split("@")[0]
        buffer = io.BytesIO()
        message.serialize(buffer)
        result.append(buffer.getvalue())
    return result


class Capture(unittest.TestCase):
    """The numbers were worked out from the lines by hand, over rotation matrices and Earth-centred
    coordinates, none of this project's code involved."""

    @classmethod
    def setUpClass(cls):
        listeners = {feed: Listener("/" + feed.__name__)
                     for feed in (whole, byte_by_byte, in_random_chunks)}
        try:
            cls.heard = {feed: listener.hear(feed) for feed, listener in listeners.items()}
        finally:
            for listener in listeners.values():
                listener.stop()

    def assert_near(self, expected, actual, tolerance=1e-9):
        names = ("x", "y", "z", "w")[:len(expected)]
        for value, name in zip(expected, names):
            self.assertAlmostEqual(value, getattr(actual, name), delta=tolerance, msg=str(actual))

    def test_number_of_messages(self):
        for feed, heard in self.heard.items():
            self.assertEqual({name: count for name, (_, count) in TOPICS.items()},
                             {name: len(messages) for name, messages in heard.items()},
                             feed.__name__)

    def test_record(self):
        self.assertEqual(capture().decode().split(),
                         [message.sentence for message in self.heard[whole]["nmea/rx"]])

    def test_first_odometry(self):
        odom = self.heard[whole]["odom"][0]
        self.assert_near((0.0, 0.0, 0.0), odom.pose.pose.position)
        # Heading 234.32964, roll -6.796959, pitch -1.706798 degrees.
        self.assert_near((-0.004000869037977588, 0.06097845356884392, -0.9498916046703747,
                          0.30654781131829023), odom.pose.pose.orientation)
        self.assertEqual(1e6, odom.twist.covariance[0])  # no velocity came before it
        self.assertAlmostEqual(9.0, odom.pose.covariance[0])
        self.assertAlmostEqual(0.0025, odom.pose.covariance[35])

    def test_second_odometry(self):
        odom = self.heard[whole]["odom"][1]
        # From 42d21.711142'N 71d05.44878'W to 42d21.516161'N 71d05.25215'W.
        self.assert_near((269.9859791071097, -360.97054254655205, 0.0), odom.pose.pose.position,
                         1e-6)
        # Heading 151.799032, roll 0.507128, pitch 2.519 degrees.
        self.assert_near((-0.007491223000423067, -0.021132838286836438, -0.5133214350399946,
                          0.8579034846953246), odom.pose.pose.orientation)
        # 0.02941 m/s east and 0.068552 m/s south; pitch rate 0.060938, yaw rate -0.061132 deg/s.
        self.assert_near((0.07424091459179916, -0.006505075325343838, -0.0032086445089455303),
                         odom.twist.twist.linear)
        self.assert_near((0.0, -0.0010635687395803045, 0.0010669546783291736),
                         odom.twist.twist.angular)

    def test_imu(self):
        imu = self.heard[whole]["imu/data"][0]
        self.assert_near((-0.004000869037977588, 0.06097845356884392, -0.9498916046703747,
                          0.30654781131829023), imu.orientation)
        self.assert_near((0.0, -0.0010635687395803045, 0.0010669546783291736),
                         imu.angular_velocity)
        # As the specification has it, though these are evidently g.
        self.assert_near((-0.026916, -0.104533, 0.932172), imu.linear_acceleration)

    def test_raw_imu(self):
        imu = self.heard[whole]["imu/data_raw"][0]
        self.assertEqual("imu_link", imu.header.frame_id)
        self.assert_near((-0.001065261708954739, 1.6929693744344997e-06, 0.001065261708954739),
                         imu.angular_velocity)
        self.assert_near((-0.026916, -0.104533, 0.932172), imu.linear_acceleration)
        self.assertEqual(-1.0, imu.orientation_covariance[0])

    def test_compass(self):
        compass = self.heard[whole]["compass/data"][0]
        self.assertEqual("compass_0_link", compass.header.frame_id)
        # Heading 234.326694, pitch -1.655603, roll -6.628557 degrees.
        self.assert_near((-0.00397654424616221, 0.05944611034492504, -0.9499864498564013,
                          0.3065552024512854), compass.orientation)

    def test_battery(self):
        battery = self.heard[whole]["battery"][0]
        self.assertEqual("battery", battery.location)
        self.assertAlmostEqual(15.091787, battery.voltage, delta=1e-6)
        self.assertEqual([battery.voltage] * 2, list(battery.cell_voltage))

    def test_fixes(self):
        first, second = self.heard[whole]["nav/fix"]
        self.assertAlmostEqual(42.36185236666667, first.latitude, delta=1e-12)
        self.assertAlmostEqual(-71.090813, first.longitude, delta=1e-12)
        self.assertAlmostEqual(42.35860268333333, second.latitude, delta=1e-12)
        self.assertAlmostEqual(-71.0875358333333, second.longitude, delta=1e-12)

    def test_gps(self):
        first, second = self.heard[whole]["gps/fix"]
        self.assertEqual(NavSatStatus.STATUS_FIX, first.status.status)
        self.assertAlmostEqual(13.4, first.altitude, delta=1e-9)  # 46.6 - 33.2
        self.assertEqual(NavSatStatus.STATUS_SBAS_FIX, second.status.status)
        self.assertAlmostEqual(-13.7, second.altitude, delta=1e-9)  # 19.5 - 33.2
        # 0.145 kn towards 156.78 degrees, 0.021 kn towards 0.
        first, second = self.heard[whole]["gps/velocity"]
        self.assert_near((0.02940980888751558, -0.0685521282176937, 0.0), first.twist.linear)
        self.assert_near((0.0, 0.010803333333333333, 0.0), second.twist.linear)
        # 2014-12-31 16:49:59 and 2014-06-26 15:02:16.2 UTC.
        first, second = self.heard[whole]["gps/time_reference"]
        self.assertEqual((1420044599, 0), (first.time_ref.secs, first.time_ref.nsecs))
        self.assertEqual((1403794936, 200000000), (second.time_ref.secs, second.time_ref.nsecs))

    def test_the_same_however_it_is_cut(self):
        for topic in TOPICS:
            expected = without_stamps(self.heard[whole][topic])
            for feed in (byte_by_byte, in_random_chunks):
                self.assertEqual(expected, without_stamps(self.heard[feed][topic]),
                                 "%s, %s" % (feed.__name__, topic))


class EndlessLine(unittest.TestCase):
    def test_costs_no_memory_and_the_next_sentence_counts(self):
        vehicle = FakeVehicle(lambda: navigation("CP"))
        self.addCleanup(vehicle.stop)
        driver = NodeDriver("/endless", parameters_for(vehicle))
        self.addCleanup(driver.stop)
        links = Collector("/endless/link", LinkStatus)
        odometry = Collector("/endless/odom", Odometry).wait_for_publisher()
        connection = vehicle.wait_for_connection()
        self.say(connection, 1, odometry)
        before = Usage(driver.process.pid)
        self.say(connection, 64, odometry)
        after = Usage(driver.process.pid)
        self.assertLessEqual(after.memory_kib, before.memory_kib + 1024, "%s, %s" % (before, after))
        links.wait_until(lambda link: link.oversized == 2)

    @staticmethod
    def say(connection, mebibytes, odometry):
        """A line of that length, and a good one after it."""
        count = len(odometry.received)
        connection.send(b"$CPNVG,")
        for _ in range(mebibytes):
            connection.send(b"A" * MEBIBYTE)
        connection.send(b"\r\n", navigation("CP"))
        odometry.wait_for(count + 1, timeout_s=30.0)


class HostileVehicle(unittest.TestCase):
    """Any bytes, as fast as they can be sent: nothing grows, and nothing waits for it."""

    FLOOD_S = 1.0
    MOST_KIB = 32 * 1024  # queues of all topics, full

    FLOODS = {
        "noise": bytes(random.Random(1).randrange(256) for _ in range(1 << 16)),
        "dollars": b"$" * (1 << 16),
        "line ends": b"\r\n" * (1 << 15),
        "wrong checksums": b"$CPNVG,1,2,3*00\r\n" * 4000,
        "unknown sentences": sentence("CPZZZ,1,2,3") * 4000,
        "positions": navigation("CP") * 700,
    }

    def test_cannot_crash_starve_or_fill_the_backseat(self):
        vehicle = FakeVehicle(lambda: navigation("CP"))
        self.addCleanup(vehicle.stop)
        driver = NodeDriver("/hostile", parameters_for(vehicle))
        self.addCleanup(driver.stop)
        odometry = Collector("/hostile/odom", Odometry).wait_for_publisher()
        connection = vehicle.wait_for_connection()
        stop = rospy.ServiceProxy("/hostile/stop", Trigger)
        stop.wait_for_service(10.0)
        for name, flood in self.FLOODS.items():
            self.flood(connection, flood)
            before = Usage(driver.process.pid)
            with row(flood=name):
                self.flood(connection, flood, meanwhile=lambda: self.assert_stops(stop))
                # The thread of the last call may be at its end a moment after the answer.
                wait_until(lambda: Usage(driver.process.pid).threads <= before.threads,
                           "the threads of %s" % before)
                after = Usage(driver.process.pid)
                self.assertLessEqual(after.memory_kib, before.memory_kib + self.MOST_KIB)
        connection.send(b"\r\n", navigation("CP", depth="3.125"))
        odometry.wait_until(lambda message: message.pose.pose.position.z == -3.125, 30.0)
        self.assertTrue(driver.process.runs())

    def assert_stops(self, stop):
        answer = stop()
        self.assertTrue(answer.success, answer.message)

    def flood(self, connection, data, meanwhile=lambda: None):
        flooding = threading.Thread(target=self.send_for, args=(connection, data, self.FLOOD_S))
        flooding.start()
        while flooding.is_alive():
            meanwhile()
            flooding.join(0.1)

    @staticmethod
    def send_for(connection, data, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            connection.send(data)


if __name__ == "__main__":
    run("input")
