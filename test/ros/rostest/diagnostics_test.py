#!/usr/bin/env python3
"""Two vehicles' diagnostics, grouped by the aggregator's shipped configuration."""

import socket
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from driver_under_test import PACKAGE, Collector, Process, Simulator, program, run
from fake_vehicle import wait_until

GROUPS = ["1 Link", "2 Data", "3 Decoding", "4 Clock", "5 Control", "6 Commands", "7 Battery"]
OK, ERROR = DiagnosticStatus.OK, DiagnosticStatus.ERROR


class Aggregated(unittest.TestCase):
    def started(self, thing):
        self.addCleanup(thing.stop)
        return thing

    def driver(self, namespace, port):
        return self.started(Process([program(PACKAGE, "nmea_node"), "__ns:=" + namespace,
                                     "__name:=frontseat", "_host:=127.0.0.1",
                                     "_port:=%d" % port]))

    def test_layers_of_all_vehicles_are_grouped_from_the_wire_up(self):
        nobody = self.started(ReservedPort())
        simulator = self.started(Simulator("/alpha/simulator", "kingfisher"))
        drivers = {"alpha": self.driver("/alpha", simulator.port),
                   "bravo": self.driver("/bravo", nobody.port)}
        grouped = Collector("/diagnostics_agg", DiagnosticArray)
        self.addCleanup(grouped.close)

        def settled():
            newest = {status.name: status for status in grouped.messages[-1].status}
            return (all(newest.get(self.item(group, name)) for group in GROUPS
                        for name in drivers)
                    and "payload interface" in newest[self.item("1 Link", "bravo")].message
                    and "Hz" in newest[self.item("2 Data", "alpha")].message and newest)

        grouped.wait_for()
        newest = wait_until(settled, "both vehicles in all groups")
        self.assertEqual([ERROR] + [OK] * 6,
                         [newest["/Frontseat/" + group].level for group in GROUPS])
        for group in GROUPS:
            self.assertEqual(OK, newest[self.item(group, "alpha")].level)
        link = newest[self.item("1 Link", "bravo")]
        self.assertEqual(ERROR, link.level)
        self.assertIn("connection refused", link.message)
        self.assertEqual("127.0.0.1:%d" % nobody.port, link.hardware_id)
        self.assertEqual([], [name for name in newest
                              if name.startswith("/Other/") and "frontseat" in name])
        self.assertEqual([], drivers["alpha"].warnings())
        self.assertEqual(1, len(drivers["bravo"].warnings()), drivers["bravo"].output)
        self.assertIn("payload interface", drivers["bravo"].warnings()[0])

    @staticmethod
    def item(group, namespace):
        layer = group.split()[1].lower()
        return "/Frontseat/%s/%s frontseat: %s" % (group, namespace, layer)


class ReservedPort:
    """A port on which nobody listens, and that nobody else gets."""

    def __init__(self):
        self._socket = socket.socket()
        self._socket.bind(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]

    def stop(self):
        self._socket.close()


if __name__ == "__main__":
    run("diagnostics")
