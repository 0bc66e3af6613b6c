"""Runs the tests that CMake knows, two at a time, and adds up the cases that they report.

A test program that crashes, hangs, or reports nothing counts as one failed case, never as none.
Rostests and the programs with real sockets keep time by the clock on the wall: on a computer that
was just then held up they may fail without a fault. One that fails is run up to twice more when all
others have ended, which is said and shown; only what it reports last counts. Everything else, in
virtual time or none, has one try.
"""

import concurrent.futures
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as xml

TIMEOUT_S = 300  # for tests that set no TIMEOUT of their own
AT_ONCE = 2  # rostests mostly wait
TIMED_BY_WALL = re.compile(
    r"rostest_|gtest_(link|zmq_link|driver|blueye_driver|diagnosis_link|sim|sim_blueye)_test$|"
    r"python_(blueye_client_steps|monitor_screen|nmea_decode)$")
MORE_TRIES = 2


class Count:
    def __init__(self):
        self.passed = 0
        self.failed = 0
        self.failures = []  # test and last line of the reason

    def add(self, other):
        self.passed += other.passed
        self.failed += other.failed
        self.failures += other.failures


class Test:
    """One program, as CMake wants it run, and where its reports will be."""

    def __init__(self, known):
        properties = {item["name"]: item["value"] for item in known["properties"]}
        self.name = re.sub(r"^_ctest_frontseat_driver_", "", known["name"])
        self.command = known["command"]
        self.folder = properties["WORKING_DIRECTORY"]
        self.timeout_s = min(properties.get("TIMEOUT", TIMEOUT_S), TIMEOUT_S * 10)
        self.timed_by_wall = TIMED_BY_WALL.match(self.name) is not None
        words = shlex.split(" ".join(self.command))
        report = next(word for word in words if word.endswith(".xml"))
        self.reports = [report]
        for name in self.rosunit_names(words):
            self.reports.append(os.path.join(os.path.dirname(report), "rosunit-%s.xml" % name))

    @staticmethod
    def rosunit_names(words):
        """Of the programs that a rostest starts, each of which writes a report of its own."""
        arguments = dict(word.split(":=", 1) for word in words if ":=" in word)
        for launch in (word for word in words if word.endswith(".test")):
            with open(launch) as file:
                for name in re.findall(r'test-name="([^"]+)"', file.read()):
                    yield re.sub(r"\$\(arg (\w+)\)", lambda arg: arguments[arg.group(1)], name)


def known_tests(build_dir, pattern):
    listing = subprocess.check_output(["ctest", "--show-only=json-v1"], cwd=build_dir)
    tests = [Test(known) for known in json.loads(listing.decode())["tests"]]
    # Those that take longest first.
    return sorted((test for test in tests if re.search(pattern, test.name)),
                  key=lambda test: not test.timed_by_wall)


def add_report(path, count):
    """rostest repeats in its own report what its nodes reported; only its failures are news."""
    summary_only = os.path.basename(path).startswith("rostest-")
    for case in xml.parse(path).iter("testcase"):
        reason = case.find("failure")
        reason = reason if reason is not None else case.find("error")
        if reason is not None:
            count.failed += 1
            text = (reason.get("message") or reason.text or "").strip()
            count.failures.append("%s.%s: %s" % (case.get("classname"), case.get("name"),
                                                 text.splitlines()[-1] if text else ""))
        elif case.find("skipped") is None and case.get("status") != "notrun" and not summary_only:
            count.passed += 1


def read_reports(test, count):
    for path in test.reports:
        if not os.path.isfile(path):
            continue
        try:
            add_report(path, count)
        except xml.ParseError as error:
            count.failed += 1
            count.failures.append("%s: %s: %s" % (test.name, path, error))


def run_program(test):
    """Exit code and output; a program that takes too long is ended with all that it started."""
    program = subprocess.Popen(test.command, cwd=test.folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        output, _ = program.communicate(timeout=test.timeout_s)
    except subprocess.TimeoutExpired:
        os.killpg(program.pid, signal.SIGKILL)
        output, _ = program.communicate()
        output += b"\ntook longer than %d s" % test.timeout_s
    return program.returncode, output.decode(errors="replace")


class Runner:
    def __init__(self, build_dir):
        self.kept = os.path.join(build_dir, "test_reports")
        shutil.rmtree(self.kept, ignore_errors=True)
        self.printing = threading.Lock()

    def run(self, test):
        for path in test.reports:
            if os.path.exists(path):
                os.remove(path)
        os.makedirs(os.path.dirname(test.reports[0]), exist_ok=True)
        started = time.monotonic()
        code, output = run_program(test)
        count = Count()
        read_reports(test, count)
        if (code != 0 and count.failed == 0) or count.passed + count.failed == 0:
            count.failed += 1
            count.failures.append("%s: ended with %d" % (test.name, code))
        self.report(test, count, time.monotonic() - started, output)
        self.keep(test)
        return count

    def report(self, test, count, seconds, output):
        word = "FAILED" if count.failed else "passed"
        with self.printing:
            print("%s  %-58s %5d passed %3d failed %7.1f s"
                  % (word, test.name, count.passed, count.failed, seconds), flush=True)
            if count.failed:
                print("    " + output.replace("\n", "\n    "), flush=True)

    def keep(self, test):
        place = os.path.join(self.kept, test.name)
        os.makedirs(place, exist_ok=True)
        for path in test.reports:
            if os.path.isfile(path):
                shutil.copy(path, place)

    def run_again(self, test, count):
        for _ in range(MORE_TRIES):
            if not count.failed:
                break
            print("once more:", flush=True)
            count = self.run(test)
        return count

    def run_all(self, tests):
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            counts = list(pool.map(self.run, tests))
        total = Count()
        for test, count in zip(tests, counts):
            total.add(self.run_again(test, count) if test.timed_by_wall else count)
        return total


def main():
    build_dir = sys.argv[1]
    pattern = sys.argv[2] if len(sys.argv) > 2 else ""
    total = Runner(build_dir).run_all(known_tests(build_dir, pattern))
    for failure in total.failures:
        print("failed: " + failure)
    print("%d passed, %d failed" % (total.passed, total.failed), flush=True)
    return 0 if total.passed and not total.failed else 1


if __name__ == "__main__":
    sys.exit(main())
