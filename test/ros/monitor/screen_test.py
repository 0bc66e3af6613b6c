#!/usr/bin/env python3
"""The screen says what it must at every size, and never shows old as new."""

import unittest

import rosunit
from diagnostic_msgs.msg import DiagnosticStatus
from frontseat_driver.msg import CommandAck, ControlStatus, MissionStatus
from sensor_msgs.msg import NavSatStatus

import messages
from frontseat_driver.monitor import layout, screen
from frontseat_driver.monitor.state import State

NOW = 1000.0
SIZES = ((80, 24), (60, 20), (132, 43))
TINY = ((1, 1), (2, 2), (10, 3), (20, 5), (39, 24), (80, 1), (400, 100))


def healthy(at=NOW - 0.1):
    state = State("/", now=at - 60.0)
    state.take_master(at, "http://127.0.0.1:11311", True)
    state.take_link(at, messages.link(), "/frontseat")
    state.take_control(at, messages.control())
    state.take_mission(at - 30.0, messages.mission())
    state.take_odom(at, messages.odom(123.4, -45.6, 359.97, 1.2, -3.4, 1.52))
    state.take_fix(at, messages.fix(42.358525, -71.087591, NavSatStatus.STATUS_NO_FIX))
    state.take_depth(at, messages.depth(4.02))
    state.take_altitude(at, messages.altitude(12.3))
    state.take_battery(at, messages.battery())
    for tick in range(50):
        state.take_received(at - 4.85 + 0.1 * tick, "$BFNVG,1*00")
    state.take_sent(at, "$BPRMB,120000.000,90.0,4.0,0,1.5,1,0*00")
    state.take_ack(at, messages.ack("BPRMB", CommandAck.DONE, 0.023))
    return state


def failing():
    state = healthy()
    state.take_link(NOW - 0.1, messages.link(connected=False, since_s=12.0, bad_checksums=3),
                    "/frontseat")
    state.take_control(NOW - 0.1, messages.control(ControlStatus.UNKNOWN, False, True,
                                                   "there is no connection to the vehicle"))
    state.take_diagnostics(NOW - 0.5, messages.diagnostics(
        ("frontseat: link", DiagnosticStatus.ERROR, "not connected: connection refused"),
        ("frontseat: data", DiagnosticStatus.ERROR, "no connection")), "/frontseat")
    state.take_log(NOW - 5.0, messages.log("/frontseat: dropped 3 position(s)"))
    return state


def shown(state, width=80, height=24, now=NOW):
    lines = [layout.text_of(line) for line in screen.render(state, now, width, height, "12:00:00")]
    return "\n".join(line.rstrip() for line in lines)


# What a healthy vehicle's screen holds at every size of SIZES.
ALWAYS = ("frontseat_monitor /", "CONNECTED", "192.168.1.2:29500", "sandshark",
          "last byte 0.1 s ago", "GRANTED", "COMMANDING", "gate open", "RUNNING", "survey.dive",
          "told 30 s ago", "42.358525 N", "71.087591 W", "dead reckoning", "east 123.4 m",
          "north -45.6 m", "heading 000.0 deg", "speed 1.52 m/s", "roll +1.2", "pitch -3.4 deg",
          "4.02 m", "altitude 12.30 m", "16.20 V", "cells 4.00 to 4.10 V", "20 degC",
          "BFNVG 10.0", "BPRMB,120000.000,90.0,4.0,0,1.5,1,0", "DONE", "after 0.023 s",
          "FAULTS   none", "q quits")

# Name, a change to a healthy state, what must then be shown, and what must not.
CHANGES = (
    ("no_connection", lambda s: s.take_link(NOW, messages.link(connected=False)),
     ("NOT CONNECTED", "WAS RUNNING"), ()),
    ("silent_vehicle", lambda s: (s.take_link(NOW, messages.link(since_s=7.0)),
                                  setattr(s, "received_at", None)),
     ("last byte 7.0 s ago",), ()),
    ("denied", lambda s: s.take_control(NOW, messages.control(
        ControlStatus.DENIED, False, True, "the vehicle gives no control")),
     ("DENIED", "not commanding", "the vehicle gives no control"), ("GRANTED",)),
    ("gate_closed", lambda s: s.take_control(NOW, messages.control(
        commanding=False, enabled=False, reason="commands are disabled")),
     ("GATE CLOSED", "commands are disabled"), ("gate open",)),
    ("bad_checksums", lambda s: s.take_link(NOW, messages.link(bad_checksums=7, malformed=2)),
     ("bad checksums 7", "malformed 2"), ("nothing bad",)),
    ("gps", lambda s: s.take_fix(NOW, messages.fix()), ("42.350000 N  71.100000 W  GPS",),
     ("dead reckoning",)),
    ("southern_and_eastern", lambda s: s.take_fix(NOW, messages.fix(-33.5, 151.25)),
     ("33.500000 S  151.250000 E",), ()),
    ("two_batteries", lambda s: s.take_battery(NOW, messages.battery(
        15.1, (), float("nan"), "battery_2")), ("battery_1 16.20 V", "battery_2 15.10 V"), ()),
    ("refused", lambda s: s.take_ack(NOW, messages.ack("BPRMB", CommandAck.INVALID, 0.1, "why")),
     ("INVALID", "why"), ("DONE",)),
    ("not_our_command", lambda s: s.take_ack(NOW, messages.ack(round_trip=float("nan"))),
     ("BPRMB  DONE",), ("after", "nan")),
    ("shutdown", lambda s: s.take_shutdown(NOW - 5.0, None), ("SHUTDOWN announced 5.0 s ago",),
     ()),
    ("aborted", lambda s: s.take_mission(NOW, messages.mission(
        MissionStatus.ABORTED, "Aborted", "", "leak")), ("ABORTED", "leak"), ("Aborted",)),
    ("master_gone", lambda s: s.take_master(NOW, "http://127.0.0.1:11311", False),
     ("NO ROS MASTER at http://127.0.0.1:11311",), ()),
    ("surface", lambda s: s.take_depth(NOW, messages.depth(-0.001)), ("DEPTH    0.00 m",), ()),
)


class Screen(unittest.TestCase):
    def test_old_values_are_marked_each_with_its_age(self):
        text = shown(healthy(NOW - 12.0), 132, 43)
        for value in ("dead reckoning OLD 12 s", "north -45.6 m OLD 12 s",
                      "heading 000.0 deg OLD 12 s", "speed 1.52 m/s OLD 12 s", "roll +1.2 OLD 12 s",
                      "pitch -3.4 deg OLD 12 s", "4.02 m OLD 12 s", "altitude 12.30 m OLD 12 s",
                      "degC OLD 12 s", "DRIVER SILENT for 12 s", "was connected to",
                      "CONTROL  unknown: the driver is silent", "WAS RUNNING", "BFNVG 0.0",
                      "last byte 12 s ago"):
            self.assertIn(value, text)
        for value in ("GRANTED", "COMMANDING", "LINK     CONNECTED"):
            self.assertNotIn(value, text)

    def test_nothing_is_old_when_it_is_fresh(self):
        self.assertNotIn("OLD ", shown(healthy()))

    def test_a_silent_master_is_told(self):
        self.assertIn("NO ROS MASTER", shown(healthy(), now=NOW + 10.0))

    def test_before_anything_is_heard(self):
        state = State("/shark", NOW)
        state.master_uri = "http://127.0.0.1:11311"
        text = shown(state)
        self.assertIn("waiting for the ROS master http://127.0.0.1:11311", text)
        self.assertIn("no driver heard in namespace /shark", text)
        state.take_master(NOW, state.master_uri, True)
        state.take_elsewhere(["/fisher"])
        self.assertIn("there is one in: /fisher", shown(state))
        self.assertNotIn("waiting", shown(state))

    def test_faults_are_told_cause_first_at_every_size(self):
        for width, height in SIZES:
            text = shown(failing(), width, height)
            cause = text.index("ERROR link: not connected: connection refused")
            self.assertLess(cause, text.index("ERROR data: no connection"))
            self.assertIn("5.0 s ago  dropped 3 position(s)", text)
            self.assertIn("NOT CONNECTED", text)

    def test_a_fault_that_lasts_is_not_told_twice(self):
        self.assertEqual(1, shown(failing()).count("connection refused"))

    def test_a_complaint_that_is_not_repeated_is_not_called_present(self):
        text = shown(failing(), now=NOW + 20.0)
        self.assertIn("20 s ago  ERROR link", text.replace("21 s", "20 s"))
        self.assertNotIn("now  ERROR", text)

    def test_the_most_important_survives_in_a_small_window(self):
        text = shown(failing(), 50, 8)
        for words in ("NOT CONNECTED", "PERMISSION UNKNOWN", "ERROR link"):
            self.assertIn(words, text)

    def test_what_the_vehicle_says_cannot_control_the_terminal(self):
        state = healthy()
        state.take_mission(NOW, messages.mission(details="\x1b[2J\x1b]0;owned\x07"))
        state.take_sent(NOW, "$BPRMB,\x1b[H*00")
        self.assertNotIn("\x1b", shown(state))
        self.assertNotIn("\x07", shown(state))


def holds_everything(width, height):
    def test(self):
        text = shown(healthy(), width, height)
        for words in ALWAYS:
            self.assertIn(words, text)
    return test


def fits(state, width, height):
    def test(self):
        lines = screen.render(state, NOW, width, height, "12:00:00 UTC")
        self.assertEqual(height, len(lines))
        for line in lines:
            self.assertLessEqual(len(layout.text_of(line)), width)
    return test


def changes(change, present, absent):
    def test(self):
        state = healthy()
        change(state)
        text = shown(state)
        for words in present:
            self.assertIn(words, text)
        for words in absent:
            self.assertNotIn(words, text)
    return test


for size in SIZES:
    setattr(Screen, "test_all_at_%dx%d" % size, holds_everything(*size))
for size in SIZES + TINY:
    for title, made in (("empty", State), ("healthy", healthy), ("failing", failing)):
        setattr(Screen, "test_%s_fits_%dx%d" % ((title,) + size), fits(made(), *size))
for name, *row in CHANGES:
    setattr(Screen, "test_" + name, changes(*row))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "monitor_screen", Screen)
