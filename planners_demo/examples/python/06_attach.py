# SPDX-License-Identifier: BSD-3-Clause
"""The robot grips, carries and releases an object; its fingers may touch it.

    06_attach.py MODELS

Exits 0 if the object counts while it is carried, and stays where it was released.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
empty = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))
home, ready = empty.named_state("home"), empty.named_state("ready")

pose = np.eye(4)
pose[2, 3] = 0.12  # m, along z of the hand
gripping = empty.with_attached("bar", "hand", swept.Shape.box((0.3, 0.04, 0.04)), pose, ["finger_*"])
print("ready, empty hand:", empty.check_state(ready), " with the bar:", gripping.check_state(ready))

released = gripping.with_detached("bar", home)
print("bodies of the world:", ", ".join(released.world.names))
touched = released.report_state(home).contacts
print("the hand is still at the bar:", [f"{c.body_a} - {c.body_b}" for c in touched])

carried = gripping.check_state(home) and empty.check_state(ready) and not gripping.check_state(ready)
sys.exit(0 if carried and "bar" in released.world and not gripping.world.names == released.world.names else 1)
