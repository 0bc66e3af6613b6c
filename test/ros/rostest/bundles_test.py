#!/usr/bin/env python3
"""A frontseat that gathers its sentences and writes fifty of them at once, ten times a second:
nothing is lost on any topic, and everything comes in the order in which it was written."""

import threading
import unittest

from frontseat_driver.msg import Sentence
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Imu, NavSatFix, Range, TimeReference

from driver_under_test import Collector, NodeDriver, NodeletDriver, parameters_for, run
from fake_vehicle import boat, sentence, time_of_day, velocity

BUNDLES = 30
PERIOD_S = 0.1


def position(depth):
    now = time_of_day(18)
    return sentence("CPNVG,%s,4221.0,N,7106.0,W,1,5.5,%d,90,0,0,%s" % (now, depth, now))


def raw_imu():
    return sentence("CPIMU,%s,1,2,3,0,0,9.8" % time_of_day(18))


def compass():
    return sentence("CPRCM,%s,0,90,0,0," % time_of_day(18))


def battery():
    return sentence("CPRBS,%s,1,15.1,3.7,3.8,21" % time_of_day(18))


def fix():
    return sentence("GPGGA,%s,4221.0,N,07106.0,W,1,06,2.8,46.6,M,-33.2,M,," % time_of_day())


def speed():
    return sentence("GPRMC,%s,A,4221.0,N,07106.0,W,1.5,90,311214,,,A" % time_of_day())


def bundle(number):
    """Ten rounds of five sentences; the depth counts the positions."""
    rounds = [[position(10 * number + i), velocity("CP"), raw_imu(),
               compass() if i % 2 else battery(), fix() if i % 2 else speed()]
              for i in range(10)]
    return b"".join(line for lines in rounds for line in lines)


# Messages of one bundle.
TOPICS = {
    "odom": (Odometry, 10),
    "imu/data": (Imu, 10),
    "imu/data_raw": (Imu, 10),
    "compass/data": (Imu, 5),
    "nav/fix": (NavSatFix, 10),
    "nav/velocity": (TwistStamped, 10),
    "depth": (PoseWithCovarianceStamped, 10),
    "altitude": (Range, 10),
    "battery": (BatteryState, 5),
    "gps/fix": (NavSatFix, 5),
    "gps/velocity": (TwistStamped, 5),
    "gps/time_reference": (TimeReference, 5),
    "nmea/rx": (Sentence, 50),
}


class Bundles(unittest.TestCase):
    def hear(self, kind, namespace):
        vehicle = boat()
        self.addCleanup(vehicle.stop)
        driver = kind(namespace, parameters_for(vehicle))
        self.addCleanup(driver.stop)
        topics = {name: Collector(namespace + "/" + name, message)
                  for name, (message, _) in TOPICS.items()}
        for collector in topics.values():
            self.addCleanup(collector.close)
            collector.wait_for_publisher()
        connection = vehicle.wait_for_connection()
        before = {name: len(collector.received) for name, collector in topics.items()}
        clock = threading.Event()
        for number in range(BUNDLES):
            connection.send(bundle(number))
            clock.wait(PERIOD_S)
        return {name: collector.wait_for(before[name] + BUNDLES * TOPICS[name][1], 30.0)
                [before[name]:] for name, collector in topics.items()}

    def check(self, kind, namespace):
        heard = self.hear(kind, namespace)
        self.assertEqual({name: BUNDLES * count for name, (_, count) in TOPICS.items()},
                         {name: len(messages) for name, messages in heard.items()})
        self.assertEqual([-float(i) for i in range(10 * BUNDLES)],
                         [message.pose.pose.position.z for message in heard["odom"]])

    def test_node(self):
        self.check(NodeDriver, "/node")

    def test_nodelet(self):
        self.check(NodeletDriver, "/nodelet")


if __name__ == "__main__":
    run("bundles")
