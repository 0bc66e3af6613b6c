#!/usr/bin/env python3
"""Decoded lines become a mission: time, plane and what to believe."""

import math
import unittest

import numpy as np
import rosunit

from frontseat_driver.plots import capture


def navigation(at=None, sent_at=43200.0, sentence="BFNVG", **fields):
    values = dict(sent_at_s=sent_at, latitude_deg=0.0, longitude_deg=10.0, from_gps=True,
                  altitude_m=None, depth_m=None, heading_deg=None, roll_deg=None, pitch_deg=None,
                  computed_at_s=None)
    values.update(fields)
    line = {"direction": "rx", "sentence": sentence, "fields": values}
    return line if at is None else dict(line, time_s=at)


def mission_of(*lines):
    reader = capture.Reader()
    for line in lines:
        reader.take(line)
    return reader.mission("m")


# Away from 0 N 10 E, degrees, and metres on WGS84 at the equator: a times pi / 180, and a (1 - e2)
# times pi / 180.
PLACES = (("east", 0.0, 0.001, 111.3195, 0.0), ("west", 0.0, -0.001, -111.3195, 0.0),
          ("north", 0.001, 0.0, 0.0, 110.5743), ("south", -0.001, 0.0, 0.0, -110.5743))

# Times of day as they come, and the time that goes on.
CLOCKS = (("forward", (1.0, 2.0), (1.0, 2.0)),
          ("over_midnight", (86399.0, 1.0), (86399.0, 86401.0)),
          ("back_over_midnight", (86399.0, 1.0, 86399.5), (86399.0, 86401.0, 86399.5)),
          ("two_days", (80000.0, 40000.0, 80000.0, 10.0), (80000.0, 40000.0, 80000.0, 86410.0)))


class Capture(unittest.TestCase):
    def test_values(self):
        mission = mission_of(
            navigation(100.0, heading_deg=90.0, roll_deg=1.0, pitch_deg=-2.0, depth_m=4.0,
                       altitude_m=0.0),
            {"time_s": 101.0, "direction": "rx", "sentence": "BFNVR",
             "fields": {"east_m_s": 3.0, "north_m_s": -4.0}},
            {"time_s": 102.0, "direction": "rx", "sentence": "CPRBS",
             "fields": {"battery_id": None, "stack_v": 16.0}},
            {"time_s": 103.0, "direction": "rx", "sentence": "CPRBS",
             "fields": {"battery_id": 2, "stack_v": None}})
        self.assertEqual((90.0, 1.0, -2.0, 4.0),
                         (mission.heading_deg.v[0], mission.roll_deg.v[0], mission.pitch_deg.v[0],
                          mission.depth_m.v[0]))
        self.assertFalse(mission.altitude_m)  # 0 is a Sandshark's word for no bottom
        self.assertEqual([5.0], list(mission.speed_m_s.v))
        self.assertEqual([16.0], list(mission.battery_v["battery"].v))
        self.assertTrue(math.isnan(mission.battery_v["battery 2"].v[0]))
        self.assertEqual("grid", mission.heading_note)
        self.assertEqual("true", mission_of(navigation(1.0, sentence="CPNVG")).heading_note)

    def test_faults_are_counted_and_bad_lines_give_no_values(self):
        bad = {"time_s": 1.0, "direction": "rx", "sentence": "BFNVG",
               "fault": {"reason": "wrong checksum", "column": 60}, "line": "$"}
        field = dict(navigation(2.0), fault={"reason": "unreadable value", "field": 7, "column": 20})
        malformed = {"time_s": 3.0, "direction": "rx", "sentence": "?",
                     "fault": {"reason": "missing checksum", "column": 3}, "line": "$x"}
        mission = mission_of(bad, field, malformed)
        self.assertEqual([1.0], list(mission.bad_checksums.t))
        self.assertEqual([2.0, 3.0], list(mission.malformed.t))
        self.assertEqual([2.0], list(mission.position.t))
        self.assertEqual(3, mission.sentences)

    def test_what_was_sent_to_the_vehicle_is_no_sentence_of_its(self):
        self.assertEqual(0, mission_of({"time_s": 1.0, "direction": "tx", "sentence": "BPVER",
                                        "fields": {"sent_at_s": 1.0}}).sentences)

    def test_positions_without_a_fix_are_left_out(self):
        mission = mission_of(navigation(1.0, latitude_deg=0.0, longitude_deg=0.0),
                             navigation(2.0, latitude_deg=None), navigation(3.0))
        self.assertEqual([3.0], list(mission.position.t))

    def test_a_record_without_times_goes_by_the_vehicles_clock(self):
        mission = mission_of(navigation(sent_at=86399.0), navigation(sent_at=1.0))
        self.assertTrue(mission.relative_time)
        self.assertEqual([86399.0, 86401.0], list(mission.position.t))

    def test_a_jump_is_dropped_and_five_in_a_row_are_believed(self):
        t = np.arange(20.0)
        x, y = np.arange(20.0), np.zeros(20)
        x[5] += 5000.0
        x[12:] += 5000.0
        keep = capture.without_jumps(t, x, y)
        self.assertEqual([5, 12, 13, 14, 15], list(np.flatnonzero(~keep)))


def place(north_deg, east_deg, east_m, north_m):
    def test(self):
        east, north = capture.to_plane(np.array([0.0, north_deg]),
                                       np.array([10.0, 10.0 + east_deg]))
        self.assertAlmostEqual(east_m, east[1], places=3)
        self.assertAlmostEqual(north_m, north[1], places=3)
    return test


def clock(times, expected):
    def test(self):
        goes_on = capture.Continued()
        self.assertEqual(list(expected), [goes_on(time) for time in times])
    return test


for name, *row in PLACES:
    setattr(Capture, "test_place_" + name, place(*row))
for name, *row in CLOCKS:
    setattr(Capture, "test_clock_" + name, clock(*row))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "plot_capture", Capture)
