#!/usr/bin/env python3
"""From a ROS command to the bytes that the vehicle hears."""

import math
import time
import unittest

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from frontseat_driver.msg import (Behavior, CommandAck, ControlStatus, Course, Drive, Helm,
                                  LinkStatus, Sentence)
from frontseat_driver.srv import Abort, ModifyBehavior, SendSentence, SetLogging
from geometry_msgs.msg import Twist, Vector3

from driver_under_test import (Collector, Log, NodeDriver, Publisher, Repeater, parameters_for,
                               row, run)
from fake_vehicle import (acknowledgement, boat, checksum, control, navigation, sentence, shark,
                          time_of_day, wait_until)

NAN = float("nan")
# So that no command goes stale on a machine that has other things to do.
PATIENT = {"command_timeout": 5.0}


def velocity(linear, angular):
    return Twist(linear=Vector3(x=linear), angular=Vector3(z=angular))


def behavior(horizontal=None, vertical=None, speed=None):
    """Pairs of mode and value."""
    message = Behavior()
    message.horizontal_mode, message.horizontal = horizontal or (0, 0.0)
    message.vertical_mode, message.vertical = vertical or (0, 0.0)
    message.speed_mode, message.speed = speed or (0, 0.0)
    return message


# Topic, message, and the body on the wire. max_speed is 2 m/s and max_yaw_rate 1 rad/s.
BOAT_ROWS = (
    ("cmd_drive", Drive(left=0.5, right=-0.25), "PYDIR,50,-25"),
    ("cmd_drive", Drive(left=1.0, right=-1.0), "PYDIR,100,-100"),
    ("cmd_drive", Drive(left=-0.004, right=0.126), "PYDIR,0,13"),
    ("cmd_helm", Helm(thrust=0.3, yaw_rate=0.2), "PYDEP,-0.2000,30"),
    ("cmd_helm", Helm(thrust=-1.0, yaw_rate=-0.5), "PYDEP,0.5000,-100"),
    ("cmd_course", Course(yaw=0.0, speed=1.5), "PYDEV,90,1.500"),
    ("cmd_course", Course(yaw=math.pi, speed=0.0), "PYDEV,270,0.000"),
    ("cmd_course", Course(yaw=math.pi / 2 + 0.005, speed=2.25), "PYDEV,0,2.250"),
    ("cmd_vel", velocity(1.0, 0.5), "PYDEP,-0.5000,50"),
    ("cmd_vel", velocity(5.0, -3.0), "PYDEP,1.0000,100"),
    ("cmd_vel", velocity(-0.5, 0.0), "PYDEP,0.0000,-25"),
)

# At 42.35 N 71.1 W grid north lies 1.4150 degrees west of true north: a grid heading is 1.4150
# degrees more than the true one.
SHARK_ROWS = (
    (behavior((1, 0.0), (1, 5.0), (2, 1.5)), "91.4150,5.000,0,1.500,1,0"),
    (behavior((1, math.pi / 2)), "1.4150,,,,,0"),
    (behavior((1, -math.pi / 2), (2, 3.25)), "181.4150,3.250,1,,,0"),
    (behavior((2, math.radians(-12.5)), (3, math.radians(10.0))), "-12.5000,10.000,2,,,1"),
    (behavior(None, (4, math.radians(-4.0)), (1, -600.0)), ",-4.000,3,-600.000,0,"),
    (behavior(None, None, (2, 0.0)), ",,,0.000,1,"),
)


class Commanding(unittest.TestCase):
    namespace = None

    def start(self, vehicle, **parameters):
        self.vehicle = vehicle
        self.addCleanup(vehicle.stop)
        self.driver = NodeDriver(self.namespace, parameters_for(vehicle, **parameters))
        self.addCleanup(self.driver.stop)
        self.control = self.collect("control", ControlStatus)
        self.connection = vehicle.wait_for_connection()
        self.control.wait_until(lambda status: status.grant == ControlStatus.GRANTED)

    def collect(self, topic, message_type):
        collector = Collector(self.namespace + "/" + topic, message_type).wait_for_publisher()
        self.addCleanup(collector.close)
        return collector

    def publisher(self, topic, message_type):
        publisher = Publisher(self.namespace + "/" + topic, message_type)
        self.addCleanup(publisher.close)
        return publisher

    def repeat(self, topic, message, rate_hz=20.0):
        repeater = Repeater(self.publisher(topic, type(message)), message, rate_hz)
        self.addCleanup(repeater.stop)
        return repeater

    def call(self, name, service_type, *arguments):
        name = self.namespace + "/" + name
        rospy.wait_for_service(name, 10.0)
        return rospy.ServiceProxy(name, service_type)(*arguments)

    def bytes_of(self, formatter):
        """The last such line, checked."""
        line = self.connection.since(0.0, formatter)[-1][1]
        body, sum_heard = line[1:].split("*")
        self.assertEqual("$", line[0])
        self.assertEqual(checksum(body), sum_heard)
        return body


class Boat(Commanding):
    namespace = "/boat"

    def test_every_command_becomes_these_bytes(self):
        self.start(boat(), **PATIENT)
        publishers = {}
        for topic, message, expected in BOAT_ROWS:
            with row(topic=topic, expected=expected):
                if topic not in publishers:
                    publishers[topic] = self.publisher(topic, type(message))
                began = time.monotonic()
                publishers[topic].publish(message)
                heard = wait_until(lambda: self.connection.since(began, expected[2:5]), expected)
                self.assertEqual("$%s*%s" % (expected, checksum(expected)), heard[-1][1])
        self.assertEqual([], [body for body in self.connection.bodies() if body[:2] != "PY"])

    def test_what_was_latched_before_the_driver_came_is_not_sent(self):
        ahead = Drive(left=0.5, right=0.5)
        latching = Publisher(self.namespace + "/cmd_drive", Drive, latched=ahead)
        self.addCleanup(latching.close)
        self.start(boat())
        wait_until(lambda: [line for line in self.driver.process.warnings()
                            if " latches, " in line], "a warning")
        self.assertEqual([], self.connection.bodies())
        latching.publish(ahead)
        self.connection.wait_for("DIR")
        # From who came later it is a new one.
        also = Publisher(self.namespace + "/cmd_helm", Helm, latched=Helm(thrust=0.5))
        self.addCleanup(also.close)
        self.connection.wait_for("DEP")

    def test_a_fresh_command_is_repeated_and_then_ends_with_one_zero(self):
        self.start(boat())
        self.publisher("cmd_drive", Drive).publish(Drive(left=0.5, right=0.5))
        self.control.wait_until(lambda status: status.commanding)
        diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.addCleanup(diagnostics.close)
        wait_until(lambda: "PYDIR,0,0" in self.connection.bodies(), "zero thrust")
        diagnostics.wait_for_publisher().wait_for(2)
        *repeated, last = self.connection.bodies()
        self.assertEqual("PYDIR,0,0", last)
        self.assertEqual({"PYDIR,50,50"}, set(repeated))
        # Five in the second that it is fresh; a computer that holds its programs up may cost some.
        self.assertIn(len(repeated), range(2, 6))
        self.assertFalse(self.control.messages[-1].commanding)


class Shark(Commanding):
    namespace = "/shark"

    def test_every_command_becomes_these_bytes(self):
        self.start(shark(), datum=[42.35, -71.1], **PATIENT)
        publisher = self.publisher("cmd_behavior", Behavior)
        for message, expected in SHARK_ROWS:
            with row(expected=expected):
                began = time.monotonic()
                publisher.publish(message)
                wait_until(lambda: self.connection.since(began, "RMB"), expected)
                self.assertRegex(self.bytes_of("RMB"), r"^BPRMB,\d{6}\.\d{3},%s$" % expected)


class Refused(Commanding):
    """A command that cannot be used: nothing is sent, and the one before goes on."""

    def check(self, good, bad_topic, bad, field, formatter):
        good_topic, message = good
        log = Log().wait_for_publisher()
        self.addCleanup(log.close)
        links = self.collect("link", LinkStatus)
        good_one = self.repeat(good_topic, message)
        self.connection.wait_for(formatter)
        for value in bad:
            refused = links.wait_for()[-1].refused_commands
            # Only the newest of a topic waits: on a busy computer a good one takes its place.
            bad_one = self.repeat(bad_topic, value, 5.0)
            links.wait_until(lambda link: link.refused_commands > refused)
            bad_one.stop()
        began = time.monotonic()
        wait_until(lambda: self.connection.since(began, formatter), "the good command going on")
        good_one.stop()
        # The fake vehicle falls silent after its greeting, which is told too.
        lines = [line for line in log.lines(self.driver.name) if " data: " not in line]
        self.assertIn("refused %s: %s" % (bad_topic, field), lines[0])
        self.assertLessEqual(len(lines), len(bad), lines)  # one in five seconds, whatever the rate
        motion = [body for body in self.connection.bodies()
                  if body[:2] == "PY" or body[2:5] == "RMB"]
        return {body.split(",", 2)[2] if formatter == "RMB" else body for body in motion}

    def check_boat(self, bad_topic, bad, field):
        self.start(boat(), **PATIENT)
        heard = self.check(("cmd_drive", Drive(left=0.5, right=0.5)), bad_topic, bad, field, "DIR")
        self.assertEqual({"PYDIR,50,50"}, heard)

    def check_shark(self, bad_topic, bad, field):
        self.start(shark(), **PATIENT)
        good = behavior((2, 0.0), (1, 2.0), (2, 1.0))
        heard = self.check(("cmd_behavior", good), bad_topic, bad, field, "RMB")
        self.assertEqual({"0.0000,2.000,0,1.000,1,1"}, heard)


class RefusedByBoat(Refused):
    namespace = "/refusing_boat"

    def test_out_of_range(self):
        self.check_boat("cmd_drive", [Drive(left=1.01), Drive(right=-1.01)], "left is 1.01")

    def test_not_a_number(self):
        self.check_boat("cmd_helm", [Helm(yaw_rate=NAN), Helm(thrust=math.inf)], "yaw_rate is nan")

    def test_velocity_not_a_number(self):
        self.check_boat("cmd_vel", [velocity(0.0, NAN)], "angular.z is nan")

    def test_for_the_other_vehicle(self):
        self.check_boat("cmd_behavior", [behavior(None, (1, 3.0))], "it is for a sandshark")


class RefusedByShark(Refused):
    namespace = "/refusing_shark"

    def test_out_of_range(self):
        self.check_shark("cmd_behavior", [behavior(None, (1, -1.0)), behavior((3, 0.0)),
                                          behavior(None, None, (2, 10.5))], "vertical is -1")

    def test_not_a_number(self):
        self.check_shark("cmd_behavior", [behavior((1, NAN))], "horizontal is nan")

    def test_for_the_other_vehicle(self):
        self.check_shark("cmd_drive", [Drive(left=0.1)], "it is for a kingfisher")


class Flood(Commanding):
    namespace = "/flood"
    SPACING_S = 0.05

    def test_zero_is_heard_at_once_after_a_thousand_commands_a_second(self):
        self.start(boat(), send_spacing=self.SPACING_S)
        sent = self.collect("nmea/tx", Sentence)
        publisher = self.publisher("cmd_drive", Drive)
        delays_s = [self.flood(publisher) for _ in range(3)]
        self.assertLess(min(delays_s), 0.1, delays_s)
        stamps = [message.header.stamp.to_sec() for message in sent.messages]
        gaps_s = [later - earlier for earlier, later in zip(stamps, stamps[1:])]
        self.assertGreater(len(gaps_s), 20)
        self.assertGreater(min(gaps_s), self.SPACING_S - 0.001)

    def flood(self, publisher):
        """How long after it was published the zero was heard."""
        repeater = Repeater(publisher, Drive(left=0.5, right=0.5), 1000.0)
        began = time.monotonic()
        wait_until(lambda: len(self.connection.since(began, "DIR,50,50")) > 10, "commands")
        repeater.stop()
        published = time.monotonic()
        publisher.publish(Drive(left=0.0, right=0.0))
        zero = wait_until(lambda: self.connection.since(published, "DIR,0,0"), "zero")[0][0]
        self.assertEqual([], self.connection.since(zero, "DIR,50,50"))
        return zero - published


class Reconnect(Commanding):
    namespace = "/reconnect"

    def break_link(self):
        """Until the driver has noticed and is back."""
        count = len(self.vehicle.connections)
        said = len(self.control.messages)
        self.connection.close(reset=True)
        self.connection = self.vehicle.wait_for_connection(count + 1)
        wait_until(lambda: [status for status in self.control.messages[said:]
                            if status.grant == ControlStatus.UNKNOWN], "permission forgotten")

    def test_boat_hears_nothing_from_before(self):
        self.start(boat(), **PATIENT)
        publisher = self.publisher("cmd_drive", Drive)
        publisher.publish(Drive(left=0.5, right=0.5))
        self.connection.wait_for("DIR,50,50", 3)
        self.break_link()
        wait_until(lambda: self.control.messages[-1].grant == ControlStatus.GRANTED, "permission")
        self.assertFalse(self.control.messages[-1].commanding)
        publisher.publish(Drive(left=0.25, right=0.25))
        self.connection.wait_for("DIR", 3)
        self.assertEqual({"PYDIR,25,25"}, set(self.connection.bodies()))

    def test_shark_hears_nothing_until_it_has_handed_control_over(self):
        self.start(shark(), **PATIENT)
        publisher = self.publisher("cmd_behavior", Behavior)
        before = Repeater(publisher, behavior(None, (1, 2.0)))
        self.connection.wait_for("RMB", 2)
        self.vehicle.greeting = lambda: navigation()
        self.break_link()
        self.connection.wait_for("LOG", 5)
        self.connection.wait_for("STS", 2)  # a second in which commands kept coming
        before.stop()
        self.assertEqual([], self.connection.bodies("RMB"))
        self.assertIn("BFCTL", self.control.messages[-1].reason)
        self.connection.send(control(True))
        wait_until(lambda: self.control.messages[-1].grant == ControlStatus.GRANTED, "permission")
        self.connection.wait_for("STS", 4)
        self.assertEqual([], self.connection.bodies("RMB"))
        publisher.publish(behavior(None, (1, 3.0)))
        self.connection.wait_for("RMB", 2)
        self.assertEqual({",3.000,0,,,"}, {body.split(",", 2)[2]
                                          for body in self.connection.bodies("RMB")})


class Requests(Commanding):
    namespace = "/requests"

    def test_abort_goes_ahead_and_its_last_answer_counts(self):
        answered = []

        def answer(connection, line):
            if line.startswith("$BPABT") and not answered:
                answered.append(line)
                connection.send(acknowledgement(line, 3, "going up"), navigation(),
                                sentence("BFMIS,%s,survey.dive,Aborting," % time_of_day()),
                                acknowledgement(line, 2, "surfaced"))

        self.start(shark(answer), send_spacing=0.8)
        acks = self.collect("ack", CommandAck)
        # Behind these five it would wait four seconds.
        self.connection.wait_for("LOG", 1)
        answer_heard = self.call("abort", Abort, "leak, so stop", True)
        self.assertFalse(answer_heard.success)
        self.assertIn("reason", answer_heard.message)
        answer_heard = self.call("abort", Abort, "leak", True)
        bodies = self.connection.bodies()
        self.assertEqual((True, "surfaced"), (answer_heard.success, answer_heard.message))
        self.assertRegex(self.bytes_of("ABT"), r"^BPABT,\d{6}\.\d{3},leak,1$")
        self.assertLess(len([body for body in bodies if body.startswith("BPLOG")]), 5)
        pending, final = acks.wait_for(2)
        self.assertEqual(("BPABT", CommandAck.PENDING), (pending.command, pending.status))
        self.assertEqual(("BPABT", CommandAck.DONE, "surfaced"),
                         (final.command, final.status, final.message))
        for ack in (pending, final):
            self.assertGreater(ack.round_trip, 0.0)
            self.assertLess(ack.round_trip, 3.0)
        self.connection.send(sentence("BFACK,%s,RMB,000000.000,,2,0," % time_of_day()))
        self.assertTrue(math.isnan(acks.wait_for(3)[2].round_trip))

    def test_the_vehicle_has_the_last_word(self):
        words = {"RMB": (1, "mission plan in charge"), "LOG": (0, "no such sentence")}

        def answer(connection, line):
            if line[3:6] in words and ",ON" not in line:
                connection.send(acknowledgement(line, *words[line[3:6]]))

        self.start(shark(answer))
        modified = self.call("modify_behavior", ModifyBehavior, behavior(None, (1, 2.0)))
        self.assertFalse(modified.success)
        self.assertIn("mission plan in charge", modified.message)
        logging = self.call("set_logging", SetLogging, "XYZ", False)
        self.assertFalse(logging.success)
        self.assertIn("no such sentence", logging.message)
        self.assertEqual("BPLOG,XYZ,OFF", self.connection.bodies("LOG")[-1])

    def test_texts_that_would_break_a_sentence_are_refused(self):
        self.start(shark())
        self.connection.wait_for("LOG", 5)
        for reason in ("a,b", "a*b", "a$b", "a\nb", "\u00e9", "x" * 10000):
            answer = self.call("abort", Abort, reason, True)
            self.assertFalse(answer.success, reason[:20])
            self.assertNotEqual("", answer.message)
        lowered = self.call("abort", Abort, "ABT by operator", False)
        self.assertTrue(lowered.success)
        self.assertIn("lower case", lowered.message)
        self.assertEqual(1, len(self.connection.bodies("ABT")))
        self.assertTrue(self.bytes_of("ABT").endswith(",abt by operator,0"))

    def test_raw_sentences_only_where_they_are_allowed(self):
        self.start(boat(), allow_raw_sentences=True)
        answer = self.call("send_sentence", SendSentence, "PYDIR,1,2")
        self.assertTrue(answer.success, answer.message)
        self.connection.wait_for("DIR")
        self.assertEqual("PYDIR,1,2", self.bytes_of("DIR"))

    def test_no_raw_sentences_otherwise(self):
        self.start(boat())
        master = rosgraph.Master("/test")
        self.assertTrue(master.lookupService(self.namespace + "/stop"))
        with self.assertRaises(rosgraph.MasterException):
            master.lookupService(self.namespace + "/send_sentence")


if __name__ == "__main__":
    run("commands")
