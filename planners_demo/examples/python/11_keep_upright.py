# SPDX-License-Identifier: BSD-3-Clause
"""Plans with the hand kept within 30 degrees of how it stands at first: 18_keep_upright.cpp in Python.

    11_keep_upright.py MODELS

Exits 0 if all of the path is proven, sampled it keeps the hand level, and tipping the hand is a violation.
"""
import math
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
start = robot.named_state("arm", "ready")
level = robot.link_pose("arm", "hand", start)
most = math.radians(30)
checker = swept.Checker(robot, "arm", constraints=swept.TaskConstraint.level("hand", level, most))

# The same posture, turned about the vertical by the joint at the base.
goal = start + np.array([1.5, 0, 0, 0, 0, 0, 0])
plan = swept.plan(checker, start, goal, seconds=10.0)
if plan.path is None:
    sys.exit(1)

# What is proven, sampled: how far what points up at the start tilts.
path = plan.path
poses = [
    robot.link_pose("arm", "hand", checker.interpolate(path[i], path[i + 1], t))
    for i in range(len(path) - 1)
    for t in np.linspace(0.0, 1.0, 100)
]
tilts = [math.acos(min(1.0, float((pose[:3, :3] @ level[2, :3])[2]))) for pose in poses]
print(f"the hand tilts by {max(tilts):.4f} rad, allowed are {most:.4f}")

# A state that does not keep it, and the nearest that does.
tipped = start + np.array([0, 0, 0, 0, 0, 0.7, 0])
violation = checker.certify_motion(start, tipped).violation
projected = swept.ConstraintProjection(checker).project(tipped)
if violation is None or projected is None:
    sys.exit(2)
print(f"at t = {violation.t:.3f}, {checker.constraints.describe(violation)}; projected: {np.round(projected, 3)}")
kept = checker.report_state(projected).constraints_hold
sys.exit(0 if plan and max(tilts) <= most and kept else 3)
