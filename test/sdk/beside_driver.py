"""The SDK and this package's driver at one drone."""

import unittest
import warnings

import rospy
from blueye.sdk import Drone
from frontseat_driver.msg import BlueyeMessage, ControlStatus
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from driver_under_test import PACKAGE, Collector, Process, program
from sdk_under_test import DRONE, Simulator, estimate, tries, wait


@tries
class BesideTheDriver(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        self.simulator = Simulator()
        self.addCleanup(self.simulator.stop)
        rospy.set_param("/driver", {"host": DRONE, "reconnect_min": 0.1})
        self.control = Collector("/control", ControlStatus)
        self.odom = Collector("/odom", Odometry)
        self.sent = Collector("/blueye/control_out", BlueyeMessage)
        self.velocity = rospy.Publisher("/cmd_vel", Twist, queue_size=1)

    def start_driver(self):
        driver = Process([program(PACKAGE, "blueye_node"), "__name:=driver"])
        self.addCleanup(driver.stop)
        wait(lambda: self.grant() == ControlStatus.DENIED, "an observer")

    def grant(self):
        return self.control.messages[-1].grant if self.control.messages else None

    def command(self, surge_m_s):
        command = Twist()
        command.linear.x = surge_m_s
        self.velocity.publish(command)

    def test_each_drives_in_its_turn(self):
        drone = Drone()
        self.addCleanup(lambda: drone.connected and drone.disconnect())
        self.start_driver()
        self.assertTrue(drone.in_control)
        drone.motion.surge = 0.5
        self.drives_in_spite_of_the_driver()
        self.assertEqual([], self.sent.messages)
        drone.motion.surge = 0.0

        self.assertTrue(rospy.ServiceProxy("/take_control", Trigger)().success)
        wait(lambda: self.grant() == ControlStatus.GRANTED, "the driver's turn")
        wait(lambda: drone.client_in_control != drone.client_id, "the SDK to hear of it")
        wait(lambda: self.command(-0.5) or estimate(drone).surge_rate < -0.1, "way astern")

        # Who was disconnected is not listed, so take_control() would leave the drone to nobody.
        drone.disconnect()
        drone.connect(disconnect_other_clients=True)
        self.assertTrue(drone.in_control)
        wait(lambda: self.grant() == ControlStatus.DENIED, "the driver to be an observer again")
        sent = len(self.sent.messages)
        drone.motion.surge = 0.5
        self.drives_in_spite_of_the_driver()
        self.assertEqual(sent, len(self.sent.messages))

    def drives_in_spite_of_the_driver(self):
        """That commands the opposite, as an observer may not."""
        wait(lambda: self.command(-0.5) or self.speed() > 0.3, "the driver to see the SDK drive")

    def speed(self):
        return self.odom.messages[-1].twist.twist.linear.x if self.odom.messages else 0.0
