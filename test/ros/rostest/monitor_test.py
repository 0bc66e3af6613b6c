#!/usr/bin/env python3
"""frontseat_monitor in a terminal: what it shows of a simulated mission, and what it leaves."""

import os
import re
import signal
import subprocess
import sys
import time
import unittest

import rosgraph

from driver_under_test import NodeDriver, Process, Simulator, parameters_for, program, run
from fake_vehicle import wait_until
from terminal import PATIENCE_S, Terminal

NAMESPACE = "/deck"
MONITOR = program("frontseat_driver", "frontseat_monitor")
LIVE = ("CONNECTED", "sandshark", "GRANTED", "RUNNING", "BFNVG", "BPSTS", "DONE", " m  north ",
        "heading", "q quits")
COLOR = re.compile(r"\x1b\[[0-9;]*3[0-7]m")
MASTER = """import rosmaster.master, sys, time
master = rosmaster.master.Master(int(sys.argv[1]))
master.start()
print(master.uri, flush=True)
while True: time.sleep(60)
"""
CRASH = """from frontseat_driver.monitor import main, screen
screen.render = lambda *a, **k: [][1]
main.main()"""


def cpu_s(pid):
    with open("/proc/%d/stat" % pid) as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Monitor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulator = Simulator(NAMESPACE + "/simulator", "sandshark")
        cls.driver = NodeDriver(NAMESPACE, parameters_for(cls.simulator))

    @classmethod
    def tearDownClass(cls):
        cls.driver.stop()
        cls.simulator.stop()

    def terminal(self, command=MONITOR + " " + NAMESPACE, **options):
        terminal = Terminal(command, **options)
        self.addCleanup(terminal.close)
        return terminal

    def ends_clean(self, terminal, code):
        shown = terminal.wait_for("ended with %d" % code)
        self.assertEqual([], terminal.leftovers())
        return shown

    def test_it_shows_the_mission_at_every_size(self):
        terminal = self.terminal()
        terminal.wait_for(*LIVE)
        self.assertTrue(COLOR.search(terminal.screen("-e")))
        began, used = time.monotonic(), cpu_s(terminal.program())
        for columns, lines in ((60, 20), (132, 43), (80, 24)):
            terminal.resize(columns, lines)
            wait_until(lambda: "q quits" in (terminal.screen().splitlines() + [""] * lines)
                       [lines - 1], "a screen of %d lines" % lines, PATIENCE_S)
            self.assertEqual(1, terminal.wait_for(*LIVE).count("q quits"))
        clock = re.search(r"\d\d:\d\d:\d\d UTC", terminal.screen()).group()
        wait_until(lambda: clock not in terminal.screen(), "the next second", PATIENCE_S)
        wait_until(lambda: time.monotonic() - began > 4.0, "some time to pass")
        share = (cpu_s(terminal.program()) - used) / (time.monotonic() - began)
        print("monitor: %.1f %% of a core" % (100.0 * share), flush=True)
        self.assertLess(share, 0.25)  # it has 1 %, and 100 if it waits busily
        os.kill(terminal.program(), signal.SIGTERM)
        self.ends_clean(terminal, 0)

    def test_without_colour_and_the_namespace_of_ros(self):
        terminal = self.terminal(MONITOR, NO_COLOR="1", ROS_NAMESPACE=NAMESPACE[1:])
        terminal.wait_for(*LIVE)
        self.assertFalse(COLOR.search(terminal.screen("-e")))
        os.kill(terminal.program(), signal.SIGINT)
        self.ends_clean(terminal, 0)

    def test_an_old_terminal_and_control_c(self):
        terminal = self.terminal(MONITOR + " __ns:=" + NAMESPACE, term="vt100")
        terminal.wait_for(*LIVE)
        self.assertFalse(COLOR.search(terminal.screen("-e")))
        terminal.type("C-c")
        self.assertNotIn("Traceback", self.ends_clean(terminal, 0))

    def test_a_crash_leaves_the_terminal_clean_and_says_why(self):
        terminal = self.terminal("%s -c '%s'" % (sys.executable, CRASH))
        self.assertIn("IndexError", self.ends_clean(terminal, 1))

    def test_a_driver_that_dies_is_told_and_its_values_grow_old(self):
        driver = NodeDriver("/brief", parameters_for(self.simulator))
        terminal = self.terminal(MONITOR + " /brief")
        terminal.wait_for("CONNECTED", "BFNVG", " m  north ")
        driver.process.send_signal(signal.SIGKILL)
        shown = terminal.wait_for("DRIVER SILENT for", "OLD ", "was connected to")
        self.assertNotIn("GRANTED", shown)
        terminal.type("q")
        self.assertNotIn("SILENT", self.ends_clean(terminal, 0))

    def test_a_namespace_without_driver_names_the_others(self):
        self.terminal(MONITOR + " /nowhere").wait_for("no driver heard in namespace /nowhere",
                                                      "there is one in:", NAMESPACE)

    def master(self, port=0):
        """A process, and where it listens."""
        process = Process([sys.executable, "-c", MASTER, str(port)])
        self.addCleanup(process.stop)
        lines = wait_until(lambda: [line for line in process.output if line.startswith("http")],
                           "the master", PATIENCE_S)
        return process, lines[0]

    def test_a_master_that_dies_is_told_and_a_new_one_is_joined(self):
        master, uri = self.master()
        terminal = self.terminal(ROS_MASTER_URI=uri)
        terminal.wait_for("no driver heard")
        wait_until(lambda: "waiting for the ROS master" not in terminal.screen(), "the master",
                   PATIENCE_S)
        master.send_signal(signal.SIGKILL)
        master.wait()
        terminal.wait_for("NO ROS MASTER at", "is roscore running?")
        self.master(int(uri.rstrip("/").rsplit(":", 1)[1]))

        def is_subscribed():
            _, subscribers, _ = rosgraph.Master("/test", uri).getSystemState()
            return NAMESPACE + "/link" in dict(subscribers)
        wait_until(is_subscribed, "the monitor to join the new master", PATIENCE_S)
        wait_until(lambda: "NO ROS MASTER" not in terminal.screen(), "good news", PATIENCE_S)
        terminal.type("q")
        self.ends_clean(terminal, 0)

    def test_into_a_pipe_goes_text(self):
        process = subprocess.Popen([MONITOR, NAMESPACE, "--period", "0.2"],
                                   stdout=subprocess.PIPE)
        text = b""
        while b"GRANTED" not in text:
            text += process.stdout.readline()
        process.send_signal(signal.SIGTERM)
        rest, _ = process.communicate(timeout=PATIENCE_S)
        self.assertNotIn(b"\x1b", text + rest)
        self.assertEqual(0, process.returncode)

    def test_a_dumb_terminal_gets_text(self):
        terminal = self.terminal(MONITOR + " " + NAMESPACE + " --period 0.5", term="dumb")
        terminal.wait_for("GRANTED")
        wait_until(lambda: terminal.screen("-S", "-500").count("frontseat_monitor") > 2,
                   "three blocks", PATIENCE_S)
        terminal.type("C-c")
        self.ends_clean(terminal, 0)


if __name__ == "__main__":
    run("monitor")
