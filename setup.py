"""What catkin_python_setup() installs: the modules behind nmea_plot and frontseat_monitor."""

from setuptools import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(
    packages=["frontseat_driver", "frontseat_driver.monitor", "frontseat_driver.plots"],
    package_dir={"": "python"}))
