#!/usr/bin/env python3
"""Rows fit, nothing that matters is lost, and a cut never looks like a value."""

import unittest

import rosunit

from frontseat_driver.monitor import layout
from frontseat_driver.monitor.layout import Row


def texts(lines):
    return [layout.text_of(line).rstrip() for line in lines]


FLOWS = (
    ("fits", 40, ["12.0 m", "east 3"], ["DEPTH    12.0 m  east 3"]),
    ("wraps_between_chunks", 24, ["heading 359.5", "speed 1.2"],
     ["DEPTH heading 359.5", "      speed 1.2"]),
    ("a_chunk_is_not_torn", 40, ["abcdefgh ijklmnop", "qrstuvwx yz012345"],
     ["DEPTH    abcdefgh ijklmnop", "         qrstuvwx yz012345"]),
    ("long_text_is_torn_between_words", 29, ["now", "one two three four five six"],
     ["DEPTH  now  one two three", "       four five six"]),
    ("a_word_longer_than_the_line", 29, ["a" * 50],
     ["DEPTH  " + "a" * 22, "       " + "a" * 22, "       " + "a" * 6]),
    ("escape_sequences_are_shown_not_obeyed", 40, ["\x1b[2Jx\n\u00b0"], ["DEPTH    ?[2Jx??"]),
    ("no_chunks", 40, [], ["DEPTH"]),
)

CUTS = (
    ("fits", 10, "12.0 m", "12.0 m"),
    ("exactly", 6, "12.0 m", "12.0 m"),
    ("a_cut_is_marked", 4, "12.0 m", "12.~"),
    ("nothing_fits", 0, "12.0 m", ""),
)


class Layout(unittest.TestCase):
    def test_the_least_important_rows_give_way_from_the_last(self):
        rows = [Row("A", [("x" * 15, ""), ("y" * 15, "")], importance=9),
                Row("B", [("b", "")], importance=1), Row("C", [("c", "")], importance=1)]
        self.assertEqual(4, len(layout.fitted(rows, 30, 4)))
        first = "A      " + "x" * 15 + "  " + "y" * 5 + "~"
        self.assertEqual([first, "B      b", "C      c"], texts(layout.fitted(rows, 30, 3)))
        self.assertEqual([first, "B      b"], texts(layout.fitted(rows, 30, 2)))
        self.assertEqual([first], texts(layout.fitted(rows, 30, 1)))
        self.assertEqual([], layout.fitted(rows, 30, 0))


def flows(width, chunks, expected):
    def test(self):
        lines = layout.flow(Row("DEPTH", [(chunk, "") for chunk in chunks]), width)
        self.assertEqual(expected, texts(lines))
        self.assertLessEqual(max(len(layout.text_of(line)) for line in lines), width)
    return test


def cuts(width, text, expected):
    def test(self):
        self.assertEqual(expected, layout.text_of(layout.clip([(text, "")], width)))
    return test


for name, *row in FLOWS:
    setattr(Layout, "test_" + name, flows(*row))
for name, *row in CUTS:
    setattr(Layout, "test_clip_" + name, cuts(*row))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "monitor_layout", Layout)
