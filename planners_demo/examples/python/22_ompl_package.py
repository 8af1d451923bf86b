# SPDX-License-Identifier: BSD-3-Clause
"""Planners of the Python package `ompl`, with states and motions that are proven.

    22_ompl_package.py MODELS

Exits 0 if RRT-Connect finds a path from home to ready that certify_path proves, and where `ompl` is not installed.
"""
import importlib
import sys
from typing import Any

import numpy as np

import swept

try:
    ob: Any = importlib.import_module("ompl.base")
    og: Any = importlib.import_module("ompl.geometric")
except ImportError:
    print("skipped: there is no Python package ompl")
    sys.exit(0)

models = sys.argv[1] if len(sys.argv) > 1 else "models"
arm = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(arm, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))
group, n = checker.group, len(checker.group)

class ProvenMotions(ob.MotionValidator):  # type: ignore[misc]
    """Of straight motions, as those of a RealVectorStateSpace are."""
    def checkMotion(self, a: Any, b: Any) -> bool:
        return bool(checker.certify_motion(a[0:n], b[0:n], swept.MotionQuery.VERDICT_ONLY))

bounds = ob.RealVectorBounds(n)
for i in range(n):
    bounds.setLow(i, group.lower[i])
    bounds.setHigh(i, group.upper[i])
space = ob.RealVectorStateSpace(n)
space.setBounds(bounds)
information = ob.SpaceInformation(space)
information.setStateValidityChecker(lambda state: bool(checker.check_state(state[0:n])))
information.setMotionValidator(ProvenMotions(information))
information.setup()

ends = []
for name in ("home", "ready"):
    ends.append(space.allocState())
    for i, value in enumerate(checker.named_state(name)):
        ends[-1][i] = value
problem = ob.ProblemDefinition(information)
problem.setStartAndGoalStates(*ends)
planner = og.RRTConnect(information)
planner.setProblemDefinition(problem)
planner.setup()
planner.solve(10.0)
path = problem.getSolutionPath()
states = np.array([path.getState(i)[0:n] for i in range(path.getStateCount())])
certificate = swept.certify_path(checker, states)
print(len(states), "states", certificate)
sys.exit(0 if problem.hasExactSolution() and certificate else 1)
