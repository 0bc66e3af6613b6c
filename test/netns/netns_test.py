#!/usr/bin/env python3
"""Makes the network, a ROS master and the tests on its backseat, and takes all of it away again."""

import os
import socket
import subprocess
import sys
import time

from network import BACKSEAT_UP, Network

PORT = 11311  # of the master: the namespace has all ports to itself
HERE = os.path.dirname(os.path.abspath(__file__))


def on_the_backseat(number, arguments):
    """In the backseat's namespace: the exit code."""
    environment = dict(os.environ, ROS_MASTER_URI="http://%s:%d" % (BACKSEAT_UP, PORT),
                       ROS_IP=BACKSEAT_UP)
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(PORT)], env=environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        wait_for_master()
        return subprocess.call([sys.executable, os.path.join(HERE, "faults_test.py"), number]
                               + arguments, env=environment)
    finally:
        master.terminate()
        master.wait()


def wait_for_master():
    end = time.monotonic() + 20.0
    while time.monotonic() < end:
        try:
            socket.create_connection((BACKSEAT_UP, PORT), 1.0).close()
            return
        except OSError:
            pass
    raise AssertionError("no ROS master")


def main(arguments):
    if arguments[:1] == ["--backseat"]:
        return on_the_backseat(arguments[1], arguments[2:])
    number = str(os.getpid())
    network = Network(number)
    try:
        network.add()
        return subprocess.call(network.backseat.command(
            sys.executable, os.path.abspath(__file__), "--backseat", number, *arguments))
    finally:
        network.remove()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
