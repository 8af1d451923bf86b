# SPDX-License-Identifier: BSD-3-Clause
"""Constraints: what C++ says, bit for bit, on random inputs; projections; plans that keep them."""
import copy
import math

import numpy as np
import pytest
from conftest import numbers

import swept
from swept import ConstraintKind, ConstraintRegion, TaskConstraint, Verdict


def at(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def constraints():
    """Those of oracle.cpp."""
    regions = [ConstraintRegion.box([1.2, 1.4, math.inf], at(0.0, 0.1, 0.4)), ConstraintRegion.sphere(0.7),
               ConstraintRegion.cylinder(0.3, 2.0)]
    return TaskConstraint.upright("hand", 2.0, [0.0, 0.6, 0.8]) & TaskConstraint(
        joints=[swept.JointConstraint("joint4", 0.2, above=1.6, below=1.4)],
        positions=[swept.PositionConstraint(("link5", at(0.0, 0.05, 0.1)), regions, "link1")],
        orientations=[swept.OrientationConstraint("hand", [3.0, 1.3, 4.0]),
                      swept.OrientationConstraint("link4", [2.5, 4.0, 2.8], reference="link2", rotation_vector=True)])


@pytest.fixture(scope="module")
def constrained(checker):
    return checker.with_constraints(constraints())


def violation_values(violation):
    return [violation.t, int(violation.kind), violation.index, violation.excess]


def test_reports_against_cpp(constrained, oracle, states):
    kinds, verdicts, holding = set(), [], 0
    for words, q in zip(oracle.ask("constrained_report", states), states):
        report = constrained.report_state(q)
        assert words[:2] == [report.verdict.name.lower(), str(report.constraints_hold)]
        said = " ".join(words[2:])
        for violation in report.violations:
            values = said.split(" ", 4)
            assert [float.fromhex(word) for word in values[:4]] == violation_values(violation)
            text = constrained.constraints.describe(violation)
            assert values[4].startswith(text)
            said = values[4][len(text) + 1:]
            kinds.add((violation.kind, violation.index))
        assert not said
        assert constrained.check_state(q) is report.verdict
        assert (report.verdict is Verdict.VIOLATION) == bool(report.violations)
        verdicts.append(report.verdict)
        holding += report.constraints_hold
    assert kinds == {(ConstraintKind.JOINT, 0), (ConstraintKind.POSITION, 0), (ConstraintKind.ORIENTATION, 0),
                     (ConstraintKind.ORIENTATION, 1), (ConstraintKind.AXIS, 0)}
    assert verdicts.count(Verdict.VIOLATION) > 60 and holding > 20 and verdicts.count(Verdict.FREE) > 3
    assert constrained.check_states(states).tolist() == [int(v) for v in verdicts]


def test_motions_against_cpp(constrained, oracle, states):
    ends = states[:-1] + 0.3 * (states[1:] - states[:-1])
    answers = oracle.ask("constrained_motion", np.hstack([states[:-1], ends]))
    found = [constrained.certify_motion(a, b) for a, b in zip(states, ends)]
    later = 0
    for words, one in zip(answers, found):
        assert words[0] == one.verdict.name.lower() and (one.violation is None) == (one.verdict is not Verdict.VIOLATION)
        values = numbers(words[1:4]).tolist()
        assert values == [one.free_until, one.effort.intervals, one.effort.lanes]
        if one.violation is not None:
            assert numbers(words[4:8]).tolist() == violation_values(one.violation) and one.violation.excess > 0.0
            assert one.free_until <= one.violation.t and "violation at t = " in repr(one)
            later += one.violation.t > 0.0
        elif one.witness is not None:
            assert float.fromhex(words[4]) == one.witness.t
    verdicts = [one.verdict for one in found]
    assert verdicts.count(Verdict.VIOLATION) > 60 and verdicts.count(Verdict.FREE) > 3 and later > 10
    batch = constrained.certify_motions(states[:-1], ends)
    assert batch.verdicts.tolist() == [int(v) for v in verdicts]
    assert sum(one.effort.constrained for one in batch) > 300


def test_trajectories_against_cpp(constrained, oracle, states):
    pairs = np.hstack([states[:60], states[:60] + 0.3 * (states[60:120] - states[:60])])
    limits, rest, violated = swept.RateLimits(constrained), np.zeros((2, 7)), 0
    for words, row in zip(oracle.ask("constrained_trajectory", pairs), pairs):
        trajectory = swept.Trajectory(constrained.group.variable_names, [0.0, 1.0], row.reshape(2, 7), rest)
        found = constrained.certify_trajectory(trajectory, limits=limits)
        assert words[0] == found.verdict.name.lower()
        assert numbers(words[1:3]).tolist() == [found.free_until, len(found.violations)]
        if found.violation is not None:
            violated += 1
            assert numbers(words[3:8]).tolist() == [found.violation_time] + violation_values(found.violation)
        assert (found.violation is None) == (found.violation_time is None)
    assert violated > 20


def test_projections_against_cpp(constrained, oracle, states):
    projection = swept.ConstraintProjection(constrained)
    assert projection.dimension == projection.degrees_of_freedom == 7 and projection.rows > 5
    rows, solved = projection.rows, 0
    for words, q in zip(oracle.ask("project", states[:100]), states):
        values = numbers(words[:1 + 8 * rows])
        assert values[0] == projection.used_share(q)
        assert (values[1:1 + rows] == projection.residuals(q)).all()
        assert (values[1 + rows:].reshape(rows, 7) == projection.jacobian(q)).all()
        found = projection.project(q, share=0.4)
        assert words[1 + 8 * rows] == str(found is not None)
        if found is not None:
            solved += 1
            assert (numbers(words[2 + 8 * rows:]) == found).all()
            assert constrained.report_state(found).constraints_hold and projection.used_share(found) <= 0.46 + 1e-9
    assert 50 < solved <= 100
    moved, flags = projection.project_states(states, share=0.4)
    assert moved.shape == states.shape and flags.dtype == bool and flags[:100].sum() == solved
    for q, new, flag in zip(states, moved, flags):
        one = projection.project(q, share=0.4)
        assert (one is not None) == flag and (one is None or (one == new).all())
    tight = projection.within(states[0] - 0.1, states[0] + 0.1)
    near, _ = tight.project_states(states[:20])
    assert (np.abs(near - states[0]) <= 0.1 + 1e-12).all()
    empty, none = projection.project_states(np.empty((0, 7)))
    assert empty.shape == (0, 7) and none.shape == (0,)


def test_projections_refuse(constrained, states):
    projection = swept.ConstraintProjection(constrained)
    with pytest.raises(swept.ArgumentError, match=r"^q: expected finite float64 values of shape \(7,\)"):
        projection.project(states[0, :3].copy())
    with pytest.raises(swept.ArgumentError, match="^states: expected finite"):
        projection.project_states(states[:, :3].copy())
    for share in (0.0, 1.0, math.nan):
        with pytest.raises(swept.ArgumentError, match="share"):
            projection.project(states[0], share=share)
    with pytest.raises(swept.ArgumentError):
        projection.within(states[0], states[0] - 1.0)
    token = swept.CancellationToken()
    token.cancel()
    with pytest.raises(swept.Cancelled, match="^cancelled by its token$"):
        projection.project_states(states, cancel=token)


def test_what_a_constraint_has():
    all_of = constraints()
    assert len(all_of) == 5 and len(TaskConstraint()) == 0 and not TaskConstraint()
    (joint,), (position,), (euler, vector), (axis,) = all_of.joints, all_of.positions, all_of.orientations, all_of.axes
    assert (joint.joint, joint.position, joint.above, joint.below) == ("joint4", 0.2, 1.6, 1.4)
    body, pose = position.frame
    assert body == "link5" and (pose == at(0.0, 0.05, 0.1)).all() and position.reference[0] == "link1"
    assert [(r.kind, r.size.tolist()) for r in position.regions] == [
        ("box", [1.2, 1.4, math.inf]), ("sphere", [0.7, 0, 0]), ("cylinder", [0.3, 2.0, 0])]
    assert (position.regions[0].pose == at(0.0, 0.1, 0.4)).all()
    assert euler.tolerance.tolist() == [3.0, 1.3, 4.0] and not euler.rotation_vector and vector.rotation_vector
    assert euler.reference[0] == "" and vector.reference[0] == "link2" and (euler.orientation == np.eye(4)).all()
    assert axis.angle == 2.0 and axis.axis.tolist() == [0.0, 0.6, 0.8] and axis.direction.tolist() == [0, 0, 1]
    for one in (all_of, joint, position, euler, axis, position.regions[0]):
        assert copy.copy(one) is one and copy.deepcopy(one) is one and type(one).__name__ in repr(one)


def test_makers(checker, states):
    """Each is the same as what it is made of, on all states."""
    pose = checker.robot.link_pose("arm", "hand", states[0])
    made = {
        TaskConstraint.upright("hand", 1.0): TaskConstraint(axes=[swept.AxisConstraint("hand", 1.0)]),
        TaskConstraint.level("hand", pose, 1.0): TaskConstraint(
            axes=[swept.AxisConstraint("hand", 1.0, axis=pose[2, :3].copy())]),
        TaskConstraint.inside("hand", [0.8, 0.8, 1.0], at(0, 0, 0.5), [0, 0, 0.1]): TaskConstraint(
            positions=[swept.PositionConstraint(("hand", at(0, 0, 0.1)),
                                                [ConstraintRegion.box([0.8, 0.8, 1.0], at(0, 0, 0.5))])]),
        TaskConstraint.on_line("hand", [0, 0, 0], [0, 0, 1], 0.3): TaskConstraint(
            positions=[swept.PositionConstraint("hand", [ConstraintRegion.cylinder(0.3, math.inf)])]),
        TaskConstraint.on_plane("hand", [0, 0, 0.5], [0, 0, 2], 0.2): TaskConstraint(
            positions=[swept.PositionConstraint("hand", [ConstraintRegion.box([math.inf, math.inf, 0.4],
                                                                              at(0, 0, 0.5))])])}
    for one, same in made.items():
        a, b = checker.with_constraints(one).check_states(states), checker.with_constraints(same).check_states(states)
        assert (a == b).all() and 20 < (a == Verdict.VIOLATION).sum() < 290, one
    assert len(checker.constraints) == 0


def test_constructor_and_versions(checker, constrained, states):
    same = swept.Checker(checker.robot, "arm", checker.world, constraints=constraints())
    assert (same.check_states(states) == constrained.check_states(states)).all()
    assert len(same.constraints) == 5 and len(constrained.with_constraints(TaskConstraint()).constraints) == 0
    assert len(constrained.with_body("globe", swept.Shape.sphere(0.1)).constraints) == 5
    bar = constrained.with_attached("bar", "hand", swept.Shape.sphere(0.01), at(0, 0, 0.2))
    assert bar.with_constraints(TaskConstraint.upright("bar", 1.0)).check_states(states).max() == Verdict.VIOLATION


@pytest.mark.parametrize("make, message", [
    (lambda: TaskConstraint.upright("nose", 1.0), "nose"),
    (lambda: TaskConstraint.upright("hand", -1.0), "hand"),
    (lambda: TaskConstraint.upright("hand", math.nan), "hand"),
    (lambda: TaskConstraint.upright("hand", 1.0, [0.0, 0.0, 0.0]), "axis"),
    (lambda: TaskConstraint.level("hand", 2 * np.eye(4), 1.0), "^pose: "),
    (lambda: TaskConstraint(joints=[swept.JointConstraint("joint9", 0.0)]), "joint9"),
    (lambda: TaskConstraint(joints=[swept.JointConstraint("joint4", 100.0)]), "joint4"),
    (lambda: TaskConstraint(positions=[swept.PositionConstraint("hand", [])]), "region"),
    (lambda: TaskConstraint(positions=[swept.PositionConstraint("hand", [ConstraintRegion.sphere(-1.0)])]), "size"),
    (lambda: TaskConstraint(orientations=[swept.OrientationConstraint("hand", [1.0, 1.0, -1.0])]), "tolerance"),
    (lambda: TaskConstraint(axes=[swept.AxisConstraint("hand", 0.1)] * 65), "64"),
    (lambda: TaskConstraint.inside("hand", [1.0, 1.0]), "^size: expected three numbers"),
    (lambda: TaskConstraint.inside("hand", 1.0), "^size: expected three numbers"),
    (lambda: TaskConstraint.on_line("hand", [0, 0, math.inf], [0, 0, 1], 0.1), "^origin: expected finite"),
])
def test_what_cannot_be_kept(checker, make, message):
    with pytest.raises(swept.ArgumentError, match=message):
        checker.with_constraints(make())


def test_wrong_types():
    with pytest.raises(swept.ArgumentTypeError, match="^frame: expected the name of a link or an attached body, or a "):
        swept.AxisConstraint(3, 1.0)
    with pytest.raises(swept.ArgumentTypeError, match="^reference: expected the name"):
        swept.AxisConstraint("hand", 1.0, reference=("hand", None, 1))
    with pytest.raises(swept.ArgumentTypeError, match="^size: expected three numbers"):
        ConstraintRegion.box(["a", 1.0, 1.0])


def test_descriptions_of_others(constrained, states):
    violation = next(v for q in states for v in constrained.report_state(q).violations if v.kind == ConstraintKind.JOINT)
    assert "joint4" in constrained.constraints.describe(violation)
    with pytest.raises(swept.ArgumentError, match="^violation: it is not one of these constraints$"):
        TaskConstraint().describe(violation)


@pytest.fixture(scope="module")
def level(robot):
    """An empty world in which the hand keeps within 30 degrees of how it stands in `ready`."""
    ready = robot.named_state("arm", "ready")
    keep = TaskConstraint.level("hand", robot.link_pose("arm", "hand", ready), math.radians(30))
    return swept.Checker(robot, "arm", constraints=keep)


def test_plans_keep_constraints(level, robot):
    start = level.named_state("ready")
    goal = start + np.array([1.5, 0, 0, 0, 0, 0, 0])
    plan = swept.plan(level, start, goal, seconds=20.0)
    assert plan and plan.certificate.verdict is Verdict.FREE
    up = robot.link_pose("arm", "hand", start)[2, :3]
    for a, b in zip(plan.path, plan.path[1:]):
        for t in np.linspace(0.0, 1.0, 50):
            pose = robot.link_pose("arm", "hand", level.interpolate(a, b, t))
            assert (pose[:3, :3] @ up)[2] >= math.cos(math.radians(30)) - 1e-9
    tipped = np.array([0.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    found = swept.certify_path(level, np.array([start, tipped, goal]))
    assert found.verdict is Verdict.VIOLATION and found.segments[0].violation.kind is ConstraintKind.AXIS
    refused = swept.plan(level, start, tipped, seconds=0.2)
    assert not refused and not refused.solved


def test_proofs_have_constraints(level, tmp_path):
    start = level.named_state("ready")
    file = tmp_path / "path.json"
    swept.write_proof(file, level, np.array([start, start + np.array([1.5, 0, 0, 0, 0, 0, 0])]))
    proof = swept.verify(file)
    assert proof and len(proof.constraints) == 1
    assert proof.constraints[0].startswith("axis (") and " of hand within 0.524 rad of (0, 0, 1)" in proof.constraints[0]
    assert swept.verify(file, level).constraints == proof.constraints
    tighter = level.with_constraints(TaskConstraint.upright("hand", 0.1))
    assert swept.verify(file, tighter).refusal == "constraints: they are not those of the checker"


def test_plans_to_poses_under_constraints(level, robot):
    start = level.named_state("ready")
    pose = robot.link_pose("arm", "hand", start)
    turned = pose.copy()
    c, s = math.cos(0.7), math.sin(0.7)
    turned[:3] = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ pose[:3]
    plan = swept.plan(level, start, swept.PoseGoal("hand", turned), seconds=20.0)
    assert plan and np.allclose(robot.link_pose("arm", "hand", plan.path[-1])[:3, 3], turned[:3, 3], atol=1e-3)
    upside = pose.copy()
    upside[:3, :3] = pose[:3, :3] @ np.diag([1.0, -1.0, -1.0])
    found = swept.plan(level, start, swept.PoseGoal("hand", upside))
    assert not found and found.status == "no free state reaches the goal pose"


REQUEST = """
group_name: arm
start_state: {joint_state: {name: [joint1, joint2, joint4, joint6], position: [0.1, 0.4, 1.2, 0.8]}}
goal_constraints:
  - joint_constraints:
      - {joint_name: joint1, position: 0.5}
path_constraints:
  orientation_constraints:
    - header: {frame_id: world}
      link_name: hand
      orientation: {x: 0, y: 1, z: 0, w: 0}
      absolute_x_axis_tolerance: 0.2
      absolute_y_axis_tolerance: 0.3
      absolute_z_axis_tolerance: 3.2
  joint_constraints:
    - {joint_name: joint4, position: 1.0, tolerance_above: 0.5, tolerance_below: 0.4}
"""


def test_requests(robot, checker, tmp_path):
    file = tmp_path / "request.yaml"
    file.write_text(REQUEST)
    request = swept.PlanningRequest.load(file, robot)
    assert request.group == "arm" and request.start["joint4"] == 1.2 and request.goals == ({"joint1": 0.5},)
    assert request.pose_goals == () and request.attached == () and len(request.rules) == 0
    keep = request.path_constraints
    (joint,), (orientation,) = keep.joints, keep.orientations
    assert (joint.joint, joint.position, joint.above, joint.below) == ("joint4", 1.0, 0.5, 0.4)
    assert orientation.frame[0] == "hand" and orientation.tolerance.tolist() == [0.2, 0.3, 3.2]
    assert np.allclose(orientation.orientation, np.diag([-1.0, 1.0, -1.0, 1.0]))
    assert len(checker.with_constraints(keep).constraints) == 2
    file.write_text(REQUEST.replace("joint4, position: 1.0", "joint9, position: 1.0"))
    with pytest.raises(swept.InputError, match="joint9"):
        swept.PlanningRequest.load(file, robot)
