#!/usr/bin/env python3
"""nmea_plot from the command line: what it makes of good and bad input."""

import os
import subprocess
import tempfile
import unittest

import roslib.packages
import rosbag
import rospy
import rosunit
from nav_msgs.msg import Odometry

HERE = os.path.dirname(os.path.abspath(__file__))
CAPTURE = os.path.join(HERE, "..", "..", "captures", "heron_2014.nmea")
PLOT = roslib.packages.find_node("frontseat_driver", "nmea_plot")[0]
DECODE = roslib.packages.find_node("frontseat_driver", "nmea_decode")[0]

# Name, arguments, exit code, and what the one line must say.
REFUSED = (
    ("no_input", ["missing.bag", "out.png"], 1, "cannot read missing.bag: No such file"),
    ("wrong_ending", ["dive.bag", "out.pdf"], 2, "out.pdf\": the name must end with .png, .svg"),
    ("no_ending", ["dive.bag", "out"], 2, "the name must end with"),
    ("broken_bag", ["broken.bag", "out.png"], 1, "broken.bag"),
    ("no_folder", ["dive.bag", "nowhere/out.png"], 1, "nowhere/out.png"),
    ("no_such_vehicle", ["dive.bag", "out.png", "--namespace", "/x"], 1,
     "no vehicle in namespace /x; there is: /"),
)


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = cls._folder.name
        with rosbag.Bag(os.path.join(cls.folder, "dive.bag"), "w") as bag:
            for tick in range(100):
                message = Odometry()
                message.header.stamp = rospy.Time(1000 + tick)
                message.pose.pose.position.x = tick
                bag.write("/odom", message, message.header.stamp)
        with open(os.path.join(cls.folder, "broken.bag"), "wb") as file:
            file.write(b"#ROSBAG V2.0\nrubbish")

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def plot(self, *arguments, program=PLOT, stdin=b""):
        done = subprocess.run([program] + list(arguments), cwd=self.folder, input=stdin,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        return done.returncode, done.stderr.decode()

    def made(self, name):
        with open(os.path.join(self.folder, name), "rb") as file:
            return file.read()

    def test_a_bag(self):
        self.assertEqual((0, ""), self.plot("dive.bag", "out.svg", "--title", "My dive",
                                            "__name:=plot"))
        self.assertIn(b"<svg", self.made("out.svg"))

    def test_a_capture(self):
        self.assertEqual((0, ""), self.plot(CAPTURE, "heron.html"))
        page = self.made("heron.html").decode("utf-8")
        for words in ("<h1>heron_2014.nmea</h1>", "<th>fastest</th>", "<th>battery</th>"):
            self.assertIn(words, page)

    def test_standard_input(self):
        with open(CAPTURE, "rb") as file:
            self.assertEqual((0, ""), self.plot("-", "piped.html", stdin=file.read()))
        self.assertIn(b"<h1>standard input</h1>", self.made("piped.html"))

    def test_by_way_of_nmea_decode(self):
        self.assertEqual((0, ""), self.plot("--plot", "decoded.svg", "--vehicle", "/", "dive.bag",
                                            program=DECODE))
        self.assertIn(b"<svg", self.made("decoded.svg"))


def refused(arguments, code, words):
    def test(self):
        returned, said = self.plot(*arguments)
        self.assertEqual(code, returned, said)
        self.assertIn(words, said)
        self.assertNotIn("Traceback", said)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "out.png")))
    return test


for name, *row in REFUSED:
    setattr(Program, "test_refuses_" + name, refused(*row))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "plot_program", Program)
