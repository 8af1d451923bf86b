# SPDX-License-Identifier: BSD-3-Clause
"""URDF, SRDF and scene: is a state free, how far is the nearest body, what touches what and where.

    02_state_check.py MODELS

Exits 0 if report and check agree, and the contact is where its distance says.
"""
import sys

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))

home = checker.named_state("home")
report = checker.report_state(home)
print(f"home: {report.verdict}, {report.clearance:.4f} m, nearest {report.nearest_a} - {report.nearest_b}")

low = checker.configuration({"joint1": 0.2, "joint2": 0.4, "joint4": 1.2, "joint6": 0.8}, others=np.zeros(7))
contacts = checker.report_state(low).contacts
for contact in contacts:
    print(f"low: {contact.body_a} touches {contact.body_b} at {contact.point_a}")
print(checker.explain("hand", "plate_left"))

agree = checker.check_state(home) is report.verdict and not checker.check_state(low)
measured = all(abs(np.linalg.norm(c.point_b - c.point_a) - c.distance) < 1e-9 for c in contacts)
sys.exit(0 if agree and report and contacts and measured else 1)
