#!/usr/bin/env python3
"""Dives, drives a square at one depth, photographs, and comes up: `cmd_vel` out, `odom` back.

    rosrun frontseat_driver blueye_dive.py _depth:=3 _side:=8 _speed:=0.4

Takes control first, and gives it back however it ends. The drone's own controller keeps the depth;
the square leads along the bow as it lies at the start, then to starboard.
"""

import math
import time

import rospy
from frontseat_driver.msg import ControlStatus
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from std_srvs.srv import SetBool, Trigger

PERIOD = 0.1     # s; a command that is not repeated is stale after command_timeout, 1 s
OLDEST = 1.0     # s; without odom for longer we do not know where we are
GAIN = 0.5       # 1/s: metres per second of way per metre of error
PATIENCE = 10.0  # s for the driver to be there


class Ended(Exception):
    """The dive cannot go on; says why."""


class Dive:
    def __init__(self):
        self.depth = float(rospy.get_param("~depth", 3.0))       # m, down
        self.side = float(rospy.get_param("~side", 8.0))         # m
        self.speed = float(rospy.get_param("~speed", 0.4))       # m/s
        self.reached = float(rospy.get_param("~reached", 0.7))   # m from a corner
        self.place = None   # x, y, z, yaw
        self.heard = 0.0
        self.in_control = False
        self.refusal = ""   # why a command would be refused now; empty if it would not
        self.command = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        # Without tcp_nodelay a message may be held back for some 40 ms.
        rospy.Subscriber("odom", Odometry, self.take, queue_size=1, tcp_nodelay=True)
        rospy.Subscriber("control", ControlStatus, self.take_control_status, tcp_nodelay=True)
        rospy.on_shutdown(self.leave)

    def take(self, odom):
        at, q = odom.pose.pose.position, odom.pose.pose.orientation
        # Yaw counts counter-clockwise from east. It is no compass heading.
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        self.place = (at.x, at.y, at.z, yaw)
        self.heard = time.monotonic()

    def take_control_status(self, control):
        self.refusal = control.reason

    def run(self):
        while self.place is None and not rospy.is_shutdown():
            time.sleep(PERIOD)
        if rospy.is_shutdown():
            return
        try:
            self.call("take_control", Trigger)
            self.in_control = True
            self.wait_for_permission()
            self.dive()
        except Ended as reason:
            if not rospy.is_shutdown():
                rospy.logwarn("ended early: %s", reason)

    def wait_for_permission(self):
        """`control` is a topic: it may be a little behind the service."""
        end = time.monotonic() + PATIENCE
        while self.refusal and time.monotonic() < end and not rospy.is_shutdown():
            time.sleep(PERIOD)

    def dive(self):
        x, y, _, yaw = self.place
        self.drive(lambda: (0.0, 0.0, -self.speed), lambda: self.place[2] < -self.depth)
        for automatic in ("auto_depth", "auto_heading"):
            self.call(automatic, SetBool, True)
        ahead = (self.side * math.cos(yaw), self.side * math.sin(yaw))
        right = (self.side * math.sin(yaw), -self.side * math.cos(yaw))
        for corner in ((x + ahead[0], y + ahead[1]),
                       (x + ahead[0] + right[0], y + ahead[1] + right[1]),
                       (x + right[0], y + right[1]), (x, y)):
            self.drive(lambda: self.towards(*corner) + (0.0,), lambda: self.at(*corner))
            rospy.loginfo("corner at %.1f, %.1f, %.1f m deep", corner[0], corner[1],
                          -self.place[2])
        self.call("take_picture", Trigger)
        for automatic in ("auto_depth", "auto_heading"):
            self.call(automatic, SetBool, False)
        self.drive(lambda: (0.0, 0.0, self.speed), lambda: self.place[2] > -0.3)
        rospy.loginfo("at the surface")

    def towards(self, x, y):
        """Metres per second to the bow and to port, the yaw as it is: it can go sideways."""
        east, north = x - self.place[0], y - self.place[1]
        distance = math.hypot(east, north)
        speed = min(self.speed, GAIN * distance) / max(distance, 1e-6)
        yaw = self.place[3]
        return (speed * (east * math.cos(yaw) + north * math.sin(yaw)),
                speed * (-east * math.sin(yaw) + north * math.cos(yaw)))

    def at(self, x, y):
        return math.hypot(x - self.place[0], y - self.place[1]) < self.reached

    def drive(self, wanted, reached):
        while not reached():
            if rospy.is_shutdown() or self.refusal:
                raise Ended(self.refusal)
            fresh = time.monotonic() - self.heard < OLDEST
            self.send(*(wanted() if fresh else (0.0, 0.0, 0.0)))
            # Not rospy.Rate: the driver's time-outs run in real time, whatever /clock does.
            time.sleep(PERIOD)

    def send(self, ahead, port, up):
        if rospy.is_shutdown():
            return
        twist = Twist()
        twist.linear.x, twist.linear.y, twist.linear.z = ahead, port, up
        self.command.publish(twist)

    def call(self, name, kind, *arguments):
        """Raises Ended, with what the driver says, if it is not done."""
        if rospy.is_shutdown():
            raise Ended("shut down")
        rospy.wait_for_service(name, PATIENCE)
        answer = rospy.ServiceProxy(name, kind)(*arguments)
        if not answer.success:
            raise Ended("%s: %s" % (name, answer.message))

    def leave(self):
        # Sooner than by command_timeout, which stops the drone if this program is killed.
        self.command.publish(Twist())
        time.sleep(0.1)  # it leaves on another thread
        if not self.in_control:
            return
        try:
            rospy.ServiceProxy("release_control", Trigger)()
        except rospy.ServiceException:
            pass  # then the drone takes it back itself when the driver ends


if __name__ == "__main__":
    rospy.init_node("blueye_dive")
    Dive().run()
