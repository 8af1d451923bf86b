# SPDX-License-Identifier: BSD-3-Clause
"""A task in one file with proofs: the arm takes a cup, carries it and leaves it; 25_pick_and_place.cpp is longer.

    19_task.py MODELS [FOLDER]

Writes task.json, which `swept verify` checks, and task.html, which plays it. Exits 0 if all of it is proven.
"""
import sys
import tempfile
from pathlib import Path
from typing import List, Sequence

import numpy as np

import swept
from swept import ChangeKind, TaskChange, TaskPhase

models = sys.argv[1] if len(sys.argv) > 1 else "models"
robot = swept.Robot.load(f"{models}/robots/rook7/rook7.urdf")
home, ready = robot.named_state("arm", "home"), robot.named_state("arm", "ready")
there = ready + [0.8, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0]

# The cup is where the hand is at `ready`, a little in front of it: a magnet holds it.
cup, hand_from_cup = swept.Shape.cylinder(radius=0.03, length=0.1), np.eye(4)
hand_from_cup[2, 3] = 0.25  # m
world = swept.World()
world.add("cup", cup, robot.link_pose("arm", "hand", ready) @ hand_from_cup)
reach = swept.Checker(robot, "arm", world)
carry = reach.without_body("cup").with_attached("cup", "hand", cup, hand_from_cup)
leave = carry.with_detached("cup", there)

phases: List[TaskPhase] = []


def move(name: str, checker: swept.Checker, goal: np.ndarray, changes: Sequence[TaskChange] = ()) -> None:
    """Plans from where the arm is by now, with times that follow those of the phase before."""
    before = phases[-1].trajectory if phases else None
    start, clock = (home, 0.0) if before is None else (before.positions[-1].copy(), float(before.times[-1]))
    planned = swept.plan_trajectory(checker, start, goal, swept.RateLimits(checker, acceleration=3.0))
    if planned.proven is None:
        sys.exit(1)
    phases.append(TaskPhase(name, checker, planned.proven.trajectory.delayed(clock), changes))


move("reach", reach, ready)
move("carry", carry, there, [TaskChange(ChangeKind.ATTACHED, "cup")])
move("leave", leave, home, [TaskChange(ChangeKind.PLACED, "cup")])
with tempfile.TemporaryDirectory() as temporary:
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else temporary)
    swept.write_task(folder / "task.json", phases)
    page = swept.show_task(phases, file=folder / "task.html", title="a cup")
    task, steps = swept.verify_task(folder / "task.json"), swept.read_task(folder / "task.json")
for phase in task.phases:
    print(f"{phase.begin:.2f} s to {phase.end:.2f} s: {phase.name}, {', '.join(phase.changes) or 'as before'}")
sys.exit(0 if task and len(steps) == 3 and "cup placed" in page.html else 2)
