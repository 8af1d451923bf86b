#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each public header of a component compiles on its own, and does not cost much.

usage: public_headers.py COMPILER FOLDER BASE[,BASE ...] LINES FLAG ...

Cost: the lines after preprocessing that it has beyond the headers BASE, which whoever includes it has
anyway; at most LINES.
"""
import subprocess
import sys
import tempfile
from pathlib import Path


def preprocess(compiler, flags, headers, target):
    source = "".join(f"#include <{header}>\n" for header in headers)
    subprocess.run([*compiler, "-E", "-P", "-x", "c++", "-", "-o", target, *flags],
                   input=source, text=True, check=True)
    with open(target, "rb") as file:
        return sum(1 for _ in file)


def compiles(compiler, flags, header):
    """Twice, as it may come to a source by two ways."""
    source = f"#include <{header}>\n#include <{header}>\n"
    return subprocess.run([*compiler, "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-",
                           *flags], input=source, text=True, check=False).returncode == 0


def main():
    compiler, folder, bases, most = [sys.argv[1], "-std=c++20"], Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])
    flags = sys.argv[5:]
    headers = sorted(str(path.relative_to(folder)) for path in folder.rglob("*.hpp"))
    failed = not headers
    with tempfile.TemporaryDirectory() as scratch:
        target = str(Path(scratch) / "preprocessed.ii")
        base = preprocess(compiler, flags, bases.split(","), target)
        for header in headers:
            alone = compiles(compiler, flags, header)
            lines = preprocess(compiler, flags, [header], target) - base if alone else 0
            wrong = "" if alone else ": does not compile on its own"
            if lines > most:
                wrong = f": more than {most}"
            failed = failed or bool(wrong)
            print(f"{header} {lines:+} lines{wrong}")
    print(f"{len(headers)} headers, beyond the {base} lines of {bases}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
