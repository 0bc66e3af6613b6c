#!/usr/bin/env python3
"""What clang-tidy has to look through: lint_units.py BUILD_DIR SOURCE...

One line for each: files that are compiled together (FRONTSEAT_QUICK_BUILD) are looked through
together, which takes a tenth of the time, since most of it goes into the headers that they share.
"""

import json
import os
import re
import sys


def united(path):
    """The sources that CMake compiles together in this file."""
    with open(path) as file:
        return re.findall(r'^#include "(.*)"', file.read(), re.M)


def main():
    with open(os.path.join(sys.argv[1], "compile_commands.json")) as file:
        compiled = {command["file"] for command in json.load(file)}
    units = sorted(path for path in compiled if "/Unity/" in path)
    covered = {source for unit in units for source in united(unit)}
    sources = [os.path.realpath(source) for source in sys.argv[2:]]
    print("\n".join(units + [source for source in sources if source not in covered]))


if __name__ == "__main__":
    main()
