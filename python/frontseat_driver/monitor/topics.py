"""What the monitor hears: queues messages for the screen's thread, in a thread of its own."""

import queue
import threading
import time

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from frontseat_driver.msg import (CommandAck, ControlStatus, LinkStatus, MissionStatus, Sentence,
                                  ShutdownNotice)
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import BatteryState, NavSatFix, Range

MASTER_PERIOD_S = 2.0

# Of these the newest is enough, read when the screen is drawn.
SAMPLED = (("odom", Odometry, "take_odom"), ("nav/fix", NavSatFix, "take_fix"),
           ("depth", PoseWithCovarianceStamped, "take_depth"),
           ("altitude", Range, "take_altitude"))
LATCHED = (("control", ControlStatus, "take_control"),
           ("mission_status", MissionStatus, "take_mission"),
           ("shutdown", ShutdownNotice, "take_shutdown"))
EVERY = (("battery", BatteryState, "take_battery"), ("ack", CommandAck, "take_ack"))
SENTENCES = (("nmea/rx", "take_received"), ("nmea/tx", "take_sent"))


def caller(message):
    return message._connection_header.get("callerid")


def stamped_age_s(message):
    """A latched message may have waited long for us; its stamp is on the ROS clock."""
    stamp = message.header.stamp.to_sec()
    return max(0.0, rospy.get_time() - stamp) if stamp else 0.0


class Topics:
    def __init__(self, namespace=None):
        self._namespace = namespace
        self._queue = queue.Queue()
        self._newest = {}
        self._subscribers = []
        self._heard_link = False
        self._stopped = threading.Event()
        self._pid = None
        self.uri = rosgraph.get_master_uri()
        self._thread = threading.Thread(target=self._watch, daemon=True)

    @property
    def namespace(self):
        """Before the node is there, only the environment and the arguments can tell."""
        own = rosgraph.names.get_ros_namespace()
        if self._namespace is None:
            return own
        return rosgraph.names.ns_join(own, self._namespace)

    def start(self):
        self._thread.start()

    def stop(self):
        self._stopped.set()

    # --- In the screen's thread.

    def drain(self, state):
        """Hands everything that came to the state."""
        while True:
            try:
                method, arguments = self._queue.get_nowait()
            except queue.Empty:
                break
            getattr(state, method)(*arguments)
        for topic, kind, method in SAMPLED:
            taken = self._newest.pop(topic, None)
            if taken is not None and taken[1]._connection_header.get("type") == kind._type:
                at, raw = taken
                getattr(state, method)(at, kind().deserialize(raw._buff))

    # --- In the thread that knows the master.

    def _watch(self):
        while not self._stopped.is_set():
            try:
                pid = rosgraph.Master("/frontseat_monitor").getPid()
                self._master_answered(pid)
            except (OSError, rosgraph.MasterException, rospy.ROSException):
                self._put("take_master", time.monotonic(), self.uri, False)
            self._stopped.wait(MASTER_PERIOD_S)

    def _master_answered(self, pid):
        if not rospy.core.is_initialized():
            rospy.init_node("frontseat_monitor", anonymous=True, disable_signals=True)
        if pid != self._pid:  # the first one, or one that was started anew and knows nobody
            self._subscribe()
            self._pid = pid
        self._put("take_master", time.monotonic(), self.uri, True)
        if not self._heard_link:
            self._put("take_elsewhere", self._elsewhere())

    def _elsewhere(self):
        found = rospy.get_published_topics()
        return sorted(name[:-len("/link")] or "/" for name, kind in found
                      if kind == LinkStatus._type and name.endswith("/link"))

    def _name(self, topic):
        return rosgraph.names.ns_join(self.namespace, topic) if self._namespace else topic

    def _subscribe(self):
        for subscriber in self._subscribers:
            subscriber.unregister()
        self._subscribers = []
        self._listen("link", LinkStatus, self._take_link)
        for topic, kind, method in LATCHED:
            self._listen(topic, kind, self._latched(method))
        for topic, kind, method in EVERY:
            self._listen(topic, kind, self._every(method), queue_size=None)
        for topic, method in SENTENCES:
            # Each counts, so none is thrown away; at a few hundred a second that costs little.
            self._listen(topic, Sentence, self._sentence(method), queue_size=None)
        for topic, _, _ in SAMPLED:
            self._listen(topic, rospy.AnyMsg, self._sample(topic))
        self._add("/diagnostics", DiagnosticArray, self._take_diagnostics, None)
        self._add("/rosout", Log, self._take_log, None)

    def _listen(self, topic, kind, callback, queue_size=1):
        self._add(self._name(topic), kind, callback, queue_size)

    def _add(self, topic, kind, callback, queue_size):
        self._subscribers.append(rospy.Subscriber(topic, kind, callback, queue_size=queue_size,
                                                  tcp_nodelay=True))

    # --- In the threads of the subscribers.

    def _put(self, method, *arguments):
        self._queue.put((method, arguments))

    def _take_link(self, message):
        behind_s = 0.0 if self._heard_link else stamped_age_s(message)
        self._heard_link = True
        self._put("take_link", time.monotonic() - behind_s, message, caller(message))

    def _latched(self, method):
        waited = [stamped_age_s]  # for the first message alone

        def take(message):
            behind_s = waited.pop()(message) if waited else 0.0
            self._put(method, time.monotonic() - behind_s, message)
        return take

    def _every(self, method):
        return lambda message: self._put(method, time.monotonic(), message)

    def _sentence(self, method):
        return lambda message: self._put(method, time.monotonic(), message.sentence)

    def _sample(self, topic):
        def take(message):
            self._newest[topic] = (time.monotonic(), message)
        return take

    def _take_diagnostics(self, message):
        self._put("take_diagnostics", time.monotonic(), message, caller(message))

    def _take_log(self, message):
        self._put("take_log", time.monotonic(), message)
