#!/usr/bin/env python3
"""What a new user tries with the vendor's SDK, tried with blueye_simulator: `make sdk-test`."""

import logging
import os
import tempfile
import time
import unittest
import warnings

import blueye.protocol as bp
import rosgraph
import rospy
from blueye.sdk import Drone
from blueye.sdk.constants import WaterDensities
from blueye.sdk.mission import (create_waypoint_instruction, export_to_json, import_from_json,
                                prepare_new_mission)

from beside_driver import BesideTheDriver  # noqa: F401
from sdk_under_test import (Heard, Simulator, Stream, drives_on, estimate, mission_state, reached,
                            round_trips, telemetry_names, tries, wait)

# Comes on events that are no part of these steps, or never from a drone without them.
ON_EVENTS = {"AnnotationTel", "IperfTel", "LogEntryTel", "MultibeamPingTel", "NotificationTel",
             "PilotGPSPositionTel", "ReferenceAutoPilotTel", "TimeLapseStateTel"}


@tries
class Steps(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")  # some versions of the SDK deprecate some names
        self.simulator = Simulator()
        self.addCleanup(self.simulator.stop)

    def drone(self, **how):
        drone = Drone(**how)
        self.addCleanup(lambda: drone.connected and drone.disconnect())
        return drone

    def test_connects_and_reads(self):
        drone = self.drone()
        self.assertTrue(drone.in_control)
        self.assertEqual("4.4.2", drone.software_version_short)
        self.assertIn("tilt", drone.features)
        self.assertEqual("SIM000001", drone.serial_number)
        self.assertAlmostEqual(0.0, drone.depth, delta=0.1)
        for angle in drone.pose.values():
            self.assertTrue(0.0 <= angle < 360.0, drone.pose)
        self.assertAlmostEqual(20.0, drone.altitude, delta=0.2)
        self.assertAlmostEqual(1.0, drone.battery.state_of_charge, delta=0.01)
        self.assertAlmostEqual(9.0, drone.water_temperature, delta=0.5)
        self.assertEqual((0.0, 0), (drone.lights, drone.dive_time))
        self.assertEqual({"main": 0, "guestport": 0}, drone.active_video_streams)
        self.assertGreater(len(drone.error_flags), 40)
        self.assertFalse([name for name, raised in drone.error_flags.items() if raised is True])
        self.assertEqual((0, 0), (len(drone.logs), len(drone.legacy_logs)))
        self.assertFalse(drone.camera.is_recording)
        self.assertEqual(-1, drone.camera.record_time)
        for name in telemetry_names():
            if hasattr(bp, name) and name not in ON_EVENTS:
                self.assertIsNotNone(drone.telemetry.get(getattr(bp, name)), name)

    def test_answers_within_the_limits(self):
        drone = self.drone()
        median, longest = round_trips(drone, 500)
        print("500 pings: median %.2f ms, longest %.2f ms" % (median * 1e3, longest * 1e3))
        self.assertLess(median, 0.05)

    def test_sets_rates(self):
        drone = self.drone()
        for kind, hz in ((bp.CalibratedImuTel, 100), (bp.DepthTel, 50), (bp.AttitudeTel, 5)):
            stream = Stream(drone, kind)
            drone.telemetry.set_msg_publish_frequency(kind, hz)
            found = wait(lambda hz=hz, stream=stream: stream.settles_at(hz), "that rate")
            print("%s asked for at %d Hz comes at %.1f Hz" % (kind.__name__, hz, found))
        for hz in (-1, 101):
            self.assertRaises(RuntimeError, drone.telemetry.set_msg_publish_frequency,
                              bp.DepthTel, hz)

    def test_drives(self):
        drone = self.drone()
        motion = drone.motion
        motion.heave = 1.0
        wait(lambda: drone.depth > 2.0, "two metres")
        motion.heave = 0.0
        motion.auto_depth_active = motion.auto_heading_active = True
        wait(lambda: motion.auto_depth_active and motion.auto_heading_active, "both controllers")
        start = estimate(drone)
        motion.surge = 0.5
        wait(lambda: estimate(drone).northing > start.northing + 1.0, "a metre north")
        self.assertGreater(estimate(drone).surge_rate, 0.2)
        motion.surge = 0.0
        motion.sway = 0.5
        wait(lambda: estimate(drone).easting > start.easting + 0.5, "half a metre to the right")
        self.assertGreater(estimate(drone).sway_rate, 0.1)
        motion.sway = 0.0
        motion.yaw = 0.5
        wait(lambda: 30.0 < drone.pose["yaw"] < 180.0, "a turn to the right")
        motion.yaw = 0.0
        held = drone.depth
        wait(lambda: abs(estimate(drone).yaw_rate) < 0.01, "the new heading")
        self.assertAlmostEqual(held, drone.depth, delta=0.5)
        motion.boost, motion.slow = 0.5, 0.5
        motion.auto_depth_active = motion.auto_heading_active = False
        wait(lambda: not (motion.auto_depth_active or motion.auto_heading_active), "neither")
        for mode in ("auto_altitude_active", "station_keeping_active", "weather_vaning_active"):
            if not hasattr(motion, mode):
                continue  # older than this mode
            for on in (True, False):
                setattr(motion, mode, on)
                wait(lambda on=on, mode=mode: getattr(motion, mode) is on, "%s: %s" % (mode, on))

    def test_sets_lights_cameras_and_guest_ports(self):
        drone = self.drone()
        drone.config.water_density = WaterDensities.fresh
        drone.lights = 0.5
        wait(lambda: drone.lights == 0.5, "the lights")
        drone.camera.tilt.set_velocity(0.5)
        wait(lambda: drone.camera.tilt.angle > 5.0, "the camera to look up")
        drone.camera.tilt.set_velocity(0)
        drone.camera.tilt.stabilization_enabled = True
        wait(lambda: drone.camera.tilt.stabilization_enabled, "a steady camera")
        wait(lambda: drone.peripherals, "the guest ports")
        drone.camera.is_recording = True
        wait(lambda: drone.camera.is_recording and drone.camera.record_time >= 1, "film")
        drone.external_camera.is_recording = True
        wait(lambda: drone.external_camera.is_recording, "the other camera")
        self.assertTrue(drone.camera.is_recording)
        drone.camera.is_recording = False
        wait(lambda: not drone.camera.is_recording, "the end of the film")
        self.assertTrue(drone.external_camera.is_recording)
        drone.camera.take_picture()
        self.keeps(drone.camera, bitrate=8000000, exposure=5, whitebalance=3000, hue=10,
                   resolution=720, framerate=25)
        self.keeps(drone.external_camera, resolution=1080, framerate=30)
        self.assertEqual((720, 25), (drone.camera.resolution, drone.camera.framerate))
        self.keeps(drone.camera.overlay, depth_enabled=True, title="dive 7", timezone_offset=60,
                   logo=bp.LogoType.LOGO_TYPE_CUSTOM, margin_width=7)
        drone.external_light.set_intensity(0.25)
        wait(lambda: drone.external_light.get_intensity() == 0.25, "the light on the guest port")
        drone.laser.set_intensity(1.0)
        wait(lambda: drone.laser.get_intensity() == 1.0, "the laser")
        drone.gripper.grip_velocity = 0.5
        drone.gripper.rotation_velocity = -0.5

    def keeps(self, what, **values):
        for name, value in values.items():
            setattr(what, name, value)
            self.assertEqual(value, getattr(what, name), name)

    def test_runs_missions_and_hears_of_them(self):
        heard = Heard()
        logging.getLogger("blueye.sdk").addHandler(heard)
        logging.getLogger("blueye.sdk").setLevel(logging.DEBUG)
        self.addCleanup(logging.getLogger("blueye.sdk").removeHandler, heard)
        drone = self.drone(log_notifications=True)
        self.assertEqual(bp.MissionState.MISSION_STATE_INACTIVE, mission_state(drone))
        self.assertFalse(drone.mission.get_active().instructions)
        here = estimate(drone).global_position
        mission = prepare_new_mission([
            create_waypoint_instruction("ahead", here.latitude + 3.0 / 111e3, here.longitude, 2.0),
            bp.Instruction(camera_command={
                "camera_action": bp.CameraAction.CAMERA_ACTION_TAKE_PHOTO}),
            bp.Instruction(go_to_surface_command={"desired_speed": 0.4})], 7, "look ahead")
        with tempfile.TemporaryDirectory() as folder:
            export_to_json(mission, os.path.join(folder, "mission.json"))
            self.assertEqual(mission, import_from_json(os.path.join(folder, "mission.json")))
        drone.mission.load_and_run(mission)
        reached(drone, "RUNNING")
        self.assertEqual("look ahead", drone.mission.get_active().name)
        self.assertEqual(3, drone.mission.get_status().total_number_of_instructions)
        drone.mission.pause()
        reached(drone, "PAUSED")
        drone.mission.run()
        reached(drone, "COMPLETED")
        self.assertAlmostEqual(3.0, estimate(drone).northing, delta=1.5)
        self.assertEqual(["MISSION_LOADED", "MISSION_STARTED"], heard.names()[:2])
        for name in ("MISSION_PAUSED", "MISSION_RESUMED", "WAYPOINT_REACHED", "CAMERA_ACTION",
                     "GO_TO_SURFACE", "MISSION_COMPLETE"):
            self.assertEqual(1, heard.names().count(name), name)
        self.assertEqual(3, heard.names().count("INSTRUCTION_COMPLETE"))
        drone.mission.load_and_run(mission)
        reached(drone, "RUNNING")
        drone.mission.clear()
        reached(drone, "INACTIVE")
        self.assertRaises(RuntimeError, drone.mission.load_and_run, prepare_new_mission([]))
        wait(lambda: "FAILED_TO_LOAD_MISSION" in heard.names(), "the reason")

    def test_hands_control_over(self):
        first = self.drone()
        observer = self.drone(connect_as_observer=True)
        second = self.drone()
        self.assertEqual((True, False, False),
                         (first.in_control, observer.in_control, second.in_control))
        wait(lambda: len(first.connected_clients) == 3, "all to be known")
        second.take_control()
        for drone in (first, observer, second):
            wait(lambda drone=drone: drone.client_in_control == second.client_id, "word of it")
        third = self.drone(disconnect_other_clients=True)
        self.assertTrue(third.in_control)
        third.disconnect()
        wait(lambda: observer.client_in_control == 0, "nobody: observers are not promoted")
        self.assertRaises(ConnectionError, lambda: third.depth)
        third.connect()
        self.assertTrue(third.in_control)

    def test_a_program_that_dies_loses_control_and_its_drone_stops(self):
        dying = drives_on()
        self.addCleanup(dying.stdout.close)
        second = self.drone()
        self.assertFalse(second.in_control)
        wait(lambda: estimate(second).surge_rate > 0.5, "way ahead")
        dying.kill()
        dying.wait()
        died = time.monotonic()
        wait(lambda: second.client_in_control == second.client_id, "control")
        print("control passed on after %.1f s" % (time.monotonic() - died))
        wait(lambda: estimate(second).surge_rate < 0.1, "standstill")

    def test_a_drone_that_starts_anew_is_connected_to_anew(self):
        drone = self.drone()
        in_control = []
        drone.telemetry.add_msg_callback([bp.ConnectedClientsTel], lambda _, message:
                                         in_control.append(message.client_id_in_control))
        wait(lambda: in_control and in_control[-1] == drone.client_id, "telemetry")
        self.simulator.stop()
        self.simulator = Simulator()
        self.addCleanup(self.simulator.stop)
        # Sooner, the request to disconnect client 1 may come after a new client 1 has connected.
        wait(lambda: in_control[-1] == 0, "word of the drone that started")
        drone.ping()
        drone.disconnect()
        drone.connect()
        self.assertTrue(drone.in_control)
        drone.motion.heave = 1.0
        wait(lambda: drone.depth > 1.0, "a metre")


if __name__ == "__main__":
    wait(rosgraph.is_master_online, "the ROS master")
    rospy.init_node("sdk_test", disable_signals=True)
    unittest.main(verbosity=2)
