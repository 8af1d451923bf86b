# SPDX-License-Identifier: BSD-3-Clause
"""Plans, and gives the controller a trajectory that is proven as it executes it: blended, timed, with a tube.

    09_plan_trajectory.py MODELS

Writes the message for ROS. Exits 0 if all of it is proven, and reads back the same.
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import swept

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load(f"{models}/scenes/narrow_slot.yaml"))

limits = swept.RateLimits(checker, acceleration=3.0)  # rad/s^2
planned = swept.plan_trajectory(
    checker,
    checker.named_state("home"),
    checker.named_state("ready"),
    limits,
    planner="RRTConnect",
    tracking=swept.TrackingTolerance(rotation=0.005),
)
proven = planned.proven
if proven is None:
    sys.exit(1)
print(proven)
for corner in proven.corners:
    print(f"way point {corner.way_point}: {'stops' if corner.stops else 'blended'}, off by {corner.deviation:.4f} rad")
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "trajectory.yaml"
    proven.trajectory.save(file)
    (read,) = swept.Trajectory.load(file, checker)
same = np.array_equal(read.positions, proven.trajectory.positions)
sys.exit(0 if planned and same and not proven.certificate.violations else 1)
