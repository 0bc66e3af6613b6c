#!/usr/bin/env python3
"""Dives and surveys parallel legs: `cmd_behavior` out, `odom` and `control` back.

    rosrun frontseat_driver sandshark_survey.py _depth:=4 _legs:=3 _length:=50

Waits until the vehicle gives control, which it does while its own mission runs. The legs lead along
`yaw` and back, each to starboard of the one before. At the end the vehicle is at the surface and
goes on with its own mission; call the service `abort` where that is not wanted.
"""

import math
import time

import rospy
from frontseat_driver.msg import Behavior, ControlStatus
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

PERIOD = 0.2      # s; a command is stale after command_timeout, 1 s; the vehicle's own limit is 5 s
OLDEST = 2.0      # s; without odom for longer we do not know where we are
LOOKAHEAD = 10.0  # m, how far ahead on the leg to steer for


class Survey:
    def __init__(self):
        self.depth = float(rospy.get_param("~depth", 4.0))       # m, down
        self.speed = float(rospy.get_param("~speed", 1.5))       # m/s
        self.legs = int(rospy.get_param("~legs", 3))
        self.length = float(rospy.get_param("~length", 50.0))    # m
        self.spacing = float(rospy.get_param("~spacing", 12.0))  # m
        # Counter-clockwise from east, so this is north. It is no compass heading.
        self.yaw = float(rospy.get_param("~yaw", math.pi / 2.0))
        self.place = None  # x, y, depth
        self.heard = 0.0
        self.refusal = "nothing heard from the driver yet"
        self.command = rospy.Publisher("cmd_behavior", Behavior, queue_size=1)
        # Without tcp_nodelay a message may be held back for some 40 ms.
        rospy.Subscriber("odom", Odometry, self.take, queue_size=1, tcp_nodelay=True)
        rospy.Subscriber("control", ControlStatus, self.take_control, tcp_nodelay=True)
        rospy.on_shutdown(self.stop)

    def take(self, odom):
        at = odom.pose.pose.position
        self.place = (at.x, at.y, -at.z)
        self.heard = time.monotonic()

    def take_control(self, control):
        self.refusal = control.reason  # why a command would be refused now; empty if it would not

    def going(self):
        fresh = time.monotonic() - self.heard < OLDEST
        return fresh and not self.refusal and not rospy.is_shutdown()

    def run(self):
        while not self.going() and not rospy.is_shutdown():
            rospy.loginfo_throttle(10, "waiting: %s" % (self.refusal or "no odom"))
            time.sleep(PERIOD)
        if self.keep(lambda: self.yaw, self.depth, lambda: self.place[2] > self.depth - 0.5):
            points = self.points()
            for start, end in zip(points, points[1:]):
                self.follow(start, end)
        if self.keep(lambda: self.yaw, 0.0, lambda: self.place[2] < 0.5):
            rospy.loginfo("at the surface")
        elif not rospy.is_shutdown():
            rospy.logwarn("ended early: %s" % (self.refusal or "no odom"))

    def points(self):
        x, y = self.place[:2]
        east, north = math.cos(self.yaw), math.sin(self.yaw)
        return [(x + along * east + leg * self.spacing * north,
                 y + along * north - leg * self.spacing * east)
                for leg in range(self.legs)
                for along in ((0.0, self.length) if leg % 2 == 0 else (self.length, 0.0))]

    def follow(self, start, end):
        yaw = math.atan2(end[1] - start[1], end[0] - start[0])
        east, north = math.cos(yaw), math.sin(yaw)

        def along():
            return (self.place[0] - start[0]) * east + (self.place[1] - start[1]) * north

        def aim():
            far = along() + LOOKAHEAD
            return math.atan2(start[1] + far * north - self.place[1],
                              start[0] + far * east - self.place[0])

        length = math.hypot(end[0] - start[0], end[1] - start[1])
        if self.keep(aim, self.depth, lambda: along() > length - 1.0):
            rospy.loginfo("at %.1f, %.1f, %.1f m deep" % self.place)

    def keep(self, yaw, depth, reached):
        """Repeats a behavior until `reached`; False if it had to be given up before."""
        while self.going() and not reached():
            command = Behavior()
            command.header.stamp = rospy.Time.now()  # so that one held up on the way is refused
            command.horizontal_mode = Behavior.HORIZONTAL_HEADING
            command.horizontal = yaw()
            command.vertical_mode = Behavior.VERTICAL_DEPTH
            command.vertical = depth
            command.speed_mode = Behavior.SPEED_SPEED
            command.speed = self.speed
            self.command.publish(command)
            # Not rospy.Rate: the driver's time-outs run in real time, whatever /clock does.
            time.sleep(PERIOD)
        return self.going()

    def stop(self):
        # Sooner than by command_timeout. The driver sends nothing more, and the vehicle takes over.
        try:
            rospy.ServiceProxy("stop", Trigger)()
        except rospy.ServiceException:
            pass  # then the command just grows stale


if __name__ == "__main__":
    rospy.init_node("sandshark_survey")
    Survey().run()
