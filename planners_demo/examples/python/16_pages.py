# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages of a path and of its trajectory, which plays in real time: 14_page.cpp and 17_trajectory_page.cpp.

    16_pages.py MODELS [FOLDER]

Writes them to a folder, by default a temporary one. Exits 0 if they say what is proven.
"""
import sys
import tempfile
from pathlib import Path

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))
home, ready = checker.named_state("home"), checker.named_state("ready")
plan = swept.plan(checker, home, ready)
if plan.path is None:
    sys.exit(1)
limits = swept.RateLimits(checker, acceleration=3.0)
proven = swept.proven_trajectory(checker, plan.path, limits)

with tempfile.TemporaryDirectory() as temporary:
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else temporary)
    # The plan beside the straight motion, which is in collision.
    paths = swept.show(checker, plan, [home, ready], file=folder / "paths.html", title="through the slot")
    # The curve with its limits.
    played = swept.show(checker, proven, limits=limits, file=folder / "trajectory.html")
    for file in sorted(folder.glob("*.html")):
        print(f"{file.name}: {file.stat().st_size / 1e6:.1f} MB")
    written = (folder / "paths.html").read_text() == paths.html

told = "2 paths: 1 free, 1 in collision" in paths.html and "through the slot" in paths.html
sys.exit(0 if told and written and len(played.html) > 1000 and proven else 2)
