#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""include_cycles.py refuses a tree whose folders include each other, names the lines, and lets others be.

usage: include_cycles_test.py
"""
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent / "include_cycles.py"


def write(tree, name, *included):
    path = tree / "part/src" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(["#pragma once\n", *(f'#include "{other}"\n' for other in included)]), encoding="utf-8")


def expect(tree, what, status, *lines):
    done = subprocess.run([sys.executable, "-B", SCRIPT, tree], text=True, capture_output=True, check=False)
    printed = (done.stdout + done.stderr).splitlines()
    if (done.returncode, printed) != (status, list(lines)):
        print(f"{what}: expected {status} and", *lines, f"but had {done.returncode} and", *printed, sep="\n  ")
        return False
    return True


def check(tree):
    write(tree, "low/number.hpp", "vector")
    write(tree, "low/sum.hpp", "low/number.hpp")
    write(tree, "middle/line.hpp", "low/sum.hpp")
    write(tree, "high/shape.cpp", "middle/line.hpp", "low/number.hpp")
    passed = expect(tree, "without a cycle", 0, "part/src: low | middle | high")
    write(tree, "middle/plane.cpp", "middle/line.hpp", "high/shape.hpp")
    write(tree, "high/shape.hpp", "low/number.hpp")
    passed &= expect(tree, "a cycle of two", 1, "part/src: folders include each other:",
                     "  high includes middle:", "    high/shape.cpp:2: middle/line.hpp",
                     "  middle includes high:", "    middle/plane.cpp:3: high/shape.hpp")
    write(tree, "middle/plane.cpp", "middle/line.hpp")
    write(tree, "low/sum.cpp", "low/sum.hpp", "high/shape.hpp")
    return passed & expect(tree, "a cycle of three, of which two are one too", 1,
                           "part/src: folders include each other:",
                           "  high includes low:", "    high/shape.cpp:3: low/number.hpp",
                           "    high/shape.hpp:2: low/number.hpp",
                           "  low includes high:", "    low/sum.cpp:3: high/shape.hpp")


def main():
    with tempfile.TemporaryDirectory() as folder:
        return 0 if check(Path(folder)) else 1


if __name__ == "__main__":
    sys.exit(main())
