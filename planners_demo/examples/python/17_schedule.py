# SPDX-License-Identifier: BSD-3-Clause
"""Two arms reach over one table, one after the other: is that free, and how late may one be? 26_schedule.cpp in Python.

    17_schedule.py MODELS

Exits 0 if the schedule is proven, with some delays, and what is found to meet does.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.WorkCell.load(f"{models}/cells/two_rooks.yaml").robot()
both = swept.Checker(robot, "both")
reaching, rest = np.array([0, 1.3, 0, 0.3, 0, 0, 0]), np.zeros((3, 7))


def reach(arm: str) -> swept.Trajectory:
    """Tucked, over the table and tucked again: cubics that rest at their points."""
    tucked = robot.named_state(arm, "tucked")
    names, points = robot.group(arm).variable_names, np.array([tucked, reaching, tucked])
    return swept.Trajectory(names, [0.0, 1.5, 3.0], points, rest)


def schedule(late: float) -> list[swept.ScheduledCurve]:
    return [
        swept.ScheduledCurve(reach("left/arm"), start=late),
        swept.ScheduledCurve(reach("right/arm"), start=3.0),
    ]


planned = swept.certify_schedule(both, schedule(0.0), clearances=True)
print(f"one after the other: {planned}")

# The left arm may start late, by any time up to some.
late = swept.certify_delays(both, schedule(0.0), 0, latest=3.0, resolution=0.01)
print(f"the left one may be late: {late}")
if late.proven is None or late.contact is None:
    sys.exit(1)

# By half of that all is free, as it is by all of it; later the two meet.
half = swept.certify_schedule(both, schedule(0.5 * late.proven))
meeting = swept.certify_schedule(both, schedule(late.contact.delay))
print(f"late by {0.5 * late.proven:.2f} s: {half}\nlate by {late.contact.delay:.2f} s: {meeting}")

# One trajectory of all joints, as a controller of both arms needs it.
together = swept.controller_trajectory(swept.combined_curve(both, schedule(0.0)).curve, both.group.variable_names)
right = planned and half and not meeting and late.proven > 0.1
sys.exit(0 if right and together is not None and both.certify_trajectory(together) else 2)
