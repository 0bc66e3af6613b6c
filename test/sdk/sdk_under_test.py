"""A simulated drone and programs of the vendor's SDK, for the tests beside this file."""

import functools
import logging
import os
import re
import signal
import statistics
import subprocess
import sys
import time

import blueye.protocol as bp
from blueye.protocol.exceptions import ResponseTimeout

from driver_under_test import PACKAGE, Process, program
from fake_vehicle import wait_until

DRONE = "192.168.1.101"
PATIENCE_S = 60.0
TRIES = 5

# A user's program that drives and then hangs: nobody will say that it is gone.
DRIVES_ON = """
import time, blueye.sdk
drone = blueye.sdk.Drone()
drone.motion.surge = 1.0
print("driving", flush=True)
time.sleep(1000)
"""


class Simulator:
    """blueye_simulator on the drone's address and ports."""

    def __init__(self, *arguments):
        self.process = Process([program(PACKAGE, "blueye_simulator"), "--no-ros", "--bind", DRONE,
                                "--noise=false"] + list(arguments))
        wait_until(lambda: self.process.output, "the simulator's ports", PATIENCE_S)

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait()


class Heard(logging.Handler):
    """What the SDK logs, as its user would read it."""

    def __init__(self):
        super().__init__()
        self.lines = []

    def emit(self, record):
        self.lines.append(record.getMessage())

    def names(self):
        """The notifications, in order, without what belongs to them."""
        words = [word for line in self.lines for word in line.split()
                 if word.startswith("NOTIFICATION_TYPE_")]
        return [word[len("NOTIFICATION_TYPE_"):].rstrip(":") for word in words]


def wait(claim, what):
    return wait_until(claim, what, PATIENCE_S)


def tries(test_case):
    """The SDK gives up on most answers after 50 ms, and a busy computer may take longer to run it.

    A try of a test that ends so is told of and made again with another drone, a few times.
    """
    def trying(test):
        @functools.wraps(test)
        def tried(self):
            for left in reversed(range(TRIES)):
                try:
                    return test(self)
                except (ResponseTimeout, ConnectionError) as error:
                    if left == 0:
                        raise
                    print("again, since the SDK did not wait: %s" % error)
                    self.doCleanups()
                    self.setUp()
        return tried

    for name in dir(test_case):
        if name.startswith("test_"):
            setattr(test_case, name, trying(getattr(test_case, name)))
    return test_case


def estimate(drone):
    return drone.telemetry.get(bp.PositionEstimateTel).position_estimate


def mission_state(drone):
    return drone.mission.get_status().state


def reached(drone, name):
    state = getattr(bp.MissionState, "MISSION_STATE_" + name)
    return wait(lambda: mission_state(drone) == state, "a mission that is " + name)


def telemetry_names():
    """Every telemetry message of the protocol as this package knows it."""
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, "../../proto/blueye/telemetry.proto"), encoding="utf-8") as proto:
        return re.findall(r"^message (\w+Tel)\b", proto.read(), re.M)


class Stream:
    """How often a message comes."""

    def __init__(self, drone, kind):
        self.times = []
        drone.telemetry.add_msg_callback([kind], lambda *_: self.times.append(time.monotonic()))

    def rate_hz(self, count):
        """Over that many messages from now on."""
        begin = len(self.times)
        wait(lambda: len(self.times) > begin + count, "%d messages" % count)
        times = self.times[begin:begin + count + 1]
        return count / (times[-1] - times[0])

    def settles_at(self, hz):
        """The rate over two seconds, if it is that one to a tenth."""
        found = self.rate_hz(2 * hz)
        return found if abs(found / hz - 1.0) < 0.1 else None


def round_trips(drone, count):
    """Median and longest of pings, s."""
    took = []
    for _ in range(count):
        began = time.monotonic()
        drone.ping()
        took.append(time.monotonic() - began)
    return statistics.median(took), max(took)


def drives_on():
    """The program above, once it drives."""
    process = subprocess.Popen([sys.executable, "-W", "ignore", "-c", DRIVES_ON],
                               stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"driving\n"
    return process
