"""The command line of nmea_plot."""

import argparse
import os
import sys

import rospy

from frontseat_driver.plots.errors import Unreadable

ENDINGS = (".png", ".svg", ".html")

DESCRIPTION = """Draws a mission on one page: track, depth and altitude, speed, heading, roll and
pitch, battery and the health of the link."""


def arguments(argv):
    parser = argparse.ArgumentParser(prog="nmea_plot", description=DESCRIPTION)
    parser.add_argument("input", help="a bag with the driver's topics or with nmea/rx alone, or a "
                                      "capture of sentences that nmea_decode reads; -: standard "
                                      "input")
    parser.add_argument("output", help="what to write; its name ends with %s"
                                       % ", ".join(ENDINGS))
    parser.add_argument("--namespace", help="which vehicle, where a bag holds several")
    parser.add_argument("--title", help="head of the page; default: the name of the input")
    chosen = parser.parse_args(argv)
    ending = os.path.splitext(chosen.output)[1].lower()
    if ending not in ENDINGS:
        parser.error("cannot write \"%s\": the name must end with %s"
                     % (chosen.output, ", ".join(ENDINGS)))
    return chosen


# What is slow to load comes last, so that a slip on the command line is told at once.


def read(chosen):
    from frontseat_driver.plots import bag, capture
    try:
        if chosen.input == "-":
            return capture.read("-", title="standard input")
        if bag.is_bag(chosen.input):
            return bag.read(chosen.input, chosen.namespace)
        return capture.read(chosen.input)
    except OSError as error:
        raise Unreadable("cannot read %s: %s" % (chosen.input, error.strerror))


def main():
    chosen = arguments(rospy.myargv()[1:])
    try:
        mission = read(chosen)
        mission.title = chosen.title or mission.title
        from frontseat_driver.plots import output
        output.write(mission, chosen.output)
    except (Unreadable, OSError) as error:
        print("nmea_plot: %s" % error, file=sys.stderr)
        return 1
    return 0
