# SPDX-License-Identifier: BSD-3-Clause
"""The trajectory that a controller is given: is the curve that it makes of it free, and all around it?

    08_trajectory.py MODELS

Exits 0 if the curve is free, also where each joint is off by 0.01 rad, and not where it is off by 0.2 rad.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
world = swept.World()
pose = np.eye(4)
pose[:3, 3] = 0.62, 0.35, 0.5
world.add("post", swept.Shape.cylinder(0.05, 1.0), pose)
checker = swept.Checker(robot, "arm", world)

# Positions and velocities: a controller makes cubics of them.
positions = [[-0.4, -0.5, 0, 1.5, 0, 0.8, 0], [0, -0.4, 0, 1.4, 0, 0.8, 0.2], [0.1, -0.2, 0, 1.2, 0, 0.8, 0.5]]
velocities = [[0.0] * 7, [0.3, 0.1, 0, 0, 0, 0, 0.4], [0.0] * 7]
trajectory = swept.Trajectory(checker.group.variable_names, [0.0, 0.8, 1.6], positions, velocities)

limits = swept.RateLimits(checker)  # velocities of the URDF
certificate = checker.certify_trajectory(trajectory, limits=limits, clearances=True)
assert certificate.world is not None
print(certificate, f"keeps {certificate.world.lower:.4f} m to the world")

tube = checker.with_tracking(swept.TrackingTolerance(rotation=0.01))
wide = checker.with_tracking(swept.TrackingTolerance(rotation=0.2))
in_tube, in_wide = tube.certify_trajectory(trajectory), wide.certify_trajectory(trajectory)
print("off by 0.01 rad:", in_tube.verdict, " by 0.2 rad:", in_wide.verdict)
sys.exit(0 if certificate and in_tube and not in_wide and not certificate.violations else 1)
