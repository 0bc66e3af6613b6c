#!/usr/bin/env python3
"""`make install` brings everything that a user of the package needs."""

import os
import shutil
import subprocess
import tempfile
import unittest

import package_under_test as package

SHARED = ("config", "launch", "rviz", "urdf", "msg", "srv")
PROGRAMS = ("blueye_node", "nmea_node", "nmea_simulator", "nmea_decode", "blueye_simulator",
            "kingfisher_square", "kingfisher_square.py", "sandshark_survey.py", "blueye_dive.py",
            "frontseat_monitor",
            "nmea_plot")
LAYERS = ("nmea", "vehicle", "link", "protocol", "capture", "session", "driver", "sim")


def installed_files():
    destination = tempfile.mkdtemp()
    try:
        subprocess.check_output(
            ["cmake", "-DCMAKE_INSTALL_PREFIX=/usr", "-P", "cmake_install.cmake"],
            cwd=package.build_dir(), env=dict(os.environ, DESTDIR=destination),
            stderr=subprocess.STDOUT)
        return {os.path.relpath(os.path.join(root, name), destination + "/usr")
                for root, _, names in os.walk(destination) for name in names}
    finally:
        shutil.rmtree(destination)


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.installed = installed_files()

    def assert_installed(self, paths):
        self.assertEqual(set(), set(paths) - self.installed)

    def test_shared_files(self):
        self.assert_installed("share/%s/%s" % (package.NAME, path)
                              for folder in SHARED for path in package.files(folder)
                              if os.path.isdir(os.path.join(package.ROOT, folder)))

    def test_package_and_plugin_description(self):
        self.assert_installed("share/%s/%s" % (package.NAME, name)
                              for name in ("package.xml", "nodelet_plugins.xml"))

    def test_headers(self):
        self.assert_installed(package.files("include", ".h"))

    def test_messages(self):
        names = [os.path.splitext(os.path.basename(path))[0] for path in package.files("msg")]
        self.assert_installed("include/%s/%s.h" % (package.NAME, name) for name in names)

    def test_libraries(self):
        self.assert_installed("lib/lib%s_%s.a" % (package.NAME, layer) for layer in LAYERS)
        self.assert_installed("lib/lib%s%s_nodelets.so" % (package.NAME, kind)
                              for kind in ("", "_blueye"))

    def test_python_modules(self):
        modules = package.files("python/" + package.NAME, ".py")
        self.assertTrue(modules)
        for module in modules:
            ending = "/" + os.path.relpath(module, "python")
            self.assertTrue([path for path in self.installed if path.endswith(ending)], module)

    def test_programs(self):
        self.assert_installed("lib/%s/%s" % (package.NAME, name) for name in PROGRAMS)

    def test_nothing_of_the_tests(self):
        self.assertEqual([], [path for path in self.installed if "test" in os.path.basename(path)])


if __name__ == "__main__":
    package.run(Install)
