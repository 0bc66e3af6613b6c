#!/usr/bin/env python3
"""The page: labelled with units, never an empty panel without words, and fast for a whole day."""

import os
import re
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml

import matplotlib.pyplot as pyplot
import numpy as np
import rosunit

from frontseat_driver.plots import output, page
from frontseat_driver.plots.mission import Mission, Series

START = 1.6e9
DAY_S = 86400.0
LABELS = {"east, m", "north, m", "depth, m", "speed, m/s", "true heading, deg",
          "roll, pitch, deg", "battery, V", "sentences/s", "time since the start, min"}


def mission_of(seconds=600.0, rate_hz=10.0):
    t = START + np.arange(0.0, seconds, 1.0 / rate_hz)
    angle = (t - START) * 0.01
    mission = Mission("dive <1> & more")
    mission.position = Series(t, 50.0 * np.sin(angle), 50.0 * np.cos(angle))
    mission.depth_m = Series(t, 4.0 + np.sin(angle))
    mission.altitude_m = Series(t, 16.0 - np.sin(angle))
    mission.speed_m_s = Series(t, np.full(len(t), 1.5))
    mission.heading_deg = Series(t, np.degrees(angle) % 360.0)
    mission.roll_deg, mission.pitch_deg = Series(t, np.sin(angle)), Series(t, np.cos(angle))
    mission.battery_v = {"battery 1": Series(t[::10], 16.0 - (t[::10] - START) * 1e-5)}
    mission.rate_hz = Series(t[::10], np.full(len(t[::10]), 25.0))
    mission.connected = Series(t[::10], np.ones(len(t[::10])))
    mission.faults_known = True
    return mission


def words(figure):
    found = [text.get_text() for text in figure.texts]
    for axes in figure.axes:
        found += [text.get_text() for text in axes.texts]
        found += [axes.get_xlabel(), axes.get_ylabel(), axes.get_title(loc="left")]
        found += [text.get_text() for text in (axes.get_legend().get_texts()
                                               if axes.get_legend() else ())]
    return [text for text in found if text]


class Page(unittest.TestCase):
    def setUp(self):
        self.addCleanup(pyplot.close, "all")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def written(self, mission, name):
        path = os.path.join(self.folder, name)
        output.write(mission, path)
        with open(path, "rb") as file:
            return file.read()

    def test_everything_is_labelled_with_its_unit(self):
        shown = words(page.figure_of(mission_of()))
        self.assertLessEqual(LABELS, set(shown))
        for text in ("start", "end", "2 min", "vehicle", "bottom (depth + altitude)",
                     "roll (port side up)", "pitch (bow up)", "battery 1",
                     "connected throughout, no bad checksum, nothing malformed, no silence"):
            self.assertIn(text, shown)

    def test_axes_of_the_track_are_equal_and_depth_is_down(self):
        figure = page.figure_of(mission_of())
        by_label = {axes.get_ylabel(): axes for axes in figure.axes}
        self.assertEqual(1.0, by_label["north, m"].get_aspect())
        low, high = by_label["depth, m"].get_ylim()
        self.assertGreater(low, high)

    def test_what_was_not_recorded_is_said(self):
        for field, value, text in (
                ("position", Series(), "no position in this recording"),
                ("speed_m_s", Series(), "no velocity in this recording"),
                ("heading_deg", Series(), "no heading in this recording"),
                ("battery_v", {}, "no battery voltage in this recording"),
                ("battery_v", {"b": Series([START], [np.nan])}, "no battery voltage in this "
                                                                "recording")):
            mission = mission_of()
            setattr(mission, field, value)
            self.assertIn(text, words(page.figure_of(mission)))
        mission = mission_of()
        mission.depth_m = mission.altitude_m = mission.roll_deg = mission.pitch_deg = Series()
        mission.rate_hz = mission.connected = Series()
        shown = words(page.figure_of(mission))
        self.assertIn("no depth and no altitude in this recording", shown)
        self.assertIn("no roll and no pitch in this recording", shown)
        self.assertIn("no sentences and no link state in this recording", shown)

    def test_no_panel_is_empty_without_words(self):
        mission = Mission("nothing but a position")
        mission.position = Series([START], [1.0], [2.0])
        for axes in page.figure_of(mission).axes:
            self.assertTrue(axes.lines or axes.texts)
        self.assertIn("m: nothing to show in this recording", words(page.figure_of(Mission("m"))))

    def test_single_values_are_seen(self):
        mission = mission_of()
        mission.speed_m_s = Series([START, START + 500.0], [1.0, 2.0])
        axes = [axes for axes in page.figure_of(mission).axes if axes.get_ylabel() == "speed, m/s"]
        self.assertEqual("o", axes[0].lines[0].get_marker())

    def test_faults_silences_and_lost_connections_are_shown(self):
        mission = mission_of()
        mission.bad_checksums = Series([START + 60.0, START + 70.0], [2, 1])
        mission.malformed = Series([START + 90.0], [4])
        mission.gaps = np.array([[START + 100.0, START + 110.0], [START + 200.0, START + 205.0]])
        mission.connected = Series(START + np.array([0.0, 100.0, 110.0]), [1, 0, 1])
        shown = words(page.figure_of(mission))
        for text in ("bad checksum: 3", "malformed: 4", "silent for over 2 s", "no connection"):
            self.assertEqual(1, shown.count(text), text)
        self.assertNotIn("no silence", " ".join(shown))

    def test_altitude_alone(self):
        mission = mission_of()
        mission.depth_m = Series()
        self.assertIn("altitude, m", words(page.figure_of(mission)))

    def test_a_surface_vehicle_that_circles_gets_one_label_for_all_laps(self):
        mission = mission_of(600.0)
        angle = (mission.position.t - START) * 2.0 * np.pi / 120.0
        mission.position = Series(mission.position.t, np.sin(angle), np.cos(angle))
        self.assertIn("2, 4, 6, 8 min", words(page.figure_of(mission)))

    def test_a_whole_day_is_drawn_fast_from_few_points(self):
        mission = mission_of(DAY_S, 10.0)
        began = time.process_time()
        picture = self.written(mission, "day.png")
        used_s = time.process_time() - began
        print("a day of 10 Hz: %.1f s, %d kB" % (used_s, len(picture) // 1000), flush=True)
        self.assertLess(used_s, 20.0)
        for axes in page.figure_of(mission).axes:
            for line in axes.lines:
                self.assertLessEqual(len(line.get_xdata()), 8 * page.BINS)

    def test_png(self):
        self.assertTrue(self.written(mission_of(), "page.PNG").startswith(b"\x89PNG\r\n"))

    def test_svg(self):
        svg = self.written(mission_of(), "page.svg")
        self.assertTrue(xml.fromstring(svg).tag.endswith("svg"))
        self.assertEqual(svg, self.written(mission_of(), "again.svg"))

    def test_html_needs_nothing_else(self):
        text = self.written(mission_of(), "page.html").decode("utf-8")
        self.assertIn("<svg", text)
        self.assertIn("dive &lt;1&gt; &amp; more", text)
        self.assertIn("<th>distance over ground</th>", text)
        self.assertEqual([], re.findall(r"<(?:script|link|img|iframe)|@import|(?:src|href)=\"(?!#)",
                                        text))


if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "plot_page", Page)
