# SPDX-License-Identifier: BSD-3-Clause
"""A point cloud as a body of the world, and the sensor's next cloud in its place.

    05_cloud.py MODELS

Exits 0 if the arm collides with the first cloud and not with the second, which is farther away.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm")
home = checker.named_state("home")
hand = robot.link_pose("arm", "hand", home)[:3, 3]

# A wall through the hand, as a sensor with an error of 5 mm sees it.
y, z = np.meshgrid(np.linspace(-0.5, 0.5, 100), hand[2] + np.linspace(-0.5, 0.5, 100))
wall = np.column_stack([np.full(y.size, hand[0]), y.ravel(), z.ravel()])
seen = checker.with_body("wall", swept.Shape.cloud(wall, radius=0.005))
report = seen.report_state(home)
print("first cloud:", report.verdict, [contact.body_a for contact in report.contacts])

later = seen.with_replaced("wall", swept.Shape.cloud(wall + [0.6, 0.0, 0.0], radius=0.005))
print("next cloud:", later.check_state(home), f"clearance {later.clearance(home):.3f} m")
sys.exit(0 if not report and later.check_state(home) else 1)
