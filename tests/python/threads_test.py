# SPDX-License-Identifier: BSD-3-Clause
"""Threads of Python share a checker; signals end long work; nothing leaks."""
import gc
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import swept


def test_eight_threads_ask_one_checker(checker, states):
    expected = checker.check_states(states, threads=1)
    motions = checker.certify_motions(states[:-1], states[1:], threads=1).free_until

    def ask(seed):
        wrong = 0
        for i in np.random.default_rng(seed).integers(0, len(states) - 1, 400):
            wrong += checker.check_state(states[i]) != expected[i]
            wrong += checker.certify_motion(states[i], states[i + 1]).free_until != motions[i]
            if i % 40 == 0:
                wrong += (checker.check_states(states[:50]) != expected[:50]).sum()
                found, _ = checker.signed_clearance(states[i], gradient=True)
                wrong += found.upper != checker.signed_clearance(states[i]).upper
        return wrong

    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(ask, range(8))) == [0] * 8


def test_others_run_while_a_query_runs(checker, states):
    """A batch that takes long: this thread counts meanwhile."""
    many = np.tile(states, (600, 1))
    done = threading.Event()

    def work():
        checker.certify_motions(many[:-1], many[1:], threads=1)
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    steps = 0
    while not done.wait(0.001):
        steps += 1
    worker.join()
    assert steps > 20


INTERRUPTED = """
import signal, sys, tempfile, threading, time, numpy as np, swept
robot = swept.Robot.load("models/robots/rook7/rook7.urdf")
checker = swept.Checker(robot, "arm", swept.World.load("models/scenes/narrow_slot.yaml"))
home, ready = checker.named_state("home"), checker.named_state("ready")
many = np.random.default_rng(1).uniform(-2, 2, (3_000_000, 7))
def late():
    arms = swept.WorkCell.load("models/cells/two_rooks.yaml").robot()
    both, curves = swept.Checker(arms, "both"), []
    for arm in ("left/arm", "right/arm"):
        path = arms.named_state(arm, "tucked") + 0.2 * np.random.default_rng(2).uniform(-1, 1, (1000, 7))
        trajectory = swept.Trajectory(arms.group(arm).variable_names, 0.2 * np.arange(1000), path)
        curves.append(swept.ScheduledCurve(trajectory))
    swept.certify_delays(both, curves, 0, latest=150.0, resolution=1e-6)
folder = tempfile.TemporaryDirectory()
def wandering(count):
    path = home + 0.02 * np.random.default_rng(2).uniform(-1, 1, (count, 7))
    return swept.Trajectory(checker.group.variable_names, 0.2 * np.arange(count), path)
if sys.argv[1] == "verify":
    swept.write_trajectory_proof(folder.name + "/proof.json", checker, wandering(3000))
work = {"task": lambda: swept.write_task(
            folder.name + "/task.json", [swept.TaskPhase("wander", checker, wandering(500))] * 60),
        "trajectory": lambda: swept.write_trajectory_proof(folder.name + "/some.json", checker, wandering(8000)),
        "proof": lambda: swept.write_proof(folder.name + "/path.json", checker, wandering(8000).positions),
        "verify": lambda: swept.verify(folder.name + "/proof.json"),
        "plan": lambda: swept.plan(checker, home, ready, planner="RRTstar", seconds=120),
        "states": lambda: checker.check_states(many, threads=1),
        "motions": lambda: checker.certify_motions(many[:-1], many[1:], threads=1),
        "path": lambda: swept.certify_path(checker, many, threads=1),
        "roadmap": lambda: swept.CertifiedRoadmap(checker, states=500_000, neighbours=40, threads=1),
        "line": lambda: swept.ToolLinePlanner(swept.Checker(robot, "arm"), "hand").plan_by(
            ready, [0.0, 0.3, -0.3], position=1e-12, angle=4.0, least_step=1e-9, max_way_points=10**9),
        "delays": late,
        "spheres": lambda: swept.SphereModel.search(robot, spheres=300, restarts=200, threads=1),
        "boxes": lambda: swept.ShapeModel.search(robot, swept.EnclosingKind.BOX, shapes=200, pieces=1200, threads=1),
        "judge": lambda: swept.SphereModel.search(robot, spheres=40, pieces=200, restarts=1, rounds=0).judge(
            robot, tolerance=1e-12, most_splits=10**9, samples=10**9)}[sys.argv[1]]
sent = []
def send():
    sent.append(time.monotonic())
    signal.raise_signal(signal.SIGINT)
threading.Timer(0.5, send).start()
try:
    work()
except KeyboardInterrupt:
    print("ended", time.monotonic() - sent[0])
"""


@pytest.mark.parametrize("work", ["plan", "states", "motions", "path", "roadmap", "line", "delays",
                                  "spheres", "boxes", "judge", "task", "trajectory", "proof", "verify"])
def test_ctrl_c_ends_work(work):
    result = subprocess.run([sys.executable, "-c", INTERRUPTED, work], capture_output=True, text=True, timeout=300)
    assert result.stdout.startswith("ended"), result.stdout + result.stderr


def resident():
    """kB that the process holds now."""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


def grown(call, times):
    """kB that so many calls add, once memory that stays is there."""
    for _ in range(times // 10 + 1):
        call()
    gc.collect()
    before = resident()
    for _ in range(times):
        call()
    gc.collect()
    return resident() - before


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_a_million_calls_leak_nothing(checker, home, states):
    near = home + 1e-3
    wall = checker.with_body("wall", swept.Shape.box([3, 3, 3]))
    wrong = home.astype(np.float32)

    def refused():
        with pytest.raises(swept.ArgumentTypeError):
            checker.check_state(wrong)

    def contact():
        return wall.certify_motion(home, near).witness.point_a

    # A leak of one object of 16 bytes for each call of the first kind would be 16000 kB.
    assert grown(lambda: checker.check_state(home), 1_000_000) < 4000
    assert grown(lambda: checker.certify_motion(home, near).effort, 200_000) < 4000
    assert grown(contact, 20_000) < 4000
    assert grown(refused, 20_000) < 4000
    assert grown(lambda: checker.check_states(states), 300) < 8000
    assert grown(lambda: checker.certify_motions(states[:-1], states[1:])[3], 100) < 8000
    assert grown(lambda: checker.report_state(home).contacts, 300) < 4000
    assert grown(lambda: checker.signed_clearance(home, gradient=True), 300) < 4000
    assert grown(lambda: checker.with_body("globe", swept.Shape.sphere(0.1), None), 300) < 16000
    assert grown(lambda: swept.plan(checker, home, near), 50) < 16000


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_constraints_lines_covers_and_cells_leak_nothing(checker, home, states):
    keep = swept.TaskConstraint.upright("hand", 0.01)
    tipped = checker.with_constraints(keep)
    projection = swept.ConstraintProjection(tipped)
    planner = swept.ToolLinePlanner(checker, "hand")
    hand = checker.robot.link_shapes("hand")
    search = swept.EnclosingSpheresSearch(hand, pieces=50, restarts=1)
    cell = swept.WorkCell.load("models/cells/two_rooks.yaml")
    arms = cell.robot()
    problems = swept.ProblemFile.load("models/problems.json")

    def refused():
        with pytest.raises(swept.ArgumentTypeError):
            swept.AxisConstraint(3, 0.1)

    assert grown(lambda: (keep & keep).axes[0].frame, 20_000) < 4000
    assert grown(lambda: tipped.certify_motion(states[0], states[0]).violation.kind, 20_000) < 4000
    assert grown(lambda: tipped.report_state(states[0]).violations, 300) < 4000
    assert grown(lambda: keep.describe(tipped.report_state(states[0]).violations[0]), 300) < 4000
    assert grown(lambda: (projection.project(home), projection.residuals(home), projection.jacobian(home)), 300) < 4000
    assert grown(lambda: projection.project_states(states), 20) < 8000
    assert grown(lambda: planner.plan_by(home, [0, 0, -2.0]).stop.variable, 100) < 4000
    assert grown(lambda: search.at_most(3).spheres, 50) < 8000
    assert grown(lambda: swept.outside_spheres(hand, [[0, 0, 0, 0.05]], samples=100).point, 50) < 8000
    assert grown(lambda: checker.robot.link_shapes("link1"), 1000) < 4000
    assert grown(lambda: swept.SphereModel({"hand": [[0, 0, 0, 1.0]]})["hand"], 10_000) < 4000
    assert grown(lambda: pickle.loads(pickle.dumps(cell)).robots[0].pose, 2000) < 4000
    assert grown(lambda: arms.standing({"left/arm": "ready"}), 2000) < 4000
    assert grown(lambda: problems.problem("shelf", problems.indices("shelf")[0]).world, 1000) < 4000
    assert grown(refused, 20_000) < 4000


def crossing_schedule(arms):
    """Two arms that meet."""
    ends = np.array([arms.named_state("left/arm", "tucked"), [0, 1.3, 0, 0.3, 0, 0, 0]])
    return [swept.ScheduledCurve(swept.Trajectory(arms.group(arm).variable_names, [0.0, 1.0], ends), start=start)
            for arm, start in (("left/arm", 0.0), ("right/arm", 0.1))]


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_schedules_leak_nothing():
    arms = swept.WorkCell.load("models/cells/two_rooks.yaml").robot()
    both = swept.Checker(arms, "both")
    curves = crossing_schedule(arms)

    def refused():
        with pytest.raises(swept.ArgumentError):
            swept.combined_curve(both, curves[:1])

    names = both.group.variable_names
    before = sys.getrefcount(curves[0]), sys.getrefcount(curves), sys.getrefcount(both), sys.getrefcount(names)
    assert grown(lambda: crossing_schedule(arms)[0].curve.knots, 2000) < 4000
    assert grown(lambda: swept.combined_curve(both, curves).rounding, 5000) < 4000
    assert grown(lambda: swept.controller_trajectory(swept.combined_curve(both, curves).curve, names), 2000) < 4000
    assert grown(lambda: swept.certify_schedule(both, curves).witness.point_a, 50) < 8000
    assert grown(lambda: swept.certify_delays(both, curves, 0).contact.configuration, 20) < 8000
    assert grown(refused, 5000) < 4000
    after = sys.getrefcount(curves[0]), sys.getrefcount(curves), sys.getrefcount(both), sys.getrefcount(names)
    assert before == after


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_roadmaps_leak_nothing(checker, home):
    roadmap, ready = swept.CertifiedRoadmap(checker, states=60, neighbours=4), checker.named_state("ready")
    crated = checker.with_body("crate", swept.Shape.box([0.2, 0.2, 0.2]))

    def refused():
        with pytest.raises(swept.ArgumentTypeError):
            roadmap.graph.add_motions(home)

    before = sys.getrefcount(home), sys.getrefcount(crated), sys.getrefcount(checker), sys.getrefcount(roadmap)
    assert grown(lambda: (roadmap.states, roadmap.motions, roadmap.verdicts), 5000) < 4000
    assert grown(lambda: roadmap.path(home, ready), 300) < 4000
    assert grown(lambda: roadmap.blocked_by(0), 10_000) < 4000
    assert grown(lambda: (roadmap.update(crated).blocked, roadmap.update(checker).freed), 200) < 8000
    assert grown(lambda: roadmap.checker.world, 2000) < 8000
    assert grown(lambda: roadmap.graph.motions, 500) < 8000
    assert grown(lambda: swept.CertifiedRoadmap.of(roadmap.graph).components, 200) < 8000
    assert grown(lambda: roadmap.plan(home, ready), 50) < 16000
    assert grown(refused, 500) < 8000
    after = sys.getrefcount(home), sys.getrefcount(crated), sys.getrefcount(checker), sys.getrefcount(roadmap)
    assert before == after


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_tasks_leak_nothing(checker, home, tmp_path):
    def task():
        ends = np.array([home, home + 0.01])
        there = swept.Trajectory(checker.group.variable_names, [0.0, 1.0], ends)
        back = swept.Trajectory(checker.group.variable_names, [0.0, 1.0], ends[::-1].copy())
        change = swept.TaskChange(swept.ChangeKind.SENSED, "shelf")
        return [swept.TaskPhase("there", checker, there), swept.TaskPhase("back", checker, back.delayed(1.0)),
                swept.TaskPhase("never", checker, back, [change])]

    def refused():
        with pytest.raises(swept.ArgumentTypeError):
            swept.TaskChange("sensed", "shelf")
        with pytest.raises(swept.UsageError):
            swept.write_task(tmp_path / "task.json", [])

    file, phases = tmp_path / "task.json", task()
    swept.write_task(file, phases[:2])
    page = swept.show_task(phases[:2]).html
    before = [sys.getrefcount(one) for one in (home, checker, phases, *phases, swept.ChangeKind.SENSED)]
    assert grown(lambda: task()[2].changes[0].kind, 5000) < 4000
    assert grown(lambda: phases[0].checker.world, 2000) < 8000
    assert grown(lambda: swept.write_task(file, phases[:2]), 30) < 8000
    assert grown(lambda: swept.verify_task(file).phases[0].proof, 60) < 8000
    assert grown(lambda: swept.read_task(file)[1].trajectory.times, 60) < 8000
    assert grown(lambda: swept.show_task(phases[:2]).html, 10) < 16000 and len(page) > 1000
    assert grown(refused, 5000) < 4000
    assert before == [sys.getrefcount(one) for one in (home, checker, phases, *phases, swept.ChangeKind.SENSED)]


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="reads /proc")
def test_shapes_leak_nothing(robot):
    hand, kind = robot.link_shapes("hand"), swept.EnclosingKind.CAPSULE
    search = swept.EnclosingShapesSearch(hand, kind, pieces=20)
    found = search.at_most(3)
    mesh = swept.Shape.mesh(np.eye(3), [[0, 1, 2]], solid=False)

    def refused():
        with pytest.raises(swept.ArgumentTypeError):
            swept.EnclosingShapesSearch(hand, 1)

    before = [sys.getrefcount(one) for one in (hand, hand[0][0], kind, found, mesh)]
    assert grown(lambda: found.shapes[0][0].parameters["radius"], 10_000) < 4000
    assert grown(lambda: mesh.parameters["triangles"], 10_000) < 4000
    assert grown(lambda: search.at_most(3).reach, 100) < 8000
    assert grown(lambda: swept.EnclosingShapesSearch(hand, kind, pieces=20).count_for(0.01), 30) < 8000
    assert grown(lambda: swept.outside_shapes(hand, found.shapes, samples=100).point, 50) < 8000
    assert grown(lambda: swept.ShapeModel({"hand": found.shapes})["hand"], 5000) < 4000
    assert grown(refused, 5000) < 4000
    assert before == [sys.getrefcount(one) for one in (hand, hand[0][0], kind, found, mesh)]


def test_what_tasks_are_made_of_may_go(robot, tmp_path):
    """Objects outlive what they were made of."""
    def make():
        checker, home = swept.Checker(robot, "arm"), robot.named_state("arm", "home")
        ends = np.array([home, home + 0.01])
        phase = swept.TaskPhase("there", checker, swept.Trajectory(checker.group.variable_names, [0.0, 1.0], ends))
        swept.write_task(tmp_path / "task.json", [phase])
        return phase.checker, swept.verify_task(tmp_path / "task.json").phases[0].proof, swept.show_task([phase])

    checker, proof, page = make()
    gc.collect()
    assert checker.check_state(robot.named_state("arm", "home")) and proof and "there" in page.html


def test_what_schedules_are_made_of_may_go():
    """Objects outlive what they were made of."""
    def make():
        arms = swept.WorkCell.load("models/cells/two_rooks.yaml").robot()
        both, curves = swept.Checker(arms, "both"), crossing_schedule(arms)
        combined = swept.combined_curve(both, curves)
        return combined.curve, curves[1].curve, swept.certify_delays(both, curves, 0).contact

    curve, own, contact = make()
    gc.collect()
    assert curve.position(0.5).shape == (14,) and own.duration == 1.0
    assert contact.configuration.shape == (14,) and "/" in contact.witness.body_a


def test_constraints_and_lines_keep_what_they_need(robot):
    """Objects outlive what they were made of."""
    def make():
        checker = swept.Checker(robot, "arm", constraints=swept.TaskConstraint.upright("hand", 0.5))
        return swept.ConstraintProjection(checker), swept.ToolLinePlanner(checker, "hand"), checker.constraints.axes[0]

    projection, planner, axis = make()
    gc.collect()
    q = robot.named_state("arm", "ready")
    assert projection.used_share(q) > 0.0 and planner.pose(q).shape == (4, 4) and axis.angle == 0.5
    pieces = swept.WorkCell.load("models/cells/two_rooks.yaml").robot().link_shapes("left/hand")
    gc.collect()
    assert swept.EnclosingSpheresSearch(pieces, pieces=50, restarts=1).at_most(2).reach > 0.0


def test_references_are_given_back(checker, home):
    tipped = checker.with_constraints(swept.TaskConstraint.upright("hand", 0.01))
    projection, planner, way = swept.ConstraintProjection(tipped), swept.ToolLinePlanner(checker, "hand"), np.zeros(3)
    before = sys.getrefcount(home), sys.getrefcount(swept.Verdict.FREE), sys.getrefcount(checker)
    for _ in range(100):
        checker.check_state(home)
        checker.certify_motion(home, home, swept.MotionQuery.VERDICT_ONLY).verdict
        checker.check_states(home[None])
        with pytest.raises(TypeError):
            checker.check_state(home, home)
        projection.project(home)
        planner.plan_by(home, way).stop
        tipped.certify_motion(home, home).violation
        with pytest.raises(TypeError):
            swept.AxisConstraint(home, 0.1)
    after = sys.getrefcount(home), sys.getrefcount(swept.Verdict.FREE), sys.getrefcount(checker)
    assert before == after
