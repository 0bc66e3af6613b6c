"""A link between driver and vehicle that breaks in every way, and remembers what it let through."""

import random
import select
import socket
import struct
import threading
import time

LISTEN = "127.0.0.1"
QUIET_S = 1.5  # before and after a fault a sentence may be lost with it


class Fault:
    def __init__(self, kind, began, ended):
        self.kind, self.began, self.ended = kind, began, ended


class FaultProxy:
    """Forwards bytes both ways. Between `begin()` and `end()` of a fault it does what the fault
    says. Every complete line that went to the driver is kept with its time."""

    KINDS = ("cut", "reset", "refuse", "half-open", "stall", "corrupt", "garbage", "split", "slow")

    def __init__(self, vehicle_port, seed):
        self.vehicle_port = vehicle_port
        self.forwarded = []  # (steady time, line) to the driver
        self.faults = []
        self._random = random.Random(seed)
        self._kind = None
        self._rest = b""
        self._ends = None  # sockets of the connection, driver's and vehicle's
        self._listener = socket.create_server((LISTEN, 0))
        self.port = self._listener.getsockname()[1]
        self._running = True
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def fault(self, kind, seconds, wait):
        """One fault, which lasts so long; `wait` lets time pass."""
        began = time.monotonic()
        self._kind = kind
        if kind in ("cut", "reset", "refuse"):
            self._close(reset=kind == "reset")
        wait(seconds)
        if kind == "half-open":
            self._close(reset=True)
        self._kind = None
        self.faults.append(Fault(kind, began, time.monotonic()))

    def undisturbed(self, since, until):
        """Lines of that time that no fault can have cost."""
        spans = [(fault.began - QUIET_S, fault.ended + QUIET_S) for fault in self.faults]
        number, lines = 0, []
        for at, line in self.forwarded:
            while number < len(spans) and spans[number][1] < at:
                number += 1
            if since < at < until and (number == len(spans) or at < spans[number][0]):
                lines.append(line)
        return lines

    def stop(self):
        self._running = False
        self._close()
        self._listener.close()
        self._thread.join(5.0)

    def _close(self, reset=False):
        ends, self._ends = self._ends, None
        for end in ends or ():
            try:
                if reset:
                    end.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                end.close()
            except OSError:
                pass

    def _serve(self):
        while self._running:
            try:
                if not select.select([self._listener], [], [], 0.2)[0]:
                    continue
                driver, _ = self._listener.accept()
                if self._kind == "refuse":
                    driver.close()
                    continue
                vehicle = socket.create_connection((LISTEN, self.vehicle_port), 1.0)
            except (OSError, ValueError):
                continue
            self._rest = b""
            self._ends = (driver, vehicle)
            self._forward(driver, vehicle)
            self._close()

    def _forward(self, driver, vehicle):
        while self._running and self._ends:
            try:
                ready = select.select([driver, vehicle], [], [], 0.2)[0]
                if self._kind in ("stall", "half-open"):
                    self._running and threading.Event().wait(0.05)
                    continue
                for end in ready:
                    data = end.recv(65536)
                    if not data:
                        return
                    if end is driver:
                        vehicle.sendall(data)
                    else:
                        self._to_driver(driver, data)
            except (OSError, ValueError):
                return

    def _to_driver(self, driver, data):
        kind = self._kind
        if kind == "corrupt":
            data = bytes(byte ^ 0x11 if self._random.random() < 0.01 else byte for byte in data)
        if kind == "garbage":
            data = bytes(self._random.randrange(256) for _ in range(300)) + data
        pieces = [data]
        if kind == "split":
            pieces = [data[i:i + 1] for i in range(len(data))]
        if kind == "slow":
            threading.Event().wait(0.1)
        for piece in pieces:
            driver.sendall(piece)
        *lines, self._rest = (self._rest + data).split(b"\n")
        now = time.monotonic()
        self.forwarded += [(now, line.rstrip(b"\r")) for line in lines]
