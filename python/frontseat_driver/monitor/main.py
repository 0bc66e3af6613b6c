"""The command line of frontseat_monitor, and its loop."""

import argparse
import os
import select
import sys
import threading
import time
import traceback

import rospy

from frontseat_driver.monitor import layout, screen, terminal
from frontseat_driver.monitor.state import State
from frontseat_driver.monitor.topics import Topics

PLAIN_SIZE = (80, 24)
LEAVE_S = 2.0
DESCRIPTION = """Shows on one terminal screen how a vehicle and its driver are. It only listens, so
it may be started and ended at any time. In place of the argument, ROS_NAMESPACE or __ns:=NAME
work too."""


def arguments(argv):
    parser = argparse.ArgumentParser(prog="frontseat_monitor", description=DESCRIPTION)
    parser.add_argument("namespace", nargs="?", help="the driver's, where it has one")
    parser.add_argument("--rate", type=float, default=3.0, help="updates per second (3)")
    parser.add_argument("--plain", action="store_true",
                        help="print a block of text now and then, as on a dumb terminal or into a "
                             "file")
    parser.add_argument("--period", type=float, default=5.0,
                        help="s between two such blocks (5)")
    chosen = parser.parse_args(argv)
    for name in ("rate", "period"):
        value = getattr(chosen, name)
        if not 0.0 < value <= 3600.0:
            parser.error("--%s is %g; it must be above 0 and at most 3600" % (name, value))
    return chosen


def clock():
    return time.strftime("%H:%M:%S UTC", time.gmtime())


def show_in_place(state, topics, ending, period_s):
    with terminal.Screen("NO_COLOR" not in os.environ) as window:
        while not ending:
            topics.drain(state)
            now = time.monotonic()
            width, height = window.size()
            window.show(screen.render(state, now, width, height, clock()))
            while not ending and time.monotonic() - now < period_s:
                key = window.key(max(0.01, now + period_s - time.monotonic()))
                if key in (ord("q"), ord("Q")):
                    return
                if key != -1:  # a new size, too
                    break


def show_as_text(state, topics, ending, period_s):
    wake, _ = os.pipe()  # nothing is ever written: a signal alone ends the wait early
    while not ending:
        topics.drain(state)
        lines = screen.render(state, time.monotonic(), *PLAIN_SIZE, clock=clock(), keys="")
        texts = [layout.text_of(line).rstrip() for line in lines]
        print("\n".join(text for text in texts if text) + "\n", flush=True)
        due = time.monotonic() + period_s
        while not ending and time.monotonic() < due:
            select.select([wake], [], [], min(0.2, max(0.0, due - time.monotonic())))


def leave():
    """Tells the other nodes, but does not wait for one that is gone."""
    if rospy.core.is_initialized():
        thread = threading.Thread(target=rospy.signal_shutdown, args=("ended",), daemon=True)
        thread.start()
        thread.join(LEAVE_S)


def run(chosen):
    ending = terminal.Ending()
    topics = Topics(chosen.namespace)
    state = State(topics.namespace, time.monotonic())
    state.master_uri = topics.uri
    topics.start()
    plain = chosen.plain or not terminal.is_capable(sys.stdout, os.environ)
    try:
        if plain:
            show_as_text(state, topics, ending, chosen.period)
        else:
            show_in_place(state, topics, ending, 1.0 / chosen.rate)
    finally:
        topics.stop()
        leave()
    return 0


def main():
    code = 0
    try:
        code = run(arguments(rospy.myargv()[1:]))
        sys.stdout.flush()
    except BrokenPipeError:  # whoever read the text has gone
        pass
    except SystemExit as ended:
        code = ended.code or 0
    except Exception:  # the terminal is in order again by now
        traceback.print_exc()
        code = 1
    sys.stderr.flush()
    # Threads of rospy may hang in a network that is gone.
    os._exit(code)
