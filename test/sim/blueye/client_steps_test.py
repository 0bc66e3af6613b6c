#!/usr/bin/env python3
"""What the vendor's client library does with a drone, step by step, done to blueye_simulator.

The order, names, sockets and time limits are those that protocol/blueye describes for that library:
drone_info over HTTP, a subscription to everything, two publishers (control and watchdog), one
request at a time, and a watchdog that begins before the client knows its number.
"""

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import unittest
import urllib.request

import rosunit
import zmq

OPTIONS = dict(argument[2:].split("=", 1) for argument in sys.argv
               if argument.startswith("--") and "=" in argument)
sys.path.insert(0, OPTIONS.get("messages", "."))
from blueye import control_pb2, message_formats_pb2, mission_planning_pb2  # noqa: E402
from blueye import req_rep_pb2, telemetry_pb2  # noqa: E402

SPEED = 4         # seconds of the drone per second
PATIENCE_S = 60   # of a busy computer
REPLY_S = 0.05    # the library's time limit for most requests


def wait_for(condition, what, timeout_s=PATIENCE_S):
    """Returns what `condition` returned once it was true."""
    end = time.monotonic() + timeout_s
    tick = threading.Event()
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > end:
            raise AssertionError("waited %.0f s for %s" % (timeout_s, what))
        tick.wait(0.01)


class Simulator:
    def __init__(self, *arguments):
        self.process = subprocess.Popen(
            [OPTIONS["simulator"], "--no-ros", "--telemetry_port=0", "--request_port=0",
             "--control_port=0", "--http_port=0", "--speed=%d" % SPEED] + list(arguments),
            stdout=subprocess.PIPE, universal_newlines=True)
        line = self.process.stdout.readline()
        self.telemetry, self.request, self.control, self.http = [
            int(re.search(name + r" (\d+)", line).group(1))
            for name in ("telemetry", "requests", "control", "http")]

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        return code


class Client:
    """One program with the library in it."""

    def __init__(self, simulator, observer=False, watchdog=True):
        self.context = zmq.Context()
        self.drone_info = self.ask_http(simulator)
        self.state, self.notifications, self.counts = {}, [], {}
        self.client_id = 0
        self.running = True
        self.control_lock = threading.Lock()
        self.subscriber = self.open(zmq.SUB, simulator.telemetry)
        self.subscriber.setsockopt(zmq.SUBSCRIBE, b"")
        self.publisher = self.open(zmq.PUB, simulator.control)
        self.requester = self.open(zmq.REQ, simulator.request)
        self.threads = [threading.Thread(target=self.listen)]
        if watchdog:
            self.threads.append(threading.Thread(target=self.watch, args=(simulator,)))
        for thread in self.threads:
            thread.daemon = True
            thread.start()
        self.ask(req_rep_pb2.PingReq())
        info = message_formats_pb2.ClientInfo(type="SDK", version="2.7.0", name="test",
                                              is_observer=observer)
        answer = self.ask(req_rep_pb2.ConnectClientReq(client_info=info))
        self.client_id = answer.client_id
        self.connected = answer

    def open(self, kind, port):
        socket = self.context.socket(kind)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.RCVTIMEO, PATIENCE_S * 1000)
        socket.connect("tcp://127.0.0.1:%d" % port)
        return socket

    @staticmethod
    def ask_http(simulator):
        url = "http://127.0.0.1:%d/diagnostics/drone_info" % simulator.http
        with urllib.request.urlopen(url, timeout=PATIENCE_S) as answer:
            return json.loads(answer.read().decode())

    def listen(self):
        poller = zmq.Poller()
        poller.register(self.subscriber, zmq.POLLIN)
        while self.running:
            if not poller.poll(10):
                continue
            name, data = self.subscriber.recv_multipart()
            name = name.decode()
            self.state[name] = data
            self.counts[name] = self.counts.get(name, 0) + 1
            if name.endswith(".NotificationTel"):
                self.notifications.append(
                    telemetry_pb2.NotificationTel.FromString(data).notification)

    def watch(self, simulator):
        """A publisher of its own, once a second of the drone, from before the number is known."""
        socket = self.open(zmq.PUB, simulator.control)
        tick, seconds = threading.Event(), 0
        while self.running:
            message = control_pb2.WatchdogCtrl(client_id=self.client_id)
            message.connection_duration.value = seconds
            socket.send_multipart([message.DESCRIPTOR.full_name.encode(),
                                   message.SerializeToString()])
            seconds += 1
            tick.wait(1.0 / SPEED)
        socket.close()

    def ask(self, request):
        name = request.DESCRIPTOR.full_name
        self.requester.send_multipart([name.encode(), request.SerializeToString()])
        reply, data = self.requester.recv_multipart()
        assert reply.decode() == name[:-3] + "Rep", reply
        return getattr(req_rep_pb2, name.rpartition(".")[2][:-3] + "Rep").FromString(data)

    def tell(self, message):
        self.publisher.send_multipart([message.DESCRIPTOR.full_name.encode(),
                                       message.SerializeToString()])

    def get(self, kind):
        """The newest one heard, or asked for; None if there is none yet."""
        name = kind.DESCRIPTOR.full_name
        data = self.state.get(name)
        if data is None:
            short = name.rpartition(".")[2]
            data = self.ask(req_rep_pb2.GetTelemetryReq(message_type=short)).payload.value or None
        return None if data is None else kind.FromString(data)

    def mission_state(self):
        return self.get(telemetry_pb2.MissionStatusTel).mission_status.state

    def move(self, **axes):
        self.tell(control_pb2.MotionInputCtrl(
            motion_input=message_formats_pb2.MotionInput(**axes)))

    def leave(self):
        if self.running:
            self.running = False
            for thread in self.threads:
                thread.join(PATIENCE_S)
            self.context.destroy(0)


class ClientSteps(unittest.TestCase):
    def setUp(self):
        self.simulator = Simulator()
        self.addCleanup(self.simulator.stop)

    def client(self, **how):
        client = Client(self.simulator, **how)
        self.addCleanup(client.leave)
        return client

    def test_connects_as_a_new_user_does(self):
        client = self.client()
        short = client.drone_info["sw_version"].split("-")[0]
        self.assertGreaterEqual(tuple(map(int, short.split("."))), (4, 0, 5))
        for key in ("serial_number", "hardware_id"):
            self.assertTrue(client.drone_info[key])
        self.assertIn("tilt", client.drone_info["features"].split(","))
        self.assertEqual(client.connected.client_id_in_control, client.client_id)
        ports = client.get(telemetry_pb2.DroneInfoTel).drone_info.gp
        self.assertTrue(ports.gp1.device_list.devices)
        now = req_rep_pb2.SyncTimeReq()
        now.time.unix_timestamp.seconds = 1900000000
        self.assertTrue(client.ask(now).success)
        client.state.clear()
        clock = wait_for(lambda: client.state.get("blueye.protocol.DroneTimeTel"), "the time")
        clock = telemetry_pb2.DroneTimeTel.FromString(clock).real_time_clock.unix_timestamp
        self.assertLess(abs(clock.seconds - 1900000000), 100)
        self.assertEqual(1, len(client.get(telemetry_pb2.ConnectedClientsTel).connected_clients))

    def test_is_answered_in_time(self):
        client = self.client()
        took = []
        for _ in range(100):
            began = time.monotonic()
            client.ask(req_rep_pb2.PingReq())
            client.ask(req_rep_pb2.GetMissionReq())
            took.append((time.monotonic() - began) / 2.0)
        self.assertLess(sorted(took)[len(took) // 2], REPLY_S)

    def test_sets_rates(self):
        client = self.client()
        imu = "blueye.protocol.CalibratedImuTel"
        wait_for(lambda: client.counts.get("blueye.protocol.AttitudeTel", 0) > 10, "telemetry")
        self.assertNotIn(imu, client.counts)
        set_rate = req_rep_pb2.SetPubFrequencyReq(message_type="CalibratedImuTel", frequency=50)
        self.assertTrue(client.ask(set_rate).success)
        wait_for(lambda: client.counts.get(imu, 0) > 50, imu)
        self.assertFalse(client.ask(req_rep_pb2.SetPubFrequencyReq(
            message_type="CalibratedImuTel", frequency=101)).success)
        self.assertFalse(client.ask(req_rep_pb2.SetPubFrequencyReq(
            message_type="NoSuchTel", frequency=1)).success)

    def test_drives(self):
        client = self.client()
        depth = lambda: client.get(telemetry_pb2.DepthTel).depth.value
        wait_for(lambda: client.get(telemetry_pb2.DepthTel), "the depth")
        wait_for(lambda: client.move(heave=1.0) or depth() > 2.0, "two metres")
        client.move()
        client.tell(control_pb2.AutoDepthCtrl(
            state=message_formats_pb2.AutoDepthState(enabled=True)))
        wait_for(lambda: client.get(telemetry_pb2.ControlModeTel).state.auto_depth, "auto depth")
        client.move(surge=0.5)
        estimate = lambda: client.get(telemetry_pb2.PositionEstimateTel).position_estimate
        wait_for(lambda: estimate().surge_rate > 0.3, "way ahead")
        client.move(yaw=1.0)
        before = estimate().heading
        wait_for(lambda: estimate().heading > before + 0.5, "a turn to the right")
        client.move()
        client.tell(control_pb2.LightsCtrl(lights=message_formats_pb2.Lights(value=0.5)))
        wait_for(lambda: abs(client.get(telemetry_pb2.LightsTel).lights.value - 0.5) < 1e-6,
                 "the lights")

    def test_runs_a_mission_and_sees_what_is_said_about_it(self):
        client = self.client()
        states = mission_planning_pb2
        self.assertEqual(states.MISSION_STATE_INACTIVE, client.mission_state())
        mission = states.Mission(id=3, name="down, look, up")
        # As the library makes them: auto_continue is never set.
        mission.instructions.add(id=0).depth_set_point_command.depth_set_point.depth = 2.0
        mission.instructions[0].depth_set_point_command.depth_set_point.depth_zero_reference = \
            states.DEPTH_ZERO_REFERENCE_SURFACE
        mission.instructions.add(id=1).camera_command.camera_action = \
            states.CAMERA_ACTION_TAKE_PHOTO
        mission.instructions.add(id=2).go_to_surface_command.desired_speed = 0.4
        client.ask(req_rep_pb2.SetMissionReq(mission=mission))
        wait_for(lambda: client.mission_state() == states.MISSION_STATE_READY, "the mission")
        self.assertEqual("down, look, up", client.ask(req_rep_pb2.GetMissionReq()).mission.name)
        client.tell(control_pb2.RunMissionCtrl())
        wait_for(lambda: client.mission_state() == states.MISSION_STATE_RUNNING, "its start")
        wait_for(lambda: client.mission_state() == states.MISSION_STATE_COMPLETED, "its end")
        said = [notification.type for notification in client.notifications]
        for kind in ("MISSION_LOADED", "MISSION_STARTED", "GO_TO_DEPTH_SET_POINT",
                     "DEPTH_TARGET_REACHED", "CAMERA_ACTION", "GO_TO_SURFACE",
                     "INSTRUCTION_COMPLETE", "MISSION_COMPLETE"):
            self.assertIn(getattr(message_formats_pb2, "NOTIFICATION_TYPE_" + kind), said)
        # The library takes two of the same microsecond for one.
        times = [(n.timestamp.seconds, n.timestamp.nanos // 1000) for n in client.notifications]
        self.assertEqual(len(times), len(set(times)))
        self.assertEqual(sorted(times), times)
        client.tell(control_pb2.ClearMissionCtrl())
        wait_for(lambda: client.mission_state() == states.MISSION_STATE_INACTIVE, "no mission")

    def test_hands_control_over(self):
        first = self.client()
        observer = self.client(observer=True)
        self.assertEqual(first.client_id, observer.connected.client_id_in_control)
        second = self.client()
        in_control = second.connected.client_id_in_control
        self.assertEqual(first.client_id, in_control)
        while in_control != second.client_id:  # as the library takes control
            in_control = second.ask(
                req_rep_pb2.DisconnectClientReq(client_id=in_control)).client_id_in_control
        wait_for(lambda: first.get(telemetry_pb2.ConnectedClientsTel).client_id_in_control
                 == second.client_id, "the others to hear of it")
        second.ask(req_rep_pb2.DisconnectClientReq(client_id=second.client_id))
        wait_for(lambda: observer.get(telemetry_pb2.ConnectedClientsTel).client_id_in_control == 0,
                 "nobody in control: observers are never promoted")

    def test_loses_control_with_its_watchdog(self):
        first = self.client()
        second = self.client()
        wait_for(lambda: first.move(surge=1.0) or first.get(
            telemetry_pb2.PositionEstimateTel).position_estimate.surge_rate > 0.3, "way ahead")
        first.leave()
        wait_for(lambda: second.get(telemetry_pb2.ConnectedClientsTel).client_id_in_control
                 == second.client_id, "control")
        wait_for(lambda: second.get(
            telemetry_pb2.PositionEstimateTel).position_estimate.surge_rate < 0.1, "standstill")


if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "blueye_client_steps", ClientSteps)
