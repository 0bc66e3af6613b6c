"""The vehicle's end of a TCP link, all in the hands of a test."""

import datetime
import socket
import struct
import threading
import time

TIMEOUT_S = 10.0


def wait_until(claim, what, timeout_s=TIMEOUT_S):
    """Returns what `claim` returns as soon as that is true; fails when it does not become so."""
    deadline = time.monotonic() + timeout_s
    while True:
        result = claim()
        if result:
            return result
        if time.monotonic() > deadline:
            raise AssertionError("after %g s still waiting for %s" % (timeout_s, what))
        time.sleep(0.002)


def checksum(body):
    total = 0
    for byte in body.encode("ascii"):
        total ^= byte
    return "%02X" % total


def sentence(body):
    """`BFCTL,...` as it goes over the link."""
    return ("$%s*%s\r\n" % (body, checksum(body))).encode("ascii")


def time_of_day(ahead_s=0):
    """UTC now, as a sentence has it."""
    now = datetime.datetime.utcnow() + datetime.timedelta(seconds=ahead_s)
    return now.strftime("%H%M%S.") + "%03d" % (now.microsecond // 1000)


def navigation(talker="BF", latitude="4221.000000,N", longitude="07106.000000,W", heading="90",
               depth="", roll="0", pitch="0"):
    """NVG at 42.35 N 71.1 W, unless told otherwise."""
    now = time_of_day(18 if talker == "CP" else 0)
    return sentence(",".join([talker + "NVG", now, latitude, longitude, "1", "", depth, heading,
                              roll, pitch, now]))


def velocity(talker="BF", east="0", north="0"):
    now = time_of_day(18 if talker == "CP" else 0)
    return sentence(",".join([talker + "NVR", now, east, north, "0", "0", "0", "0"]))


def control(granted):
    return sentence("BFCTL,%s,%d" % (time_of_day(), granted))


def acknowledgement(line, status, message=""):
    """BFACK for a command as it was heard."""
    fields = line[1:].split("*")[0].split(",")
    command_time = "" if fields[0] == "BPLOG" else fields[1]
    return sentence("BFACK,%s,%s,%s,,%d,0,%s"
                    % (time_of_day(), fields[0][2:], command_time, status, message))


class Connection:
    """One client: what it sent, when, and how it went away."""

    def __init__(self, client, on_line):
        self._client = client
        self._on_line = on_line
        self._rest = b""
        self.opened_at = time.monotonic()
        self.lines = []  # (steady time, text) of every line, as it came in
        self.ended = None  # "closed" in order, "reset", or "by the vehicle"
        self.ended_at = None
        self._closing = False
        self._sending = threading.Lock()
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def read(self):
        ended = "closed"
        try:
            while True:
                data = self._client.recv(65536)
                if not data:
                    break
                self._take(time.monotonic(), data)
        except OSError:
            ended = "reset"
        self.ended_at = time.monotonic()
        self.ended = "by the vehicle" if self._closing else ended
        self._client.close()

    def _take(self, now, data):
        *lines, self._rest = (self._rest + data).split(b"\n")
        for raw in lines:
            line = raw.decode("ascii", "backslashreplace").rstrip("\r")
            self.lines.append((now, line))
            self._on_line(self, line)

    def send(self, *data):
        with self._sending:
            self._client.sendall(b"".join(data))

    def bodies(self, formatter=""):
        """Without `$` and checksum; only lines whose sixth character on is `formatter`."""
        return [line[1:].split("*")[0] for _, line in list(self.lines)
                if line[3:].startswith(formatter)]

    def since(self, steady_s, formatter=""):
        return [(at, line) for at, line in list(self.lines)
                if at > steady_s and line[3:].startswith(formatter)]

    def wait_for(self, formatter, count=1, timeout_s=TIMEOUT_S):
        """Bodies with that formatter, when there are `count` of them."""
        what = "%d of %s" % (count, formatter)
        wait_until(lambda: len(self.bodies(formatter)) >= count, what, timeout_s)
        return self.bodies(formatter)

    def wait_for_end(self, timeout_s=TIMEOUT_S):
        wait_until(lambda: self.ended, "the end of the connection", timeout_s)
        return self.ended

    def close(self, reset=False):
        self._closing = True
        try:
            if reset:  # the reading end, unseen by the client: read() then closes with a reset
                self._client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER,
                                        struct.pack("ii", 1, 0))
                self._client.shutdown(socket.SHUT_RD)
            else:
                self._client.shutdown(socket.SHUT_WR)
        except OSError:
            return


class FakeVehicle:
    """Listens on a port that the system picks. `greeting` is said to every client; `answer` is
    called with connection and line for every line heard."""

    def __init__(self, greeting=lambda: b"", answer=lambda connection, line: None):
        self.greeting = greeting
        self.answer = answer
        self._listener = None
        self.connections = []
        self.port = 0
        self.start()

    def start(self):
        """Also after a stop, on the same port."""
        self._listener = socket.create_server(("127.0.0.1", self.port))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._serve, args=(self._listener,), daemon=True).start()

    def stop(self, reset=False):
        """As when its power is cut; with `reset`, as when it comes up again and knows nobody."""
        try:
            self._listener.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self._listener.close()
        for connection in self.connections:
            connection.close(reset)

    def _serve(self, listener):
        try:
            while True:
                client, _ = listener.accept()
                connection = Connection(client, self._heard)
                self.connections.append(connection)
                connection.send(self.greeting())
                threading.Thread(target=connection.read, daemon=True).start()
        except OSError:
            return

    def _heard(self, connection, line):
        self.answer(connection, line)

    def wait_for_connection(self, count=1, timeout_s=TIMEOUT_S):
        """The newest connection, when there were `count` since the beginning."""
        wait_until(lambda: len(self.connections) >= count, "connection %d" % count, timeout_s)
        return self.connections[-1]


def boat():
    """A Kingfisher that says where it is, so that its dialect is known."""
    return FakeVehicle(lambda: navigation("CP"))


def acknowledge_all(connection, line):
    if not line.startswith("$BPVER"):
        connection.send(acknowledgement(line, 2))


def shark(answer=acknowledge_all):
    """A Sandshark at a known place that hands control over and acknowledges everything."""
    return FakeVehicle(lambda: navigation() + control(True), answer)
