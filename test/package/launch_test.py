#!/usr/bin/env python3
"""Every launch file loads, starts programs that exist, and explains its arguments."""

import os
import unittest
import xml.etree.ElementTree as xml

import roslaunch.config
import roslaunch.node_args
import roslaunch.rlutil
import yaml

import package_under_test as package

# Seen from a machine without a display: not every program is installed everywhere.
OPTIONAL = {("rviz", "rviz")}

# File, arguments, and the nodes that must come of it.
LAUNCHES = (
    ("driver.launch", [], {"/frontseat", "/model"}),
    ("driver.launch", ["vehicle:=kingfisher", "namespace:=boat"],
     {"/boat/frontseat", "/boat/model"}),
    ("driver.launch", ["manager:=/fleet", "model:=false", "dialect:=auto"], {"/frontseat"}),
    ("driver.launch", ["vehicle:=blueye", "namespace:=rov", "model:=false"], {"/rov/frontseat"}),
    ("driver.launch", ["vehicle:=blueye", "manager:=/fleet", "model:=false"], {"/frontseat"}),
    ("simulator.launch", [], {"/simulator"}),
    ("simulator.launch", ["vehicle:=kingfisher", "port:=29501"], {"/simulator"}),
    ("simulator.launch", ["vehicle:=blueye", "telemetry_port:=6555"], {"/simulator"}),
    ("demo.launch", [], {"/simulator", "/frontseat", "/model", "/rviz"}),
    ("demo.launch", ["vehicle:=kingfisher", "rviz:=false"],
     {"/simulator", "/frontseat", "/model"}),
    ("demo.launch", ["example:=square", "rviz:=false"],
     {"/simulator", "/frontseat", "/model", "/square"}),
    ("demo.launch", ["example:=square_cpp", "rviz:=false"],
     {"/simulator", "/frontseat", "/model", "/square"}),
    ("demo.launch", ["example:=survey", "rviz:=false"],
     {"/simulator", "/frontseat", "/model", "/survey"}),
    ("diagnostics.launch", [], {"/diagnostic_aggregator"}),
    ("demo.launch", ["vehicle:=blueye", "rviz:=false"], {"/simulator", "/frontseat", "/model"}),
    ("demo.launch", ["example:=dive", "rviz:=false"],
     {"/simulator", "/frontseat", "/model", "/dive"}),
    ("demo.launch", ["vehicle:=blueye", "example:=square", "rviz:=false"],
     {"/simulator", "/frontseat", "/model", "/square"}),
    ("fleet.launch", [], {"/fleet", "/shark/simulator", "/fisher/simulator",
                          "/shark/frontseat", "/fisher/frontseat"}),
    ("fleet.launch", ["simulate:=false"], {"/fleet", "/shark/frontseat", "/fisher/frontseat"}),
    ("replay.launch", ["bag:=dive.bag"], {"/play", "/frontseat", "/model"}),
    ("replay.launch", ["bag:=dive.bag", "rate:=unlimited"], {"/play", "/frontseat", "/model"}),
    ("replay.launch", ["capture:=dive.nmea", "rate:=10"], {"/play", "/frontseat", "/model"}),
)


def load(name, arguments):
    path = os.path.join(package.ROOT, "launch", name)
    return roslaunch.config.load_config_default([(path, arguments)], None, verbose=False,
                                                assign_machines=False)


def parameters(config, node):
    """The private parameters of a node, as it will find them."""
    prefix = node + "/"
    return {key[len(prefix):]: param.value for key, param in config.params.items()
            if key.startswith(prefix)}


class Launch(unittest.TestCase):
    def test_every_file_has_a_row(self):
        rows = {"launch/" + row[0] for row in LAUNCHES}
        self.assertEqual(set(package.files("launch", ".launch")), rows)

    def test_every_argument_has_a_doc(self):
        for path in package.files("launch", ".launch"):
            for arg in xml.parse(os.path.join(package.ROOT, path)).getroot().findall("arg"):
                self.assertTrue(arg.get("doc"), "%s: %s" % (path, arg.get("name")))

    def test_every_program_exists(self):
        for name, arguments, _ in LAUNCHES:
            for node in load(name, arguments).nodes:
                if (node.package, node.type) not in OPTIONAL:
                    self.assertTrue(roslaunch.node_args.create_local_process_args(node, None))

    def test_the_config_file_of_the_vehicle_is_taken(self):
        kingfisher = parameters(load("driver.launch", ["vehicle:=kingfisher"]), "/frontseat")
        self.assertEqual("kingfisher", kingfisher["dialect"])
        self.assertEqual(18, kingfisher["leap_seconds"])
        sandshark = parameters(load("driver.launch", []), "/frontseat")
        self.assertEqual("sandshark", sandshark["dialect"])
        self.assertEqual("grid", sandshark["heading_reference"])

    def test_a_vehicle_that_is_not_known_gets_the_defaults_of_its_dialect(self):
        unknown = parameters(load("driver.launch", ["dialect:=auto"]), "/frontseat")
        self.assertEqual("auto", unknown["dialect"])
        for name in ("heading_reference", "leap_seconds", "send_spacing"):
            self.assertNotIn(name, unknown)

    def test_a_blueye_gets_its_own_node_and_parameters(self):
        config = load("driver.launch", ["vehicle:=blueye", "model:=false"])
        self.assertEqual(["blueye_node"], [node.type for node in config.nodes])
        given = parameters(config, "/frontseat")
        self.assertEqual(("192.168.1.101", 5555, True),
                         tuple(given[name] for name in ("host", "telemetry_port", "observer")))
        self.assertNotIn("dialect", given)
        nodelet = load("driver.launch", ["vehicle:=blueye", "manager:=/fleet", "model:=false"])
        self.assertIn("frontseat_driver/BlueyeNodelet", nodelet.nodes[0].args)

    def test_an_example_chooses_its_vehicle(self):
        for example, vehicle in (("square", "kingfisher"), ("survey", "sandshark")):
            config = load("demo.launch", ["example:=" + example, "rviz:=false"])
            for node in ("/simulator", "/frontseat"):
                self.assertEqual(vehicle, parameters(config, node)["dialect"])

    def test_a_simulator_takes_its_parameters_from_a_file(self):
        for vehicle in ("sandshark", "kingfisher"):
            name = "simulator_%s_field.yaml" % vehicle
            config = load("simulator.launch", ["vehicle:=" + vehicle, "port:=29501", "config:=" +
                                               os.path.join(package.ROOT, "config", name)])
            given = parameters(config, "/simulator")
            wanted = yaml.safe_load(package.read("config", name))
            self.assertTrue(wanted["quirks"])
            self.assertEqual(dict(given, port=29501), given)
            self.assertEqual(dict(given, **wanted), given)

    def test_arguments_reach_the_driver(self):
        given = parameters(load("driver.launch", ["host:=10.0.0.5", "port:=29600",
                                                  "odom_frame:=a/odom", "base_frame:=a/base",
                                                  "namespace:=a"]), "/a/frontseat")
        self.assertEqual(("10.0.0.5", 29600, "a/odom", "a/base"),
                         tuple(given[name] for name in
                               ("host", "port", "odom_frame", "base_frame")))

    def test_replay_takes_sentences_from_a_topic(self):
        config = load("replay.launch", ["bag:=dive.bag"])
        self.assertEqual("topic", parameters(config, "/frontseat")["source"])
        self.assertTrue(config.params["/use_sim_time"].value)

    def test_replay_of_a_bag_drops_nothing(self):
        for rate, option in (("10", "--rate 10"), ("0.5", "--rate 0.5"),
                             ("unlimited", "--immediate")):
            config = load("replay.launch", ["bag:=dive.bag", "rate:=" + rate])
            play = [node for node in config.nodes if node.name == "play"][0]
            self.assertEqual(("rosbag", "play"), (play.package, play.type))
            for wanted in (option, "--queue 0", "--wait-for-subscribers", "--keep-alive", "--clock",
                           "--bags dive.bag"):
                self.assertIn(wanted, " ".join(play.args.split()))

    def test_replay_of_a_capture(self):
        config = load("replay.launch", ["capture:=dive.nmea", "rate:=unlimited",
                                        "start:=2014-11-19"])
        given = parameters(config, "/play")
        self.assertEqual(("dive.nmea", 0.0, "2014-11-19"),
                         (given["capture"], given["rate"], given["start"]))

    def test_models_have_the_sensor_frames(self):
        boat = {"imu_link", "gps_link", "compass_0_link", "compass_1_link", "altimeter_link"}
        drone = {"imu_link", "dvl_link", "altimeter_link", "pinger_link", "camera_tilt_link",
                 "sonar_link"}
        frames = {"kingfisher": boat, "sandshark": boat, "blueye": drone}
        moving = {"camera_tilt": "revolute", "multibeam_tilt": "revolute"}
        self.assertEqual({"urdf/%s.urdf" % name for name in frames},
                         set(package.files("urdf", ".urdf")))
        for name, expected in frames.items():
            model = xml.parse(os.path.join(package.ROOT, "urdf", name + ".urdf")).getroot()
            self.assertEqual(expected | {"base_link"},
                             {link.get("name") for link in model.iter("link")}, name)
            children = {joint.find("child").get("link") for joint in model.iter("joint")}
            self.assertEqual(expected, children, name)
            for joint in model.iter("joint"):
                self.assertEqual((moving.get(joint.get("name"), "fixed"), "base_link"),
                                 (joint.get("type"), joint.find("parent").get("link")), name)

    def test_rviz_shows_topics_that_exist(self):
        displays = yaml.safe_load(package.read("rviz", "demo.rviz"))
        displays = displays["Visualization Manager"]["Displays"]
        topics = {display["Topic"].lstrip("/") for display in displays if "Topic" in display}
        self.assertIn("odom", topics)
        self.assertLessEqual(topics, set(package.topics_in_code()))


def starts(name, arguments, nodes):
    def test(self):
        config = load(name, arguments)
        self.assertEqual([], config.config_errors)
        self.assertEqual(nodes, {roslaunch.core.rosgraph.names.ns_join(node.namespace, node.name)
                                 for node in config.nodes})
    return test


for number, row in enumerate(LAUNCHES):
    title = "test_%d_%s_loads" % (number, row[0].replace(".", "_"))
    setattr(Launch, title, starts(*row))

if __name__ == "__main__":
    package.run(Launch)
