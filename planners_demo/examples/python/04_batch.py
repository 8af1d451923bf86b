# SPDX-License-Identifier: BSD-3-Clause
"""Thousands of states and motions at once, on all processors: a roadmap's vertices and edges.

    04_batch.py MODELS

Exits 0 if one by one they get the same answers.
"""
import sys

import numpy as np

import swept
from swept import Verdict

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/shelf.yaml"))

group = checker.group
states = np.random.default_rng(1).uniform(group.lower, group.upper, (2000, len(group)))
verdicts = checker.check_states(states)
print(np.count_nonzero(verdicts == Verdict.FREE), "of", len(states), "states are free")

# Each state to the next one: slices of C-contiguous arrays are read in place.
motions = checker.certify_motions(states[:-1], states[1:])
print(np.count_nonzero(motions.verdicts == Verdict.FREE), "of", len(motions), "motions between them are")

same = all(checker.check_state(states[i]) == verdict for i, verdict in enumerate(verdicts))
same &= all(checker.certify_motion(states[i], states[i + 1]).verdict == v for i, v in enumerate(motions.verdicts))
sys.exit(0 if same and (motions.verdicts == Verdict.FREE).any() else 1)
