# SPDX-License-Identifier: BSD-3-Clause
"""A tool goes along a straight line: 20_line.cpp in Python. Why a longer line ends early, and a curve in time.

    12_line.py MODELS

Exits 0 if the line is proven, its samples are no farther off than that, and so is its trajectory.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm")
planner = swept.ToolLinePlanner(checker, "hand")
start = checker.named_state("ready")

line = planner.plan_by(start, [0.0, 0.0, -0.1])
print(f"0.1 m with {len(line.path)} way points, never more than {1e3 * line.position:.3f} mm off")
beyond = planner.plan_by(start, [0.0, 0.0, -2.0])
print(f"2 m: {beyond.stop}; {beyond.share:.0%} of it is proven")

# To a pose: a quarter of a turn about the tool's own axis on the way.
goal = planner.pose(start) @ np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0.05], [0, 0, 0, 1]])
turning = planner.plan(start, goal, position=0.002, angle=0.02)
print(f"turned by {turning.turn:.3f} rad: {len(turning.path)} way points, {turning.angle:.4f} rad off at most")

# Sampled, the tool is no farther off than was proven.
below = line.start_pose[:2, 3]
farthest = max(
    float(np.linalg.norm(planner.pose(checker.interpolate(line.path[i], line.path[i + 1], t))[:2, 3] - below))
    for i in range(len(line.path) - 1)
    for t in np.linspace(0.0, 1.0, 100)
)
timed = swept.proven_trajectory(checker, line.path, swept.RateLimits(checker, acceleration=3.0))
print(f"sampled {1e3 * farthest:.3f} mm off; {timed}")
sys.exit(0 if line and not beyond and turning and farthest <= line.position and timed else 1)
