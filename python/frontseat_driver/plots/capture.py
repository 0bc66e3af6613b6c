"""A mission from sentences: a text capture, or whatever else nmea_decode reads. It decodes; here its
lines of JSON are put into columns."""

import json
import math
import os
import shutil
import subprocess
import tempfile

import numpy as np

from frontseat_driver.plots.columns import Columns
from frontseat_driver.plots.errors import Unreadable
from frontseat_driver.plots.mission import Mission, Series

DAY_S = 86400.0
WGS84_A_M, WGS84_E2 = 6378137.0, 6.69437999014e-3
# As the driver drops positions: parameter max_jump, and how many in a row are believed.
MAX_JUMP_M_S, BELIEVED, LEAST_ELAPSED_S = 50.0, 5, 1.0


def decoder():
    """The program, beside this one or in the path."""
    import roslib.packages  # slow to load, and a bag with odom needs none of it
    found = roslib.packages.find_node("frontseat_driver", "nmea_decode")
    path = found[0] if found else shutil.which("nmea_decode")
    if not path:
        raise Unreadable("nmea_decode, which reads sentences, was not found; is the package built?")
    return path


def decoded(path, vehicle=None):
    """Yields what nmea_decode prints, an object for each line of the input."""
    command = [decoder(), "--format", "json", "--quiet", path]
    command += ["--vehicle", vehicle] if vehicle else []
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors)
        for line in process.stdout:
            yield json.loads(line.decode("ascii"))
        if process.wait() != 0:
            errors.seek(0)
            raise Unreadable(errors.read().decode(errors="replace").strip()
                             or "nmea_decode ended with %d" % process.returncode)


class Continued:
    """Times of day on a time that goes on over midnight, both ways."""

    def __init__(self):
        self._last = None

    def __call__(self, time_of_day_s):
        if self._last is None:
            self._last = time_of_day_s
        days = round((self._last - time_of_day_s) / DAY_S)
        self._last = time_of_day_s + days * DAY_S
        return self._last


def number(value):
    return math.nan if value is None else float(value)


def to_earth(latitude_deg, longitude_deg):
    """WGS84 ellipsoid to earth-centred coordinates, at height 0."""
    lat, lon = np.radians(latitude_deg), np.radians(longitude_deg)
    n = WGS84_A_M / np.sqrt(1.0 - WGS84_E2 * np.sin(lat) ** 2)
    return np.array([n * np.cos(lat) * np.cos(lon), n * np.cos(lat) * np.sin(lon),
                     n * (1.0 - WGS84_E2) * np.sin(lat)])


def to_plane(latitude_deg, longitude_deg):
    """Metres east and north of the first position, on the plane that touches the ellipsoid there."""
    lat, lon = math.radians(latitude_deg[0]), math.radians(longitude_deg[0])
    earth = to_earth(latitude_deg, longitude_deg)
    away = earth - earth[:, :1]
    east = -math.sin(lon) * away[0] + math.cos(lon) * away[1]
    north = (-math.sin(lat) * math.cos(lon) * away[0] - math.sin(lat) * math.sin(lon) * away[1]
             + math.cos(lat) * away[2])
    return east, north


def without_jumps(t, x, y):
    """Which positions a vehicle can have reached; of a few in a row that agree, the later ones."""
    keep = np.zeros(len(t), dtype=bool)
    last, in_a_row = None, 0
    for i in range(len(t)):
        if last is not None:
            elapsed_s = max(t[i] - t[last], LEAST_ELAPSED_S)
            moved_m = math.hypot(x[i] - x[last], y[i] - y[last])
            in_a_row = in_a_row + 1 if moved_m > MAX_JUMP_M_S * elapsed_s else 0
            if 0 < in_a_row < BELIEVED:
                continue
        keep[i], last, in_a_row = True, i, 0
    return keep


class Reader:
    """Puts decoded lines into columns."""

    def __init__(self):
        self.navigation = Columns()  # latitude, longitude, depth, altitude, heading, roll, pitch
        self.speed = Columns()
        self.batteries = {}
        self.arrivals, self.bad_checksums, self.malformed = Columns(), Columns(), Columns()
        self.relative_time = False
        self.grid_heading = False
        self._continued = Continued()
        self._now = None
        self._takers = {"NVG": self.take_navigation, "NVR": self.take_velocity,
                        "RBS": self.take_battery}

    def take(self, line):
        if line["direction"] != "rx":
            return
        fields = line.get("fields", {})
        at = self.time_of(line, fields)
        if at is None:
            return  # before the first time that is told
        self.arrivals.add(at)
        if "fault" in line:
            wrong_sum = line["fault"]["reason"].startswith("wrong checksum")
            (self.bad_checksums if wrong_sum else self.malformed).add(at, 1)
        taker = self._takers.get(line["sentence"][2:])
        if taker and fields:
            taker(at, line["sentence"], fields)

    def time_of(self, line, fields):
        if "time_s" in line:
            self._now = line["time_s"]
        elif fields.get("sent_at_s") is not None:
            self.relative_time = True
            self._now = self._continued(fields["sent_at_s"])
        return self._now

    def take_navigation(self, at, sentence, fields):
        self.grid_heading = self.grid_heading or sentence.startswith("BF")
        latitude, longitude = fields["latitude_deg"], fields["longitude_deg"]
        if latitude is None or longitude is None or (latitude == 0.0 and longitude == 0.0):
            latitude = longitude = None
        altitude = fields["altitude_m"] or None  # 0: no bottom
        self.navigation.add(at, *map(number, (
            latitude, longitude, fields["depth_m"], altitude, fields["heading_deg"],
            fields["roll_deg"], fields["pitch_deg"])))

    def take_velocity(self, at, _, fields):
        self.speed.add(at, math.hypot(number(fields["east_m_s"]), number(fields["north_m_s"])))

    def take_battery(self, at, _, fields):
        number_of = fields.get("battery_id")
        name = "battery" if number_of is None else "battery %d" % number_of
        self.batteries.setdefault(name, Columns()).add(at, number(fields["stack_v"]))

    def mission(self, title):
        mission = Mission(title)
        mission.relative_time = self.relative_time
        mission.heading_note = "grid" if self.grid_heading else "true"
        mission.faults_known = True
        table = self.navigation.series()
        if len(table):
            latitude, longitude, depth, altitude, heading, roll, pitch = table.values
            mission.position = track(table.t, latitude, longitude)
            mission.depth_m, mission.altitude_m = Series(table.t, depth), Series(table.t, altitude)
            mission.heading_deg = Series(table.t, heading)
            mission.roll_deg, mission.pitch_deg = Series(table.t, roll), Series(table.t, pitch)
        mission.speed_m_s = self.speed.series()
        mission.battery_v = {name: column.series() for name, column in self.batteries.items()}
        mission.hear(self.arrivals.series().t)
        mission.bad_checksums = self.bad_checksums.series()
        mission.malformed = self.malformed.series()
        return mission


def track(t, latitude, longitude):
    known = np.isfinite(latitude) & np.isfinite(longitude)
    if not np.any(known):
        return Series()
    east, north = to_plane(latitude[known], longitude[known])
    keep = without_jumps(t[known], east, north)
    return Series(t[known][keep], east[keep], north[keep])


def read(path, vehicle=None, title=None):
    reader = Reader()
    for line in decoded(path, vehicle):
        reader.take(line)
    return reader.mission(title or os.path.basename(path))
