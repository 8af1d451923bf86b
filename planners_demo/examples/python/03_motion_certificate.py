# SPDX-License-Identifier: BSD-3-Clause
"""Is a whole motion proven free, until when, what does it hit; and its least distance.

    03_motion_certificate.py MODELS

Exits 0 if states before the contact are free, and the least distance is none that a state undercuts.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))

home, ready = checker.named_state("home"), checker.named_state("ready")
certificate = checker.certify_motion(home, ready)
print(certificate)
print(certificate.witness)

times = np.linspace(0.0, certificate.free_until, 50)
before = [checker.check_state(checker.interpolate(home, ready, t)) for t in times]

half = checker.interpolate(home, ready, 0.5 * certificate.free_until)
clearance = checker.motion_clearance(home, half, 1e-4)
states = [checker.interpolate(home, half, t) for t in np.linspace(0.0, 1.0, 20)]
least = min(checker.clearance(q) for q in states)
print(f"until half way it keeps {clearance.lower:.5f} m; the states seen, {least:.5f} m")
sys.exit(0 if not certificate and all(before) and clearance.lower <= least + 1e-9 else 1)
