# SPDX-License-Identifier: BSD-3-Clause
"""Few capsules, boxes or convex hulls that contain a link or a robot, where spheres are too coarse.

    20_enclosing_shapes.py MODELS

Writes a URDF with them. Exits 0 if they contain the robot, and what they keep free is free of the robot itself.
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")

# Around one link: how far do so many reach beyond it?
hand = robot.link_shapes("hand")
for kind in swept.EnclosingKind:
    search = swept.EnclosingShapesSearch(hand, kind)
    found = search.at_most(3)
    excess = swept.shapes_excess(hand, found.shapes)
    print(f"hand in {len(found)} of kind {kind}: at most {1e3 * excess.largest:.1f} mm beyond it, proven")

# Around all links, and what each is.
model = swept.ShapeModel.search(robot, swept.EnclosingKind.CAPSULE, shapes=24)
reports = model.judge(robot)
for shape, pose in model["link3"]:
    print(f"link3: radius {shape.parameters['radius']:.3f} m, length {shape.parameters['length']:.3f} m")
contained = all(report.outside.upper <= 0.0 for report in reports)

# A robot of capsules is in no collision where the robot itself could be in one unseen.
with tempfile.TemporaryDirectory() as folder:
    model.save(Path(folder) / "capsules.urdf", robot)
    capsules = swept.Robot.load(Path(folder) / "capsules.urdf", f"{models}/robots/rook7/rook7.srdf")
world = swept.World.load(f"{models}/scenes/shelf.yaml")
exact, coarse = (swept.Checker(one, "arm", world) for one in (robot, capsules))
states = np.random.default_rng(1).uniform(exact.group.lower, exact.group.upper, (2000, exact.dimension))
hits, more = (checker.check_states(states) == swept.Verdict.COLLISION for checker in (exact, coarse))
print(f"{hits.sum()} states are in collision, {more.sum()} as capsules")
sys.exit(0 if contained and bool((more | ~hits).all()) and 0 < hits.sum() < len(states) else 1)
