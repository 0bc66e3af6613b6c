#!/usr/bin/env python3
"""README, messages and sources say what they must, and nothing that is not the project's."""

import os
import re
import unittest
import xml.etree.ElementTree as xml

import package_under_test as package

FIELD = re.compile(r"^\s*[\w/]+(?:\[\])?\s+\w+\s*(#.*)?$")
CONSTANT = re.compile(r"^\s*\w+\s+[A-Z_0-9]+\s*=")
# A name that says it all, or that its constants explain.
SELF_EXPLAINING = re.compile(r"\b(connected|\w+_(received|sent|mode)|success|message|enable|"
                             r"behavior)$")
OPEN_END = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
ONE_MACHINE = re.compile(r"/(home|root|work)/\w")
TEXT = (".cpp", ".h", ".py", ".md", ".rst", ".launch", ".yaml", ".msg", ".srv", ".txt", ".xml",
        ".bash", ".cmake", ".test", ".urdf", ".rviz")


def rows(heading):
    """The first cells of the tables below a heading of the README, code marks taken off."""
    text = package.read("README.md")
    section = re.search(r"^#+ %s\n(.*?)(?=^#+ |\Z)" % re.escape(heading), text, re.S | re.M)
    cells = re.findall(r"^\| (`[^|]*?) \|", section.group(1), re.M)
    return {name for cell in cells for name in re.findall(r"`([^`]+)`", cell)}


class Documentation(unittest.TestCase):
    def test_readme_lists_every_topic(self):
        self.assertEqual(set(package.topics_in_code()) | {"/tf", "/tf_static", "/diagnostics"},
                         rows("Topics") | rows("Command the vehicle"))

    def test_readme_lists_every_parameter(self):
        self.assertEqual(package.parameters_in_code(), rows("Parameters"))

    def test_readme_names_every_launch_file_and_its_pictures_exist(self):
        readme = package.read("README.md")
        for path in package.files("launch", ".launch"):
            self.assertIn(os.path.basename(path), readme)
        targets = re.findall(r"\]\(([^)#:]+)\)", readme)
        self.assertTrue(targets)
        for target in targets:
            self.assertTrue(os.path.exists(os.path.join(package.ROOT, target)), target)

    def test_safety_names_tests_that_exist(self):
        tests = "".join(package.read(path) for path in package.files("test", ".cpp", ".py"))
        failures = package.read("doc", "safety.md").split("## Failures")[1]
        names = re.findall(r"\btest_[a-z_]+[a-z]\b|\b[A-Z][a-z]*(?:[A-Z][a-z]*){2,}\b", failures)
        self.assertGreater(len(names), 30)
        for name in names:
            self.assertIn(name, tests)
        for path in re.findall(r"`([a-z_/]+/[a-z_]+\.(?:cpp|py))`", failures):
            self.assertTrue(os.path.exists(os.path.join(package.ROOT, "test", path)), path)

    def test_every_planted_bug_still_has_its_place(self):
        """A patch whose place has changed would stop `make plant`."""
        patches = package.files("test/ros/simulation/plants", ".patch")
        self.assertGreater(len(patches), 20)
        for path in patches:
            for target, hunks in re.findall(r"^\+\+\+ b/(\S+)\n(.*?)(?=^diff |\Z)",
                                            package.read(path), re.S | re.M):
                for hunk in re.split(r"^@@.*\n", hunks, flags=re.M)[1:]:
                    before = [line[1:] for line in hunk.splitlines() if line[:1] in (" ", "-")]
                    self.assertIn("\n".join(before), package.read(target), path)

    def test_readme_shows_both_commands(self):
        for command in ("make demo", "make test"):
            self.assertIn(command, package.read("README.md"))

    def test_every_message_field_is_explained(self):
        for path in package.files("msg", ".msg") + package.files("srv", ".srv"):
            lines = [line for line in package.read(path).splitlines() if line.strip()]
            self.assertTrue(lines[0].startswith("# "), path)
            for line in lines:
                field = FIELD.match(line)
                if field and not CONSTANT.match(line):
                    self.assertTrue(field.group(1) or SELF_EXPLAINING.search(line),
                                    "%s: %s" % (path, line))

    def test_every_message_is_built(self):
        build = package.read("CMakeLists.txt")
        for path in package.files("msg", ".msg") + package.files("srv", ".srv"):
            self.assertIn(os.path.basename(path), build)

    def test_every_test_is_run(self):
        lists = "".join(package.read(path) for path in package.files("test", "CMakeLists.txt"))
        for path in package.files("test", ".test", "_test.cpp"):
            self.assertIn(os.path.basename(path), lists)

    def test_nothing_is_left_open_and_nothing_names_one_machine(self):
        for path in package.tracked_files():
            binary = path.startswith(os.path.join("test", "fuzz", "corpus"))
            if binary or (not path.endswith(TEXT) and "." in os.path.basename(path)):
                continue
            for number, line in enumerate(package.read(path).splitlines(), 1):
                place = "%s:%d: %s" % (path, number, line)
                self.assertIsNone(OPEN_END.search(line), place)
                if path != os.path.join("test", "package", os.path.basename(__file__)):
                    self.assertIsNone(ONE_MACHINE.search(line), place)

    def test_version_and_changelog_agree(self):
        version = xml.parse(os.path.join(package.ROOT, "package.xml")).findtext("version")
        newest = re.findall(r"^(Forthcoming|\d+\.\d+\.\d+)", package.read("CHANGELOG.rst"), re.M)[0]
        self.assertIn(newest, ("Forthcoming", version))


if __name__ == "__main__":
    package.run(Documentation)
