#!/usr/bin/env python3
"""doc/blueye.md and config/blueye.yaml name everything that the Blueye nodelet has, and no more."""

import re
import unittest

import yaml

import package_under_test as package

SOURCE = ("src", "ros", "blueye")


def names_in_section(heading):
    section = re.search(r"^## %s\n(.*?)(?=^## |\Z)" % heading, package.read("doc", "blueye.md"),
                        re.S | re.M).group(1)
    cells = re.findall(r"^\| (`[^|]*?) \|", section, re.M)
    return [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]


def parameters_in_code():
    code = package.read(*SOURCE, "parameters.cpp")
    names = re.findall(r'\bin\.(?!refuse|has)\w+(?:<[^()]*>)?\(\s*"(\w+)"', code)
    names += re.findall(r'\bread\("(\w+)"', code)
    names += re.findall(r'\bport\("(\w+)"', code)
    names += re.findall(r'\breadFrame\(in, "(\w+)"', code)
    return set(names) | {"rates"}


class Blueye(unittest.TestCase):
    def test_document_lists_every_topic_and_service_once(self):
        code = package.read(*SOURCE, "topics.h")
        named = re.findall(r'constexpr char k\w+\[\] =\s+"([^"]+)"', code)
        self.assertGreater(len(named), 90)
        self.assertEqual(sorted(named),
                         sorted(names_in_section("Topics") + names_in_section("Commands")))

    def test_document_lists_every_parameter(self):
        self.assertGreater(len(parameters_in_code()), 40)
        self.assertEqual(parameters_in_code(), set(names_in_section("Parameters")))

    def test_configuration_names_every_parameter_once_and_no_other(self):
        named = package.parameters_in_config("config/blueye.yaml")
        self.assertEqual(sorted(parameters_in_code()), sorted(named))
        self.assertIsInstance(yaml.safe_load(package.read("config", "blueye.yaml")), dict)

    def test_every_message_of_the_protocol_is_described(self):
        text = "".join(package.read(path) for path in package.files("proto", ".proto"))
        for name in re.findall(r"^ *message (\w+)", text, re.M):
            self.assertRegex(text, r"// [^\n]*\n *message %s\b" % name)


if __name__ == "__main__":
    package.run(Blueye)
