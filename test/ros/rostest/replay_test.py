#!/usr/bin/env python3
"""Missions recorded by rosbag and played back at several rates give the same messages, and all."""

import os
import shutil
import struct
import tempfile
import time
import unittest

import rosbag
import rosgraph
import rospy

from frontseat_driver.msg import Sentence

from driver_under_test import PACKAGE, NodeDriver, Process, Simulator, parameters_for, program, run
from fake_vehicle import wait_until

DIALECTS = ("sandshark", "kingfisher")
# rosbag record queues 100 messages of a topic and drops what comes on top of that. A slow machine
# may keep it waiting for that long at rates that no vehicle has; then the bag is written here, and
# a vehicle at its own rate is recorded beside it.
MOST_RECORDED_SPEED = 1.0

# All that comes from sentences. Not: link, control, nmea/tx and diagnostics, which tell of the
# connection and of commands.
TOPICS = ("odom", "imu/data", "imu/data_raw", "compass/data", "nav/fix", "nav/velocity", "depth",
          "altitude", "battery", "gps/fix", "gps/velocity", "gps/time_reference", "vehicle_time",
          "mission_status", "interface_version", "shutdown", "ack", "nmea/rx", "tf")
RECORD_PATIENCE_S = 60.0


def without_seq(topic, raw):
    """What must be the same: a message without its count; an acknowledgement also without the time
    since its command, which is not replayed; a line without its connection, which text lacks."""
    if topic == "nmea/rx":
        sentence = Sentence()
        sentence.deserialize(raw)
        return sentence.header.stamp, sentence.sentence
    start = 4 if topic == "tf" else 0
    end = len(raw) - 8 if topic == "ack" else len(raw)
    return raw[:start] + raw[start + 4:end]


def at_least(counts, others):
    return all(counts[topic] >= others[topic] for topic in TOPICS)


def lost(raw):
    """How many messages with a header did not get here: a test that is held up loses what does not
    fit the driver's queue."""
    seqs = [struct.unpack_from("<I", one)[0] for one in raw]
    return seqs[-1] - seqs[0] + 1 - len(seqs) if seqs else 0


class Messages:
    """All messages of a driver as they come over the wire; be there before the driver is."""

    def __init__(self, namespace):
        self.raw = {topic: [] for topic in TOPICS}
        self._subscribers = [
            rospy.Subscriber(namespace + "/" + topic, rospy.AnyMsg, self._take, topic,
                             buff_size=1 << 24)
            for topic in TOPICS]

    def _take(self, message, topic):
        self.raw[topic].append(message._buff)

    def connected_to(self, topics):
        return all(subscriber.get_num_connections() > 0
                   for topic, subscriber in zip(TOPICS, self._subscribers) if topic in topics)

    def counts(self):
        return {topic: len(raw) for topic, raw in self.raw.items()}

    def by_topic(self):
        return {topic: [without_seq(topic, one) for one in raw] for topic, raw in self.raw.items()}

    def close(self):
        for subscriber in self._subscribers:
            subscriber.unregister()


class RosbagRecord:
    """rosbag record of nmea/rx; there when this returns."""

    def __init__(self, topic, bag):
        self._topic = topic
        subscribers = len(self._subscribers())
        self._process = Process([program("rosbag", "record"), "--output-name=" + bag, topic])
        wait_until(lambda: len(self._subscribers()) > subscribers, "rosbag record",
                   RECORD_PATIENCE_S)

    def _subscribers(self):
        topics = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
        return topics.get(self._topic, [])

    def stop(self, _raw):
        self._process.stop()


class WrittenHere:
    def __init__(self, topic, bag):
        self._topic = topic
        self._bag = bag

    def stop(self, raw):
        with rosbag.Bag(self._bag, "w") as bag:
            for one in raw:
                sentence = Sentence()
                sentence.deserialize(one)
                bag.write(self._topic, sentence, sentence.header.stamp)


class Mission:
    """A simulated vehicle, the driver, all that it publishes, and a bag of nmea/rx."""

    def __init__(self, name, dialect, folder, speed):
        self.dialect = dialect
        self.speed = speed
        self.namespace = "/" + name
        self.topic = self.namespace + "/nmea/rx"
        self.bag = os.path.join(folder, name + ".bag")
        self.messages = Messages(self.namespace)
        record = RosbagRecord if speed <= MOST_RECORDED_SPEED else WrittenHere
        self._recorder = record(self.topic, self.bag)
        self._simulator = Simulator(self.namespace + "/simulator", dialect, speed=speed)
        self._driver = NodeDriver(self.namespace, parameters_for(self._simulator),
                                  ["/tf:=" + self.namespace + "/tf"])

    def end(self):
        """The vehicle falls silent first, so that everything gets where it goes."""
        self._simulator.stop()
        count = -1
        while count != self.messages.counts()["nmea/rx"]:
            count = self.messages.counts()["nmea/rx"]
            began = time.monotonic()
            wait_until(lambda: time.monotonic() - began > 0.5, "the last messages")
        self._recorder.stop(self.messages.raw["nmea/rx"])
        self._driver.stop()
        self.messages.close()

    def lines(self):
        with rosbag.Bag(self.bag) as bag:
            return bag.get_message_count()

    def part(self, seconds):
        """A bag of the beginning."""
        path = self.bag.replace(".bag", "_part.bag")
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(path, "w") as part:
            end = rospy.Time.from_sec(bag.get_start_time() + seconds)
            lines = list(bag.read_messages(end_time=end))
            for topic, message, when in lines:
                part.write(topic, message, when)
        return path, len(lines)


    def text(self):
        """The lines as text with times in front, a few comments and some of the other side's."""
        path = self.bag.replace(".bag", ".nmea")
        with rosbag.Bag(self.bag) as bag, open(path, "w") as text:
            text.write("# a capture\n")
            for lines, (_, message, _) in enumerate(bag.read_messages(), 1):
                stamp = message.header.stamp
                text.write("%d.%09d rx %s\n" % (stamp.secs, stamp.nsecs, message.sentence))
                if lines % 100 == 0:
                    text.write("%d.%09d tx $BPLOG,ALL,OFF*00\n" % (stamp.secs, stamp.nsecs))
        return path, lines


def bag_player(options):
    def command(mission, namespace, bag):
        return [program("rosbag", "play"), bag, "--queue=0", "--keep-alive", "--quiet",
                "--wait-for-subscribers",
                "%s:=%s/nmea/replay" % (mission.topic, namespace)] + options
    return command


def text_player(_mission, namespace, capture):
    return [program(PACKAGE, "nmea_replay"), "__ns:=" + namespace, "_capture:=" + capture,
            "_rate:=0"]


class Replay:
    """The same sentences through a driver that has no vehicle."""

    def __init__(self, mission, name, record, player):
        namespace = mission.namespace + "_" + name
        self.messages = Messages(namespace)
        self._driver = NodeDriver(namespace, {"source": "topic"}, ["/tf:=" + namespace + "/tf"])
        # On a slow computer that takes longer than the second for which the driver waits.
        spoken = {topic for topic, count in mission.messages.counts().items() if count}
        wait_until(lambda: self.messages.connected_to(spoken), "connections for what is replayed")
        self._began = time.monotonic()
        self._player = Process(player(mission, namespace, record))

    def wait_for(self, lines, timeout_s):
        wait_until(lambda: self.messages.counts()["nmea/rx"] >= lines,
                   "%d lines" % lines, timeout_s)
        return time.monotonic() - self._began

    def stop(self):
        self._player.stop()
        self._driver.stop()
        self.messages.close()


class Replayed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.speed = float(rospy.get_param("~speed"))
        cls.duration_s = float(rospy.get_param("~minutes")) * 60.0 / cls.speed
        cls.folder = tempfile.mkdtemp()
        cls.missions = [Mission(dialect, dialect, cls.folder, cls.speed) for dialect in DIALECTS]
        if cls.speed > MOST_RECORDED_SPEED:
            cls.missions.append(Mission("recorded", "sandshark", cls.folder, MOST_RECORDED_SPEED))
        for mission in cls.missions:
            wait_until(lambda: mission.messages.counts()["odom"] > 0, "odometry")
        began = time.monotonic()
        wait_until(lambda: time.monotonic() - began > cls.duration_s, "the end of the mission",
                   timeout_s=2.0 * cls.duration_s + 60.0)
        for mission in cls.missions:
            mission.end()
        rospy.set_param("/use_sim_time", True)  # for the nodes that start from now on

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def replay(self, name, player, record_of, timeout_s):
        """All that came out, after comparing it with what the driver said live."""
        runs = []
        for mission in self.missions:
            record, lines = record_of(mission)
            self.assertGreater(lines, 0)
            runs.append((mission, lines, Replay(mission, name, record, player)))
            self.addCleanup(runs[-1][2].stop)
        for mission, lines, replay in runs:
            took_s = replay.wait_for(lines, timeout_s)
            self.compare(mission, lines, replay, name, took_s)

    def compare(self, mission, lines, replay, name, took_s):
        live = mission.messages.by_topic()
        whole = lines == len(live["nmea/rx"])
        if whole:
            wait_until(lambda: at_least(replay.messages.counts(), mission.messages.counts()),
                       "as many messages as live: %s, %s"
                       % (mission.messages.counts(), replay.messages.counts()), RECORD_PATIENCE_S)
        played = replay.messages.by_topic()
        self.assertEqual(lines, len(played["nmea/rx"]))
        self.assertGreater(len(played["odom"]), 0)
        for topic in TOPICS:
            # Transforms are not numbered; there are no more than odometries.
            gaps = lost(mission.messages.raw["odom" if topic == "tf" else topic])
            expected = live[topic] if whole else live[topic][:max(0, len(played[topic]) - gaps)]
            rest = iter(played[topic])
            different = [i for i, one in enumerate(expected) if one not in rest]
            self.assertEqual([], different[:10], topic)
            if gaps == 0:
                self.assertEqual(len(expected), len(played[topic]), topic)
        print("%s, %s: %d lines in %.1f s gave %d messages, all as live"
              % (mission.namespace, name, lines, took_s, sum(map(len, played.values()))),
              flush=True)

    def test_the_bag_holds_every_line(self):
        for mission in self.missions:
            live = mission.messages.by_topic()
            self.assertEqual(len(live["nmea/rx"]), mission.lines())
            with rosbag.Bag(mission.bag) as bag:
                seqs = [message.header.seq for _, message, _ in bag.read_messages()]
            self.assertEqual(list(range(seqs[0], seqs[0] + len(seqs))), seqs)
            silent = {topic for topic in TOPICS if not live[topic]}
            self.assertEqual({"sandshark": {"imu/data_raw", "compass/data", "battery", "gps/fix",
                                            "gps/velocity", "gps/time_reference", "shutdown"},
                              "kingfisher": {"depth", "altitude", "mission_status", "shutdown",
                                             "interface_version", "ack"}}
                             [mission.dialect], silent)

    def test_at_the_rate_it_was_recorded(self):
        part_s = float(rospy.get_param("~part")) or self.duration_s
        self.replay("rate_1", bag_player(["--rate=1"]), lambda mission: mission.part(part_s),
                    2.0 * part_s + 60.0)

    def test_ten_times_as_fast(self):
        self.replay("rate_10", bag_player(["--rate=10", "--clock"]),
                    lambda mission: (mission.bag, mission.lines()), self.duration_s + 60.0)

    def test_as_fast_as_it_can_be_read(self):
        self.replay("unlimited", bag_player(["--immediate"]),
                    lambda mission: (mission.bag, mission.lines()), self.duration_s + 60.0)

    def test_from_text(self):
        self.replay("text", text_player, Mission.text, self.duration_s + 60.0)


if __name__ == "__main__":
    run("replay")
