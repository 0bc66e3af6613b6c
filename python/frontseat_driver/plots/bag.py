"""A mission from a bag with the driver's topics, in any namespace."""

import math
import os
import struct

import genpy
import numpy as np
import rosbag

from frontseat_driver.plots import capture
from frontseat_driver.plots.columns import Columns
from frontseat_driver.plots.errors import Unreadable
from frontseat_driver.plots.mission import GAP_S, Mission, Series

UNKNOWN_VARIANCE = 1e5  # the driver says 1e6 where the vehicle told nothing
SAME_CLOCK_S = 5.0

# What tells a vehicle's namespace: topics whose type is the driver's own, and their names.
OWN = {"nmea/rx": "frontseat_driver/Sentence", "link": "frontseat_driver/LinkStatus",
       "odom": "nav_msgs/Odometry"}


def is_bag(path):
    with open(path, "rb") as file:
        return file.read(7) == b"#ROSBAG"


def namespaces(bag):
    """Of every vehicle in the bag, each ending with a slash."""
    found = set()
    topics = bag.get_type_and_topic_info().topics
    for own, kind in OWN.items():
        found |= {topic[:-len(own)] for topic, info in topics.items()
                  if info.msg_type == kind and topic.endswith("/" + own)}
    # A simulator's own odom is the truth, not a vehicle.
    named = {space for space in found
             if any(space + own in topics for own in ("nmea/rx", "link"))}
    return sorted(named or found)


def choose(bag, wanted):
    found = namespaces(bag)
    if wanted is not None:
        space = "/" + wanted.strip("/") + "/" if wanted.strip("/") else "/"
        if space in found:
            return space
        raise Unreadable("no vehicle in namespace %s; there is: %s"
                         % (wanted, ", ".join(found) or "none"))
    if len(found) > 1:
        raise Unreadable("the bag holds %d vehicles; choose one with --namespace: %s"
                         % (len(found), ", ".join(found)))
    if not found:
        raise Unreadable("no topic of the driver (odom, link, nmea/rx) in this bag")
    return found[0]


def unless_unknown(value, variance):
    return value if 0.0 <= variance < UNKNOWN_VARIANCE else math.nan


def attitude_deg(q):
    """Heading (clockwise from north), roll (port side up) and pitch (bow up) of a FLU body in ENU."""
    roll = math.atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y))
    pitch = -math.asin(max(-1.0, min(1.0, 2.0 * (q.w * q.y - q.z * q.x))))
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return math.degrees(math.pi / 2.0 - yaw) % 360.0, math.degrees(roll), math.degrees(pitch)


class Reader:
    def __init__(self, bag, space, topics):
        self.bag = bag
        self.odom = Columns()      # x, y, heading, roll, pitch, speed
        self.depth = Columns()
        self.altitude = Columns()
        self.batteries = {}
        self.link = Columns()      # connected, sentences since the last one, s since a byte
        self.bad_checksums = Columns()
        self.malformed = Columns()
        self.counters = None
        self.arrivals = Columns()
        self.lags = []             # s, recorded minus stamped
        # Every sentence is read only where the driver's own counters were not recorded: that is
        # most of the bag.
        self.heard = None if space + "link" in topics else space + "nmea/rx"
        self.takers = {space + "odom": self.take_odom, space + "depth": self.take_depth,
                       space + "altitude": self.take_altitude,
                       space + "battery": self.take_battery, space + "link": self.take_link}

    def read(self):
        topics = list(self.takers) + ([self.heard] if self.heard else [])
        for topic, raw, recorded in self.bag.read_messages(topics=topics, raw=True):
            if topic == self.heard:
                # Of the header alone: sequence, then when the driver heard it.
                seconds, nanoseconds = struct.unpack_from("<II", raw[1], 4)
                self.arrivals.add(seconds + 1e-9 * nanoseconds)
                continue
            message = raw[-1]()
            try:
                message.deserialize(raw[1])
            except genpy.DeserializationError:
                continue  # costs this message alone
            at = recorded.to_sec()
            if topic.endswith("/link"):
                at = message.header.stamp.to_sec() or at  # on the driver's ROS clock
            elif topic.endswith(("/odom", "/depth", "/altitude", "/battery")):
                stamp = message.header.stamp.to_sec()
                self.lags.append(at - stamp)
                at = stamp
            self.takers[topic](at, message)
        return self

    def take_odom(self, at, odom):
        pose, covariance = odom.pose.pose, odom.pose.covariance
        heading, roll, pitch = attitude_deg(pose.orientation)
        velocity = odom.twist.twist.linear
        self.odom.add(at, pose.position.x, pose.position.y,
                      unless_unknown(heading, covariance[35]),
                      unless_unknown(roll, covariance[21]),
                      unless_unknown(pitch, covariance[28]),
                      unless_unknown(math.hypot(velocity.x, velocity.y),
                                     odom.twist.covariance[0]))

    def take_depth(self, at, depth):
        self.depth.add(at, -depth.pose.pose.position.z)

    def take_altitude(self, at, altitude):
        # Zero is what a Sandshark says when it hears no bottom.
        self.altitude.add(at, altitude.range if altitude.range > 0.0 else math.nan)

    def take_battery(self, at, battery):
        name = (battery.location or "battery").replace("_", " ")
        self.batteries.setdefault(name, Columns()).add(at, battery.voltage)

    def take_link(self, at, link):
        now = np.array([link.bad_checksums, link.malformed + link.oversized,
                        link.sentences_received], dtype=float)
        before, self.counters = self.counters, now
        if before is None:
            before = now
        elif now[2] < before[2]:  # the driver started anew
            before = np.zeros(3)
        bad, malformed, heard = now - before
        self.link.add(at, link.connected, heard, link.since_received.to_sec())
        for column, more in ((self.bad_checksums, bad), (self.malformed, malformed)):
            if more > 0:
                column.add(at, more)

    def offset_s(self):
        """What takes the stamps to the time of recording, if they are on another clock."""
        lag = float(np.median(self.lags)) if self.lags else 0.0
        return lag if abs(lag) > SAME_CLOCK_S else 0.0


def read(path, wanted=None):
    try:
        bag = rosbag.Bag(path)
    except rosbag.ROSBagUnindexedException:
        raise Unreadable("the bag was not closed; run: rosbag reindex %s" % path)
    except (rosbag.ROSBagException, OSError) as error:
        raise Unreadable("%s: %s" % (path, error))
    with bag:
        space = choose(bag, wanted)
        topics = bag.get_type_and_topic_info().topics
        if space + "odom" not in topics and space + "nmea/rx" in topics:
            return capture.read(path, space.rstrip("/") or "/")
        reader = Reader(bag, space, topics).read()
        mission = Mission(os.path.basename(path) + ("" if space == "/" else " " + space[:-1]))
        fill(mission, reader)
    return mission


def fill(mission, reader):
    offset_s = reader.offset_s()
    odom = reader.odom.series(offset_s)
    if len(odom):
        x, y, heading, roll, pitch, speed = odom.values
        mission.position = Series(odom.t, x, y)
        mission.heading_deg = Series(odom.t, heading)
        mission.roll_deg = Series(odom.t, roll)
        mission.pitch_deg = Series(odom.t, pitch)
        mission.speed_m_s = Series(odom.t, speed)
    mission.depth_m = reader.depth.series(offset_s)
    mission.altitude_m = reader.altitude.series(offset_s)
    mission.battery_v = {name: column.series(offset_s)
                         for name, column in reader.batteries.items()}
    if reader.counters is not None:
        mission.faults_known = True
        hear_by_link(mission, reader.link.series())
    else:
        mission.hear(reader.arrivals.series().t)
    mission.bad_checksums = reader.bad_checksums.series()
    mission.malformed = reader.malformed.series()


def hear_by_link(mission, link):
    connected, heard, silent_s = link.values
    mission.connected = Series(link.t, connected)
    mission.count(link.t, np.cumsum(heard))
    # The last report of each silence tells its length.
    ends = np.flatnonzero((silent_s > GAP_S) & (np.append(silent_s[1:], 0.0) <= silent_s))
    mission.gaps = np.column_stack([link.t[ends] - silent_s[ends], link.t[ends]])
