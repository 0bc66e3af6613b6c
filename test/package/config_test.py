#!/usr/bin/env python3
"""Every parameter file can be read, names every parameter the driver knows, and no other."""

import re
import unittest

import yaml

import package_under_test as package

VEHICLES = ("config/sandshark.yaml", "config/kingfisher.yaml")

# What differs between the vehicles; see the README's table.
BY_DIALECT = {
    "config/sandshark.yaml": {"send_spacing": 0.06, "heading_reference": "grid",
                              "leap_seconds": 0},
    "config/kingfisher.yaml": {"send_spacing": 0.02, "heading_reference": "true",
                               "leap_seconds": 18},
}


class Config(unittest.TestCase):
    def test_every_file_is_a_set_of_parameters(self):
        for path in package.files("config", ".yaml"):
            self.assertIsInstance(yaml.safe_load(package.read(path)), dict, path)

    def test_vehicle_files_name_every_parameter_once_and_no_other(self):
        known = package.parameters_in_code()
        self.assertGreater(len(known), 40)
        for path in VEHICLES:
            named = package.parameters_in_config(path)
            self.assertEqual(sorted(known), sorted(named), path)

    def test_both_vehicles_differ_only_where_the_dialects_do(self):
        values = {path: yaml.safe_load(package.read(path)) for path in VEHICLES}
        for path, expected in BY_DIALECT.items():
            self.assertEqual(expected, {name: values[path][name] for name in expected})
            for name in expected:
                del values[path][name]
        self.assertEqual(values[VEHICLES[0]], values[VEHICLES[1]])

    def test_every_stddev_time_and_rate_has_its_unit_in_the_comment(self):
        unit = re.compile(r"# (-> )?(m|m/s|m/s\^2|rad|rad/s|s|Hz)\b")
        with_unit = re.compile(r"stddev|timeout|_rate$|^max_(speed|yaw|jump|data|command)|"
                               r"^reconnect|spacing|declination|leap_seconds")
        for path in VEHICLES:
            for name, comment in re.findall(r"^(\w+): [^#\n]*(#.*)?$", package.read(path), re.M):
                if with_unit.search(name):
                    self.assertRegex(comment, unit, "%s: %s" % (path, name))


if __name__ == "__main__":
    package.run(Config)
