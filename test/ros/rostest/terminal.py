"""A terminal of a given size with a program in it, to be looked at and typed into."""

import os
import shlex
import subprocess
import tempfile

from fake_vehicle import wait_until

PATIENCE_S = 30.0


class Terminal:
    """tmux without a window: it keeps the screen that a program draws. The program's shell writes
    down how the terminal's modes were before and after."""

    def __init__(self, command, columns=80, lines=24, term="screen-256color", **environment):
        self._folder = tempfile.TemporaryDirectory()
        place = self._folder.name
        self._tmux = ["tmux", "-S", os.path.join(place, "socket"), "-f", "/dev/null"]
        script = ("trap : INT; stty -g > {0}/before; {1}; echo ended with $?; stty -g > {0}/after; exec cat"
                  .format(shlex.quote(place), command))
        settings = dict({"TERM": term}, **environment)
        with_settings = ["env"] + ["%s=%s" % pair for pair in settings.items()]
        subprocess.check_call(
            self._tmux + ["new-session", "-d", "-x", str(columns), "-y", str(lines), "--"]
            + with_settings + ["sh", "-c", script], env=dict(os.environ, LC_ALL="C.UTF-8"))

    def _ask(self, *words):
        return subprocess.check_output(self._tmux + list(words)).decode()

    def screen(self, *options):
        return self._ask("capture-pane", "-p", *options)

    def wait_for(self, *words):
        """The screen that holds all of these."""
        shown = []

        def holds():
            shown[:] = [self.screen()]
            return all(word in shown[0] for word in words)
        try:
            wait_until(holds, " and ".join(words), PATIENCE_S)
        except AssertionError as error:
            raise AssertionError("%s; the screen is:\n%s" % (error, shown[0]))
        return shown[0]

    def resize(self, columns, lines):
        self._ask("resize-window", "-x", str(columns), "-y", str(lines))

    def type(self, key):
        self._ask("send-keys", key)

    def program(self):
        """The process id of what the shell runs."""
        shell = self._ask("display", "-p", "#{pane_pid}").strip()
        with open("/proc/{0}/task/{0}/children".format(shell)) as children:
            return int(children.read().split()[0])

    def leftovers(self):
        """What an ended program has left changed; empty if nothing."""
        self.wait_for("ended with")
        modes = []
        for name in ("before", "after"):
            path = os.path.join(self._folder.name, name)
            wait_until(lambda: os.path.exists(path) and os.path.getsize(path), path)
            with open(path) as file:
                modes.append(file.read())
        found = [] if modes[0] == modes[1] else ["modes %s became %s" % tuple(modes)]
        flags = self._ask("display", "-p", "#{alternate_on} #{cursor_flag} #{keypad_flag}")
        if flags.split() != ["0", "1", "0"]:
            found.append("alternate screen, cursor, keypad: " + flags)
        return found

    def close(self):
        subprocess.call(self._tmux + ["kill-server"])
        self._folder.cleanup()
