#!/usr/bin/env python3
"""Drives a square: `cmd_vel` out, `odom` back.

    rosrun frontseat_driver kingfisher_square.py _side:=20 _speed:=1.0

The first side leads east (x of `odom`), then north, west, south. Nothing here belongs to one kind
of vehicle.
"""

import math
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

PERIOD = 0.1    # s; a command that is not repeated is stale after command_timeout, 1 s
OLDEST = 1.0    # s; without odom for longer we do not know where we are
GAIN = 0.8      # rad/s of turn per rad of error
LEAST = 0.2     # share of the speed while turning; some boats do not turn without any thrust


class Square:
    def __init__(self):
        self.side = float(rospy.get_param("~side", 20.0))        # m
        self.speed = float(rospy.get_param("~speed", 1.0))       # m/s
        self.reached = float(rospy.get_param("~reached", 1.5))   # m from a corner
        self.place = None   # x, y, yaw
        self.heard = 0.0
        self.command = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        # Without tcp_nodelay a message may be held back for some 40 ms.
        rospy.Subscriber("odom", Odometry, self.take, queue_size=1, tcp_nodelay=True)
        rospy.on_shutdown(self.stop)

    def take(self, odom):
        at, q = odom.pose.pose.position, odom.pose.pose.orientation
        # Yaw counts counter-clockwise from east. It is no compass heading.
        yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        self.place = (at.x, at.y, yaw)
        self.heard = time.monotonic()

    def run(self):
        while self.place is None and not rospy.is_shutdown():
            time.sleep(PERIOD)
        if rospy.is_shutdown():
            return
        x, y, _ = self.place
        side = self.side
        for corner in ((x + side, y), (x + side, y + side), (x, y + side), (x, y)):
            self.drive_to(*corner)

    def drive_to(self, x, y):
        while not rospy.is_shutdown():
            if time.monotonic() - self.heard > OLDEST:
                self.send(0.0, 0.0)
            else:
                east, north = x - self.place[0], y - self.place[1]
                if math.hypot(east, north) < self.reached:
                    rospy.loginfo("corner at %.1f, %.1f", x, y)
                    return
                error = math.remainder(math.atan2(north, east) - self.place[2], 2.0 * math.pi)
                self.send(self.speed * max(LEAST, math.cos(error)), GAIN * error)
            # Not rospy.Rate: the driver's time-outs run in real time, whatever /clock does.
            time.sleep(PERIOD)

    def send(self, ahead, turn):
        if rospy.is_shutdown():
            return
        twist = Twist()
        twist.linear.x = ahead
        twist.angular.z = turn
        self.command.publish(twist)

    def stop(self):
        # Sooner than by command_timeout, which stops the boat if this program is killed.
        self.command.publish(Twist())
        time.sleep(0.1)  # it leaves on another thread


if __name__ == "__main__":
    rospy.init_node("kingfisher_square")
    Square().run()
