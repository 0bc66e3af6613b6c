#!/usr/bin/env python3
"""Tables of what codec_bench measured: codec_table.py codec.json"""

import json
import sys


def medians(path):
    with open(path) as file:
        runs = json.load(file)["benchmarks"]
    return {run["run_name"]: run for run in runs if run.get("aggregate_name") == "median"}


def decoding(runs):
    base = runs["decode/byte_wise_checksum"]["ns"]
    print("| decoding | ns per sentence | of the checksum | heap allocations |\n"
          "| --- | --- | --- | --- |")
    for name, run in runs.items():
        if name.startswith("decode/"):
            ns = run["ns"]
            print("| %s | %.0f | %.2f | %.2f |" % (
                name[len("decode/"):].replace("_", " "), ns, ns / base, run["allocations"]))


def encoding(runs):
    print("\n| encoding | ns | snprintf ns | ratio | heap allocations |\n"
          "| --- | --- | --- | --- | --- |")
    for name, run in runs.items():
        if name.startswith("encode/") and name.endswith("/this_writer"):
            sentence = name.split("/")[1]
            other = runs["encode/%s/snprintf" % sentence]["cpu_time"]
            print("| %s | %.0f | %.0f | %.2f | %.2f |" % (
                sentence, run["cpu_time"], other, run["cpu_time"] / other, run["allocations"]))


def main():
    runs = medians(sys.argv[1])
    decoding(runs)
    encoding(runs)


if __name__ == "__main__":
    main()
