"""Starts the driver as a node or as a nodelet, and what is needed around it."""

import contextlib
import os
import re
import signal
import subprocess
import threading
import time
import xmlrpc.client

import nodelet.srv
import rosgraph
import rosgraph_msgs.msg
import roslib.packages
import rospy
import rostest

from fake_vehicle import TIMEOUT_S, wait_until

PACKAGE = "frontseat_driver"
NODELET = PACKAGE + "/NmeaNodelet"
# Back at once, and patient with a vehicle that says nothing more than its greeting.
QUICK = {"reconnect_min": 0.02, "reconnect_max": 0.1, "silence_timeout": 60.0}


def program(package, name):
    return roslib.packages.find_node(package, name)[0]


COLOR = re.compile(r"\x1b\[\d*m")


class Process:
    """A program and every line that it prints."""

    started = []

    def __init__(self, command):
        Process.started.append(self)
        self.command = command
        self.output = []
        self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            self.output.append(COLOR.sub("", line.decode(errors="replace")).rstrip())

    @property
    def pid(self):
        return self._process.pid

    def warnings(self):
        return [line for line in self.output if re.match(r"\[( WARN|ERROR|FATAL)\]", line)]

    def runs(self):
        return self._process.poll() is None

    def send_signal(self, number):
        self._process.send_signal(number)

    def wait(self, timeout_s=TIMEOUT_S):
        """The exit code; negative for a signal."""
        code = self._process.wait(timeout_s)
        self._reader.join(timeout_s)
        return code

    def stop(self):
        if self.runs():
            self.send_signal(signal.SIGINT)
        try:
            return self.wait()
        except subprocess.TimeoutExpired:
            self._process.kill()
            raise


class Usage:
    """What a process holds."""

    def __init__(self, pid):
        place = "/proc/%d/" % pid
        with open(place + "status") as status:
            line = [line for line in status if line.startswith("VmRSS")][0]
        self.memory_kib = int(line.split()[1])
        self.threads = len(os.listdir(place + "task"))
        self.files = len(os.listdir(place + "fd"))

    def __repr__(self):
        return "%d KiB, %d threads, %d files" % (self.memory_kib, self.threads, self.files)


def parameters_for(vehicle, **parameters):
    """Where a fake or simulated vehicle is, and what else is given."""
    return dict({"host": "127.0.0.1", "port": vehicle.port}, **dict(QUICK, **parameters))


class NodeDriver:
    """nmea_node in a namespace of its own."""

    def __init__(self, namespace, parameters, arguments=()):
        self.namespace = namespace
        self.name = namespace + "/driver"
        rospy.set_param(self.name, parameters)
        self.process = Process([program(PACKAGE, "nmea_node"), "__ns:=" + namespace,
                                "__name:=driver"] + list(arguments))

    def unload(self):
        self.process.stop()

    def stop(self):
        self.process.stop()


class Manager:
    """A nodelet manager."""

    def __init__(self, name):
        self.name = name
        self.process = Process([program("nodelet", "nodelet"), "manager", "__name:=" + name[1:]])
        rospy.wait_for_service(name + "/load_nodelet", TIMEOUT_S)
        self._load = rospy.ServiceProxy(name + "/load_nodelet", nodelet.srv.NodeletLoad)
        self._unload = rospy.ServiceProxy(name + "/unload_nodelet", nodelet.srv.NodeletUnload)

    def load(self, name):
        """False if the nodelet did not come up."""
        try:
            return self._load(name, NODELET, [], [], [], "").success
        except rospy.ServiceException:
            return False

    def unload(self, name):
        return self._unload(name).success

    def stop(self):
        self.process.stop()


class NodeletDriver:
    """The nodelet in a manager, which is its own unless another is given."""

    def __init__(self, namespace, parameters, manager=None):
        self.namespace = namespace
        self.name = namespace + "/driver"
        self._own_manager = manager is None
        self.manager = manager or Manager(namespace + "_manager")
        self.process = self.manager.process
        rospy.set_param(self.name, parameters)
        if not self.manager.load(self.name):
            raise AssertionError("not loaded: %s" % self.process.output)

    def unload(self):
        if not self.manager.unload(self.name):
            raise AssertionError("not unloaded")

    def stop(self):
        if self._own_manager:
            self.manager.stop()
        else:
            self.manager.unload(self.name)


class Simulator:
    """nmea_simulator on a port that the system picks."""

    def __init__(self, name, dialect, **parameters):
        rospy.set_param(name, dict({"dialect": dialect, "port": 0}, **parameters))
        namespace, own = name.rsplit("/", 1)
        self.process = Process([program(PACKAGE, "nmea_simulator"), "__ns:=" + (namespace or "/"),
                                "__name:=" + own])
        self.port = wait_until(lambda: rospy.get_param(name + "/actual_port", 0), "the simulator")

    def stop(self):
        self.process.stop()


def sends(node, topic):
    """Whether a node knows this program as a subscriber; None for one that does not answer, since
    the master remembers what was killed."""
    try:
        api = rosgraph.Master(rospy.get_name()).lookupNode(node)
        _, _, links = xmlrpc.client.ServerProxy(api).getBusInfo(rospy.get_name())
    except (OSError, rosgraph.MasterException):
        return None
    return any(link[1] == rospy.get_name() and link[2] == "o" and link[4] == topic
               for link in links)


class Collector:
    """Every message of a topic, with the steady time at which it came."""

    def __init__(self, topic, message_type):
        self._topic = topic
        self.received = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, buff_size=1 << 24,
                                            tcp_nodelay=True)

    def _take(self, message):
        self.received.append((time.monotonic(), message))

    @property
    def messages(self):
        return [message for _, message in list(self.received)]

    def wait_for_publisher(self):
        """Until every publisher sends to this subscriber; there must be one."""
        wait_until(self._connected, "a publisher of " + self._topic)
        return self

    def _connected(self):
        publishers = []
        for topic, nodes in rosgraph.Master(rospy.get_name()).getSystemState()[0]:
            if topic == self._topic:
                publishers = [node for node in nodes if node != rospy.get_name()]
        links = [sends(node, self._topic) for node in publishers]
        return True in links and False not in links

    def wait_for(self, count=1, timeout_s=TIMEOUT_S):
        wait_until(lambda: len(self.received) >= count,
                   "%d messages on %s" % (count, self._topic), timeout_s)
        return self.messages

    def wait_until(self, claim, timeout_s=TIMEOUT_S):
        """The first message of which the claim is true."""
        found = wait_until(lambda: [message for message in self.messages if claim(message)],
                           "a message on " + self._topic, timeout_s)
        return found[0]

    def close(self):
        self._subscriber.unregister()


class Publisher:
    """A topic to one subscriber, which is there when this returns."""

    def __init__(self, topic, message_type, latched=None):
        """With a message that is published at once, before anybody hears it, and latched."""
        self._publisher = rospy.Publisher(topic, message_type, queue_size=1000, tcp_nodelay=True,
                                          latch=latched is not None)
        if latched is not None:
            self._publisher.publish(latched)
            return
        wait_until(lambda: self._publisher.get_num_connections() > 0, "a subscriber of " + topic)

    def publish(self, message):
        self._publisher.publish(message)

    def close(self):
        self._publisher.unregister()


class Repeater:
    """Publishes one message at a rate until it is stopped."""

    def __init__(self, publisher, message, rate_hz=20.0):
        self.message = message
        self.published_at = 0.0
        self._publisher = publisher
        self._period_s = 1.0 / rate_hz
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        due = time.monotonic()
        while not self._stopped.wait(max(0.0, due - time.monotonic())):
            self.published_at = time.monotonic()
            self._publisher.publish(self.message)
            due = max(due + self._period_s, self.published_at)

    def stop(self):
        self._stopped.set()
        self._thread.join()


class Log(Collector):
    """/rosout."""

    def __init__(self):
        super().__init__("/rosout", rosgraph_msgs.msg.Log)

    def lines(self, node, level=rosgraph_msgs.msg.Log.WARN):
        """What a node or nodelet said at that level or above."""
        return [entry.msg for entry in self.messages
                if entry.level >= level and entry.msg.startswith(node + ":")]


@contextlib.contextmanager
def row(**named):
    """Names the row of a table that failed, as subTest() does, whose failures rosunit keeps to
    itself."""
    try:
        yield
    except (AssertionError, rospy.ServiceException) as error:
        raise AssertionError("%s: %s" % (named, error)) from error


def run(name):
    """Runs all test cases of the program; shows what the driver said if one of them fails."""
    rospy.init_node(name)
    try:
        rostest.rosrun(PACKAGE, name, "__main__")
    except SystemExit:
        for process in Process.started:
            print("\n".join([" ".join(process.command)] + process.output[-20:]), flush=True)
        raise
