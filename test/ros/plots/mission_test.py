#!/usr/bin/env python3
"""The figures of a mission, and what thinning keeps."""

import unittest

import numpy as np
import rosunit

from frontseat_driver.plots import thin
from frontseat_driver.plots.mission import (Mission, Series, clock_text, duration_text, summary)

DURATIONS = ((0.4, "0 s"), (59.0, "59 s"), (59.6, "1 min 00 s"), (600.0, "10 min 00 s"),
             (3600.0, "1 h 00 min"), (86400.0, "24 h 00 min"))


class Figures(unittest.TestCase):
    def test_durations(self):
        for seconds, text in DURATIONS:
            self.assertEqual(text, duration_text(seconds))

    def test_the_start_is_told_in_utc_or_not_at_all(self):
        self.assertEqual("2001-09-09 01:46:40 UTC", clock_text(1e9, False))
        self.assertEqual("no date in the recording", clock_text(1e9, True))

    def test_times_are_put_in_order(self):
        series = Series([2.0, 1.0, 3.0], [20.0, 10.0, 30.0])
        self.assertEqual([10.0, 20.0, 30.0], list(series.v))

    def test_silences_and_rates_from_arrivals(self):
        mission = Mission("m")
        mission.hear(np.array([0.0, 0.5, 1.0, 4.0, 4.5, 6.5, 10.0]))
        self.assertEqual([[1.0, 4.0], [6.5, 10.0]], mission.gaps.tolist())
        self.assertEqual(7, mission.sentences)
        self.assertEqual([2.0, 1.0, 0.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0, 1.0],
                         list(mission.rate_hz.v))  # of each second

    def test_times_without_connection(self):
        mission = Mission("m")
        mission.connected = Series([0, 1, 2, 3, 4, 5], [0, 1, 1, 0, 1, 0])
        self.assertEqual([[0, 1], [3, 4], [5, 5]], mission.disconnected().tolist())
        mission.connected = Series([0, 1], [1, 1])
        self.assertEqual(0, len(mission.disconnected()))

    def test_summary(self):
        mission = Mission("m")
        mission.position = Series([1e9, 1e9 + 30.0, 1e9 + 60.0], [0, 3, 3], [0, 4, 5])
        mission.depth_m = Series([1e9], [4.25])
        mission.pitch_deg = Series([1e9, 1e9 + 1.0], [-31.0, 20.0])
        mission.battery_v = {"battery 1": Series([1e9, 2e9, 3e9], [np.nan, 16.24, 15.0])}
        mission.hear(1e9 + np.array([0.0, 10.0]))
        rows = dict(summary(mission))
        self.assertEqual("6 m", rows["distance over ground"])
        self.assertEqual("4.2 m", rows["deepest"])
        self.assertEqual("31.0 deg", rows["most pitch"])
        self.assertEqual("16.2 V to 15.0 V", rows["battery 1"])
        self.assertEqual("10.0 s", rows["longest silence"])
        self.assertNotIn("bad checksums", rows)  # nobody counted
        self.assertNotIn("fastest", rows)

    def test_an_empty_mission_is_said_to_be_empty(self):
        self.assertEqual([("recording", "empty")], summary(Mission("m")))

    # --- Thinning.

    def test_every_extreme_stays(self):
        v = np.sin(np.arange(1000000) * 0.01)
        v[123456], v[654321] = 9.0, -9.0
        pick = thin.kept([v], 1000)
        self.assertLessEqual(len(pick), 4000)
        self.assertTrue({0, 123456, 654321, 999999} <= set(pick))
        self.assertTrue(np.all(np.diff(pick) > 0))

    def test_the_envelope_is_that_of_all(self):
        v = np.random.RandomState(1).normal(size=20000)
        pick = thin.kept([v], 100)
        for start in range(0, 20000, 200):
            inside = v[pick[(pick >= start) & (pick < start + 200)]]
            whole = v[start:start + 200]
            self.assertEqual((whole.min(), whole.max()), (inside.min(), inside.max()))

    def test_both_axes_of_a_track_count(self):
        x, y = np.zeros(100000), np.zeros(100000)
        x[40000], y[60000] = 5.0, -5.0
        self.assertTrue({40000, 60000} <= set(thin.kept([x, y], 50)))

    def test_short_ones_stay_whole_and_blanks_do_no_harm(self):
        self.assertEqual([0, 1, 2], list(thin.kept([np.arange(3.0)], 10)))
        v = np.full(10000, np.nan)
        v[5000] = 1.0
        self.assertIn(5000, thin.kept([v], 10))

    def test_a_line_breaks_at_holes_and_not_where_points_were_left_out(self):
        t = np.concatenate([np.arange(0.0, 100.0), np.arange(200.0, 300.0)])
        self.assertEqual([100], list(thin.breaks_of_time(t, 10.0)))
        x, y = thin.broken_at(t, t * 2.0, [100])
        self.assertTrue(np.isnan(y[100]))
        self.assertEqual((99.0, 200.0, 200.0), tuple(x[99:102]))


if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "plot_mission", Figures)
