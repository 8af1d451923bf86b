# SPDX-License-Identifier: BSD-3-Clause
"""Planning, paths, proofs, trajectories and pages."""
import html
import math
import threading
import time

import numpy as np
import pytest
from conftest import MODELS, numbers

import swept
from swept import Verdict


@pytest.fixture(scope="module")
def slot(robot):
    return swept.Checker(robot, "arm", swept.World.load(MODELS / "scenes/narrow_slot.yaml"))


@pytest.fixture(scope="module")
def plan(slot):
    return swept.plan(slot, slot.named_state("home"), slot.named_state("ready"))


@pytest.mark.parametrize("planner", ["CertifiedConnect", "rrtconnect", "KPIECE1", "PRM"])
def test_plan(slot, planner):
    start, goal = slot.named_state("home"), slot.named_state("ready")
    found = swept.plan(slot, start, goal, planner=planner, seconds=20.0)
    assert found and found.solved and found.planner.lower() == planner.lower()
    assert (found.path[0] == start).all() and (found.path[-1] == goal).all()
    assert len(found.certificate) == len(found.path) - 1
    for a, b, segment in zip(found.path, found.path[1:], found.certificate.segments):
        assert segment and slot.certify_motion(a, b)
    assert found.motions_certified > 0 and found.motions_refused > 0


def test_the_same_seed_gives_the_same_path(slot, plan):
    start, goal = slot.named_state("home"), slot.named_state("ready")
    assert np.array_equal(swept.plan(slot, start, goal).path, plan.path)
    other = swept.plan(slot, start, goal, seed=2, shorten=False)
    assert other and not np.array_equal(other.path, plan.path)


def test_several_goals_and_poses(slot, robot):
    start, ready = slot.named_state("home"), slot.named_state("ready")
    found = swept.plan(slot, start, np.array([ready, start + 0.01]))
    assert found and (found.path[-1] == start + 0.01).all()
    pose = robot.link_pose("arm", "hand", ready)
    goal = swept.PoseGoal("hand", pose, orientation_tolerance=0.05)
    found = swept.plan(slot, start, goal, seconds=20.0)
    assert found and np.linalg.norm(robot.link_pose("arm", "hand", found.path[-1])[:3, 3] - pose[:3, 3]) < 1e-3
    pose[0, 3] = 50.0
    found = swept.plan(slot, start, swept.PoseGoal("hand", pose))
    assert not found and not found.solved and found.path is None
    assert found.status == "no free state reaches the goal pose"


def test_what_cannot_be_planned(slot):
    home = slot.named_state("home")
    with pytest.raises(swept.UsageError, match="^no planner 'RRTConect'.*did you mean"):
        swept.plan(slot, home, home, planner="RRTConect")
    with pytest.raises(ValueError, match="^goal: expected finite float64 values of shape"):
        swept.plan(slot, home, home[:3].copy())
    with pytest.raises(ValueError, match="^seconds: "):
        swept.plan(slot, home, home, seconds=math.nan)
    with pytest.raises(swept.UsageError, match="has no range"):
        swept.plan(slot, home, slot.named_state("ready"), planner="PRM", range=1.0)
    blocked = swept.plan(slot, home, np.array([0.2, 0.4, 0, 1.2, 0, 0.8, 0]), seconds=0.1)
    assert not blocked.solved and not blocked
    assert "RRTstar" in swept.planner_names()


def test_cancelled_from_another_thread(slot):
    token = swept.CancellationToken()
    begin = time.monotonic()
    threading.Timer(0.3, token.cancel).start()
    with pytest.raises(swept.Cancelled, match="^cancelled by its token$"):
        home, ready = slot.named_state("home"), slot.named_state("ready")
        swept.plan(slot, home, ready, planner="RRTstar", seconds=60.0, cancel=token)
    assert time.monotonic() - begin < 30.0 and token.cancelled
    with pytest.raises(swept.Cancelled):
        slot.check_states(np.zeros((4, 7)), cancel=token)
    with pytest.raises(swept.Cancelled, match="^the time was up"):
        slot.certify_motions(np.zeros((4, 7)), np.zeros((4, 7)), seconds=0.0)


def test_shorter_paths(slot):
    start, goal = slot.named_state("home"), slot.named_state("ready")
    long = swept.plan(slot, start, goal, shorten=False, range=0.3).path
    length = lambda path: np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    for short in (swept.shorten_path(slot, long), swept.simplify_path(slot, long, 0.2)):
        assert (short[0] == start).all() and (short[-1] == goal).all()
        assert swept.certify_path(slot, short, clearances=False) and length(short) < length(long)


def test_certificates_of_paths(slot, plan):
    certificate = swept.certify_path(slot, plan.path)
    assert certificate.verdict is Verdict.FREE and len(certificate.clearances) == len(certificate)
    clearance = swept.path_clearance(slot, plan.path, 1e-4)
    least = min(c.lower for c in certificate.clearances)
    assert abs(clearance.lower - least) < 2e-4 and clearance.segment is not None
    direct = swept.certify_path(slot, plan.path[[0, -1]])
    assert direct.verdict is Verdict.COLLISION and direct.clearances == (None,)
    with pytest.raises(ValueError, match="^path: expected one state"):
        swept.certify_path(slot, np.empty((0, 7)))


def test_path_clearance_against_cpp(checker, oracle, states):
    pairs = np.hstack([states[:20], states[20:40]])
    for words, row in zip(oracle.ask("path_clearance", pairs), pairs):
        found = swept.path_clearance(checker, row.reshape(2, 7), 1e-3)
        assert [float.fromhex(w) for w in words[:3]] == [found.lower, found.upper, found.t]
        assert words[3:] == [str(found.body_a), str(found.body_b)]


def test_proofs(slot, plan, tmp_path):
    file = tmp_path / "proof.json"
    swept.write_proof(file, slot, plan.path)
    proof = swept.verify(file)
    assert proof and proof.holds and proof.segments == len(plan.path) - 1 and proof.planes > 0
    assert swept.verify(file, slot) and (swept.read_path(file, slot) == plan.path).all()
    moved = slot.with_body("ball", swept.Shape.sphere(0.01), np.diag([1.0, 1, 1, 1]) + np.eye(4, k=3) * 5)
    assert not swept.verify(file, moved) and swept.verify(file, moved).refusal
    with pytest.raises(swept.UsageError):
        swept.write_proof(file, slot, plan.path[[0, -1]])
    with pytest.raises(swept.InputError) as caught:
        swept.verify("models/scenes/shelf.yaml")
    assert caught.value.file == "models/scenes/shelf.yaml" and caught.value.message in str(caught.value)


def test_trajectories(slot, plan, tmp_path):
    limits = swept.RateLimits(slot, acceleration=3.0)
    proven = swept.proven_trajectory(slot, plan.path, limits)
    assert proven and not proven.certificate.violations
    times, curve = proven.trajectory.times, proven.curve
    assert times[0] == 0.0 and times[-1] == curve.duration
    for t in np.linspace(0.0, curve.duration, 200):
        assert slot.check_state(curve.position(t)) is not Verdict.COLLISION
        assert (np.abs(curve.velocity(t)) <= limits.velocity + 1e-6).all()
        assert (np.abs(curve.acceleration(t)) <= limits.acceleration + 1e-6).all()
    for name in ("t.csv", "t.json"):
        proven.trajectory.save(tmp_path / name)
        (read,) = swept.Trajectory.load(tmp_path / name, slot)
        for part in ("times", "positions", "velocities"):
            assert np.array_equal(getattr(read, part), getattr(proven.trajectory, part))
        assert read.accelerations is None
    swept.write_trajectory_proof(tmp_path / "proof.json", slot, proven.trajectory)
    assert swept.verify(tmp_path / "proof.json").duration == pytest.approx(curve.duration)
    # Beside a ball that stands in the way until the clock shows 5 s.
    at, away = np.eye(4), np.eye(4)
    at[:3, 3] = slot.robot.link_pose("arm", "hand", curve.position(0.5 * curve.duration))[:3, 3]
    away[:3, 3] = [5.0, 0.0, 0.0]
    late = slot.with_obstacle("ball", swept.Shape.sphere(0.05), [0.0, 4.0, 5.0], [at, at, away])
    assert late.certify_trajectory(proven.trajectory).verdict is Verdict.COLLISION
    with pytest.raises(swept.UsageError):
        swept.write_trajectory_proof(tmp_path / "early.json", late, proven.trajectory)
    swept.write_trajectory_proof(tmp_path / "late.json", late, proven.trajectory, clock=6.0)
    assert swept.verify(tmp_path / "late.json").duration == pytest.approx(curve.duration)
    tight = slot.certify_trajectory(proven.trajectory, limits=swept.RateLimits(slot, velocity=0.01))
    assert {v.kind for v in tight.violations} == {swept.LimitKind.VELOCITY}


def test_certify_trajectory_against_cpp(checker, oracle, states):
    pairs = np.hstack([states[:60], states[:60] + 0.3 * (states[60:120] - states[:60])])
    limits, rest = swept.RateLimits(checker), np.zeros((2, 7))
    verdicts = []
    for words, row in zip(oracle.ask("certify_trajectory", pairs), pairs):
        trajectory = swept.Trajectory(checker.group.variable_names, [0.0, 1.0], row.reshape(2, 7), rest)
        found = checker.certify_trajectory(trajectory, limits=limits)
        assert words[0] == found.verdict.name.lower()
        assert numbers(words[1:3]).tolist() == [found.free_until, len(found.violations)]
        if found.witness is not None:
            assert float.fromhex(words[3]) == found.contact_time and words[4] == found.witness.body_a
        verdicts.append(found.verdict)
    assert verdicts.count(Verdict.FREE) > 5 and verdicts.count(Verdict.COLLISION) > 5


def test_certify_trajectory_of_other_variables(checker, home):
    names, ends = checker.group.variable_names, np.array([home, home + 0.01])
    assert checker.certify_trajectory(swept.Trajectory(names, [0.0, 1.0], ends))
    swapped = swept.Trajectory(names[1::-1] + names[2:], [0.0, 1.0], ends)
    text = "trajectory: expected the variables joint1, joint2, .*, joint7, in this order; got joint2, joint1, joint3"
    with pytest.raises(swept.ArgumentError, match=text):
        checker.certify_trajectory(swapped)
    with pytest.raises(swept.ArgumentError, match="^curve: expected the variables joint1, "):
        swept.ScheduleChecker(checker, names).certify(swapped)


def test_ranges(slot, home):
    ready = slot.named_state("ready")
    for bad in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(swept.ArgumentError, match="^range: expected a positive number"):
            swept.plan(slot, home, ready, range=bad)
    # With a range of so little RRT goes nowhere. As 0 it would be the planner's own.
    assert not swept.plan(slot, home, ready, planner="RRT", range=1e-7, seconds=0.3)


def test_plan_trajectory(slot):
    tube = swept.TrackingTolerance(rotation=0.005)
    limits = swept.RateLimits(slot, acceleration=3.0)
    planned = swept.plan_trajectory(slot, slot.named_state("home"), slot.named_state("ready"), limits, tracking=tube)
    assert planned and planned.checker.tracking.rotation == 0.005 and planned.proven.trajectory
    blocked = np.array([0.2, 0.4, 0, 1.2, 0, 0.8, 0])
    assert not swept.plan_trajectory(slot, slot.named_state("home"), blocked, limits, seconds=0.1)


def test_curves():
    curve = swept.Curve([0.0, 1.0], [[[0.0, 1.0], [2.0, 2.0]]])
    assert curve.position(0.25).tolist() == [0.25, 2.0] and curve.velocity(0.5).tolist() == [1.0, 0.0]
    spline = swept.Curve.b_spline(1, [0.0, 0.0, 1.0, 1.0], [[0.0, 2.0], [1.0, 2.0]])
    assert spline.position(0.25).tolist() == [0.25, 2.0] and spline.dimension == 2
    with pytest.raises(TypeError, match="^trajectory: expected a swept.Trajectory or a swept.Curve"):
        swept.Checker(swept.Robot.load(MODELS / "robots/rook7/rook7.urdf"), "arm").certify_trajectory([1.0])
    with pytest.raises(ValueError):
        swept.Trajectory(["a"], [0.0, 0.0], [[1.0], [2.0]])


def test_inverse_kinematics(checker, robot, oracle, states):
    kinematics = swept.InverseKinematics(robot, "arm", "hand")
    pairs = np.hstack([states[:50], states[50:100]])
    found = 0
    for words, row in zip(oracle.ask("inverse_kinematics", pairs), pairs):
        pose = kinematics.pose(row[:7])
        assert (pose == robot.link_pose("arm", "hand", row[:7])).all()
        q = kinematics.solve(pose, row[7:])
        assert words[0] == str(q is not None)
        if q is not None:
            found += 1
            assert (numbers(words[1:]) == q).all() and np.allclose(kinematics.pose(q), pose, atol=1e-5)
    assert found > 10
    q, step = states[0], 1e-6
    columns = [(kinematics.pose(q + e)[:3, 3] - kinematics.pose(q - e)[:3, 3]) / (2 * step) for e in step * np.eye(7)]
    assert np.allclose(kinematics.jacobian(q)[:3], np.transpose(columns), atol=1e-6)


def test_pages(slot, plan, tmp_path):
    page = swept.show(slot, plan, plan.path[[0, -1]], file=tmp_path / "page.html", title="two paths")
    assert "2 paths: 1 free, 1 in collision" in page.html and "two paths" in page.html
    assert (tmp_path / "page.html").read_text() == page.html
    frame = page._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and html.escape(page.html) in frame
    assert '"state 1"' in swept.show(slot, plan.path[0]).html
    proven = swept.proven_trajectory(slot, plan.path, swept.RateLimits(slot, acceleration=3.0))
    assert swept.show(slot, proven).html
    with pytest.raises(ValueError):
        swept.show(slot, plan.path, plan.path[0])
    far = np.eye(4)
    far[0, 3] = 50.0
    with pytest.raises(swept.UsageError, match="^a plan without a path"):
        swept.show(slot, swept.plan(slot, plan.path[0], swept.PoseGoal("hand", far)))
    with pytest.raises(swept.UsageError):
        page.write(tmp_path / "page.txt")
