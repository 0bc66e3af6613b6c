#!/usr/bin/env python3
"""nmea_decode as its users start it: every kind of input, its exit codes, memory and manners."""

import json
import os
import pty
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospy
import rosunit

from frontseat_driver.msg import Sentence

TIMEOUT_S = 120
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))
HERON = os.path.join(ROOT, "test", "captures", "heron_2014.nmea")
MISSING = os.path.join(tempfile.gettempdir(), "no", "such", "record")


def program():
    return [arg.split("=", 1)[1] for arg in sys.argv if arg.startswith("--program=")][0]


def framed(body):
    checksum = 0
    for byte in body.encode():
        checksum ^= byte
    return "$%s*%02X" % (body, checksum)


def limit_memory():
    """For a child process: what it allocates beyond this fails."""
    resource.setrlimit(resource.RLIMIT_DATA, (40000000, 40000000))


class Result:
    def __init__(self, code, out, err):
        self.code = code
        self.out = out
        self.err = err

    def rows(self):
        return [json.loads(line) for line in self.out.decode().splitlines()]


def decode(*arguments, **options):
    command = [options.pop("program", None) or program()] + list(arguments)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          timeout=TIMEOUT_S, **options)
    return Result(done.returncode, done.stdout, done.stderr)


def pcap(segments):
    """A capture of raw IP packets from port 29500: (seconds, sequence, bytes)."""
    file = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101)
    for seconds, sequence, data in segments:
        tcp = struct.pack(">HHIIBBHHH", 29500, 40000, sequence, 0, 0x50, 0x18, 8192, 0, 0) + data
        ip = struct.pack(">BBHHHBBHII", 0x45, 0, 20 + len(tcp), 0, 0, 64, 6, 0, 1, 2)
        file += struct.pack("<IIII", seconds, 0, 20 + len(tcp), 20 + len(tcp)) + ip + tcp
    return file


class Decode(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())
        return self.path(name)

    def write_bag(self, name, *vehicles):
        with rosbag.Bag(self.path(name), "w") as bag:
            for vehicle in vehicles:
                for second, direction in ((10, "rx"), (11, "tx")):
                    sentence = Sentence(sentence=framed(
                        "BFVER,000102,a" if direction == "rx" else "BPVER,000102,b"))
                    sentence.header.stamp = rospy.Time(second, 500000000)
                    bag.write("%s/nmea/%s" % (vehicle, direction), sentence, rospy.Time(second + 1))
        return self.path(name)

    def assert_refused(self, code, words, *arguments, **options):
        result = decode(*arguments, **options)
        self.assertEqual(code, result.code, result.err)
        self.assertEqual(b"", result.out)
        self.assertEqual(1, result.err.count(b"\n"), result.err)
        self.assertIn(words, result.err.decode())

    def test_reads_a_text_log(self):
        result = decode(HERON)
        self.assertEqual(0, result.code)
        lines = result.out.decode().splitlines()
        self.assertEqual(14, len(lines))
        self.assertEqual(
            "< CPRBS battery: sent at 15:02:18.154, battery id -, stack 15.091787 V, lowest cell "
            "15.091787 V, highest cell 15.091787 V, temperature 0 degC", lines[11])
        self.assertIn("14 sentences: 14 from the vehicle", result.err.decode())

    def test_summary_alone_is_on_standard_output(self):
        result = decode("--summary", HERON)
        self.assertTrue(result.out.startswith(b"14 sentences"))
        self.assertEqual(b"", result.err)

    def test_quiet_leaves_standard_error_alone(self):
        self.assertEqual(b"", decode("--quiet", HERON).err)

    def test_selects(self):
        rows = decode("--format", "json", "--only", "nvg,GPGGA", "--except", "GGA", HERON).rows()
        self.assertEqual(["CPNVG", "CPNVG"], [row["sentence"] for row in rows])
        rows = decode("--format", "json", "--only", "RBS", "--from", "0", "--to", "1e9", HERON)
        self.assertEqual(2, rows.code)

    def test_reads_standard_input_by_name_and_without(self):
        with open(HERON, "rb") as heron:
            capture = heron.read()
        expected = decode("--quiet", HERON).out
        for arguments in ((), ("-",)):
            self.assertEqual(expected, decode("--quiet", *arguments, input=capture).out)

    def test_shows_a_line_from_a_pipe_before_the_next_comes(self):
        process = subprocess.Popen([program(), "--quiet"], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE)
        try:
            for number in range(3):
                process.stdin.write((framed("BFVER,000102,v%d" % number) + "\r\n").encode())
                process.stdin.flush()
                self.assertIn(b'"v%d"' % number, process.stdout.readline())
        finally:
            process.stdin.close()
            self.assertEqual(0, process.wait(TIMEOUT_S))
            process.stdout.close()

    def test_reads_a_serial_device_until_interrupted(self):
        master, slave = pty.openpty()
        process = subprocess.Popen(
            [program(), os.ttyname(slave), "--baud", "9600", "--format", "json"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            # Until it is raw, the device may lose or change what comes.
            while True:
                os.write(master, (framed("BFVER,000102,v") + "\r\n").encode())
                line = process.stdout.readline()
                self.assertTrue(line)
                row = json.loads(line.decode())
                if "fields" in row:
                    break
            self.assertEqual("v", row["fields"]["version"])
            self.assertGreater(row["time_s"], 1.4e9)  # when it came
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=TIMEOUT_S)
            self.assertEqual(0, process.returncode)
            self.assertIn(b"from the vehicle", err)
        finally:
            if process.poll() is None:
                process.kill()
            os.close(master)
            os.close(slave)

    def test_reads_a_packet_capture(self):
        a, b = [(framed("BFVER,000102," + text) + "\r\n").encode() for text in "ab"]
        name = self.write("sea.pcap", pcap([(5, 0, a), (6, 0, a), (7, len(a), b)]))
        result = decode("--format", "json", name)
        self.assertEqual([(5, "a"), (7, "b")],
                         [(row["time_s"], row["fields"]["version"]) for row in result.rows()])
        self.assertIn(b"bytes of TCP sent again                %d" % len(a), result.err)
        with open(name, "rb") as file:
            self.assertEqual(2, len(decode("--format", "json", input=file.read()).rows()))
        self.assertEqual(0, len(decode("--format", "json", "--port", "1", name).rows()))

    def test_reads_a_bag(self):
        rows = decode("--format", "json", self.write_bag("one.bag", "/alpha")).rows()
        self.assertEqual([(10.5, "rx", "BFVER"), (11.5, "tx", "BPVER")],
                         [(row["time_s"], row["direction"], row["sentence"]) for row in rows])

    def test_asks_which_vehicle_of_a_bag(self):
        name = self.write_bag("two.bag", "/alpha", "/beta")
        self.assert_refused(1, "/alpha, /beta", name)
        self.assert_refused(1, "no vehicle gamma", name, "--vehicle", "gamma")
        self.assertEqual(2, len(decode("--format", "json", "--vehicle", "beta", name).rows()))

    def test_refuses_a_bag_that_cannot_be_read(self):
        with open(self.write_bag("one.bag", ""), "rb") as file:
            bag = file.read()
        self.assert_refused(1, "name it", input=bag)
        for size in range(13, len(bag), max(1, len(bag) // 50)):
            result = decode("--quiet", self.write("cut.bag", bag[:size]))
            self.assertEqual(1, result.code, size)
            self.assertIn(b"cut.bag", result.err)
        with rosbag.Bag(self.path("other.bag"), "w"):
            pass
        self.assert_refused(1, "has no topic", self.path("other.bag"))

    def test_names_what_it_cannot_read(self):
        self.assert_refused(1, "No such file", MISSING)
        self.assert_refused(1, "Is a directory", self.folder)
        self.assert_refused(1, r"a\x0ab", self.path("a\nb"))
        self.assert_refused(1, "zcat", self.write("log.gz", b"\x1f\x8b\x08" + b"x" * 20))

    def test_names_the_option_that_is_wrong(self):
        for words, arguments in (("--bogus", ["--bogus"]), ("--only", ["--only", "N"]),
                                 ("--from", ["--from", "soon"]), ("--format", ["--format", "xml"]),
                                 ("--output", ["--output", "x"]), ("--port", ["--port", "0"]),
                                 ("--output DIR", ["--format", "csv"])):
            self.assert_refused(2, words, HERON, *arguments)

    def test_help_needs_nothing(self):
        result = decode("--help")
        self.assertEqual(0, result.code)
        self.assertIn(b"--summary", result.out)

    def test_writes_tables(self):
        result = decode("--format", "csv", "--output", self.path("tables"), HERON)
        self.assertEqual((0, b""), (result.code, result.out))
        self.assertEqual(sorted(name + ".csv" for name in (
            "GGA", "IMU", "NVG", "NVR", "RBS", "RCM", "RMC", "VTG", "unknown")),
                         sorted(os.listdir(self.path("tables"))))
        self.assert_refused(1, "No such file", "--format", "csv", "--output", MISSING, HERON)

    def test_ends_when_nobody_reads(self):
        process = subprocess.Popen([program(), "--quiet"], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE)
        process.stdout.close()
        try:
            process.communicate((framed("BFVER,000102,a") + "\n").encode() * 100000,
                                timeout=TIMEOUT_S)
        except BrokenPipeError:
            pass
        self.assertEqual(-signal.SIGPIPE, process.wait(TIMEOUT_S))

    def test_plots_with_the_program_beside_it(self):
        copy = shutil.copy(program(), self.path("nmea_decode"))
        self.assert_refused(1, "nmea_plot", "--plot", "a b.png", HERON, program=copy)
        self.write("nmea_plot", "#!/bin/sh\nprintf '%s|' \"$@\"\nexit 7\n")
        os.chmod(self.path("nmea_plot"), 0o755)
        result = decode("--plot", "a b;c.png", "in put", program=copy)
        self.assertEqual((7, b"in put|a b;c.png|"), (result.code, result.out))

    def test_plots_only_the_whole_record(self):
        """What nmea_plot cannot do is refused, not left out."""
        copy = shutil.copy(program(), self.path("nmea_decode"))
        self.write("nmea_plot", "#!/bin/sh\nprintf plotted\n")
        os.chmod(self.path("nmea_plot"), 0o755)
        for name, value in (("--from", "1"), ("--to", "1"), ("--only", "NVG"), ("--except", "NVG"),
                            ("--dialect", "sandshark"), ("--port", "29501"), ("--baud", "9600"),
                            ("--format", "json"), ("--output", "x")):
            self.assert_refused(2, name + " does not go with --plot", "--plot", "a.png", name, value,
                                HERON, program=copy)
        self.assert_refused(2, "--summary does not go with --plot", "--plot", "a.png", "--summary",
                            HERON, program=copy)
        result = decode("--plot", "a.png", "--quiet", "--vehicle", "/", HERON, program=copy)
        self.assertEqual((0, b"plotted"), (result.code, result.out))

    def test_takes_little_memory_and_counts_right(self):
        """50 MB of log in less memory than that, whatever it is made of."""
        block = "".join(
            "%d.5 < %s\r\n" % (1416410000 + i, framed("BFNVR,000102,%d,2,3,4,5,6" % i))
            for i in range(1000)) + "$BFNVR,bad*00\n" + "x" * 5000 + "\n$" + "y" * 2000 + "\n"
        times = 50000000 // len(block) + 1
        name = self.path("big.txt")
        with open(name, "w") as file:
            for _ in range(times):
                file.write(block)
        result = decode("--summary", name, preexec_fn=limit_memory)
        self.assertEqual(0, result.code, result.err)
        summary = result.out.decode()
        self.assertIn("%d sentences: %d from the vehicle, 0 to it" % (times * 1001, times * 1001),
                      summary)
        for words, count in (("wrong checksum", times), ("too long", times),
                             ("lines without a sentence", times)):
            self.assertRegex(summary, r"%s +%d\b" % (words, count))
        tables = decode("--quiet", "--format", "csv", "--output", self.path("tables"), name,
                        preexec_fn=limit_memory)
        self.assertEqual(0, tables.code, tables.err)
        with open(self.path("tables/NVR.csv")) as file:
            self.assertEqual(times * 1000 + 1, sum(1 for _ in file))

    def test_survives_garbage(self):
        garbage = bytes(bytearray((i * 7919 + i // 251) % 256 for i in range(300000)))
        for head in (b"", b"$", b"\xd4\xc3\xb2\xa1", b"\x0a\x0d\x0d\x0a", b"#ROSBAG V2.0\n"):
            name = self.write("garbage", head + garbage)
            for form in ("lines", "json"):
                result = decode("--format", form, name)
                self.assertIn(result.code, (0, 1), result.err)
                self.assertTrue(all(32 <= byte < 127 or byte == 10 for byte in result.out))


if __name__ == "__main__":
    rosunit.unitrun("frontseat_driver", "Decode", Decode)
