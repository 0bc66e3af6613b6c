"""Runs the tests that CMake knows and adds up the cases that they report.

A test program that crashes, hangs, or reports nothing counts as one failed case, never as none.
A rostest keeps time by the clock on the wall, with several processes: on a computer that was just
then held up it may fail without a fault. One that fails is run once more, which is said and shown;
only what it reports then counts. Everything else has one try.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

TIMEOUT_S = 300  # for tests that set no TIMEOUT of their own
WALL_CLOCK = "_ctest_frontseat_driver_rostest_"


class Count:
    def __init__(self):
        self.passed = 0
        self.failed = 0
        self.failures = []  # test and first line of the reason


def known_tests(build_dir, pattern):
    listing = subprocess.check_output(["ctest", "--show-only=json-v1"], cwd=build_dir)
    names = [test["name"] for test in json.loads(listing.decode())["tests"]]
    return [name for name in names if re.search(pattern, name)]


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


def read_reports(folder, count):
    for root, _, names in os.walk(folder):
        for name in sorted(names):
            if not name.endswith(".xml"):
                continue
            try:
                add_report(os.path.join(root, name), count)
            except xml.ParseError as error:
                print("    %s: %s" % (name, error))
                count.failed += 1


def run(build_dir, name):
    count = attempt(build_dir, name)
    if count.failed and name.startswith(WALL_CLOCK):
        print("    once more:", flush=True)
        count = attempt(build_dir, name)
    return count


def attempt(build_dir, name):
    results = os.path.join(build_dir, "test_results")
    shutil.rmtree(results, ignore_errors=True)
    started = time.monotonic()
    command = ["ctest", "-R", "^%s$" % re.escape(name), "--timeout", str(TIMEOUT_S), "-V"]
    done = subprocess.run(command, cwd=build_dir, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    count = Count()
    read_reports(results, count)
    if done.returncode != 0 and count.failed == 0:
        count.failed = 1
    if count.passed + count.failed == 0:
        count.failed = 1
    report(name, count, time.monotonic() - started, done.stdout.decode(errors="replace"))
    keep(results, os.path.join(build_dir, "test_reports", name))
    return count


def report(name, count, seconds, output):
    word = "FAILED" if count.failed else "passed"
    print("%s  %-58s %5d passed %3d failed %7.1f s"
          % (word, short(name), count.passed, count.failed, seconds), flush=True)
    if count.failed:
        print("    " + output.replace("\n", "\n    "), flush=True)


def short(name):
    return re.sub(r"^_ctest_frontseat_driver_", "", name)


def keep(results, place):
    if os.path.isdir(results):
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(results, place)


def main():
    build_dir = sys.argv[1]
    pattern = sys.argv[2] if len(sys.argv) > 2 else ""
    shutil.rmtree(os.path.join(build_dir, "test_reports"), ignore_errors=True)
    total = Count()
    for name in known_tests(build_dir, pattern):
        count = run(build_dir, name)
        total.passed += count.passed
        total.failed += count.failed
        total.failures += count.failures or (["%s: no report" % name] if count.failed else [])
    for failure in total.failures:
        print("failed: " + failure)
    print("%d passed, %d failed" % (total.passed, total.failed), flush=True)
    return 0 if total.passed and not total.failed else 1


if __name__ == "__main__":
    sys.exit(main())
