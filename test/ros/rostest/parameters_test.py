#!/usr/bin/env python3
"""A parameter that cannot be used stops the node, or the one nodelet, with one line."""

import concurrent.futures
import unittest

import rosgraph
from nav_msgs.msg import Odometry

from driver_under_test import (Collector, NodeDriver, NodeletDriver, parameters_for, row, run)
from fake_vehicle import boat, navigation, wait_until

# Name, value, the value as the line shows it, and what the line says is accepted.
BAD = (
    ("host", "", '""', "a host name or an address, without blanks,"),
    ("host", 7, "7", "a host name or an address, without blanks,"),
    ("port", 0, "0", "a whole number 1..65535"),
    ("port", 70000, "70000", "a whole number 1..65535"),
    ("port", "http", '"http"', "a whole number 1..65535"),
    ("port", 29500.5, "29500.5", "a whole number 1..65535"),
    ("dialect", "seashark", '"seashark"', "sandshark, kingfisher or auto"),
    ("source", "file", '"file"', "tcp or topic"),
    ("interface_version", "0,1", '"0,1"', "a number or a text of 1 to 20 printable ASCII"),
    ("log_sentences", ["NVG", "nvr"], '["NVG", "nvr"]', "a list of sentence names"),
    ("use_acks", "yes", '"yes"', "true or false"),
    ("connect_timeout", 0, "0", "a number above 0 and up to 3600 s"),
    ("reconnect_min", -1.0, "-1", "a number above 0 and up to 3600 s"),
    ("reconnect_max", 1e9, "1000000000", "a number above 0 and up to 3600 s"),
    ("silence_timeout", False, "false", "a number above 0 and up to 3600 s"),
    ("odom_frame", "o dom", '"o dom"', "a frame name, without blanks,"),
    ("base_frame", "/", '"/"', "a frame name, without blanks,"),
    ("publish_tf", 1, "1", "true or false"),
    ("publish_frd_frames", "no", '"no"', "true or false"),
    ("datum", [91.0, 0.0], "[91, 0]", "a list [latitude -90..90, longitude -180..180]"),
    ("datum", [42.0], "[42]", "a list [latitude -90..90, longitude -180..180]"),
    ("heading_reference", "magnetic", '"magnetic"', "grid or true"),
    ("stamp", "gps", '"gps"', "synced, vehicle or receive"),
    ("leap_seconds", 18.5, "18.5", "a whole number -60..60"),
    ("command_timeout", 6, "6", "a number above 0 and up to 5 s"),
    ("max_command_age", 0.0, "0", "a number above 0 and up to 3600 s"),
    ("command_rate", 0.1, "0.1", "a number 0.25..100 Hz"),
    ("control_hook", "always", '"always"', "ctl, mis or none"),
    ("send_spacing", 2, "2", "a number 0..1 s"),
    ("commands_enabled", 0, "0", "true or false"),
    ("thrust_decimals", 7, "7", "a whole number 0..6"),
    ("yaw_rate_unit", "turns", '"turns"', "rad or deg"),
    ("speed_table", [[1.0, 600], [0.5, 900]], "[[1, 600], [0.5, 900]]", "a list of pairs"),
    ("max_jump", 0, "0", "a number above 0 and up to 1000000 m/s"),
    ("magnetic_declination", 15.0, "15", "a number -3.141592653589793..3.141592653589793 rad"),
    ("compass_convention", "boat", '"boat"', "spec or heron"),
    ("acceleration_unit", "ft/s2", '"ft/s2"', "m/s2 or g"),
    ("fill_behavior_fields", "true", '"true"', "true or false"),
    ("ack_timeout", 61, "61", "a number above 0 and up to 60 s"),
    ("max_data_age", [2], "[2]", "a number above 0 and up to 3600 s"),
    ("allow_raw_sentences", 1.0, "1", "true or false"),
    ("effect_timeout", 0, "0", "a number above 0 and up to 3600 s"),
    ("max_speed", 11, "11", "a number above 0 and up to 10 m/s"),
    ("max_yaw_rate", -1, "-1", "a number above 0 and up to 10 rad/s"),
    ("status_rate", 11, "11", "a number 0..10 Hz"),
    ("position_stddev_gps", 0, "0", "a number above 0 and up to 1000 m"),
    ("orientation_stddev", {"roll": 1}, "{roll: 1}", "a number above 0 and up to 1000 rad"),
)


def start_with(number, row):
    """The exit code and all that the node says."""
    name, value, _, _ = row
    driver = NodeDriver("/bad%d" % number, {name: value})
    try:
        return driver.process.wait(30.0), driver.process.output
    finally:
        driver.stop()


class BadParameter(unittest.TestCase):
    def test_stops_the_node_with_one_line(self):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            results = list(pool.map(start_with, range(len(BAD)), BAD))
        for (name, value, shown, accepted), (code, lines) in zip(BAD, results):
            with row(name=name, value=value):
                self.assertEqual(1, code, lines)
                self.assertEqual(1, len(lines), lines)
                self.assertIn("parameter %s is %s: %s" % (name, shown, accepted), lines[0])
                self.assertTrue(lines[0].endswith(" is accepted"), lines[0])

    def test_leaves_one_nodelet_down_and_the_others_at_work(self):
        vehicle = boat()
        self.addCleanup(vehicle.stop)
        good = NodeletDriver("/good", parameters_for(vehicle))
        self.addCleanup(good.stop)
        odometry = Collector("/good/odom", Odometry).wait_for_publisher()
        with self.assertRaises(AssertionError):
            NodeletDriver("/bad", {"port": -1}, good.manager)
        complaint = "parameter port is -1: a whole number"
        wait_until(lambda: any(complaint in line for line in good.process.output), complaint)
        topics = [topic for topic, _ in rosgraph.Master("/test").getPublishedTopics("/bad")]
        self.assertEqual([], topics)
        count = len(odometry.received)
        vehicle.connections[-1].send(navigation("CP"))
        odometry.wait_for(count + 1)
        repaired = NodeletDriver("/bad", parameters_for(vehicle), good.manager)
        self.addCleanup(repaired.stop)
        vehicle.wait_for_connection(2)


class MisspeltParameter(unittest.TestCase):
    def test_is_warned_about_with_the_nearest_name(self):
        vehicle = boat()
        self.addCleanup(vehicle.stop)
        driver = NodeDriver("/misspelt", parameters_for(vehicle, comand_timeout=2.0))
        self.addCleanup(driver.stop)
        vehicle.wait_for_connection()
        wait_until(lambda: [line for line in driver.process.warnings()
                            if "comand_timeout is not known" in line
                            and "did you mean command_timeout?" in line], "the warning")
        self.assertTrue(driver.process.runs())


if __name__ == "__main__":
    run("parameters")
