#!/usr/bin/env python3
"""Makes a computer with the drone's address, a ROS master and the tests on it; takes it away."""

import os
import subprocess
import sys

from network import Namespace

HERE = os.path.dirname(os.path.abspath(__file__))
DRONE = "192.168.1.101"  # where the SDK looks for a drone
MASTER = "http://127.0.0.1:11311"  # the namespace has all ports to itself


def main(arguments):
    namespace = Namespace("blueye-sdk-%d" % os.getpid())
    environment = dict(os.environ, ROS_MASTER_URI=MASTER, ROS_IP="127.0.0.1")
    try:
        namespace.add()
        namespace.ip("address", "add", DRONE + "/32", "dev", "lo")
        master = subprocess.Popen(namespace.command("rosmaster", "--core", "-p", "11311"),
                                  env=environment, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        try:
            return subprocess.call(namespace.command(
                sys.executable, os.path.join(HERE, "steps_test.py"), *arguments), env=environment)
        finally:
            master.terminate()
            master.wait()
    finally:
        namespace.remove()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
