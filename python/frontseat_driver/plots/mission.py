"""What a mission was, as numbers to draw: the readers fill it, the page shows it."""

import datetime

import numpy as np

GAP_S = 2.0  # the driver's max_data_age: a longer silence leaves its data stale
MOST_RATES = 3600  # stretches of a long recording


class Series:
    """Values over time, both as arrays; `t` in s since the epoch, in order."""

    def __init__(self, t=(), *values):
        self.t = np.asarray(t, dtype=float)
        self.values = tuple(np.asarray(value, dtype=float) for value in values)
        if np.any(np.diff(self.t) < 0.0):
            order = np.argsort(self.t, kind="stable")
            self.t = self.t[order]
            self.values = tuple(value[order] for value in self.values)

    def __len__(self):
        return len(self.t)

    def __bool__(self):
        return any(np.any(np.isfinite(value)) for value in self.values)

    @property
    def v(self):
        return self.values[0] if self.values else np.empty(0)


class Mission:
    """One vehicle's recording. What was not recorded is an empty Series."""

    def __init__(self, title):
        self.title = title
        self.position = Series()     # x, y: m east and north of the datum
        self.depth_m = Series()      # below the surface
        self.altitude_m = Series()   # above the bottom
        self.speed_m_s = Series()    # over ground
        self.heading_deg = Series()  # clockwise from north
        self.heading_note = "true"   # which north that is
        self.roll_deg = Series()     # positive port side up
        self.pitch_deg = Series()    # positive bow up
        self.battery_v = {}          # by the battery's name
        self.rate_hz = Series()      # sentences received, since the time before
        self.sentences = 0           # how many altogether
        self.gaps = np.empty((0, 2))  # start and end of every silence longer than GAP_S
        self.bad_checksums = Series()   # how many, at the time they were noticed
        self.malformed = Series()
        self.faults_known = False    # whether anybody counted the last two
        self.connected = Series()    # 1 or 0, each time it was told
        self.relative_time = False   # the times are right among themselves, without a date

    def every_series(self):
        return [self.position, self.depth_m, self.altitude_m, self.speed_m_s, self.heading_deg,
                self.roll_deg, self.pitch_deg, self.rate_hz, self.bad_checksums, self.malformed,
                self.connected] + list(self.battery_v.values())

    def span_s(self):
        """First and last time of anything; None for an empty recording."""
        times = [(series.t[0], series.t[-1]) for series in self.every_series() if len(series)]
        if not times:
            return None
        return min(first for first, _ in times), max(last for _, last in times)

    def hear(self, t):
        """Takes the time of each sentence, in order."""
        if not len(t):
            return
        ends = np.flatnonzero(np.diff(t) > GAP_S)
        self.gaps = np.column_stack([t[ends], t[ends + 1]])
        edges = stretches(t[0], t[-1])
        self.sentences = len(t)
        self.rate_hz = Series(edges[1:], np.histogram(t, edges)[0] / np.diff(edges))

    def count(self, t, counts):
        """Takes how many sentences had been received at each time. Told about once a second, but
        also twice within a moment: hence even stretches."""
        edges = stretches(t[0], t[-1])
        self.sentences = int(counts[-1] - counts[0])
        self.rate_hz = Series(edges[1:], np.diff(np.interp(edges, t, counts)) / np.diff(edges))

    def disconnected(self):
        """Start and end of every time without a connection."""
        told = self.connected
        if not len(told):
            return np.empty((0, 2))
        edges = np.flatnonzero(np.diff(told.v)) + 1
        starts = np.concatenate([[0], edges])
        ends = np.append(told.t[edges], told.t[-1])
        rows = [(told.t[start], end) for start, end in zip(starts, ends) if not told.v[start]]
        return np.asarray(rows, dtype=float).reshape(-1, 2)

    def distance_m(self):
        x, y = self.position.values
        return float(np.sum(np.hypot(np.diff(x), np.diff(y))))


def stretches(start_s, end_s):
    """The edges of a second each, or of longer ones of a long recording."""
    count = int(min(max(end_s - start_s, 1.0), MOST_RATES))
    return np.linspace(start_s, max(end_s, start_s + 1.0), count + 1)


def clock_text(seconds, relative):
    if relative:
        return "no date in the recording"
    started = datetime.datetime.utcfromtimestamp(seconds)
    return started.strftime("%Y-%m-%d %H:%M:%S UTC")


def duration_text(seconds):
    hours, rest = divmod(int(round(seconds)), 3600)
    minutes, seconds = divmod(rest, 60)
    if hours:
        return "%d h %02d min" % (hours, minutes)
    return "%d min %02d s" % (minutes, seconds) if minutes else "%d s" % seconds


def summary(mission):
    """Pairs of words and figures, the most wanted first; for the page's head and its table."""
    span = mission.span_s()
    if span is None:
        return [("recording", "empty")]
    rows = [("start", clock_text(span[0], mission.relative_time)),
            ("duration", duration_text(span[1] - span[0]))]
    if mission.position:
        rows.append(("distance over ground", "%.0f m" % mission.distance_m()))
    for name, series, pick, text in (
            ("deepest", mission.depth_m, np.nanmax, "%.1f m"),
            ("lowest altitude", mission.altitude_m, np.nanmin, "%.1f m"),
            ("fastest", mission.speed_m_s, np.nanmax, "%.2f m/s"),
            ("most roll", mission.roll_deg, lambda v: np.nanmax(np.abs(v)), "%.1f deg"),
            ("most pitch", mission.pitch_deg, lambda v: np.nanmax(np.abs(v)), "%.1f deg")):
        if series:
            rows.append((name, text % pick(series.v)))
    for name, series in sorted(mission.battery_v.items()):
        if series:
            volts = series.v[np.isfinite(series.v)]
            rows.append((name, "%.1f V to %.1f V" % (volts[0], volts[-1])))
    return rows + link_summary(mission)


def link_summary(mission):
    gaps = mission.gaps
    rows = []
    if mission.rate_hz:
        rows += [("sentences received", "%d" % mission.sentences),
                 ("silences over %g s" % GAP_S, "%d" % len(gaps))]
    if mission.faults_known:
        rows += [("bad checksums", "%d" % np.sum(mission.bad_checksums.v)),
                 ("malformed", "%d" % np.sum(mission.malformed.v))]
    if len(gaps):
        rows.append(("longest silence", "%.1f s" % np.max(gaps[:, 1] - gaps[:, 0])))
    if len(mission.connected):
        rows.append(("times without connection", "%d" % len(mission.disconnected())))
    return rows
