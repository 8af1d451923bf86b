# SPDX-License-Identifier: BSD-3-Clause
"""An arm is planned beside another one that moves, with room for delays. 28_plan_beside.cpp in Python.

    21_plan_beside.py MODELS

Exits 0 if a way is found, proven together with that of the first arm, and both may be late.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.WorkCell.load(f"{models}/cells/two_rooks.yaml").robot()
# Links of the two arms keep 1 cm apart.
both = swept.Checker(robot, "both", margin=0.01)
reaching, rest = np.array([0, 1.3, 0, 0.3, 0, 0, 0]), np.zeros((4, 7))

# The first arm: tucked, over the table from 1.5 s to 2.5 s, and tucked again.
tucked = robot.named_state("left/arm", "tucked")
first = swept.Trajectory(
    robot.group("left/arm").variable_names, [0.0, 1.5, 2.5, 4.0], np.array([tucked, reaching, reaching, tucked]), rest
)

# The second one may take either of two places.
start = robot.named_state("right/arm", "tucked")
goals = [reaching, robot.named_state("right/arm", "ready")]
limits = swept.RateLimits(swept.Checker(robot, "right/arm"), acceleration=5.0)
tasks = [swept.ScheduleTask("right/arm", start, goals, limits)]
plan = swept.plan_schedule(both, tasks, [swept.ScheduledCurve(first)], delay=0.1)
print(f"planned: {plan.status}")
if not plan:
    sys.exit(1)

trajectory = plan.trajectories[0]
for time, q in zip(trajectory.times, trajectory.positions):
    print(f"  {time:.3f} s: {np.round(q, 3)}")
print(f"both together: {plan.certificate}")
for name, delay in zip(("left", "right"), plan.delays):
    print(f"the {name} one may be late by {delay.proven} s")

# One trajectory of all joints, as a controller of both arms needs it.
curves = [swept.ScheduledCurve(first), *plan.curves]
together = swept.controller_trajectory(swept.combined_curve(both, curves).curve, both.group.variable_names)
sys.exit(0 if together is not None and both.certify_trajectory(together) and all(plan.delays) else 2)
