#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each public header of a component compiles on its own, and does not cost much.

usage: public_headers.py COMPILER FOLDER BASE[,BASE ...] LINES FLAG ...

Cost: the lines after preprocessing that it has beyond the headers BASE, which whoever includes it has
anyway; at most LINES.

The headers BASE and those of the standard library that includes.py knows by their names are precompiled,
which halves the work. So a header that does not include one of these compiles here: includes.py
finds a missing standard header by its text, and a base is looked for among what the header includes.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import includes

WARNINGS = ["-Wall", "-Wextra", "-Werror"]
# What a header names of a base, and what is only there if the base was included.
OF_BASES = {"Eigen::": "namespace Eigen", "ompl::": "namespace ompl", "og::": "namespace ompl", "ob::": "namespace ompl"}


def included(headers):
    return "".join(f"#include <{header}>\n" for header in headers)


def preprocess(compiler, flags, headers):
    return subprocess.run([*compiler, "-E", "-P", "-x", "c++", "-", *flags], input=included(headers),
                          capture_output=True, text=True, check=True).stdout


def precompile(compiler, flags, headers, target):
    """The path to include: the compiler takes the precompiled file beside it."""
    target.write_text(included(headers), encoding="utf-8")
    subprocess.run([*compiler, *WARNINGS, "-x", "c++-header", str(target), "-o", f"{target}.gch", *flags],
                   check=True)
    return ["-include", str(target)]


def compiles(compiler, flags, header):
    """Twice, as it may come to a source by two ways."""
    return subprocess.run([*compiler, "-fsyntax-only", *WARNINGS, "-x", "c++", "-", *flags],
                          input=included([header, header]), text=True, check=False).returncode == 0


def lacking(code, alone):
    """The bases that a header names, and that it does not include by any way."""
    return sorted({base for name, base in OF_BASES.items()
                   if re.search(rf"\b{name}", code) and not re.search(rf"\b{base}\b", alone)})


def main():
    compiler, folder, bases, most = [sys.argv[1], "-std=c++20"], Path(sys.argv[2]), sys.argv[3].split(","), int(sys.argv[4])
    flags = sys.argv[5:]
    headers = sorted(str(path.relative_to(folder)) for path in folder.rglob("*.hpp"))
    failed = not headers
    base = preprocess(compiler, flags, bases).count("\n")
    with tempfile.TemporaryDirectory() as scratch:
        precompiled = precompile(compiler, flags, [*bases, *includes.NAMES], Path(scratch) / "bases.hpp")
        for header in headers:
            wrong, lines = "", 0
            if compiles(compiler, [*precompiled, *flags], header):
                alone = preprocess(compiler, flags, [header])
                lines = alone.count("\n") - base
                code = includes.TEXT.sub("", (folder / header).read_text(encoding="utf-8"))
                if lacking(code, alone):
                    wrong = f": names what it does not include: {', '.join(lacking(code, alone))}"
                elif lines > most:
                    wrong = f": more than {most}"
            else:
                wrong = ": does not compile"
            failed = failed or bool(wrong)
            print(f"{header} {lines:+} lines{wrong}")
    print(f"{len(headers)} headers, beyond the {base} lines of {','.join(bases)}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
