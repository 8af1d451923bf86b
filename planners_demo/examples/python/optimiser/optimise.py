# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory optimiser in numpy: it makes RRT-Connect's paths short, smooth and clear of bodies, and proves them.

    optimise.py MODELS
    optimise.py PROBLEMS.json ROBOT.urdf GROUP [PER_SET]

Runs problems of MotionBenchMaker, and prints for each set how many RRT-Connect solves, for how many the optimiser has a
proven trajectory, and medians: lengths (rad) and clearances (mm) of both and of shorten_path, times. Exits 0 if at least
nine of ten have one and are shorter.
"""
import sys
import time
from typing import List, NamedTuple, Optional

import numpy as np

import swept

POINTS = 24  # way points between the ends
ROUNDS = 100
STIFFNESS = 6.0  # of the elastic band in each round
DISTANCE = 0.01  # m, from which on bodies push way points away
MARGIN = 0.003  # m that all motions keep, or half of what the first path does if that is less
LONGEST = 0.15  # rad, step of a way point
LEAST_SHARE = 0.1  # of a step, below which a way point stays where it is


class Outcome(NamedTuple):
    lengths: List[float]  # rad: of RRT-Connect's path, of the optimised one, of that of shorten_path
    clearances: List[float]  # mm, likewise
    milliseconds: List[float]  # of planning and optimising
    duration: float  # s, of the curve
    proven: bool

    def values(self) -> List[float]:
        return self.lengths + self.clearances + self.milliseconds + [self.duration]


def length(path: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def resampled(path: np.ndarray, count: int) -> np.ndarray:
    """The same path with way points at equal distances, and all of its own corners."""
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    shares = np.union1d(np.linspace(0.0, at[-1], count + 2), at)
    keep = np.concatenate([[True], np.diff(shares) > 1e-6])
    return np.column_stack([np.interp(shares[keep], at, column) for column in path.T])


def pushes(checker: swept.Checker, path: np.ndarray) -> np.ndarray:
    """For each way point the step that makes up for the missing distance, along the gradient of its clearance."""
    steps = np.zeros_like(path)
    for i, q in enumerate(path[1:-1], 1):
        found, gradient = checker.signed_clearance(q, gradient=True)
        missing, steep = DISTANCE - found.upper, float(gradient @ gradient)
        if missing > 0.0 and steep > 1e-6:
            steps[i] = missing / steep * gradient
    return steps


def optimised(checker: swept.Checker, path: np.ndarray) -> np.ndarray:
    """An elastic band over proven motions of joints with limits: what a round moves and cannot prove, it puts back."""
    group, band = checker.group, resampled(path, POINTS)
    inner = len(band) - 2
    laplacian = 2.0 * np.eye(inner) - np.eye(inner, k=1) - np.eye(inner, k=-1)
    for _ in range(ROUNDS):
        # One implicit step of (tension + pushes), as CHOMP's covariant gradient (Ratliff et al. 2009).
        pulled = band[1:-1] + pushes(checker, band)[1:-1]
        pulled[0] += STIFFNESS * band[0]
        pulled[-1] += STIFFNESS * band[-1]
        steps = np.linalg.solve(np.eye(inner) + STIFFNESS * laplacian, pulled) - band[1:-1]
        lengths = np.linalg.norm(steps, axis=1, keepdims=True)
        steps *= np.minimum(1.0, LONGEST / np.maximum(lengths, 1e-12))
        # The largest of these steps that are proven: where a motion is refused, both its ends step half as far.
        shares = np.ones((inner, 1))
        while True:
            wanted = band.copy()
            wanted[1:-1] = np.clip(band[1:-1] + shares * steps, group.lower, group.upper)
            proven = checker.certify_motions(wanted[:-1], wanted[1:], swept.MotionQuery.VERDICT_ONLY).verdicts
            refused = np.flatnonzero(proven != swept.Verdict.FREE)
            if len(refused) == 0:
                break
            ends = np.union1d(refused, refused + 1) - 1
            ends = ends[(ends >= 0) & (ends < inner)]
            if not shares[ends].any():  # the path itself cannot be proven with the margin
                return path
            shares[ends] = np.where(shares[ends] > LEAST_SHARE, 0.5 * shares[ends], 0.0)
        moved, band = np.abs(wanted - band).max(), wanted
        if moved < 1e-3:
            break
    return band


def solve(checker: swept.Checker, start: np.ndarray, goal: np.ndarray, limits: swept.RateLimits) -> Optional[Outcome]:
    plan = swept.plan(checker, start, goal, planner="RRTConnect", shorten=False, seconds=5.0)
    if not plan or plan.path is None:
        return None
    begin = time.perf_counter()
    least = swept.path_clearance(checker, plan.path)
    rules = swept.CollisionRules().margin("*", "*", min(MARGIN, 0.5 * max(0.0, least.lower)))
    path = optimised(checker.with_rules(rules.over(checker.rules)), plan.path)
    proven = swept.proven_trajectory(checker, path, limits)
    seconds = time.perf_counter() - begin
    paths = (plan.path, path, swept.shorten_path(checker, plan.path))
    clearances = [1e3 * swept.path_clearance(checker, one).upper for one in paths]
    milliseconds = [1e3 * plan.seconds, 1e3 * seconds]
    return Outcome([length(one) for one in paths], clearances, milliseconds, proven.curve.duration, bool(proven))


HEADINGS = "set problems solved optimised length after shortened mm after shortened plan_ms opt._ms curve_s".split()
ROW = "{:18}" + len(HEADINGS[1:]) * " {:>9}"


def print_row(name: str, asked: int, outcomes: List[Outcome]) -> None:
    medians = np.median([one.values() for one in outcomes], axis=0) if outcomes else np.full(9, np.nan)
    counts = (asked, len(outcomes), sum(one.proven for one in outcomes))
    print(ROW.format(name, *counts, *(f"{value:.3g}" for value in medians)), flush=True)


def main(arguments: List[str]) -> int:
    models = arguments[0] if arguments else "models"
    own = [f"{models}/problems.json", f"{models}/robots/rook7/rook7.urdf", "arm"]
    problems, urdf, group = arguments[:3] if len(arguments) > 2 else own
    per_set = int(arguments[3]) if len(arguments) > 3 else 2
    file, empty = swept.ProblemFile.load(problems), swept.Checker(swept.Robot.load(urdf), group)
    limits = swept.RateLimits(empty, acceleration=5.0)  # rad/s^2
    print(ROW.format(*HEADINGS))
    everything: List[Outcome] = []
    asked = 0
    for name in file.sets:
        indices = file.indices(name)[:per_set]
        outcomes = []
        for index in indices:
            problem = file.problem(name, index)
            start, goal = (empty.configuration(dict(zip(problem.joint_names, map(float, end))))
                           for end in (problem.start, problem.goals[0]))
            found = solve(empty.with_world(problem.world), start, goal, limits)
            outcomes += [] if found is None else [found]
        print_row(name, len(indices), outcomes)
        everything += outcomes
        asked += len(indices)
    print_row("all", asked, everything)
    kept = sum(one.proven and one.lengths[1] < one.lengths[0] for one in everything)
    return 0 if everything and kept >= 0.9 * len(everything) else 1


sys.exit(main(sys.argv[1:]))
