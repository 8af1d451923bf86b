# SPDX-License-Identifier: BSD-3-Clause
"""Two arms over one table: 21_two_arms.cpp in Python. One moves while the other stands, then both at once.

    14_two_arms.py MODELS

Exits 0 if the standing arm blocks what is free without it, and both find a proven path together.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
cell = swept.WorkCell.load(f"{models}/cells/two_rooks.yaml")
robot = cell.robot()

# The right arm, which `left/arm` does not move, stands as `reference` says.
tucked, reaching = robot.named_state("right/arm", "tucked"), np.array([0, 1.3, 0, 0.3, 0, 0, 0])
verdicts = {}
for name, posture in {"tucked": tucked, "reaching": reaching}.items():
    left = swept.Checker(robot, "left/arm", reference=robot.standing({"right/arm": posture}))
    certificate = left.certify_motion(left.named_state("home"), reaching)
    verdicts[name] = certificate.verdict
    print(f"beside a {name} arm: {certificate}")

# All 14 joints at once.
both = swept.Checker(robot, "both")
plan = swept.plan(both, both.named_state("ready"), both.named_state("tucked"), seconds=10.0)
print(f"both together: {plan}")

# The same cell made here, with the right robot farther away: what was in collision is free.
pose = cell.robots[1].pose
pose[0, 3] += 1.5  # m
right = swept.CellRobot("right", cell.robots[1].urdf, pose=pose)
apart = swept.WorkCell([cell.robots[0], right], {"both": ["left/arm", "right/arm"]}).robot()
wide = swept.Checker(apart, "both")
meeting = np.concatenate([reaching, reaching])
print(f"both reaching: {both.check_state(meeting)}, farther apart: {wide.check_state(meeting)}")

blocked = verdicts["reaching"] is swept.Verdict.COLLISION and verdicts["tucked"]
sys.exit(0 if blocked and plan and not both.check_state(meeting) and wide.check_state(meeting) else 1)
