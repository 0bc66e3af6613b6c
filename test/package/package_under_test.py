"""Where the package is, and how its tests report."""

import os
import re
import subprocess
import sys

import rosunit

NAME = "frontseat_driver"
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILT = ("build", "devel", "install", ".git")


def build_dir():
    options = [arg for arg in sys.argv if arg.startswith("--build-dir=")]
    return options[0].split("=", 1)[1] if options else os.path.join(ROOT, "build")


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def files(folder, *endings):
    """Paths below the repository's root, sorted."""
    found = []
    for root, folders, names in os.walk(os.path.join(ROOT, folder)):
        folders[:] = [name for name in folders if name != "__pycache__"]
        found += [os.path.relpath(os.path.join(root, name), ROOT) for name in names]
    return sorted(name for name in found if name.endswith(endings or ("",)))


def tracked_files():
    """Every file of the repository; without git, every file that is not built."""
    try:
        listing = subprocess.check_output(["git", "-C", ROOT, "ls-files"],
                                          stderr=subprocess.DEVNULL).decode()
        if listing:
            return [name for name in listing.splitlines()
                    if os.path.isfile(os.path.join(ROOT, name))]
    except (OSError, subprocess.CalledProcessError):
        pass
    return [name for name in files(".")
            if not re.match("|".join(BUILT), os.path.normpath(name))]


def parameters_in_code():
    """Every name that the parameter reader asks for."""
    code = read("src", "ros", "parameters.cpp")
    names = re.findall(r'\b(?:in|parameters)\.\w+(?:<[^()]*>)?\(\s*"(\w+)"', code)
    names += re.findall(r'\bread\w*\((?:in, )?"(\w+)"', code)
    return set(names)


def parameters_in_config(path):
    """The keys of a YAML file, the commented ones included."""
    return re.findall(r"^(?:# )?(\w+): ", read(path), flags=re.M)


def topics_in_code():
    return re.findall(r'constexpr char k\w+\[\] = "([^"]+)"', read("src", "ros", "topics.h"))


def run(test_case):
    rosunit.unitrun(NAME, test_case.__name__, test_case)
