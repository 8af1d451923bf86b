# SPDX-License-Identifier: BSD-3-Clause
"""Plans with OMPL and proves the path: 07_plan.cpp in Python.

    01_plan.py ROBOT.urdf ROBOT.srdf SCENE GROUP START GOAL

Exits 0 if every segment is proven free.
"""
import sys

import swept

urdf, srdf, scene, group, start, goal = sys.argv[1:]
robot = swept.Robot.load(urdf, srdf)
checker = swept.Checker(robot, group, swept.World.load(scene))

plan = swept.plan(checker, checker.named_state(start), checker.named_state(goal), seconds=10.0)
if not plan.solved:
    sys.exit(1)
print(plan.path)
for segment in plan.certificate.segments:
    print("segment", segment.verdict)
sys.exit(0 if plan else 2)
