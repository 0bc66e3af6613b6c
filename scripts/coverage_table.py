"""Adds gcovr's summary up by layer: coverage_table.py summary.json"""

import collections
import json
import sys

LEAST_LINES, LEAST_BRANCHES = 95.0, 90.0
ABOVE = ("ros",)  # the limits are for the layers below


def layer_of(path):
    parts = path.split("/")
    return parts[2] if parts[0] == "include" else parts[1]


def percent(part):
    covered, total = part
    return 100.0 * covered / total if total else 100.0


def main():
    with open(sys.argv[1]) as file:
        files = json.load(file)["files"]
    if not files:
        sys.exit("nothing was measured; gcovr.log in the same folder says why")
    lines = collections.defaultdict(lambda: [0, 0])
    branches = collections.defaultdict(lambda: [0, 0])
    for one in files:
        layer = layer_of(one["filename"])
        for total, kind in ((lines, "line"), (branches, "branch")):
            total[layer][0] += one[kind + "_covered"]
            total[layer][1] += one[kind + "_total"]
    failed = False
    print("%-10s %9s %9s %9s %9s" % ("layer", "lines", "covered", "branches", "covered"))
    for layer in sorted(lines):
        low = layer not in ABOVE and (percent(lines[layer]) < LEAST_LINES
                                      or percent(branches[layer]) < LEAST_BRANCHES)
        failed |= low
        print("%-10s %9d %8.1f%% %9d %8.1f%% %s"
              % (layer, lines[layer][1], percent(lines[layer]), branches[layer][1],
                 percent(branches[layer]), "too low" if low else ""))
    least = sorted(files, key=lambda one: one["line_covered"] - one["line_total"])[:10]
    print("most lines missed: " + ", ".join(
        "%s %d" % (one["filename"], one["line_total"] - one["line_covered"]) for one in least))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
