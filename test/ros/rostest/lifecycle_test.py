#!/usr/bin/env python3
"""Vehicles that come and go, and nodelets that do."""

import time
import unittest

import tf2_msgs.msg
from diagnostic_msgs.msg import DiagnosticArray
from frontseat_driver.msg import ControlStatus, InterfaceVersion, LinkStatus
from nav_msgs.msg import Odometry

from driver_under_test import (Collector, Manager, NodeDriver, NodeletDriver, Simulator,
                               Usage, parameters_for, run)
from fake_vehicle import boat, wait_until

MORE_KIB = 1024  # what a heap may vary by
MORE_FILES = 4  # master and test keep some of their connections to a node


class Lifecycle(unittest.TestCase):
    def started(self, thing):
        self.addCleanup(thing.stop)
        return thing

    @staticmethod
    def assert_not_grown(before, process):
        """Connections that are just being closed have the time to."""
        def settled():
            after = Usage(process.pid)
            return (after.threads <= before.threads and after.files <= before.files + MORE_FILES
                    and after.memory_kib <= before.memory_kib + MORE_KIB)

        try:
            wait_until(settled, "no more than before")
        except AssertionError:
            raise AssertionError("%s, then %s" % (before, Usage(process.pid)))


class VehicleRestarts(Lifecycle):
    WARM_UP = 15
    RESTARTS = 50

    def test_the_same_process_is_back_with_data_each_time(self):
        vehicle = self.started(boat())
        driver = self.started(NodeDriver("/restarts", parameters_for(
            vehicle, reconnect_min=0.01, reconnect_max=0.05)))
        links = Collector("/restarts/link", LinkStatus)
        odometry = Collector("/restarts/odom", Odometry).wait_for_publisher()
        for number in range(1, self.RESTARTS + 1):
            vehicle.wait_for_connection(number)
            vehicle.stop(reset=number % 2 == 0)
            vehicle.connections[-1].wait_for_end()
            count = len(odometry.received)
            vehicle.start()
            odometry.wait_for(count + 1)
            if number == self.WARM_UP:
                before = Usage(driver.process.pid)
        self.assert_not_grown(before, driver.process)
        links.wait_until(lambda link: link.connected and link.connects == self.RESTARTS + 1)
        self.assertTrue(driver.process.runs())


class HostDown(Lifecycle):
    def test_one_line_then_retries_until_it_is_up(self):
        diagnostics = Collector("/diagnostics", DiagnosticArray)
        vehicle = self.started(boat())
        vehicle.stop()
        driver = self.started(NodeDriver("/down", parameters_for(vehicle)))
        # Once a second, and tries are at most 0.1 s apart.
        diagnostics.wait_for_publisher().wait_for(2)
        lines = driver.process.warnings()
        self.assertEqual(1, len(lines), lines)
        self.assertIn("cannot connect to the vehicle at 127.0.0.1:%d" % vehicle.port, lines[0])
        self.assertIn("refused", lines[0])
        odometry = Collector("/down/odom", Odometry).wait_for_publisher()
        vehicle.start()
        odometry.wait_for()
        self.assertEqual(lines, driver.process.warnings())


class TwoVehicles(Lifecycle):
    def setUp(self):
        self.manager = self.started(Manager("/fleet"))
        self.simulators = {}
        self.drivers = {}
        for name, dialect in (("shark", "sandshark"), ("fisher", "kingfisher")):
            simulator = self.started(Simulator("/%s/simulator" % name, dialect))
            parameters = parameters_for(simulator, odom_frame=name + "/odom",
                                        base_frame=name + "/base_link")
            self.simulators[name] = simulator
            self.drivers[name] = NodeletDriver("/" + name, parameters, self.manager)

    def static_frames(self):
        """As a late subscriber sees them; empty while there are fewer than expected."""
        collector = Collector("/tf_static", tf2_msgs.msg.TFMessage)
        try:
            collector.wait_for_publisher()
            collector.wait_for()
            return {(frame.header.frame_id, frame.child_frame_id)
                    for message in collector.messages for frame in message.transforms}
        finally:
            collector.close()

    def test_in_one_manager_do_not_disturb_each_other(self):
        frames = Collector("/tf", tf2_msgs.msg.TFMessage)
        odometry = {name: Collector("/%s/odom" % name, Odometry) for name in self.drivers}
        for name in self.drivers:
            for odom in odometry[name].wait_for(20):
                self.assertEqual((name + "/odom", name + "/base_link"),
                                 (odom.header.frame_id, odom.child_frame_id))
        self.assertEqual({("shark/odom", "shark/base_link"), ("fisher/odom", "fisher/base_link")},
                         {(frame.header.frame_id, frame.child_frame_id)
                          for message in frames.messages for frame in message.transforms})
        helpers = {name: {(name + "/base_link", name + "/base_link_frd"),
                          (name + "/odom", name + "/odom_ned")} for name in self.drivers}
        wait_until(lambda: self.static_frames() == helpers["shark"] | helpers["fisher"],
                   "the helper frames of both")
        for name, dialect in (("shark", "sandshark"), ("fisher", "kingfisher")):
            link = Collector("/%s/link" % name, LinkStatus).wait_for()[0]
            self.assertEqual((True, dialect, 1), (link.connected, link.dialect, link.connects))
        Collector("/shark/interface_version", InterfaceVersion).wait_for()
        grants = [Collector("/%s/control" % name, ControlStatus).wait_until(
            lambda control: control.grant == ControlStatus.GRANTED) for name in self.drivers]
        self.assertEqual(2, len(grants))

        self.simulators["shark"].stop()
        Collector("/shark/link", LinkStatus).wait_until(lambda link: not link.connected)
        odometry["fisher"].wait_for(len(odometry["fisher"].received) + 5)
        self.drivers["shark"].unload()
        odometry["fisher"].wait_for(len(odometry["fisher"].received) + 5)
        wait_until(lambda: self.static_frames() == helpers["fisher"],
                   "the helper frames of the one that is left")
        link = Collector("/fisher/link", LinkStatus).wait_for()[0]
        self.assertEqual((True, 1), (link.connected, link.connects))


class Nodelet(Lifecycle):
    WARM_UP = 6
    TIMES = 20

    def test_is_loaded_and_unloaded_without_a_trace(self):
        vehicle = self.started(boat())
        manager = self.started(Manager("/coming_and_going"))
        slowest_s = 0.0
        for number in range(1, self.TIMES + 1):
            driver = NodeletDriver("/guest", parameters_for(vehicle), manager)
            vehicle.wait_for_connection(number)
            began = time.monotonic()
            driver.unload()
            slowest_s = max(slowest_s, time.monotonic() - began)
            self.assertEqual("closed", vehicle.connections[-1].wait_for_end())
            if number == self.WARM_UP:
                before = Usage(manager.process.pid)
        self.assertLess(slowest_s, 1.0)
        self.assert_not_grown(before, manager.process)


if __name__ == "__main__":
    run("lifecycle")
