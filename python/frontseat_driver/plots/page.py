"""Draws a mission: the track on the left, everything over time on the right."""

import matplotlib

matplotlib.use("Agg")  # no display is needed

import matplotlib.pyplot as pyplot  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib import patheffects  # noqa: E402

from frontseat_driver.plots import thin  # noqa: E402
from frontseat_driver.plots.mission import GAP_S, summary  # noqa: E402

# Okabe and Ito's colours, which people who are colour-blind tell apart.
BLUE, ORANGE, GREEN, RED, SKY, PURPLE = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7")
INK, PALE = "#222222", "#888888"
SIZE_IN = (14.0, 9.0)
BINS = 1200           # a panel has about half as many pixels across
HOLE_S = 10.0         # a line is not drawn over a longer hole
FEW = 60
TIME_MARKS = 6        # on the track, about
NEAR_SHARE = 0.07     # of the track: closer marks share a label
MARK_STEPS_S = (5, 10, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 28800)
TIME_UNITS = ((7200.0, 3600.0, "h"), (180.0, 60.0, "min"), (0.0, 1.0, "s"))

STYLE = {"font.size": 9.5, "axes.edgecolor": PALE, "axes.labelcolor": INK, "axes.grid": True,
         "grid.color": "#E2E2E2", "grid.linewidth": 0.7, "axes.axisbelow": True,
         "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "lines.linewidth": 1.4, "xtick.color": INK, "ytick.color": INK, "svg.fonttype": "path",
         "svg.hashsalt": "frontseat_driver"}


class Clock:
    """Seconds since the epoch to the unit of the time axis, counted from the start."""

    def __init__(self, mission):
        self.start_s, self.end_s = mission.span_s()
        length_s = self.end_s - self.start_s
        self.unit_s, self.unit = next((unit_s, name) for least_s, unit_s, name in TIME_UNITS
                                      if length_s >= least_s)

    def __call__(self, seconds):
        return (np.asarray(seconds) - self.start_s) / self.unit_s

    def marks_s(self):
        length_s = self.end_s - self.start_s
        step_s = next((step for step in MARK_STEPS_S if length_s / step <= TIME_MARKS),
                      MARK_STEPS_S[-1])
        return step_s * np.arange(1, int(length_s / step_s + 0.9))  # none upon the end


def without_data(axes, words):
    """A panel that has nothing to show says why."""
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center", color=PALE,
              style="italic")
    axes.set_yticks([])
    axes.grid(False)


def line(axes, clock, series, **style):
    pick = thin.kept([series.v], BINS)
    holes = holes_of(series.t, pick)
    if len(pick) <= FEW:  # single points make no line
        style = dict(style, marker="o", markersize=3)
    return axes.plot(*thin.broken_at(clock(series.t[pick]), series.v[pick], holes), **style)


def holes_of(t, pick):
    """Where in `pick` a hole in the data begins: points left out by thinning are none."""
    breaks = thin.breaks_of_time(t, HOLE_S)
    return np.unique(np.searchsorted(pick, breaks))


def draw_track(axes, mission, clock):
    axes.set_title("Track, m from the datum", loc="left", weight="bold")
    axes.set_xlabel("east, m")
    axes.set_ylabel("north, m")
    axes.set_aspect("equal", adjustable="datalim")
    if not mission.position:
        return without_data(axes, "no position in this recording")
    x, y = mission.position.values
    t = mission.position.t
    pick = thin.kept([x, y], BINS)
    axes.plot(*thin.broken_at(x[pick], y[pick], holes_of(t, pick)), color=BLUE)
    axes.margins(0.12)
    place = (t, x, y)
    point_ahead(axes, place, clock)
    mark_times(axes, place, clock)
    axes.plot(x[0], y[0], "o", color=GREEN, markersize=11, label="start", zorder=6)
    axes.plot(x[-1], y[-1], "s", color=RED, markersize=10, label="end", zorder=6)
    axes.legend(loc="upper right", ncol=2)


def place_at(t, wanted_s):
    """Index of the first position from then on; None where there is none near."""
    at = np.searchsorted(t, wanted_s)
    return at if at < len(t) and t[at] - wanted_s <= HOLE_S else None


def point_ahead(axes, place, clock):
    """Arrows between the time marks: which way it went."""
    t, x, y = place
    half_s = np.diff(clock.marks_s()[:2], prepend=0.0)[-1] / 2.0 if len(clock.marks_s()) else 0.0
    for mark_s in clock.marks_s():
        at = place_at(t, clock.start_s + mark_s - half_s)
        if at is None:
            continue
        away = np.hypot(x[at:] - x[at], y[at:] - y[at])
        ahead = at + int(np.argmax(away > 0.01 * np.ptp(np.hypot(x, y)) + 0.5))
        if ahead > at:
            axes.annotate("", (x[ahead], y[ahead]), (x[at], y[at]),
                          arrowprops={"arrowstyle": "-|>", "color": BLUE, "mutation_scale": 16})


def mark_times(axes, place, clock):
    t, x, y = place
    near_m = NEAR_SHARE * max(np.ptp(x), np.ptp(y))
    marks = []  # index, and the times there: a vehicle in circles comes by again
    for mark_s in clock.marks_s():
        at = place_at(t, clock.start_s + mark_s)
        if at is None:
            continue
        axes.plot(x[at], y[at], "o", color="white", markeredgecolor=INK, markersize=5, zorder=3)
        time = "%g" % (mark_s / clock.unit_s)
        near = [times for other, times in marks
                if np.hypot(x[at] - x[other], y[at] - y[other]) < near_m]
        if near:
            near[0].append(time)
        else:
            marks.append((at, [time]))
    for at, times in marks:
        axes.annotate("%s %s" % (", ".join(times), clock.unit), (x[at], y[at]), xytext=(6, 5),
                      textcoords="offset points", fontsize=8.5, color=INK, zorder=7,
                      path_effects=[patheffects.withStroke(linewidth=2.5, foreground="white")])


def draw_depth(axes, mission, clock):
    depth, altitude = mission.depth_m, mission.altitude_m
    if depth:
        line(axes, clock, depth, color=BLUE, label="vehicle")
    if depth and altitude:
        bottom = altitude_as_bottom(depth, altitude)
        line(axes, clock, bottom, color=ORANGE, label="bottom (depth + altitude)")
    elif altitude:
        axes.set_ylabel("altitude, m")
        line(axes, clock, altitude, color=ORANGE, label="above the bottom")
        axes.set_ylim(bottom=0.0)
    if depth:
        low, high = axes.get_ylim()
        axes.set_ylim(max(high, 1.0), min(low, 0.0))  # down is down
    legend(axes)


def altitude_as_bottom(depth, altitude):
    at = np.interp(altitude.t, depth.t, depth.v)
    return type(altitude)(altitude.t, at + altitude.v)


def draw_speed(axes, mission, clock):
    line(axes, clock, mission.speed_m_s, color=BLUE)
    axes.set_ylim(bottom=0.0)


def draw_heading(axes, mission, clock):
    t, v = mission.heading_deg.t, mission.heading_deg.v
    pick = thin.kept([v], BINS)
    # Dots: a heading that goes through north is no line across the panel.
    axes.plot(clock(t[pick]), v[pick], ".", color=BLUE, markersize=6 if len(pick) <= FEW else 2.5)
    axes.set_ylim(-10.0, 370.0)
    axes.set_yticks([0, 90, 180, 270, 360])
    axes.set_yticklabels(["0 N", "90 E", "180 S", "270 W", "360 N"], fontsize=8.0)


def draw_attitude(axes, mission, clock):
    if mission.roll_deg:
        line(axes, clock, mission.roll_deg, color=ORANGE, label="roll (port side up)",
             linewidth=0.9)
    if mission.pitch_deg:
        line(axes, clock, mission.pitch_deg, color=BLUE, label="pitch (bow up)", linewidth=0.9)
    legend(axes)


def draw_battery(axes, mission, clock):
    present = [(name, series) for name, series in sorted(mission.battery_v.items()) if series]
    for color, (name, series) in zip((BLUE, ORANGE, GREEN, PURPLE, SKY, RED), present):
        line(axes, clock, series, color=color, label=name)
    low = min(np.nanmin(series.v) for _, series in present)
    high = max(np.nanmax(series.v) for _, series in present)
    axes.set_ylim(low - max(0.5, 0.1 * (high - low)), high + max(0.5, 0.1 * (high - low)))
    legend(axes)


def draw_link(axes, mission, clock):
    if mission.rate_hz:
        pick = thin.kept([mission.rate_hz.v], BINS // 2)
        axes.step(clock(mission.rate_hz.t[pick]), mission.rate_hz.v[pick], where="pre", color=BLUE,
                  linewidth=1.0, label="received")
    top = axes.get_ylim()[1] * 1.25
    axes.set_ylim(0.0, top)
    for start_s, end_s in mission.disconnected():
        axes.axvspan(clock(start_s), clock(end_s), color=RED, alpha=0.35, linewidth=0,
                     label="no connection")
    for start_s, end_s in mission.gaps:
        axes.axvspan(clock(start_s), clock(end_s), facecolor="none", edgecolor=PALE, hatch="////",
                     linewidth=0, label="silent for over %g s" % GAP_S)
    draw_faults(axes, mission, clock, top)
    label_once(axes, mission)


def draw_faults(axes, mission, clock, top):
    for series, color, marker, name, height in (
            (mission.bad_checksums, RED, "x", "bad checksum", 0.80),
            (mission.malformed, PURPLE, "^", "malformed", 0.72)):
        if len(series):
            axes.plot(clock(series.t), np.full(len(series), top * height), marker, color=color,
                      markersize=5, label="%s: %d" % (name, np.sum(series.v)))


def label_once(axes, mission):
    handles = dict(zip(*reversed(axes.get_legend_handles_labels())))
    if not set(handles) - {"received"}:
        handles[good_words(mission)] = axes.plot([], [], " ")[0]
    legend(axes, handles.values(), handles.keys())


def good_words(mission):
    words = ["connected throughout"] if len(mission.connected) else []
    words += ["no bad checksum, nothing malformed"] if mission.faults_known else []
    return ", ".join(words + (["no silence"] if mission.rate_hz else []))


def legend(axes, *handles):
    """Above the panel, where it hides nothing."""
    axes.legend(*handles, loc="lower right", bbox_to_anchor=(1.0, 0.96), ncol=5, fontsize=8.5,
                handlelength=1.4, columnspacing=1.2, borderaxespad=0.0, borderpad=0.1)


class Panel:
    def __init__(self, label, height, draw, has_data, otherwise):
        self.label, self.height, self.draw = label, height, draw
        self.has_data, self.otherwise = has_data, otherwise


PANELS = (
    Panel("depth, m", 1.3, draw_depth, lambda m: m.depth_m or m.altitude_m,
          "no depth and no altitude in this recording"),
    Panel("speed, m/s", 0.9, draw_speed, lambda m: m.speed_m_s, "no velocity in this recording"),
    Panel("{north} heading, deg", 1.0, draw_heading, lambda m: m.heading_deg,
          "no heading in this recording"),
    Panel("roll, pitch, deg", 1.0, draw_attitude, lambda m: m.roll_deg or m.pitch_deg,
          "no roll and no pitch in this recording"),
    Panel("battery, V", 0.8, draw_battery, lambda m: any(m.battery_v.values()),
          "no battery voltage in this recording"),
    Panel("sentences/s", 1.1, draw_link, lambda m: m.rate_hz or m.connected,
          "no sentences and no link state in this recording"))
EMPTY_HEIGHT = 0.3


def empty_figure(mission):
    figure = pyplot.figure(figsize=SIZE_IN)
    figure.text(0.5, 0.5, "%s: nothing to show in this recording" % mission.title, ha="center",
                color=PALE, fontsize=14)
    return figure


def figure_of(mission):
    with matplotlib.rc_context(STYLE):
        if mission.span_s() is None:
            return empty_figure(mission)
        return drawn(mission, Clock(mission))


def drawn(mission, clock):
    figure = pyplot.figure(figsize=SIZE_IN)
    heights = [panel.height if panel.has_data(mission) else EMPTY_HEIGHT for panel in PANELS]
    grid = figure.add_gridspec(len(PANELS), 2, width_ratios=(1.0, 1.2), left=0.05, right=0.985,
                               top=0.865, bottom=0.06, wspace=0.2, hspace=0.42,
                               height_ratios=heights)
    draw_track(figure.add_subplot(grid[:, 0]), mission, clock)
    axes = None
    for row, panel in enumerate(PANELS):
        axes = figure.add_subplot(grid[row, 1], sharex=axes)
        draw_panel(axes, panel, mission, clock)
        axes.tick_params(labelbottom=row == len(PANELS) - 1)
    length = max(float(clock(clock.end_s)), 1e-6)
    axes.set_xlim(-0.008 * length, 1.008 * length)  # so that what is at the edge is seen whole
    axes.set_xlabel("time since the start, %s" % clock.unit)
    write_head(figure, mission)
    return figure


def draw_panel(axes, panel, mission, clock):
    axes.set_ylabel(panel.label)
    axes.yaxis.set_label_coords(-0.085, 0.5)
    if panel.has_data(mission):
        axes.set_ylabel(panel.label.format(north=mission.heading_note))
        panel.draw(axes, mission, clock)
    else:
        axes.set_ylabel("")
        without_data(axes, panel.otherwise)


def write_head(figure, mission):
    rows = summary(mission)
    figure.text(0.015, 0.965, mission.title, fontsize=15, weight="bold", color=INK, va="center")
    half = (len(rows) + 1) // 2
    for number, part in enumerate((rows[:half], rows[half:])):
        text = "     ".join("%s: %s" % pair for pair in part)
        figure.text(0.015, 0.931 - 0.026 * number, text, fontsize=9.5, color=INK, va="center")
