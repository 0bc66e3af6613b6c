#!/usr/bin/env python3
"""Ten minutes of a mission at twenty times the speed: odometry is where the vehicle is."""

import math
import time
import unittest

import rospy
from nav_msgs.msg import Odometry

from driver_under_test import NodeDriver, Simulator, parameters_for, run
from fake_vehicle import wait_until

DATUM = [42.35, -71.1]
SPEED = 20.0
MISSION_S = 600.0
MOST_POSITION_M = 0.01
MOST_ANGLE_DEG = 0.01
LEAST_MATCHED = 0.9


class Recorder:
    """Messages as they come over the wire: they are read when the mission is over."""

    def __init__(self, topic):
        self.raw = []
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._take, buff_size=1 << 24)

    def _take(self, message):
        self.raw.append(message._buff)

    def by_stamp(self):
        result = {}
        for raw in self.raw:
            odometry = Odometry()
            odometry.deserialize(raw)
            result[odometry.header.stamp.to_nsec()] = odometry.pose.pose
        return result

    def close(self):
        self._subscriber.unregister()


def distance_m(one, other):
    return math.sqrt(sum((getattr(one.position, axis) - getattr(other.position, axis)) ** 2
                         for axis in "xyz"))


def angle_deg(one, other):
    """Of the turn from one to the other; by its sine, since the cosine of a small one is 1."""
    a, b = one.orientation, other.orientation
    x = a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y
    y = a.w * b.y - a.y * b.w - a.z * b.x + a.x * b.z
    z = a.w * b.z - a.z * b.w - a.x * b.y + a.y * b.x
    return math.degrees(2.0 * math.asin(min(1.0, math.sqrt(x * x + y * y + z * z))))


class Vehicle:
    def __init__(self, dialect):
        namespace = "/" + dialect
        self.simulator = Simulator(namespace + "/simulator", dialect, speed=SPEED, noise=False,
                                   datum=DATUM)
        self.truth = Recorder(namespace + "/simulator/odom")
        self.driver = NodeDriver(namespace, parameters_for(self.simulator, stamp="vehicle",
                                                           datum=DATUM, dialect=dialect))
        self.odometry = Recorder(namespace + "/odom")

    def stop(self):
        self.truth.close()
        self.odometry.close()
        self.driver.stop()
        self.simulator.stop()


class Truth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        vehicles = {dialect: Vehicle(dialect) for dialect in ("sandshark", "kingfisher")}
        try:
            for vehicle in vehicles.values():
                wait_until(lambda: vehicle.truth.raw and vehicle.odometry.raw, "odometry")
            began = time.monotonic()
            wait_until(lambda: time.monotonic() - began > MISSION_S / SPEED,
                       "the end of the mission", timeout_s=MISSION_S)
        finally:
            for vehicle in vehicles.values():
                vehicle.stop()
        cls.vehicles = vehicles

    def check(self, dialect):
        truth = self.vehicles[dialect].truth.by_stamp()
        odometry = self.vehicles[dialect].odometry.by_stamp()
        matched = sorted(set(truth) & set(odometry))
        errors_m = [distance_m(truth[stamp], odometry[stamp]) for stamp in matched]
        errors_deg = [angle_deg(truth[stamp], odometry[stamp]) for stamp in matched]
        seconds = (matched[-1] - matched[0]) * 1e-9 if matched else 0.0
        text = ("%s: %d of %d odometry messages matched, over %.0f s; at most %.4f m and %.5f deg"
                % (dialect, len(matched), len(odometry), seconds, max(errors_m, default=math.nan),
                   max(errors_deg, default=math.nan)))
        print(text, flush=True)
        self.assertGreater(len(matched), LEAST_MATCHED * len(odometry), text)
        self.assertGreater(len(matched), 1000, text)
        self.assertGreater(seconds, 0.8 * MISSION_S, text)
        self.assertLess(max(errors_m), MOST_POSITION_M, text)
        self.assertLess(max(errors_deg), MOST_ANGLE_DEG, text)
        self.assertGreater(max(distance_m(truth[matched[0]], pose)
                               for pose in odometry.values()), 10.0)  # it did move

    def test_sandshark(self):
        self.check("sandshark")

    def test_kingfisher(self):
        self.check("kingfisher")


if __name__ == "__main__":
    run("truth")
