# SPDX-License-Identifier: BSD-3-Clause
"""A path of any planner: is it free? Writes the proof to a file that anybody can check, and a page.

    07_proof.py MODELS

Exits 0 if the proof holds, and does not for a world with one more body.
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
world = swept.World()
pose = np.eye(4)
pose[0, 3] = -1.2
world.add("post", swept.Shape.cylinder(0.05, 1.0), pose)
checker = swept.Checker(robot, "arm", world)

path = np.array([[-0.3, -0.5, 0, 1.5, 0, 0.8, 0], [0, -0.5, 0, 1.5, 0, 0.8, 0], [0.2, -0.4, 0, 1.4, 0, 0.8, 0.5]])
certificate = swept.certify_path(checker, path)
print(certificate)

with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "proof.json"
    swept.write_proof(file, checker, path, certificate)
    proof = swept.verify(file)
    print(f"proof holds: {proof.planes} planes, every pair keeps more than {proof.clearance:.4f} m")
    elsewhere = swept.verify(file, checker.with_body("ball", swept.Shape.sphere(0.1), pose))
    print("in another world:", elsewhere.refusal)
    page = swept.show(checker, path, file=Path(folder) / "page.html")
    written = (Path(folder) / "page.html").read_text() == page.html
sys.exit(0 if certificate and proof and not elsewhere and written else 1)
