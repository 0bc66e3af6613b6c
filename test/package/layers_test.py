#!/usr/bin/env python3
"""The layers keep to the arrows of doc/architecture.md, and the check that says so can fail."""

import importlib.machinery
import importlib.util
import os
import tempfile
import unittest

import package_under_test as package


def load_checker():
    path = os.path.join(package.ROOT, "scripts", "check_layers")
    loader = importlib.machinery.SourceFileLoader("check_layers", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


CHECKER = load_checker()

FORBIDDEN = (
    ("ros_header", "session", "#include <ros/ros.h>", "a ROS header"),
    ("standard_message", "driver", "#include <nav_msgs/Odometry.h>", "a ROS header"),
    ("own_message", "session", '#include "frontseat_driver/LinkStatus.h"', "a ROS header"),
    ("tf2", "vehicle", "#include <tf2/LinearMath/Quaternion.h>", "a ROS header"),
    ("upwards", "nmea", '#include "frontseat_driver/protocol/message.h"', "a header of protocol"),
    ("between_leaves", "link", '#include "frontseat_driver/vehicle/clock.h"',
     "a header of vehicle"),
    ("sim_uses_session", "sim", '#include "frontseat_driver/session/session.h"',
     "a header of session"),
    ("driver_skips_session", "driver", '#include "frontseat_driver/protocol/message.h"',
     "a header of protocol"),
    ("clock", "session", "auto now = std::chrono::steady_clock::now();", "a clock"),
    ("sleep", "protocol", "std::this_thread::sleep_for(pause);", "a wait"),
    ("thread", "session", "std::thread worker(run);", "a thread"),
    ("socket", "session", "#include <boost/asio.hpp>", "a socket"),
    ("logger", "driver", 'ROS_INFO("connected");', "a logger"),
    ("print", "nmea", 'printf("%d", count);', "a logger"),
)

ALLOWED = (
    ("own_layer", "session", '#include "frontseat_driver/session/session.h"'),
    ("down_the_arrows", "session", '#include "frontseat_driver/protocol/message.h"'),
    ("standard_library", "nmea", "#include <string_view>"),
    ("clock_type", "vehicle", "using SteadyTime = std::chrono::steady_clock::time_point;"),
    ("clock_in_driver", "driver", "auto now = std::chrono::steady_clock::now();"),
    ("socket_in_link", "link", "#include <boost/asio.hpp>"),
    ("comment", "session", "// std::thread worker(run); ROS_INFO"),
    ("names_alike", "protocol", "timeOfDay(time); start_time(now); snprintf(text, n, format);"),
)


class Layers(unittest.TestCase):
    def test_sources_keep_to_the_arrows(self):
        self.assertEqual([], CHECKER.check(package.ROOT))

    def test_there_are_sources_in_every_layer(self):
        layers = {layer for layer, _ in CHECKER.sources(package.ROOT)}
        self.assertEqual(set(CHECKER.ARROWS), layers)

    def test_a_planted_fault_is_found_in_its_file_and_line(self):
        with tempfile.TemporaryDirectory() as root:
            folder = os.path.join(root, "src", "nmea")
            os.makedirs(folder)
            with open(os.path.join(folder, "bad.cpp"), "w") as file:
                file.write("/* two\nlines */\n#include <ros/ros.h>\n")
            self.assertEqual(["src/nmea/bad.cpp:3: nmea may not include a ROS header"],
                             CHECKER.check(root))


def refuses(layer, line, reason):
    def test(self):
        reasons = [found for _, found in CHECKER.faults(layer, line)]
        self.assertEqual(1, len(reasons), reasons)
        self.assertIn(reason, reasons[0])
    return test


def accepts(layer, line):
    def test(self):
        self.assertEqual([], list(CHECKER.faults(layer, line)))
    return test


for name, layer, line, reason in FORBIDDEN:
    setattr(Layers, "test_refuses_" + name, refuses(layer, line, reason))
for name, layer, line in ALLOWED:
    setattr(Layers, "test_accepts_" + name, accepts(layer, line))

if __name__ == "__main__":
    package.run(Layers)
