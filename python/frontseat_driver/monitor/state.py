"""What is known of one vehicle, from messages as they come. Times are steady, in s."""

import collections
import math

from diagnostic_msgs.msg import DiagnosticStatus
from rosgraph_msgs.msg import Log

UNKNOWN_VARIANCE = 1e5   # the driver says 1e6 where the vehicle told nothing
RATE_WINDOW_S = 5.0
KEPT_FAULTS = 50
KEPT_ADDRESSES = 50      # noise on the line must not fill the memory
# Not commands: the driver sends these by itself, at its start or all the time.
HOUSEKEEPING = ("BPSTS", "BPLOG", "BPVER")


class Told:
    """A value, and when it was true."""

    def __init__(self, value, at):
        self.value = value
        self.at = at

    def age_s(self, now):
        return max(0.0, now - self.at)


class Rate:
    """How often something came lately."""

    def __init__(self):
        self._times = collections.deque()

    def count(self, at):
        self._times.append(at)

    def hz(self, now, since):
        while self._times and self._times[0] <= now - RATE_WINDOW_S:
            self._times.popleft()
        # Right from the first seconds on.
        return len(self._times) / min(RATE_WINDOW_S, max(1.0, now - since))


def unless_unknown(value, variance):
    return value if 0.0 <= variance < UNKNOWN_VARIANCE else None


def compass_attitude_deg(q):
    """Heading (clockwise from true north), roll (port side up) and pitch (bow up) of a FLU body in
    ENU."""
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    roll = math.atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y))
    pitch = -math.asin(max(-1.0, min(1.0, 2.0 * (q.w * q.y - q.z * q.x))))
    heading = math.degrees(math.pi / 2.0 - yaw) % 360.0
    return heading, math.degrees(roll), math.degrees(pitch)


def address(line):
    """`BFNVG` of `$BFNVG,...`."""
    return line[1:].split("*")[0].split(",")[0][:8]


class Fault:
    def __init__(self, at, level, text):
        self.at, self.level, self.text = at, level, text
        self.count = 1


class State:
    def __init__(self, namespace="/", now=0.0):
        self.namespace = "/" + namespace.strip("/")
        self.since = now
        self.master_uri = ""
        self.master_heard = None     # when the master answered last
        self.master_lost = False
        self.elsewhere = ()          # namespaces in which there are drivers
        self.driver = None           # full name of the node that publishes `link`
        self.link = self.control = self.mission = self.shutdown = None
        self.pose = self.heading = self.roll = self.pitch = self.speed = None
        self.fix = self.depth = self.altitude = None
        self.batteries = {}
        self.received = {}           # rates by address
        self.received_at = None      # when the newest sentence came
        self.sent = {}               # newest line by address
        self.sent_rates = {}
        self.acks = collections.OrderedDict()  # newest by command
        self.diagnostics = {}        # Told levels and texts by name, in the driver's order
        self.faults = collections.deque(maxlen=KEPT_FAULTS)  # oldest first

    # --- The master, which brings nodes together.

    def take_master(self, at, uri, answered):
        self.master_uri, self.master_lost = uri, not answered
        if answered:
            self.master_heard = at

    def take_elsewhere(self, namespaces):
        self.elsewhere = namespaces

    # --- The link and permission: latched, told once a second or on change.

    def take_link(self, at, message, publisher=None):
        self.link = Told(message, at)
        self.driver = publisher or self.driver

    def take_control(self, at, message):
        self.control = Told(message, at)

    def take_mission(self, at, message):
        self.mission = Told(message, at)

    def take_shutdown(self, at, message):
        self.shutdown = Told(message, at)

    # --- Where the vehicle is.

    def take_odom(self, at, odom):
        pose, variance = odom.pose.pose, odom.pose.covariance
        velocity = odom.twist.twist.linear
        self.pose = Told((pose.position.x, pose.position.y), at)
        heading, roll, pitch = compass_attitude_deg(pose.orientation)
        speed = math.hypot(velocity.x, velocity.y)
        for name, value in (("heading", unless_unknown(heading, variance[35])),
                            ("roll", unless_unknown(roll, variance[21])),
                            ("pitch", unless_unknown(pitch, variance[28])),
                            ("speed", unless_unknown(speed, odom.twist.covariance[0]))):
            # A part that the vehicle leaves out grows old; it is not zero.
            if value is not None:
                setattr(self, name, Told(value, at))

    def take_fix(self, at, fix):
        self.fix = Told(fix, at)

    def take_depth(self, at, depth):
        self.depth = Told(-depth.pose.pose.position.z, at)

    def take_altitude(self, at, altitude):
        self.altitude = Told(altitude.range, at)

    def take_battery(self, at, battery):
        self.batteries[battery.location or "battery"] = Told(battery, at)

    # --- What is said on the link.

    def take_received(self, at, line):
        self.received_at = at
        kind = address(line)
        if kind in self.received or len(self.received) < KEPT_ADDRESSES:
            self.received.setdefault(kind, Rate()).count(at)

    def take_sent(self, at, line):
        kind = address(line)
        self.sent[kind] = Told(line, at)
        self.sent_rates.setdefault(kind, Rate()).count(at)

    def take_ack(self, at, ack):
        self.acks.pop(ack.command, None)
        self.acks[ack.command] = Told(ack, at)

    def received_hz(self, now):
        """By address, the most frequent first; what came once stays, as zero."""
        rates = [(kind, rate.hz(now, self.since)) for kind, rate in self.received.items()]
        return sorted(rates, key=lambda pair: (-round(pair[1], 1), pair[0]))

    def last_byte_age_s(self, now):
        """By the driver's own word, or by what it passed on since; None before any byte."""
        times = [self.received_at]
        if self.link and self.link.value.bytes_received:
            times.append(self.link.at - self.link.value.since_received.to_sec())
        times = [at for at in times if at is not None]
        return max(0.0, now - max(times)) if times else None

    def commands(self):
        """Lines sent, the newest first, what a person meant before what keeps the link alive."""
        return sorted(self.sent.items(),
                      key=lambda pair: (pair[0] in HOUSEKEEPING, -pair[1].at))

    # --- What is wrong.

    def is_ours(self, name):
        """Whether a node or nodelet belongs to this vehicle: by its namespace."""
        return ("/" + name.strip("/")).rsplit("/", 1)[0] == self.namespace.rstrip("/")

    def take_diagnostics(self, at, array, publisher=None):
        if self.driver and publisher and publisher != self.driver:
            return
        for status in array.status:
            node, separator, name = status.name.rpartition(": ")
            if not separator or not self.is_ours(node):
                continue
            before = self.diagnostics.get(name)
            # A change alone is news. Stale values are no fault of the vehicle's.
            if status.level in (DiagnosticStatus.WARN, DiagnosticStatus.ERROR) and (
                    before is None or before.value.level != status.level):
                self.add_fault(at, status.level, "%s: %s" % (name, status.message))
            self.diagnostics[name] = Told(status, at)

    def take_log(self, at, entry):
        if entry.level < Log.WARN:
            return
        speaker, _, text = entry.msg.partition(": ")
        # The driver begins with its name, since a manager speaks for many.
        if not text or not speaker.startswith("/"):
            speaker, text = entry.name, entry.msg
        if not self.is_ours(speaker) or self.driver not in (None, entry.name):
            return
        level = DiagnosticStatus.WARN if entry.level == Log.WARN else DiagnosticStatus.ERROR
        self.add_fault(at, level, text)

    def add_fault(self, at, level, text):
        if self.faults and self.faults[-1].text == text:
            fault = self.faults[-1]
            fault.at = at
            fault.count += 1
        else:
            self.faults.append(Fault(at, level, text))

    def complaints(self):
        """Diagnostics that are not well now; the first is the cause of the others."""
        return [(name, told) for name, told in self.diagnostics.items()
                if told.value.level != DiagnosticStatus.OK]
