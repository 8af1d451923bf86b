#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""lint.py finds what is there, once, and looks again at what has changed and at nothing else.

usage: lint_test.py ROOT COMPILER
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT, COMPILER = Path(sys.argv[1]), sys.argv[2]
HALF = "#pragma once\ninline int half(int whole) { return whole / 2; }\n"
ONE = '#include "half.hpp"\nint one() { return half(2); }\n'
TWO = '#include "half.hpp"\nint two() { return half(4); }\n'
TYPED = """#include <gtest/gtest.h>
template <typename Number>
class Numbers : public testing::Test {};
TYPED_TEST_SUITE(Numbers, testing::Types<int>);
TYPED_TEST(Numbers, StartAtZero) { EXPECT_EQ(TypeParam(), 0); }
"""
NAMING = "invalid case style for function 'Twice' [readability-identifier-naming]"
ANY_NAME = """InheritParentConfig: true
CheckOptions:
  - { key: readability-identifier-naming.FunctionCase, value: aNy_CasE }
"""


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def expect(tree, what, status, *lines, names=()):
    path = f"{tree / 'tools'}:{os.environ['PATH']}"
    done = subprocess.run([sys.executable, "-B", ROOT / "tests/lint.py", tree, tree / "build", *names],
                          cwd=tree, text=True, capture_output=True, check=False, env=os.environ | {"PATH": path})
    printed = (done.stdout + done.stderr).splitlines()
    if done.returncode != status or len(printed) != len(lines) or any(
            line not in text for line, text in zip(lines, printed)):
        print(f"{what}: expected {status} and", *lines, f"but had {done.returncode} and", *printed, sep="\n  ")
        return False
    return True


def check(tree):
    for name in [".clang-tidy", "tests/cppcheck_suppressions.txt", "tests/cppcheck_googletest.cfg"]:
        write(tree / name, (ROOT / name).read_text(encoding="utf-8"))
    half, one, two = (tree / "core" / name for name in ("half.hpp", "one.cpp", "two.cpp"))
    generated = tree / "build/generated.cpp"
    for path, text in [(half, HALF), (one, ONE), (two, TWO), (generated, "int Generated() { return 1; }\n")]:
        write(path, text)
    command = [COMPILER, "-std=c++20", "-c"]
    write(tree / "build/compile_commands.json", json.dumps(
        [{"directory": str(tree / "build"), "file": str(path), "arguments": [*command, str(path)]}
         for path in (one, two, generated)]))

    yield expect(tree, "nothing to find", 0, "2 sources, 0 of them as they were, 0 findings")
    yield expect(tree, "nothing has changed", 0, "2 sources, 2 of them as they were, 0 findings")

    write(half, HALF + "inline int Twice(int half) { return 2 * half; }\n")
    found = f"core/half.hpp:3: {NAMING}"
    yield expect(tree, "a header of both", 1, found, "2 sources, 0 of them as they were, 1 findings")
    yield expect(tree, "what is known is said again", 1, found, "2 sources, 2 of them as they were, 1 findings")
    write(tree / "core/.clang-tidy", ANY_NAME)
    yield expect(tree, "settings of a folder", 0, "2 sources, 0 of them as they were, 0 findings")
    (tree / "core/.clang-tidy").unlink()
    yield expect(tree, "its parent's", 1, found, "2 sources, 0 of them as they were, 1 findings")
    yield expect(tree, "one source", 1, found, "1 sources, 1 of them as they were, 1 findings", names=["core/two.cpp"])

    write(half, HALF)
    write(one, ONE + "int none() {\n  int* p = nullptr;\n  return *p;\n}\n")
    found = "core/one.cpp:5: Null pointer dereference: p [cppcheck-nullPointer]"
    yield expect(tree, "cppcheck's", 1, found, "2 sources, 0 of them as they were, 1 findings", names=["core"])
    write(two, TWO + "// Changed.\n")
    yield expect(tree, "one has changed", 1, found, "2 sources, 1 of them as they were, 1 findings")
    # clang-tidy ends as by someone who interrupts it all.
    killed = tree / "tools/clang-tidy"
    write(killed, f'#!/bin/sh\n[ "$1" = --version ] || kill -9 $$\nexec {shutil.which("clang-tidy")} "$@"\n')
    killed.chmod(0o755)
    write(tree / "tests/cppcheck_suppressions.txt", "nullPointer\n")
    yield expect(tree, "settings of one tool", 0, "2 sources, 0 of them as they were, 0 findings")
    write(one, ONE + "int more() { return 1; }\n")
    yield expect(tree, "a tool that is killed", 1, "core/one.cpp:1: clang-tidy ends with -9:  [lint]",
                 "2 sources, 1 of them as they were, 1 findings")
    killed.unlink()
    yield expect(tree, "looks again", 0, "2 sources, 1 of them as they were, 0 findings")

    write(one, TYPED)
    yield expect(tree, "typed tests", 0, "2 sources, 1 of them as they were, 0 findings")

    write(one, "int one() { return undeclared; }\n")
    yield expect(tree, "an error", 1, "core/one.cpp:1: use of undeclared identifier 'undeclared'",
                 "2 sources, 1 of them as they were, 1 findings")
    write(one, '#include "absent.hpp"\n')
    yield expect(tree, "a header that is not there", 1, "core/one.cpp:1: does not compile: ",
                 "2 sources, 1 of them as they were, 1 findings")

    yield expect(tree, "a header", 2, "error: core/half.hpp: the build has no such source (a header is looked at "
                 "with those that include it)", names=["core/half.hpp"])
    yield expect(tree, "a wrong name", 2, "error: core/three.cpp: no such file or folder", names=["core/three.cpp"])
    yield expect(tree, "an empty folder", 2, "error: tests: the build has no source there", names=["tests"])
    write(one, ONE)
    write(tree / "core/left_out.cpp", "")
    yield expect(tree, "a source that is not built", 0, "core/left_out.cpp: not in this build, and so not looked at",
                 "2 sources, 1 of them as they were, 0 findings", names=["core"])


def main():
    with tempfile.TemporaryDirectory() as folder:
        results = list(check(Path(folder).resolve()))
    sys.exit(0 if results and all(results) else 1)


if __name__ == "__main__":
    main()
