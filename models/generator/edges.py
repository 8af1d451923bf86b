# SPDX-License-Identifier: BSD-3-Clause
"""Straight motions of given lengths in the worlds of the problems, to measure how long certifying takes."""
import math
import random

LENGTHS = (0.1, 0.5, 1, 2, 4)  # rad, in the joint space's Euclidean norm


def towards(start, target, length):
    distance = math.dist(start, target)
    return [a + (b - a) * length / distance for a, b in zip(start, target)]


def cut(arm, source, start, length):
    """A random direction from `start`, or from a random configuration, that stays within the limits."""
    while True:
        begin = start if start is not None else arm.random(source)
        target = arm.random(source)
        if math.dist(begin, target) > length:
            return begin, towards(begin, target, length)


def to_csv(arm, problems):
    """For each problem and length one motion from its start and one from anywhere. `problems`: set -> list of problems."""
    source, n = random.Random("edges"), len(arm.joints)
    rows = [["set", "index"] + [f"from{i}" for i in range(n)] + [f"to{i}" for i in range(n)] + ["length"]]
    for name, asked in problems.items():
        for problem in asked:
            for length in LENGTHS:
                for start in (problem["start"], None):
                    begin, end = cut(arm, source, start, length)
                    rows.append([name, str(problem["index"])] + [f"{v:.4f}" for v in (*begin, *end)] + [f"{length:g}"])
    return "".join(",".join(row) + "\n" for row in rows)
