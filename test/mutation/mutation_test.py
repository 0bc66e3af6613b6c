#!/usr/bin/env python3
"""The rules of `make mutate` find what they are for, and its two lists tell of what there is."""

import glob
import os
import re
import unittest

import rosunit

import mutate
import rules

# Rule, the code, and what it becomes, change by change.
CHANGES = (
    ("sign", "return -x;", ["return x;"]),
    ("sign", "f(-(a), b - c);", ["f((a), b - c);", "f(-(a), b + c);"]),
    ("sign", "a -= b;", ["a += b;"]),
    ("sign", "int f() -> int;", []),
    ("sign", 'out = "it is " + name;', []),
    ("scale", "y = x * kPerDegree;", ["y = x / kPerDegree;"]),
    ("scale", "const double* x = &y;", []),
    ("scale", "if (x < 2.0) return 0.5F;", ["if (x < 2.2) return 0.5F;",
                                            "if (x < 2.0) return 0.55F;"]),
    ("scale", "double x = 0.0; f(0.0);", ["double x = 0.0; f(1.0);"]),
    ("scale", "constexpr int kSure = 100; x = 100;", ["constexpr int kSure = 200; x = 100;"]),
    ("scale", "y = std::sin(x);", ["y = std::cos(x);"]),
    ("scale", "std::min(a, std::numeric_limits<int>::max());",
     ["std::max(a, std::numeric_limits<int>::max());"]),
    ("axis", "out.x = in.x(); in.y();", ["out.x = in.y(); in.y();", "out.x = in.x(); in.x();"]),
    ("axis", "f(roll_deg, yaw_deg); pitch_deg;",
     ["f(pitch_deg, yaw_deg); pitch_deg;", "f(roll_deg, roll_deg); pitch_deg;",
      "f(roll_deg, yaw_deg); yaw_deg;"]),
    ("axis", "void f(double x, const T& y);", []),
    ("order", "  m.depth = in.number();\n  m.altitude = in.number();\n",
     ["  m.altitude = in.number();\n  m.depth = in.number();\n"]),
    ("order", "  out.number(depth);\n  out.number(altitude);\n",
     ["  out.number(altitude);\n  out.number(depth);\n"]),
    ("time", "constexpr nanoseconds kTick = 5s;", ["constexpr nanoseconds kTick = 10s;",
                                                   "constexpr nanoseconds kTick = 2s;"]),
    ("time", "std::chrono::milliseconds period{100};", ["std::chrono::milliseconds period{200};",
                                                        "std::chrono::milliseconds period{50};"]),
    ("time", "return std::chrono::seconds(1);", ["return std::chrono::seconds(2);",
                                                 "return std::chrono::seconds(0);"]),
    ("compare", "if (a < b || c == d) {", ["if (a >= b || c == d) {", "if (a < b || c != d) {"]),
    ("compare", "std::optional<double> x;", []),
    ("compare", "for (int i = 0; i < n; ++i) {", []),
    ("edge", "if (a < b) {", ["if (a <= b) {"]),
    ("logic", "if (!a && b) {", ["if (a && b) {", "if (!a || b) {"]),
    ("sign", "// a - b\n#define X -1\n", []),
)


class Mutation(unittest.TestCase):
    def test_a_change_names_its_line(self):
        one, = rules.Source("a.cpp", "int a;\n  x = -y;  // why\n", set()).mutations(("sign",))
        self.assertEqual(("a.cpp", "x = -y; // why", "x = y; // why"), one.key())
        self.assertEqual(2, one.line)

    def test_guards_exist(self):
        programs = set()
        for path in glob.glob(os.path.join(mutate.REPOSITORY, "test/**/CMakeLists.txt"),
                              recursive=True):
            with open(path) as file:
                programs |= set(re.findall(r"catkin_add_gtest\((\w+)", file.read()))
        for row in mutate.read_guards():
            self.assertTrue(mutate.paths(mutate.REPOSITORY, row.files), "no such file: " + row.files)
            self.assertTrue(row.guards, "nothing guards " + row.files)
            self.assertLessEqual({guard.split(":")[0] for guard in row.guards}, programs)
            self.assertLessEqual(set(row.rules), set(rules.RULES))

    def test_what_is_explained_is_still_there(self):
        there = set()
        for mutation, _ in mutate.find_mutations(mutate.REPOSITORY, []):
            path, old, new = mutation.key()
            there |= {(path, old, new), (path, old, mutate.ANY)}
        for explained, why in mutate.read_equivalent().items():
            self.assertIn(explained, there, "no such mutation; is its line another one now?")
            self.assertGreater(len(why), 10, "%s: %s: why?" % explained[:2])


def changes(rule, code, changed):
    def test(self):
        found = rules.Source("a.cpp", code, rules.words_of(code)).mutations((rule,))
        self.assertEqual(sorted(changed), sorted(one.text for one in found))
    return test


for number, (rule, code, changed) in enumerate(CHANGES):
    setattr(Mutation, "test_%s_%d" % (rule, number), changes(rule, code, changed))

if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "mutation", Mutation)
