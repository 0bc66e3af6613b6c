#!/usr/bin/env python3
"""What the monitor makes of each message."""

import math
import unittest

import rosunit
from diagnostic_msgs.msg import DiagnosticStatus
from frontseat_driver.msg import CommandAck
from rosgraph_msgs.msg import Log

import messages
from frontseat_driver.monitor.state import State

# Name, what odom is made with, and heading, roll, pitch and speed as a person on deck has them.
ATTITUDES = (
    ("north", dict(heading_deg=0.0), (0.0, 0.0, 0.0, 0.0)),
    ("east", dict(heading_deg=90.0, ahead=1.5), (90.0, 0.0, 0.0, 1.5)),
    ("south", dict(heading_deg=180.0), (180.0, 0.0, 0.0, 0.0)),
    ("west", dict(heading_deg=270.0), (270.0, 0.0, 0.0, 0.0)),
    ("port_side_up", dict(heading_deg=33.0, roll_deg=10.0), (33.0, 10.0, 0.0, 0.0)),
    ("bow_up", dict(heading_deg=33.0, pitch_deg=20.0), (33.0, 0.0, 20.0, 0.0)),
    ("no_heading", dict(unknown=(5,)), (None, 0.0, 0.0, 0.0)),
    ("no_roll", dict(unknown=(3,)), (0.0, None, 0.0, 0.0)),
    ("no_pitch", dict(unknown=(4,)), (0.0, 0.0, None, 0.0)),
    ("no_velocity", dict(unknown=("twist",)), (0.0, 0.0, 0.0, None)),
)

# Namespace of the monitor, name of a node or nodelet, and whether it is that vehicle's.
OWNERS = (("/", "frontseat", True), ("/", "/frontseat", True), ("/", "shark/frontseat", False),
          ("/shark", "/shark/frontseat", True), ("/shark", "frontseat", False),
          ("/shark", "/sharks/frontseat", False), ("/a/b", "/a/b/frontseat", True),
          ("/a", "/a/b/frontseat", False))


class StateTest(unittest.TestCase):
    def test_a_blank_field_keeps_the_old_value_with_its_age(self):
        state = State()
        state.take_odom(10.0, messages.odom(heading_deg=90.0))
        state.take_odom(15.0, messages.odom(unknown=(5,)))
        self.assertAlmostEqual(90.0, state.heading.value)
        self.assertEqual(7.0, state.heading.age_s(17.0))
        self.assertEqual(2.0, state.roll.age_s(17.0))

    def test_depth_is_positive_down(self):
        state = State()
        state.take_depth(1.0, messages.depth(4.5))
        self.assertEqual(4.5, state.depth.value)

    def test_rates_are_right_at_once_and_end(self):
        state = State(now=100.0)
        for tick in range(100):
            state.take_received(100.0 + 0.1 * tick, "$BFNVG,1*00")
        self.assertEqual([("BFNVG", 10.0)], state.received_hz(109.95))
        self.assertEqual([("BFNVG", 0.0)], state.received_hz(120.0))
        young = State(now=100.0)
        for tick in range(10):
            young.take_received(100.0 + 0.1 * tick, "$BFNVG,1*00")
        self.assertEqual([("BFNVG", 10.0)], young.received_hz(101.0))

    def test_noise_does_not_fill_the_memory(self):
        state = State()
        for number in range(10000):
            state.take_received(1.0, "$N%d,1" % number)
        self.assertEqual(50, len(state.received))

    def test_last_byte_by_link_or_by_sentence(self):
        state = State()
        self.assertIsNone(state.last_byte_age_s(5.0))
        state.take_link(10.0, messages.link(since_s=4.0))
        self.assertAlmostEqual(5.0, state.last_byte_age_s(11.0))
        state.take_received(10.5, "$BFNVG,1*00")
        self.assertAlmostEqual(0.5, state.last_byte_age_s(11.0))
        silent = State()
        silent.take_link(10.0, messages.link(since_s=0.0, received=0))
        self.assertIsNone(silent.last_byte_age_s(11.0))

    def test_commands_come_before_housekeeping(self):
        state = State()
        state.take_sent(1.0, "$BPRMB,1*00")
        state.take_sent(2.0, "$BPABT,1*00")
        state.take_sent(9.0, "$BPSTS,1*00")
        self.assertEqual(["BPABT", "BPRMB", "BPSTS"], [kind for kind, _ in state.commands()])

    def test_the_newest_answer_of_each_command_is_kept(self):
        state = State()
        state.take_ack(1.0, messages.ack("BPRMB", CommandAck.PENDING))
        state.take_ack(2.0, messages.ack("BPLOG"))
        state.take_ack(3.0, messages.ack("BPRMB", CommandAck.DONE))
        self.assertEqual(["BPLOG", "BPRMB"], list(state.acks))
        self.assertEqual(CommandAck.DONE, state.acks["BPRMB"].value.status)

    def test_diagnostics_keep_the_drivers_order_and_a_change_is_news_once(self):
        state = State()
        bad = messages.diagnostics(("frontseat: link", DiagnosticStatus.ERROR, "refused"),
                                   ("frontseat: data", DiagnosticStatus.ERROR, "none"),
                                   ("frontseat: clock", DiagnosticStatus.OK, "fine"),
                                   ("shark/frontseat: link", DiagnosticStatus.ERROR, "another"))
        state.take_diagnostics(1.0, bad)
        state.take_diagnostics(2.0, bad)
        self.assertEqual(["link", "data"], [name for name, _ in state.complaints()])
        self.assertEqual(["link: refused", "data: none"], [fault.text for fault in state.faults])
        state.take_diagnostics(3.0, messages.diagnostics(
            ("frontseat: link", DiagnosticStatus.OK, "connected")))
        self.assertEqual(["data"], [name for name, _ in state.complaints()])

    def test_diagnostics_of_another_node_in_the_same_namespace_are_not_ours(self):
        state = State()
        state.take_link(1.0, messages.link(), "/frontseat")
        state.take_diagnostics(1.0, messages.diagnostics(
            ("camera: lens", DiagnosticStatus.ERROR, "dirty")), "/camera")
        self.assertEqual([], state.complaints())

    def test_warnings_of_the_driver_are_faults(self):
        state = State("/shark")
        state.take_link(1.0, messages.link(), "/fleet")
        state.take_log(1.0, messages.log("/shark/frontseat: disconnected", name="/fleet"))
        state.take_log(2.0, messages.log("/fisher/frontseat: disconnected", name="/rviz"))
        state.take_log(3.0, messages.log("/shark/frontseat: connected", Log.INFO, "/fleet"))
        state.take_log(4.0, messages.log("/shark/frontseat: disconnected", name="/fleet"))
        self.assertEqual([("disconnected", 2, 4.0)],
                         [(fault.text, fault.count, fault.at) for fault in state.faults])

    def test_a_manager_of_several_vehicles_is_told_apart(self):
        state = State("/shark")
        state.take_link(1.0, messages.link(), "/fleet")
        state.take_log(2.0, messages.log("/fisher/frontseat: disconnected", name="/fleet"))
        self.assertEqual([], list(state.faults))


def attitude(made_with, expected):
    def test(self):
        state = State()
        state.take_odom(1.0, messages.odom(**made_with))
        for name, value in zip(("heading", "roll", "pitch", "speed"), expected):
            told = getattr(state, name)
            if value is None:
                self.assertIsNone(told, name)
            else:
                difference = math.remainder(told.value - value, 360.0)
                self.assertAlmostEqual(0.0, difference, places=6, msg=name)
    return test


def owner(namespace, node, expected):
    return lambda self: self.assertEqual(expected, State(namespace).is_ours(node))


for name, *row in ATTITUDES:
    setattr(StateTest, "test_attitude_" + name, attitude(*row))
for number, row in enumerate(OWNERS):
    setattr(StateTest, "test_owner_%d" % number, owner(*row))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "monitor_state", StateTest)
