# SPDX-License-Identifier: BSD-3-Clause
"""What a query from Python takes beyond the same query in C++; prints a table.

    PYTHONPATH=BUILD/ompl_bridge/python python3 tests/python/overhead.py BUILD/tests/python/swept_python_overhead

10000 states, each a small step from the one before; the first 1000 for queries one by one. Runs of both sides
alternate, and the least of each counts, as other programs only add to a time.
"""
import subprocess
import sys
import time

import numpy as np

import swept

MODEL = ["models/robots/rook7/rook7.urdf", "arm", "models/scenes/shelf.yaml"]
COUNT, FEW, ROUNDS = 10_000, 1000, 15


def least(queries, work):
    times = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        work()
        times.append((time.perf_counter() - begin) / queries)
    return min(times)


def python_side(checker, states):
    rows = list(states[: FEW + 1])
    check, certify = checker.check_state, checker.certify_motion

    def one_by_one():
        for q in rows[:FEW]:
            check(q)

    def motions_one_by_one():
        for a, b in zip(rows, rows[1:]):
            certify(a, b)

    def loop():
        for _ in zip(rows, rows[1:]):
            pass

    empty = least(FEW, loop)
    return {
        "check_state": least(FEW, one_by_one) - empty,
        "certify_motion": least(FEW, motions_one_by_one) - empty,
        "check_states": least(COUNT, lambda: checker.check_states(states)),
        "certify_motions": least(COUNT - 1, lambda: checker.certify_motions(states[:-1], states[1:])),
    }


def cpp_side(program, states):
    text = "\n".join(" ".join(x.hex() for x in row) for row in states.tolist())
    output = subprocess.run([program, *MODEL], input=text, capture_output=True, text=True, check=True).stdout
    return {name: float(value) for name, value in (line.split() for line in output.splitlines())}


def main():
    checker = swept.Checker(swept.Robot.load(MODEL[0]), MODEL[1], swept.World.load(MODEL[2]))
    random, group = np.random.default_rng(3), checker.group
    steps = random.uniform(-0.1, 0.1, (COUNT, 7))
    walk = checker.named_state("home") + 0.2 * np.cumsum(steps, axis=0)
    states = np.ascontiguousarray(np.clip(walk, group.lower, group.upper))
    ours, theirs = {}, {}
    for _ in range(5):
        for found, side in ((theirs, cpp_side(sys.argv[1], states)), (ours, python_side(checker, states))):
            for name, value in side.items():
                found[name] = min(value, found.get(name, value))
    print("| query | C++ | Python | more |\n|---|---|---|---|")
    for name, mine in ours.items():
        more = f"{mine / theirs[name] - 1:.1%}" if name.endswith("s") else f"{(mine - theirs[name]) * 1e9:.0f} ns"
        print(f"| `{name}` | {theirs[name] * 1e6:.3f} µs | {mine * 1e6:.3f} µs | {more} |")


if __name__ == "__main__":
    main()
