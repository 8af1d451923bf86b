#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Breaks the library on purpose, one place at a time, and sees whether a test notices. See README.md."""

import argparse
import pathlib
import re
import sys
import time

from mutations import Malformed, read_all
from report import append_result, read_results, result_of, succeeded, table, verdict
from work_tree import Failed, WorkTree

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
RESULTS = HERE / "results.jsonl"
TABLE = HERE / "results.md"


def regex(text):
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not a regular expression: {error}")


def positive(text):
    if not text.isdigit() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number above 0")
    return int(text)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--list", action="store_true", help="print the mutations and end")
    what.add_argument("--check", action="store_true",
                      help="only see that each mutation fits the tree once, and that results.md is that of results.jsonl")
    what.add_argument("--report", action="store_true", help="write results.md from results.jsonl and end")
    parser.add_argument("--only", type=regex, metavar="REGEX", help="mutations whose COMPONENT/NAME has this in it")
    parser.add_argument("--work", metavar="DIR", help="folder for the copy of the tree, kept between runs")
    parser.add_argument("--again", action="store_true", help="run also what is in results.jsonl")
    parser.add_argument("--named", action="store_true",
                        help="run only the tests that a mutation names, and leave what these do not notice open")
    parser.add_argument("-j", type=positive, default=2, metavar="N", help="jobs of builds and tests (default: 2)")
    parser.add_argument("--timeout", type=positive, default=300, metavar="S",
                        help="s, after which a test without a limit of its own does not end (default: 300)")
    options = parser.parse_args()
    if not (options.list or options.check or options.report or options.work):
        parser.error("--work is needed: a folder for the copy of the tree")
    return options


def faults(mutations):
    """Prints what does not fit the tree; their number."""
    count = 0
    for mutation in mutations:
        fault = mutation.fault(SOURCE)
        if fault:
            print(f"{mutation.where}: {mutation.name}: {fault}", file=sys.stderr)
            count += 1
    return count


def judge(work, mutation, named_only):
    """Outcome, and the test that decided it. No outcome: the tests that it names do not notice."""
    first = work.matching(mutation.tests)
    if not work.build(first):
        return "does not compile", None
    failure = work.first_failure(first)
    if failure is None:
        if named_only:
            return None, None
        if not work.build():
            return "does not compile", None
        failure = work.first_failure([name for name in work.tests if name not in first])
    if failure is None:
        return "survived", None
    return ("does not end" if failure.timed_out else "caught"), failure.test


def try_one(work, mutation, named_only):
    begin = time.monotonic()
    work.mutate(mutation)
    try:
        outcome, test = judge(work, mutation, named_only)
    finally:
        work.restore(mutation)
    return {"mutation": mutation.name, "digest": mutation.digest(), "outcome": outcome, "by": test,
            "seconds": round(time.monotonic() - begin)}


def prepare(work, mutations):
    """Builds and runs, without a mutation, what the mutations name."""
    work.lock()
    work.sync()
    work.configure()
    named = set()
    for mutation in mutations:
        first = work.matching(mutation.tests)
        if not first:
            raise Failed(f"{mutation.where}: {mutation.name}: no test matches '{mutation.tests}'")
        named.update(first)
    work.require_passing(sorted(named))


def write_table(mutations):
    TABLE.write_text(table(mutations, read_results(RESULTS)))


def campaign(options, mutations, every_mutation):
    results = read_results(RESULTS)
    open_ones = [m for m in mutations if options.again or result_of(m, results) is None]
    work = WorkTree(SOURCE, options.work, options.j, options.timeout)
    if open_ones:
        prepare(work, open_ones)
    for number, mutation in enumerate(open_ones, 1):
        result = try_one(work, mutation, options.named)
        # Worth something only if the test that fails, or all of them, pass without it.
        if result["outcome"] == "survived":
            work.require_passing(sorted(work.tests))
        elif result["by"]:
            work.require_passing([result["by"]])
        if result["outcome"]:
            append_result(RESULTS, result)
            write_table(every_mutation)
        print(f"{number}/{len(open_ones)} {mutation.name}: {result['outcome'] or 'left open'} {result['by'] or ''}"
              f" ({result['seconds']} s)", flush=True)
    return conclude(mutations)


def conclude(mutations):
    results = read_results(RESULTS)
    print(verdict(mutations, results))
    return 0 if succeeded(mutations, results) else 1


def check(mutations, every_mutation):
    count = faults(mutations)
    if not TABLE.is_file() or TABLE.read_text() != table(every_mutation, read_results(RESULTS)):
        print("results.md is not what results.jsonl says; write it with --report", file=sys.stderr)
        count += 1
    if count == 0:
        print(f"{len(mutations)} mutations fit the tree")
    return min(count, 1)


def main():
    options = arguments()
    every_mutation = mutations = read_all(HERE / "mutations")
    if options.only:
        mutations = [m for m in mutations if options.only.search(f"{m.component}/{m.name}")]
        if not mutations:
            raise Failed(f"--only '{options.only.pattern}': no mutation has this in COMPONENT/NAME, see --list")
    if options.list:
        for mutation in mutations:
            print(f"{mutation.component}/{mutation.name}  {mutation.file}  {mutation.why}")
        return 0
    if options.check:
        return check(mutations, every_mutation)
    if options.report:
        write_table(every_mutation)
        return conclude(mutations)
    if faults(mutations):
        return 1
    return campaign(options, mutations, every_mutation)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Malformed, Failed) as error:
        print(f"mutate.py: error: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
