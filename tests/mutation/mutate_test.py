# SPDX-License-Identifier: BSD-3-Clause
"""Runs mutate.py on a tree of a few lines, with one mutation for each outcome."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

PROJECT = """cmake_minimum_required(VERSION 3.22)
project(few_lines CXX)
enable_testing()
add_compile_options(-Wall -Wextra -Werror)
add_library(numbers numbers.cpp)
foreach(test one two steps)
  add_executable(${test} ${test}.cpp)
  target_link_libraries(${test} numbers)
  add_test(NAME ${test} COMMAND ${test})
endforeach()
add_test(NAME speed COMMAND ${CMAKE_COMMAND} -E false)
set_tests_properties(speed PROPERTIES LABELS instructions)
"""
SOURCES = {
    "numbers.cpp": "int one() { return 1; }\nint two() { return 2; }\nint three() { return 3; }\nint step() { return 1; }\n",
    "one.cpp": "int one();\nint main() { return one() == 1 ? 0 : 1; }\n",
    "two.cpp": "int two();\nint main() { return two() == 2 ? 0 : 1; }\n",
    "steps.cpp": "int step();\nint main() { for (volatile int i = 0; i < 3; i = i + step()) {} }\n",
}
# Name, function, what it becomes, tests to ask first; outcome and who found it, with those alone and with all.
MUTATIONS = [
    ("named", "int one() { return 1; }", "int one() { const double left = 1.0; return 7; }", "one", ("caught", "one"), ("caught", "one")),
    ("crash", "int one() { return 1; }", "int one() { __builtin_trap(); }", "one", ("caught", "one"), ("caught", "one")),
    ("elsewhere", "int two() { return 2; }", "int two() { return 7; }", "one", None, ("caught", "two")),
    ("endless", "int step() { return 1; }", "int step() { return 0; }", "steps",
     ("does not end", "steps"), ("does not end", "steps")),
    ("unnoticed", "int three() { return 3; }", "int three() { return 7; }", "one|two", None, ("survived", None)),
    ("broken", "int three() { return 3; }", "int three() { return it; }", "one",
     ("does not compile", None), ("does not compile", None)),
]


def make_tree(tree):
    folder = tree / "tests" / "mutation"
    (folder / "mutations").mkdir(parents=True)
    for script in HERE.glob("*.py"):
        shutil.copy(script, folder)
    (tree / "CMakeLists.txt").write_text(PROJECT)
    for name, text in SOURCES.items():
        (tree / name).write_text(text)
    with (folder / "mutations" / "numbers.txt").open("w") as file:
        for name, original, replacement, tests, *_ in MUTATIONS:
            file.write(f"= {name}\nfile: numbers.cpp\nwhy: -\ntests: {tests}\n"
                       f"<<<<\n{original}\n====\n{replacement}\n>>>>\n")
    subprocess.run(["git", "init", "-q", tree], check=True)


def run(tree, *arguments):
    return subprocess.run([sys.executable, "-B", tree / "tests/mutation/mutate.py", *arguments],
                          capture_output=True, text=True)


def require(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


def require_results(tree, column):
    found = {}
    for line in (tree / "tests/mutation/results.jsonl").read_text().splitlines():
        result = json.loads(line)
        require(result["mutation"] not in found, f"{result['mutation']} was run twice")
        found[result["mutation"]] = (result["outcome"], result["by"])
    wanted = {m[0]: m[column] for m in MUTATIONS if m[column]}
    require(found == wanted, f"results are {found}, not {wanted}")


def test_outcomes(tree, work):
    first = run(tree, "--work", work, "--timeout", "10", "--named")
    require(first.returncode == 1, f"--named ends with {first.returncode}: {first.stderr}")
    require_results(tree, 4)
    # As if it had been killed within a mutation.
    (work / "tree" / "numbers.cpp").write_text("int one() { return 7; }\n")
    second = run(tree, "--work", work, "--timeout", "10")
    require(second.returncode == 1, f"the campaign ends with {second.returncode}: {second.stderr}")
    require_results(tree, 5)
    score = "66.7 % of 6 mutations caught, 0 not run."
    require(score in second.stdout, f"score: {second.stdout}")
    require(score in (tree / "tests/mutation/results.md").read_text(), "results.md is not written")
    require((work / "tree" / "numbers.cpp").read_text() == SOURCES["numbers.cpp"], "the text is not put back")
    good = run(tree, "--work", work, "--only", "named|elsewhere")
    require(good.returncode == 0, f"two that are caught end with {good.returncode}: {good.stdout}")


def test_faults(tree):
    require(run(tree, "--check").returncode == 0, "mutations that fit are refused")
    numbers = tree / "numbers.cpp"
    for text in (SOURCES["numbers.cpp"].replace("return 2", "return 4"), 2 * SOURCES["numbers.cpp"]):
        numbers.write_text(text)
        require(run(tree, "--check").returncode == 1, f"mutations seem to fit {text}")
    numbers.write_text(SOURCES["numbers.cpp"].replace("return 1", "return 4"))
    wrong = run(tree, "--check")
    require("numbers.txt:1: named: its text occurs 0 times" in wrong.stderr, f"said is: {wrong.stderr}")
    numbers.write_text(SOURCES["numbers.cpp"])
    results = tree / "tests/mutation/results.md"
    results.write_text(results.read_text().replace("caught by", "missed by", 1))
    stale = run(tree, "--check")
    require(stale.returncode == 1, "a table that is not that of the results is taken")
    require("results.md is not what results.jsonl says" in stale.stderr, f"said is: {stale.stderr}")
    require(run(tree, "--report").returncode == 1, "a table with a survivor is a success")
    require(run(tree, "--check").returncode == 0, "the table that was written anew is refused")


with tempfile.TemporaryDirectory() as folder:
    make_tree(pathlib.Path(folder) / "tree")
    test_outcomes(pathlib.Path(folder) / "tree", pathlib.Path(folder) / "work")
    test_faults(pathlib.Path(folder) / "tree")
