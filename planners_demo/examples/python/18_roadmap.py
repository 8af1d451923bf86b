# SPDX-License-Identifier: BSD-3-Clause
"""A roadmap whose motions stay proven while the world changes: 23_roadmap.cpp in Python.

    18_roadmap.py MODELS

Exits 0 if every motion, and the path, is as a checker says that is asked about all of them.
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))
home, ready = checker.named_state("home"), checker.named_state("ready")

roadmap = swept.CertifiedRoadmap(checker, states=400)
print(roadmap)
at_first = roadmap.verdicts

# A crate comes: only motions that it can reach are asked about again.
place = np.eye(4)
place[:3, 3] = -0.5, 0.3, 0.5
crated = checker.with_body("crate", swept.Shape.box([0.2, 0.2, 0.2]), place)
change = roadmap.update(crated)
print(f"with a crate {change.motions_asked} motions are asked about, {change.blocked} are blocked")
path = roadmap.path(home, ready)
if path is None:
    sys.exit(1)
ends = roadmap.states[roadmap.motions]
asked = crated.certify_motions(ends[:, 0].copy(), ends[:, 1].copy()).verdicts
right = bool(((roadmap.verdicts == swept.Verdict.FREE) == (asked == swept.Verdict.FREE)).all())
right &= bool(swept.certify_path(crated, path)) and bool(roadmap.plan(home, ready))

# The program may end, and go on without the crate.
with tempfile.TemporaryDirectory() as folder:
    roadmap.save(Path(folder) / "roadmap.json")
    graph, gone = swept.ProvenGraph.load_changed(Path(folder) / "roadmap.json", checker)
print(f"without it {gone.asked} questions are asked, {gone.freed} motions are free again")
right &= bool((graph.verdicts == at_first).all()) and swept.CertifiedRoadmap.of(graph).path(home, ready) is not None
sys.exit(0 if right and change.blocked > 0 else 2)
