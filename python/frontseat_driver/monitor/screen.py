"""The screen: what is known, as lines. Pure: state, time and size in, lines out."""

import math

from diagnostic_msgs.msg import DiagnosticStatus
from frontseat_driver.msg import CommandAck, ControlStatus, MissionStatus
from sensor_msgs.msg import NavSatStatus

from frontseat_driver.monitor import layout
from frontseat_driver.monitor.layout import BAD, BAR, BOLD, DIM, GOOD, PLAIN, WARN, Row

FRESH_S = 2.0           # max_data_age of the driver
DRIVER_SILENT_S = 3.0   # it tells the state of its link every second
MASTER_SILENT_S = 6.0   # it is asked every two seconds
SEEN_S = 600.0          # an older fault is history

GRANTS = {ControlStatus.UNKNOWN: ("PERMISSION UNKNOWN", WARN),
          ControlStatus.DENIED: ("DENIED", BAD), ControlStatus.GRANTED: ("GRANTED", GOOD)}
ACKS = {CommandAck.INVALID: ("INVALID", BAD), CommandAck.FAILED: ("FAILED", BAD),
        CommandAck.DONE: ("DONE", GOOD), CommandAck.PENDING: ("PENDING", WARN)}
LEVELS = {DiagnosticStatus.OK: ("OK", GOOD), DiagnosticStatus.WARN: ("WARN", WARN),
          DiagnosticStatus.ERROR: ("ERROR", BAD), DiagnosticStatus.STALE: ("STALE", WARN)}
MISSIONS = {value: name.replace("_", " ") for name, value in vars(MissionStatus).items()
            if name.isupper() and isinstance(value, int)}


def age_text(seconds):
    """In at most six characters."""
    if seconds < 10.0:
        return "%.1f s" % seconds
    if seconds < 120.0:
        return "%.0f s" % seconds
    if seconds < 7200.0:
        return "%.0f min" % (seconds / 60.0)
    return "%.0f h" % (seconds / 3600.0)


def chunk(name, told, now, text, style=PLAIN):
    """A value with its name; one that is not fresh says so with its age, never by colour alone."""
    if told is None:
        return "%s --" % name, DIM
    shown = "%s %s" % (name, text(told.value)) if name else text(told.value)
    age_s = told.age_s(now)
    if age_s > FRESH_S:
        return "%s OLD %s" % (shown, age_text(age_s)), WARN
    return shown, style


def link_silent_s(state, now):
    """How long the driver has said nothing; None while it is heard."""
    if state.link is None:
        return None
    age_s = state.link.age_s(now)
    return age_s if age_s > DRIVER_SILENT_S else None


def master_chunks(state, now):
    heard = state.master_heard
    silent = state.master_lost or (heard is not None and now - heard > MASTER_SILENT_S)
    if heard is None and not silent:
        return [("waiting for the ROS master %s" % state.master_uri, WARN)]
    if not silent:
        return []
    text = "NO ROS MASTER at %s" % state.master_uri
    if heard is not None:
        text += " for %s" % age_text(now - heard)
    return [(text, BAD), ("is roscore running?", PLAIN)]


def link_row(state, now):
    if state.link is None:
        chunks = [("no driver heard in namespace %s" % state.namespace, BAD)]
        if state.elsewhere:
            chunks.append(("there is one in: %s" % ", ".join(state.elsewhere), PLAIN))
        return Row("LINK", chunks, importance=9)
    link, silent_s = state.link.value, link_silent_s(state, now)
    if silent_s is not None:
        chunks = [("DRIVER SILENT for %s" % age_text(silent_s), BAD),
                  ("was %s %s" % ("connected to" if link.connected else "not connected to",
                                  link.endpoint), DIM)]
    elif link.connected:
        chunks = [("CONNECTED", GOOD), (link.endpoint, PLAIN)]
    else:
        chunks = [("NOT CONNECTED", BAD), (link.endpoint, PLAIN)]
    return Row("LINK", chunks + [(link.dialect, PLAIN), last_byte(state, now)]
               + counters(link), importance=9)


def last_byte(state, now):
    age_s = state.last_byte_age_s(now)
    if age_s is None:
        return "no byte yet", WARN
    return "last byte %s ago" % age_text(age_s), PLAIN if age_s < FRESH_S else WARN


def counters(link):
    chunks = [("connects %d" % link.connects, PLAIN)]
    for name, count in (("bad checksums", link.bad_checksums), ("malformed", link.malformed),
                        ("unknown", link.unknown), ("too long", link.oversized),
                        ("refused commands", link.refused_commands)):
        if count:
            chunks.append(("%s %d" % (name, count), PLAIN if name == "unknown" else WARN))
    return chunks if len(chunks) > 1 else chunks + [("nothing bad", PLAIN)]


def control_row(state, now):
    if state.control is None:
        return Row("CONTROL", [("--", DIM)], importance=8)
    if link_silent_s(state, now) is not None:
        return Row("CONTROL", [("unknown: the driver is silent", WARN)], importance=8)
    control = state.control.value
    return Row("CONTROL", [
        GRANTS.get(control.grant, ("grant %d" % control.grant, WARN)),
        ("COMMANDING", BOLD) if control.commanding else ("not commanding", PLAIN),
        ("gate open", PLAIN) if control.commands_enabled else ("GATE CLOSED", WARN),
        (control.reason, WARN)], importance=8)


def is_connected(state, now):
    return (state.link is not None and state.link.value.connected
            and link_silent_s(state, now) is None)


def mission_row(state, now):
    chunks = [("--", DIM)]
    if state.mission is not None:
        mission = state.mission.value
        name = MISSIONS.get(mission.state, "state %d" % mission.state)
        same = mission.status.replace(" ", "").lower() == name.replace(" ", "").lower()
        # Told on change: it holds as long as the vehicle could tell another.
        state_now = (name, BOLD) if is_connected(state, now) else ("WAS " + name, WARN)
        chunks = [state_now, ("" if same else mission.status, PLAIN), (mission.dive_file, PLAIN),
                  (mission.details, PLAIN),
                  ("told %s ago" % age_text(state.mission.age_s(now)), PLAIN)]
    if state.shutdown is not None:
        chunks.insert(0, ("SHUTDOWN announced %s ago" % age_text(state.shutdown.age_s(now)), BAD))
    return Row("MISSION", chunks, importance=5)


def degrees_text(value, positive, negative):
    return "%.6f %s" % (abs(value), positive if value >= 0.0 else negative)


def fixed(value, decimals):
    """Without a minus sign before zero."""
    return "%.*f" % (decimals, round(value, decimals) + 0.0)


def fix_text(fix):
    source = "dead reckoning" if fix.status.status == NavSatStatus.STATUS_NO_FIX else "GPS"
    return "%s  %s  %s" % (degrees_text(fix.latitude, "N", "S"),
                           degrees_text(fix.longitude, "E", "W"), source)


def position_row(state, now):
    return Row("POSITION", [
        chunk("", state.fix, now, fix_text) if state.fix else ("--", DIM),
        chunk("east", state.pose, now, lambda p: "%s m  north %s m" % (fixed(p[0], 1), fixed(p[1], 1)))],
        importance=7)


def motion_row(state, now):
    return Row("MOTION", [
        # 359.97 is north, not 360.
        chunk("heading", state.heading, now, lambda v: "%05.1f deg" % (round(v, 1) % 360.0)),
        chunk("speed", state.speed, now, lambda v: "%.2f m/s" % v),
        chunk("roll", state.roll, now, lambda v: "%+.1f" % v),
        chunk("pitch", state.pitch, now, lambda v: "%+.1f deg" % v)], importance=7)


def depth_row(state, now):
    return Row("DEPTH", [
        chunk("", state.depth, now, lambda v: fixed(v, 2) + " m") if state.depth else ("--", DIM),
        chunk("altitude", state.altitude, now, lambda v: fixed(v, 2) + " m")], importance=7)


def battery_text(battery):
    cells = [volts for volts in battery.cell_voltage if not math.isnan(volts)]
    text = "--" if math.isnan(battery.voltage) else "%.2f V" % battery.voltage
    if cells:
        text += "  cells %.2f to %.2f V" % (min(cells), max(cells))
    temperature = getattr(battery, "temperature", math.nan)
    return text if math.isnan(temperature) else text + "  %.0f degC" % temperature


def battery_row(state, now):
    many = len(state.batteries) > 1
    chunks = [chunk(name if many else "", told, now, battery_text)
              for name, told in sorted(state.batteries.items())]
    return Row("BATTERY", chunks or [("--", DIM)], importance=6)


def rates_row(state, now):
    rates = state.received_hz(now)
    chunks = [("%s %.1f" % (kind, hz), PLAIN if hz else DIM) for kind, hz in rates]
    total = "all %.1f" % sum(hz for _, hz in rates)
    return Row("HEARD/s", [(total, BOLD)] + chunks if rates else [("nothing", DIM)],
               importance=4)


def sent_rows(state, now):
    rows = []
    for kind, told in state.commands():
        hz = state.sent_rates[kind].hz(now, state.since)
        rate = "%.1f/s" % hz if hz >= 0.3 else ""
        rows.append(Row("" if rows else "SENT", [
            ("%s ago" % age_text(told.age_s(now)), PLAIN), (told.value[1:].split("*")[0], PLAIN),
            (rate, PLAIN)], importance=4 - min(len(rows), 3)))
    return rows or [Row("SENT", [("nothing", DIM)], importance=4)]


def ack_rows(state, now):
    rows = []
    for command, told in reversed(list(state.acks.items())):
        ack = told.value
        took = "" if math.isnan(ack.round_trip) else "after %.3f s" % ack.round_trip
        name, style = ACKS.get(ack.status, ("status %d" % ack.status, WARN))
        rows.append(Row("" if rows else "ANSWER", [
            ("%s ago" % age_text(told.age_s(now)), PLAIN), (command, PLAIN), (name, style),
            (took, PLAIN), (ack.message, PLAIN)], importance=4 - min(len(rows), 3)))
    return rows or [Row("ANSWER", [("none", DIM)], importance=3)]


def complaint_rows(state, now):
    """What is wrong now, the cause first."""
    rows = []
    for name, told in state.complaints():
        level, style = LEVELS.get(told.value.level, ("LEVEL %d" % told.value.level, WARN))
        age_s = told.age_s(now)
        when = "now" if age_s < DRIVER_SILENT_S else "%s ago" % age_text(age_s)
        rows.append(Row("", [(when, style), ("%s %s: %s" % (level, name, told.value.message),
                                             style)], importance=8 - min(len(rows), 6)))
    return rows


def past_rows(state, now):
    """What was wrong, the latest first."""
    present = {"%s: %s" % (name, told.value.message) for name, told in state.complaints()}
    rows = []
    for fault in reversed(state.faults):
        if now - fault.at < SEEN_S and fault.text not in present:
            times = " (%d times)" % fault.count if fault.count > 1 else ""
            rows.append(Row("", [("%s ago" % age_text(now - fault.at), PLAIN),
                                 (fault.text + times, PLAIN)], importance=3 if not rows else 1))
    return rows


def fault_rows(state, now):
    rows = complaint_rows(state, now) + past_rows(state, now)
    if not rows:
        rows = [Row("", [("none in the last %s" % age_text(SEEN_S), GOOD)], importance=3)]
    rows[0].label = "FAULTS"
    return rows


def bar(left, right, width):
    room = width - len(left) - 1
    text = left + right.rjust(room) if len(right) < room else left
    return [(text.ljust(width)[:width], BAR)]


def render(state, now, width, height, clock="", keys="q quits"):
    """At most `height` lines of at most `width` columns, each a list of (text, style)."""
    title = "frontseat_monitor %s" % layout.printable(state.namespace)
    rows = [link_row(state, now), control_row(state, now), mission_row(state, now),
            Row("", [], importance=0),
            position_row(state, now), motion_row(state, now), depth_row(state, now),
            battery_row(state, now),
            Row("", [], importance=0), rates_row(state, now)]
    rows += sent_rows(state, now) + ack_rows(state, now) + fault_rows(state, now)
    master = master_chunks(state, now)
    if master:
        rows.insert(0, Row("ROS", master, importance=10))
    room = max(height - 2, 0)
    body = layout.fitted(rows, width, room)
    body += [[] for _ in range(room - len(body))]
    foot = bar(keys, "OLD: nothing newer has come", width - 1)  # see Screen.show
    return ([bar(title, clock, width)] + body + [foot])[:height]
