"""Gets one thing of the sources wrong at a time, and sees whether a test notices.

A copy of the repository is built once, without optimisation. Then, for each mutation that the rules
find in the files of guards.txt, the changed file alone is compiled, each of its guards is linked
with it, and run until one fails. A change that no guard notices has survived: it needs a test, or a
line in equivalent.txt that says why it changes nothing. A header's mutations build whatever
includes it. The repository itself is only read.
"""

import argparse
import collections
import concurrent.futures
import csv
import glob
import json
import os
import queue
import resource
import shlex
import shutil
import subprocess
import sys
import time

import rules

HERE = os.path.dirname(os.path.abspath(__file__))
REPOSITORY = os.path.dirname(os.path.dirname(HERE))
USUAL_RULES = ("sign", "scale", "axis", "time", "compare")
COMPILER = ["-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g0 -w",
            "-DCATKIN_ENABLE_TESTING=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
KILLED, SURVIVED, EXPLAINED, NO_PROGRAM = "killed", "survived", "explained", "no program"


class Guarded(collections.namedtuple("Guarded", "files rules guards")):
    """One line of guards.txt."""


def read_guards(path=os.path.join(HERE, "guards.txt")):
    rows = []
    with open(path) as file:
        for line in file:
            words = line.split("#")[0].split()
            if not words:
                continue
            more = tuple(word[1:] for word in words[1:] if word.startswith("+"))
            guards = tuple(word for word in words[1:] if not word.startswith("+"))
            rows.append(Guarded(words[0], USUAL_RULES + more, guards))
    return rows


ANY = "*"  # in equivalent.txt: whatever a line is changed to


def read_equivalent(path=os.path.join(HERE, "equivalent.txt")):
    """{(file, line before, line after or ANY): why}"""
    explained = {}
    name = old = new = None
    with open(path) as file:
        for line in file:
            text = line.strip()
            if line.startswith("#") or not text:
                continue
            if line.startswith("- "):
                old = text[2:]
            elif line.startswith("+ "):
                new = text[2:]
                explained[name, old, new] = ""
            elif line.startswith("  "):
                explained[name, old, new] = (explained[name, old, new] + " " + text).strip()
            else:
                name = text
    return explained


def is_explained(mutation, explained):
    path, old, new = mutation.key()
    return (path, old, new) in explained or (path, old, ANY) in explained


def known_words(root):
    """Names that the sources, messages and protocols use: what is none of them will not compile."""
    known = set()
    for pattern in ("src/**/*.cpp", "src/**/*.h", "include/**/*.h", "msg/*.msg", "srv/*.srv"):
        for path in glob.glob(os.path.join(root, pattern), recursive=True):
            with open(path) as file:
                known |= rules.words_of(file.read())
    for path in glob.glob(os.path.join(root, "proto/**/*.proto"), recursive=True):
        with open(path) as file:
            for word in rules.words_of(file.read()):
                known |= {word, "set_" + word, "has_" + word, "mutable_" + word}
    return known


def paths(root, pattern):
    return sorted(glob.glob(os.path.join(root, pattern), recursive=True))


def find_mutations(root, wanted):
    """(mutation, guards) of each file of the table; `wanted` are patterns of files, or nothing."""
    known = known_words(root)
    chosen = {path for pattern in wanted for path in paths(root, pattern)}
    seen = set()
    found = []
    for row in read_guards():
        for path in paths(root, row.files):
            name = os.path.relpath(path, root)
            if name in seen:
                continue
            seen.add(name)  # the first line of the table counts
            if wanted and path not in chosen:
                continue
            with open(path) as file:
                source = rules.Source(name, file.read(), known)
            found += [(mutation, row.guards) for mutation in source.mutations(row.rules)]
    return found


def run(command, timeout_s=600, **options):
    """True if it ended well in time."""
    done = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            stdin=subprocess.DEVNULL, **options)
    try:
        return done.wait(timeout_s) == 0
    except subprocess.TimeoutExpired:
        done.kill()
        done.wait()
        return False


class Program:
    """A test program of the build: `name` or `name:filter`, where the filter is GoogleTest's."""

    def __init__(self, build, guard):
        self.guard = guard
        self.target, _, self.filter = guard.partition(":")
        pattern = os.path.join(build, "**", self.target + ".dir", "link.txt")
        link = glob.glob(pattern, recursive=True)[0]
        self.folder = os.path.dirname(os.path.dirname(os.path.dirname(link)))
        with open(link) as file:
            self.link = shlex.split(file.read())
        if shutil.which("ld.lld"):
            self.link.insert(1, "-fuse-ld=lld")  # three times as fast
        self.limit_s = None

    def path(self):
        return os.path.normpath(os.path.join(self.folder, self.link[self.link.index("-o") + 1]))

    def link_with(self, item, output):
        """The object comes before the library that has the unchanged one, which then stays out."""
        command = list(self.link)
        command[command.index("-o") + 1] = output
        first = next(i for i, word in enumerate(command) if word.endswith(".o"))
        return run(command[:first] + [item] + command[first:], cwd=self.folder)

    def holds(self, library):
        return any(os.path.basename(word) == "lib%s.a" % library for word in self.link)

    def passes(self, program, timeout_s=None):
        command = [program] + (["--gtest_filter=" + self.filter] if self.filter else [])
        environment = dict(os.environ, GTEST_BREAK_ON_FAILURE="1")
        return run(command, timeout_s or self.limit_s, cwd=self.folder, env=environment)

    def measure(self):
        begin = time.monotonic()
        if not self.passes(self.path(), 600):
            sys.exit("mutate: %s fails without any mutation" % self.guard)
        self.limit_s = 30 + 10 * (time.monotonic() - begin)


class Workshop:
    """The copy of the repository, its build, and how one file of it is compiled."""

    def __init__(self, folder, jobs):
        self.source = os.path.join(folder, "source")
        self.build = os.path.join(folder, "build")
        self.scratch = os.path.join(folder, "scratch")
        self.jobs = jobs
        self.clang = shutil.which("clang++")  # twice as fast; the same ABI
        self.commands = {}
        self.programs = {}
        self.preambles = {}

    def copy(self):
        os.makedirs(self.source, exist_ok=True)
        os.makedirs(self.scratch, exist_ok=True)
        files = subprocess.check_output(["git", "ls-files", "-z"], cwd=REPOSITORY)
        for name in filter(None, files.decode().split("\0")):
            self._copy_file(name)

    def _copy_file(self, name):
        """Only what differs, so that a second run compiles what has changed since the first."""
        old, new = os.path.join(REPOSITORY, name), os.path.join(self.source, name)
        if not os.path.exists(old):
            return
        with open(old, "rb") as file:
            content = file.read()
        if os.path.exists(new):
            with open(new, "rb") as file:
                if file.read() == content:
                    return
        os.makedirs(os.path.dirname(new), exist_ok=True)
        with open(new, "wb") as file:
            file.write(content)
        os.chmod(new, os.stat(old).st_mode)

    def build_guards(self, guards):
        targets = sorted({guard.split(":")[0] for guard in guards})
        environment = dict(os.environ, BUILD_DIR=self.build, TARGETS=" ".join(targets),
                           JOBS=str(self.jobs))
        with open(os.path.join(self.scratch, "build.log"), "w") as log:
            status = subprocess.call([os.path.join(self.source, "scripts", "build")] + COMPILER,
                                     env=environment, stdout=log, stderr=log)
        if status != 0:
            sys.exit("mutate: the copy does not build; see " + log.name)
        with open(os.path.join(self.build, "compile_commands.json")) as file:
            for entry in json.load(file):
                name = os.path.relpath(entry["file"], self.source)
                self.commands[name] = (entry["directory"], shlex.split(entry["command"]))
        for guard in sorted(guards):
            self.programs[guard] = Program(self.build, guard)
            self.programs[guard].measure()

    def check(self, name, guards):
        """A guard without the file could not fail."""
        if name.endswith(".h"):
            return
        _, command = self.commands[name]
        library = command[command.index("-o") + 1].split("CMakeFiles/")[1].split(".dir/")[0]
        for guard in guards:
            if not self.programs[guard].holds(library):
                sys.exit("mutate: guards.txt: %s does not use %s" % (guard, name))

    def preamble(self, name):
        """The headers of a file, precompiled: the options that take them in."""
        path = os.path.join(self.source, os.path.dirname(name),
                            ".preamble_" + os.path.basename(name) + ".h")
        with open(os.path.join(self.source, name)) as file:
            lines = [line for line in file if line.startswith("#include")]
        with open(path, "w") as file:
            file.writelines(lines)
        output = path + (".pch" if self.clang else ".gch")
        folder, command = self.commands[name]
        command = self._changed(command, path, output)
        if not run(command[:1] + ["-x", "c++-header"] + command[1:], cwd=folder):
            raise RuntimeError("mutate: does not compile: " + " ".join(command))
        return ["-include-pch", output] if self.clang else ["-include", path]

    def prepare(self, seat, name, guards):
        """The preamble; with it the unchanged file has to survive, or nothing that dies counts."""
        preamble = self.preamble(name)
        with open(os.path.join(self.source, name)) as file:
            unchanged = rules.Mutation(name, "none", 0, "", "", file.read())
        outcome, guard = self.try_file(unchanged, guards, preamble, seat)
        if outcome != SURVIVED:
            raise RuntimeError("mutate: %s unchanged: %s %s" % (name, outcome, guard))
        return preamble

    def _changed(self, command, source, output):
        command = [self.clang or command[0]] + command[1:]
        command[command.index("-o") + 1] = output
        command[command.index("-c") + 1] = source
        return command

    def try_file(self, mutation, guards, preamble, seat):
        """What becomes of a mutation of a .cpp, and by which guard."""
        folder, name = os.path.split(os.path.join(self.source, mutation.path))
        source = os.path.join(folder, ".mutant%d_%s" % (seat, name))
        with open(source, "w") as file:
            file.write(mutation.text)
        item = os.path.join(self.scratch, "mutant%d.o" % seat)
        build_folder, command = self.commands[mutation.path]
        command = self._changed(command, source, item)
        compiled = run(command[:1] + preamble + command[1:], cwd=build_folder)
        os.unlink(source)
        if not compiled:
            return NO_PROGRAM, ""
        for guard in guards:
            program = os.path.join(self.scratch, "mutant%d" % seat)
            if not self.programs[guard].link_with(item, program):
                return NO_PROGRAM, guard
            if not self.programs[guard].passes(program):
                return KILLED, guard
        return SURVIVED, ""

    def try_header(self, mutation, guards):
        path = os.path.join(self.source, mutation.path)
        with open(path) as file:
            original = file.read()
        try:
            with open(path, "w") as file:
                file.write(mutation.text)
            for guard in guards:
                program = self.programs[guard]
                if not run(["make", "-C", self.build, "-j%d" % self.jobs, program.target]):
                    return NO_PROGRAM, guard
                if not program.passes(program.path()):
                    return KILLED, guard
            return SURVIVED, ""
        finally:
            with open(path, "w") as file:
                file.write(original)

    def try_all(self, found, tell):
        seats = queue.Queue()
        for seat in range(self.jobs):
            seats.put(seat)
        headers = [pair for pair in found if pair[0].path.endswith(".h")]
        files = [pair for pair in found if not pair[0].path.endswith(".h")]

        def seated(work, *arguments):
            seat = seats.get()
            try:
                return work(seat, *arguments)
            finally:
                seats.put(seat)

        def one(seat, mutation, guards, preamble):
            tell(mutation, *self.try_file(mutation, guards, preamble.result(), seat))

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            preambles = {}
            results = []
            for mutation, guards in files:
                name = mutation.path
                if name not in preambles:
                    preambles[name] = pool.submit(seated, self.prepare, name, guards)
                results.append(pool.submit(seated, one, mutation, guards, preambles[name]))
            for result in results:
                result.result()
        for mutation, guards in headers:
            tell(mutation, *self.try_header(mutation, guards))


class Report:
    """What became of each mutation; written down as it happens."""

    FIELDS = ("path", "line", "rule", "old", "new", "outcome", "guard")

    def __init__(self, path, total):
        self.explained = read_equivalent()
        self.total = total
        self.rows = []
        self.file = open(path, "w", newline="")
        self.writer = csv.writer(self.file)
        self.writer.writerow(self.FIELDS)
        self.begin = time.monotonic()

    def tell(self, mutation, outcome, guard):
        if outcome == SURVIVED and is_explained(mutation, self.explained):
            outcome = EXPLAINED
        row = (mutation.path, mutation.line, mutation.rule, mutation.old, mutation.new, outcome,
               guard)
        self.rows.append(row)
        self.writer.writerow(row)
        self.file.flush()
        if outcome == SURVIVED:
            self.show(row)
        if len(self.rows) % 100 == 0:
            print("... %d of %d in %.0f s" % (len(self.rows), self.total,
                                              time.monotonic() - self.begin), flush=True)

    @staticmethod
    def show(row):
        print("%s: %s:%d: %s\n- %s\n+ %s" % (row[5], row[0], row[1], row[2], row[3], row[4]),
              flush=True)

    def table(self):
        heads = (KILLED, EXPLAINED, SURVIVED, NO_PROGRAM)
        counts = collections.defaultdict(collections.Counter)
        for row in self.rows:
            counts[row[0]][row[5]] += 1
            counts["by rule: " + row[2]][row[5]] += 1
            counts["~"][row[5]] += 1
        print("%-48s %9s %9s %9s %9s %10s" % (("file", "mutations") + heads))
        for name in sorted(counts):
            count = counts[name]
            print("%-48s %9d %9d %9d %9d %10d" % (
                ("all" if name == "~" else name, sum(count.values())) +
                tuple(count[head] for head in heads)))
        print("%.0f s" % (time.monotonic() - self.begin))

    def count(self, outcome):
        return sum(row[5] == outcome for row in self.rows)


def survived_before(path):
    with open(path, newline="") as file:
        return {(row["path"], row["old"], row["new"]) for row in csv.DictReader(file)
                if row["outcome"] in (SURVIVED, NO_PROGRAM)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir")
    parser.add_argument("files", nargs="*", help="patterns of files; all of guards.txt if none")
    parser.add_argument("--list", action="store_true", help="the mutations, and nothing else")
    parser.add_argument("--again", action="store_true",
                        help="only what survived in the last run, after its tests were written")
    parser.add_argument("--jobs", type=int, default=int(os.environ.get("JOBS", "2")))
    arguments = parser.parse_intermixed_args()  # options may come before the files

    found = find_mutations(REPOSITORY, arguments.files)
    folder = os.path.realpath(os.path.join(arguments.build_dir, "mutation"))
    result = os.path.join(folder, "result.csv")
    if arguments.again:
        survivors = survived_before(result)
        found = [(mutation, guards) for mutation, guards in found if mutation.key() in survivors]
    if arguments.list:
        for mutation, _ in found:
            Report.show((mutation.path, mutation.line, mutation.rule, mutation.old, mutation.new,
                         "mutation"))
        return 0
    if not found:
        sys.exit("mutate: no mutation in " + (" ".join(arguments.files) or "what survived"))

    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    workshop = Workshop(folder, arguments.jobs)
    workshop.copy()
    workshop.build_guards({guard for _, guards in found for guard in guards})
    for name, guards in {(mutation.path, guards) for mutation, guards in found}:
        workshop.check(name, guards)
    report = Report(result, len(found))
    workshop.try_all(found, report.tell)
    report.table()
    return 1 if report.count(SURVIVED) else 0


if __name__ == "__main__":
    sys.exit(main())
