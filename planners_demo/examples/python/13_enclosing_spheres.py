# SPDX-License-Identifier: BSD-3-Clause
"""Few spheres that contain a body, a link or a robot: 19_enclosing_spheres.cpp in Python.

    13_enclosing_spheres.py MODELS

Exits 0 if spheres made by hand are judged as they are, and those that are found contain all.
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"


def at(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


# A gripper, and someone's guess: all radii have to grow by `upper` so that the spheres contain it.
finger = swept.Shape.box([0.12, 0.02, 0.03])
gripper = [(swept.Shape.box([0.04, 0.2, 0.06]), None), (finger, at(0.08, -0.08, 0)), (finger, at(0.08, 0.08, 0))]
outside = swept.outside_spheres(gripper, [[0, -0.05, 0, 0.05], [0, 0.05, 0, 0.05], [0.1, 0, 0, 0.1]])
print(f"guessed spheres leave out up to {outside.upper:.4f} m, at {outside.point}")

# Proven: at most 12 spheres that contain it.
found = swept.EnclosingSpheresSearch(gripper).at_most(12)
excess = swept.sphere_excess(gripper, found.spheres)
print(f"{len(found)} spheres contain it; they reach {excess.largest:.4f} m beyond it, {excess.mean:.4f} m in the mean")

# A robot, for a planner that reads cuRobo's files; and one link of it by the excess.
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
model = swept.SphereModel.search(robot, spheres=80, pieces=300, restarts=1)
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "spheres.yaml"
    model.save(file, robot)
    reports = swept.SphereModel.load(file, robot).judge(robot)
for report in reports:
    print(f"  {report.link}: {report.spheres} spheres, {1e3 * report.excess.largest:.1f} mm beyond it")
hand = swept.EnclosingSpheresSearch(robot.link_shapes("hand")).within(0.02)
print(f"the hand within 2 cm: {hand}")

judged = outside.lower > 0.01 and outside.upper < outside.lower + 1e-4
contained = all(reports) and len(model) <= 80 and hand.reach <= 0.02
sys.exit(0 if judged and len(found) <= 12 and excess.largest < 0.03 and contained else 1)
