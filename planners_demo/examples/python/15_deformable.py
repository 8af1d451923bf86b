# SPDX-License-Identifier: BSD-3-Clause
"""A surface that deforms from frame to frame, as a body of the world: it swells until the arm touches it.

    15_deformable.py MODELS

Exits 0 if the frame of the first contact is that of a box as large as the surface.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm")
q = checker.named_state("home")
place = robot.link_pose("arm", "hand", q)
place[:3, 3] += 0.6 * np.array([1.0, 0.0, 0.0])

corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
         [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]

# The first frame has triangles; later ones only move its vertices, which takes a fraction of the time.
surface = swept.Shape.mesh(0.05 * corners, faces)
swelling = checker.with_body("balloon", surface, place)
first = boxed = None
for frame in range(40):
    half = 0.05 + 0.01 * frame
    swelling = swelling.with_replaced("balloon", surface.moved(half * corners), place)
    box = checker.with_body("balloon", swept.Shape.box([2 * half] * 3), place)
    if first is None and not swelling.check_state(q):
        first = frame
        print(f"frame {frame}: {swelling.report_state(q).contacts[0]}")
    if boxed is None and not box.check_state(q):
        boxed = frame
print(f"first contact in frame {first}; of boxes in {boxed}")
sys.exit(0 if first is not None and first == boxed and first > 0 else 1)
