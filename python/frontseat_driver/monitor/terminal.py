"""Puts lines on a terminal and leaves it as it was, however the program ends."""

import contextlib
import curses
import io
import os
import signal
import sys

from frontseat_driver.monitor import layout

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
COLORS = {layout.GOOD: curses.COLOR_GREEN, layout.WARN: curses.COLOR_YELLOW,
          layout.BAD: curses.COLOR_RED}
ATTRIBUTES = {layout.BOLD: curses.A_BOLD, layout.GOOD: curses.A_BOLD, layout.WARN: curses.A_BOLD,
              layout.BAD: curses.A_REVERSE, layout.DIM: curses.A_DIM,
              layout.BAR: curses.A_REVERSE}


class Ending:
    """Whether a signal has asked for the end; the first one, in order of arrival."""

    def __init__(self):
        self.signal = None
        for number in ENDING:
            signal.signal(number, self._take)

    def _take(self, number, _frame):
        self.signal = self.signal or number

    def __bool__(self):
        return self.signal is not None


def is_capable(stream, environment):
    """Whether a screen can be updated in place; a dumb terminal, a pipe or a file gets text."""
    if not stream.isatty() or environment.get("TERM", "") in ("", "dumb", "unknown"):
        return False
    try:
        curses.setupterm(fd=stream.fileno())
    except curses.error:  # this computer does not know the terminal
        return False
    return bool(curses.tigetstr("cup")) and bool(curses.tigetstr("clear"))


class Screen:
    """Curses; a context, so that nothing can leave the terminal changed."""

    def __init__(self, wants_color=True):
        self._wants_color = wants_color
        self._attributes = dict(ATTRIBUTES)
        self._output = contextlib.ExitStack()

    def __enter__(self):
        self._window = curses.initscr()
        try:
            self._prepare()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def _prepare(self):
        curses.noecho()
        curses.cbreak()
        self._window.keypad(True)
        with contextlib.suppress(curses.error):
            curses.curs_set(0)
        if self._wants_color and curses.has_colors():
            curses.start_color()
            with contextlib.suppress(curses.error):
                curses.use_default_colors()
            for number, (style, color) in enumerate(COLORS.items(), 1):
                curses.init_pair(number, color, -1)
                self._attributes[style] |= curses.color_pair(number)
        # What libraries print would tear the screen.
        self._output.enter_context(contextlib.redirect_stdout(io.StringIO()))
        self._output.enter_context(contextlib.redirect_stderr(io.StringIO()))

    def __exit__(self, *_):
        self._output.close()
        with contextlib.suppress(curses.error):
            self._window.keypad(False)
            curses.nocbreak()
            curses.echo()
            curses.curs_set(1)
        curses.endwin()

    def size(self):
        """Columns and lines as they are now; follows a resized window."""
        size = os.get_terminal_size(sys.__stdout__.fileno())
        if (size.lines, size.columns) != self._window.getmaxyx() and min(size) > 0:
            curses.resizeterm(size.lines, size.columns)
            self._window.clear()
        lines, columns = self._window.getmaxyx()
        return columns, lines

    def show(self, lines):
        height, width = self._window.getmaxyx()
        self._window.erase()
        for y, line in enumerate(lines[:height]):
            # The last cell of the screen cannot be written without scrolling it.
            spans = layout.clip(line, width - 1 if y == height - 1 else width)
            x = 0
            for text, style in spans:
                with contextlib.suppress(curses.error):
                    self._window.addstr(y, x, text, self._attributes.get(style, 0))
                x += len(text)
        self._window.refresh()

    def key(self, wait_s):
        """The key pressed within that time, else -1."""
        self._window.timeout(int(1000 * wait_s))
        return self._window.getch()
