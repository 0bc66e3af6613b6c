#!/usr/bin/env python3
"""However commanding ends, no old command stands: a boat hears zero thrust, a Sandshark nothing
more, and then the connection is closed in order."""

import signal
import socket
import threading
import time
import unittest
import urllib.parse

import rosgraph
import rosnode
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from frontseat_driver.msg import Behavior, ControlStatus, Drive
from nav_msgs.msg import Odometry
from std_srvs.srv import SetBool, Trigger

from driver_under_test import (PACKAGE, Collector, NodeDriver, NodeletDriver, Process, Publisher,
                               Repeater, Simulator, parameters_for, program, run)
from fake_vehicle import boat, shark, wait_until

COMMAND_TIMEOUT_S = 0.5
LIMIT_S = 0.2
# roscpp looks every 0.1 s whether it is to end, at three places one after the other.
ROS_SHUTDOWN_S = 0.5
ORDERLY_CLOSE_S = 0.1
# From the driver's socket to this program's clock, on a machine that does other things too.
NOISE_S = 1.0

AHEAD = Drive(left=0.5, right=0.5)
DIVE = Behavior(vertical_mode=Behavior.VERTICAL_DEPTH, vertical=2.0)


class Commanded:
    """A vehicle that obeys commands; nothing else is said to it."""

    def __init__(self, vehicle, topic, message, formatter, driver):
        self.vehicle = vehicle
        self.formatter = formatter
        self.driver = driver
        self.message = message
        self.connection = vehicle.wait_for_connection()
        Collector(driver.namespace + "/control", ControlStatus).wait_until(
            lambda status: status.grant == ControlStatus.GRANTED)
        self.connection.wait_for("LOG", 5 if formatter == "RMB" else 0)
        self.publisher = Publisher(driver.namespace + "/" + topic, type(message))

    def command(self):
        """Once; it stays fresh for the driver's command_timeout."""
        self.publisher.publish(self.message)
        self.connection.wait_for(self.formatter, 2)

    def stop(self):
        self.publisher.close()
        self.driver.stop()
        self.vehicle.stop()


class Leaving(unittest.TestCase):
    number = 0

    def start(self, kind, command_timeout=5.0):
        """A boat and a Sandshark, each with a driver of its own."""
        Leaving.number += 1
        self.boat = self.commanded(boat(), "cmd_drive", AHEAD, "DIR", "boat", kind,
                                   command_timeout)
        self.shark = self.commanded(shark(), "cmd_behavior", DIVE, "RMB", "shark", kind,
                                    command_timeout)
        return self.boat, self.shark

    def commanded(self, vehicle, topic, message, formatter, name, kind, command_timeout):
        namespace = "/%s%d" % (name, Leaving.number)
        driver = kind(namespace, parameters_for(vehicle, command_timeout=command_timeout,
                                                status_rate=0.0))
        result = Commanded(vehicle, topic, message, formatter, driver)
        self.addCleanup(result.stop)
        return result

    def assert_ended(self, vehicle, since, limit_s=LIMIT_S):
        """Zero thrust within the limit, or just nothing later than that; once, and nothing more."""
        late = since + limit_s + NOISE_S
        if vehicle.formatter == "DIR":
            zeros = wait_until(lambda: vehicle.connection.since(since, "DIR,0,0"), "zero thrust")
            self.assertLess(zeros[0][0], late, "zero after %.3f s" % (zeros[0][0] - since))
            self.assertEqual("PYDIR,0,0", vehicle.connection.bodies()[-1])
            self.assertEqual(1, len(zeros))
        after = [line for at, line in vehicle.connection.since(since) if at > late]
        self.assertEqual([], after)

    def assert_left(self, vehicle, since, limit_s):
        self.assertEqual("closed", vehicle.connection.wait_for_end())
        self.assertLess(vehicle.connection.ended_at - since, limit_s + ORDERLY_CLOSE_S + NOISE_S)
        self.assert_ended(vehicle, since, limit_s)


class WhileConnected(Leaving):
    def end(self, act, kind=NodeDriver):
        vehicles = self.start(kind)
        diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.addCleanup(diagnostics.close)
        since = []
        for vehicle in vehicles:
            vehicle.command()
            since.append(time.monotonic())
            act(vehicle.driver.namespace)
        # The next sentence would be due after 0.2 s; these come once a second.
        diagnostics.wait_for_publisher().wait_for(len(diagnostics.received) + 3)
        for vehicle, began in zip(vehicles, since):
            self.assert_ended(vehicle, began)
            self.assertIsNone(vehicle.connection.ended)

    def test_stop(self):
        self.end(lambda namespace: rospy.ServiceProxy(namespace + "/stop", Trigger)())

    def test_gate_closed(self):
        self.end(lambda namespace: rospy.ServiceProxy(namespace + "/enable_commands",
                                                      SetBool)(False))

    def test_publisher_stops(self):
        for vehicle in self.start(NodeDriver, COMMAND_TIMEOUT_S):
            repeater = Repeater(vehicle.publisher, vehicle.message)
            vehicle.connection.wait_for(vehicle.formatter, 4)
            repeater.stop()
            control = Collector(vehicle.driver.namespace + "/control", ControlStatus)
            control.wait_until(lambda status: not status.commanding)
            self.assert_ended(vehicle, repeater.published_at, COMMAND_TIMEOUT_S + 0.1)
            control.close()


class WithTheProgram(Leaving):
    def end(self, kind, act, limit_s):
        for vehicle in self.start(kind):
            vehicle.command()
            since = time.monotonic()
            act(vehicle.driver)
            self.assert_left(vehicle, since, limit_s)

    def signal(self, kind, number, limit_s):
        self.end(kind, lambda driver: driver.process.send_signal(number), limit_s)
        for vehicle in (self.boat, self.shark):
            self.assertEqual(0, vehicle.driver.process.wait())

    def test_interrupt(self):
        self.signal(NodeDriver, signal.SIGINT, LIMIT_S)

    def test_terminate(self):
        self.signal(NodeDriver, signal.SIGTERM, LIMIT_S)

    def test_hang_up(self):
        """Its terminal or ssh session is gone."""
        before = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # else it is as after nohup
        self.addCleanup(signal.signal, signal.SIGHUP, before)
        self.signal(NodeDriver, signal.SIGHUP, LIMIT_S)

    def test_unload(self):
        self.end(NodeletDriver, lambda driver: driver.unload(), LIMIT_S)

    def test_rosnode_kill(self):
        self.end(NodeDriver, lambda driver: rosnode.kill_nodes([driver.name]), ROS_SHUTDOWN_S)

    def test_interrupted_manager(self):
        self.signal(NodeletDriver, signal.SIGINT, ROS_SHUTDOWN_S)

    def test_rosnode_kill_of_the_manager(self):
        self.end(NodeletDriver, lambda driver: rosnode.kill_nodes([driver.manager.name]),
                 ROS_SHUTDOWN_S)


class MasterLink:
    """A way to the ROS master on which nothing passes any more when it is told so: the master's
    host has gone, and no one says so."""

    def __init__(self):
        master = urllib.parse.urlparse(rosgraph.get_master_uri())
        self._master = (master.hostname, master.port)
        self._passes = threading.Event()
        self._passes.set()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.argument = "__master:=http://127.0.0.1:%d" % self._listener.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def hold(self):
        self._passes.clear()

    def release(self):
        self._passes.set()

    def _serve(self):
        while True:
            near = self._listener.accept()[0]
            far = socket.create_connection(self._master)
            for ends in ((near, far), (far, near)):
                threading.Thread(target=self._forward, args=ends, daemon=True).start()

    def _forward(self, source, sink):
        try:
            while True:
                data = source.recv(65536)
                self._passes.wait()
                if not data:
                    return sink.shutdown(socket.SHUT_WR)
                sink.sendall(data)
        except OSError:
            return


class WithASilentMaster(Leaving):
    def test_interrupt(self):
        master = MasterLink()

        def node(namespace, parameters):
            return NodeDriver(namespace, parameters, [master.argument])

        vehicles = self.start(node)
        self.addCleanup(master.release)
        master.hold()
        for vehicle in vehicles:
            vehicle.command()
            since = time.monotonic()
            vehicle.driver.process.send_signal(signal.SIGINT)
            self.assert_left(vehicle, since, LIMIT_S)
        master.release()
        for vehicle in vehicles:
            self.assertEqual(0, vehicle.driver.process.wait())


class WithoutMaster(unittest.TestCase):
    def test_a_node_that_waits_for_its_master_can_be_interrupted(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = Process([program(PACKAGE, "nmea_node"), "__master:=http://127.0.0.1:1"])
            self.addCleanup(process.stop)
            wait_until(lambda: [line for line in process.output if "master" in line],
                       "the node's word that there is no master")
            process.send_signal(number)
            self.assertEqual(0, process.wait(), process.output)


class Killed(unittest.TestCase):
    """What the driver cannot do anything about, the boat's own watchdog covers."""

    def test_the_connection_is_closed(self):
        vehicle = boat()
        self.addCleanup(vehicle.stop)
        driver = NodeDriver("/killed", parameters_for(vehicle))
        self.addCleanup(driver.stop)
        connection = vehicle.wait_for_connection()
        driver.process.send_signal(signal.SIGKILL)
        self.assertIn(connection.wait_for_end(1.0), ("closed", "reset"))

    def test_the_boat_stops_its_motors(self):
        simulator = Simulator("/killed/simulator", "kingfisher", loop_speed=0.0, resume_loop=0.0,
                              noise=False)
        self.addCleanup(simulator.stop)
        truth = Collector("/killed/simulator/odom", Odometry).wait_for_publisher()
        driver = NodeDriver("/killed", parameters_for(simulator))
        self.addCleanup(driver.stop)
        repeater = Repeater(Publisher("/killed/cmd_drive", Drive), Drive(left=1.0, right=1.0))
        self.addCleanup(repeater.stop)
        truth.wait_until(lambda odometry: odometry.twist.twist.linear.x > 0.2)
        driver.process.send_signal(signal.SIGKILL)
        killed = time.monotonic()
        wait_until(lambda: self.slows_down(truth), "the boat to slow down")
        fastest = max(truth.received, key=lambda received: received[1].twist.twist.linear.x)[0]
        self.assertLess(fastest - killed, 1.5)

    @staticmethod
    def slows_down(truth):
        speeds = [odometry.twist.twist.linear.x for odometry in truth.messages]
        return speeds[-1] < 0.7 * max(speeds)


class Halted(unittest.TestCase):
    """Ctrl-Z and later fg: what came meanwhile lies in the kernel and looks new."""

    HALTED_S = 2.0  # longer than a command_timeout, and than the driver needs to notice

    def test_what_came_meanwhile_is_not_sent(self):
        vehicle = boat()
        self.addCleanup(vehicle.stop)
        driver = NodeDriver("/halted", parameters_for(vehicle))
        self.addCleanup(driver.stop)
        self.addCleanup(driver.process.send_signal, signal.SIGCONT)
        connection = vehicle.wait_for_connection()
        publisher = Publisher("/halted/cmd_drive", Drive)
        control = Collector("/halted/control", ControlStatus).wait_for_publisher()
        publisher.publish(AHEAD)
        connection.wait_for("DIR", 2)
        wait_until(lambda: not control.messages[-1].commanding, "the command to be stale")
        driver.process.send_signal(signal.SIGSTOP)
        halted = time.monotonic()
        publisher.publish(Drive(left=0.7, right=0.7))
        wait_until(lambda: time.monotonic() > halted + self.HALTED_S, "time to pass")
        driver.process.send_signal(signal.SIGCONT)
        wait_until(lambda: [line for line in driver.process.output if "long ago" in line],
                   "the refusal")
        repeater = Repeater(publisher, AHEAD)
        self.addCleanup(repeater.stop)
        wait_until(lambda: connection.since(halted, "DIR,50,50"), "a new command")
        self.assertEqual([], connection.since(halted, "DIR,70,70"))


class WithoutClock(Leaving):
    """use_sim_time, and no clock: ROS time stands still at zero."""

    def setUp(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")

    def test_time_outs_services_and_diagnostics_go_on(self):
        diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.addCleanup(diagnostics.close)
        for vehicle in self.start(NodeDriver, COMMAND_TIMEOUT_S):
            vehicle.publisher.publish(vehicle.message)
            since = time.monotonic()
            vehicle.connection.wait_for(vehicle.formatter, 2)
            Collector(vehicle.driver.namespace + "/control", ControlStatus).wait_until(
                lambda status: not status.commanding)
            self.assert_ended(vehicle, since, COMMAND_TIMEOUT_S + 0.1)
            self.assertTrue(rospy.ServiceProxy(vehicle.driver.namespace + "/stop",
                                               Trigger)().success)
        diagnostics.wait_for_publisher().wait_for(len(diagnostics.received) + 3)
        self.assertEqual(0, diagnostics.messages[-1].header.stamp.to_nsec())


if __name__ == "__main__":
    run("leaving")
