# SPDX-License-Identifier: BSD-3-Clause
"""RRT-Connect in numpy, as a planner of your own: each motion of its trees is proven.

    10_rrt_connect.py MODELS

Exits 0 if it finds a path from home to ready that certify_path proves.
"""
import sys
from typing import List, Optional, Tuple

import numpy as np

import swept

RANGE = 0.8  # rad, longest motion of a tree

class Tree:
    def __init__(self, root: np.ndarray) -> None:
        self.states, self.parents = np.array([root]), [0]

    def extend(self, checker: swept.Checker, target: np.ndarray) -> Tuple[Optional[int], bool]:
        """The new node, if the motion towards the target is free, and whether it is the target."""
        offsets = target - self.states
        near = int(np.argmin(np.einsum("ij,ij->i", offsets, offsets)))
        length = float(np.linalg.norm(offsets[near]))
        reached = length <= RANGE
        state = target if reached else self.states[near] + RANGE / length * offsets[near]
        if not checker.certify_motion(self.states[near], state, swept.MotionQuery.VERDICT_ONLY):
            return None, False
        self.states, self.parents = np.vstack([self.states, state]), self.parents + [near]
        return len(self.parents) - 1, reached

    def branch(self, node: int) -> List[np.ndarray]:
        return [self.states[0]] if node == 0 else self.branch(self.parents[node]) + [self.states[node]]


def rrt_connect(checker: swept.Checker, start: np.ndarray, goal: np.ndarray, seed: int) -> np.ndarray:
    random, group, trees = np.random.default_rng(seed), checker.group, [Tree(start), Tree(goal)]
    while True:
        new, _ = trees[0].extend(checker, random.uniform(group.lower, group.upper))
        while new is not None:
            meeting, reached = trees[1].extend(checker, trees[0].states[new])
            if meeting is None:
                break
            if reached:
                path = trees[0].branch(new) + trees[1].branch(meeting)[-2::-1]
                return np.array(path if np.array_equal(path[0], start) else path[::-1])
        trees.reverse()


models = sys.argv[1] if len(sys.argv) > 1 else "models"
arm = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
slot = swept.Checker(arm, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))
found = rrt_connect(slot, slot.named_state("home"), slot.named_state("ready"), seed=1)
short = swept.shorten_path(slot, found)
print(len(found), "states, shortened to", len(short), swept.certify_path(slot, short))
sys.exit(0 if swept.certify_path(slot, found) and swept.certify_path(slot, short) else 1)
