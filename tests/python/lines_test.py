# SPDX-License-Identifier: BSD-3-Clause
"""Straight motions of a tool: what C++ says, bit for bit, on random inputs."""
import copy
import math

import numpy as np
import pytest
from conftest import numbers
from constraints_test import constraints

import swept
from swept import LineStop


@pytest.fixture(scope="module")
def planner(checker):
    return swept.ToolLinePlanner(checker, "hand")


@pytest.fixture(scope="module")
def alone(robot):
    return swept.Checker(robot, "arm")


def values_of(line):
    return [line.length, line.turn, line.share, line.position, line.angle, line.solved, *line.path.ravel()]


@pytest.mark.parametrize("keeps", [0.0, 1.0])
def test_lines_against_cpp(checker, oracle, states, random, keeps):
    tested = checker.with_constraints(constraints()) if keeps else checker
    planner = swept.ToolLinePlanner(tested, "hand")
    by = random.uniform(-0.15, 0.15, (len(states), 3))
    reasons, complete = set(), 0
    for words, q, way in zip(oracle.ask("tool_line", np.hstack([states, by, np.full((len(states), 1), keeps)])),
                             states, by):
        line = planner.plan_by(q, way, position=2e-3)
        values = values_of(line)
        assert numbers(words[:len(values)]).tolist() == values
        assert line.complete == bool(line) == (line.stop is None) == (line.share == 1.0)
        assert len(line.shares) == len(line.path) and (np.diff(line.shares) > 0).all()
        complete += line.complete
        if line.stop is None:
            assert len(words) == len(values)
            goal = planner.pose(q)
            goal[:3, 3] += way
            assert (planner.plan(q, goal, position=2e-3).path == line.path).all()
            continue
        stop, rest = line.stop, words[len(values):]
        reasons.add(stop.reason)
        assert numbers(rest[:4]).tolist() == [int(stop.reason), stop.share, stop.least_singular_value, stop.joint_step]
        assert " ".join(rest[4:]) == str(stop) and str(stop) in repr(line)
        assert (stop.witness is None) == (stop.reason is not LineStop.CONTACT)
        assert (stop.violation is None) == (stop.reason is not LineStop.VIOLATION)
        assert (stop.variable is None) == (stop.reason is not LineStop.LIMIT)
    assert reasons >= {LineStop.CONTACT, LineStop.LIMIT} and (LineStop.VIOLATION in reasons) == bool(keeps)
    assert complete >= 10


def test_the_tool_stays_on_its_line(alone, states):
    """Sampled, with the proven deviation."""
    planner, lines = swept.ToolLinePlanner(alone, "hand"), 0
    for q in states[:60]:
        line = planner.plan_by(q, [0.0, 0.06, -0.08], position=5e-4, angle=0.01)
        if not line:
            continue
        lines += 1
        assert line.length == pytest.approx(0.1) and line.turn < 1e-9 and line.position <= 5e-4 and line.angle <= 0.01
        start, end = line.start_pose[:3, 3], line.goal_pose[:3, 3]
        assert (line.path[0] == q).all() and np.allclose(planner.pose(line.path[-1])[:3, 3], end, atol=2e-6)
        along = (end - start) / line.length
        for a, b in zip(line.path, line.path[1:]):
            for t in np.linspace(0.0, 1.0, 20):
                pose = planner.pose(alone.interpolate(a, b, t))
                off = pose[:3, 3] - start
                assert np.linalg.norm(off - off @ along * along) <= line.position + 1e-12
                turned = line.start_pose[:3, :3].T @ pose[:3, :3]
                assert math.acos(min(1.0, (np.trace(turned) - 1) / 2)) <= line.angle + 1e-7
        assert swept.certify_path(alone, line.path)
    assert lines > 10


def test_frames(alone, states):
    """In the tool's own axes, and with a tool beside the link."""
    tool = np.eye(4)
    tool[:3, 3] = 0.0, 0.02, 0.1
    planner, compared = swept.ToolLinePlanner(alone, "hand", tool), 0
    for q in states[:40]:
        pose = planner.pose(q)
        assert np.allclose(pose, alone.robot.link_pose("arm", "hand", q) @ tool, atol=1e-12)
        line = planner.plan_by(q, [0.0, 0.0, 0.03], in_tool=True)
        assert np.allclose(line.goal_pose[:3, 3], pose[:3, 3] + 0.03 * pose[:3, 2], atol=1e-12)
        compared += line.complete
    assert compared > 10


def test_turns_and_options(alone):
    planner = swept.ToolLinePlanner(alone, "hand")
    ready = alone.named_state("ready")
    goal = planner.pose(ready)
    goal[:3, :3] = goal[:3, :3] @ np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    turn = planner.plan(ready, goal)
    assert turn and turn.turn == pytest.approx(math.pi / 2) and turn.length == 0.0
    few = planner.plan(ready, goal, max_way_points=2)
    assert not few and few.stop.reason is LineStop.UNDECIDED
    free = planner.plan(ready, goal, angle=4.0)
    assert free and free.angle == 0.0
    beyond = planner.plan_by(ready, [0.0, 0.0, -2.0])
    assert not beyond and 0.0 < beyond.share < 1.0 and beyond.stop.share >= beyond.share
    assert copy.copy(beyond) is beyond and copy.deepcopy(planner) is planner


def test_lines_end_with_their_token(planner, home):
    """And after their time; Ctrl-C is in threads_test.py."""
    token, goal = swept.CancellationToken(), planner.pose(home)
    token.cancel()
    for call in (lambda **how: planner.plan(home, goal, **how), lambda **how: planner.plan_by(home, [0, 0, 0.1], **how)):
        with pytest.raises(swept.Cancelled, match="^cancelled by its token$"):
            call(cancel=token)
        with pytest.raises(swept.Cancelled, match="^the time was up before the work was done$"):
            call(seconds=0.0)
        call(seconds=100.0, cancel=swept.CancellationToken())


def test_what_lines_refuse(checker, planner, home):
    goal = planner.pose(home)
    with pytest.raises(swept.ArgumentError, match="nose"):
        swept.ToolLinePlanner(checker, "nose")
    with pytest.raises(swept.ArgumentError):
        swept.ToolLinePlanner(checker, "link0")
    with pytest.raises(swept.ArgumentError):
        swept.ToolLinePlanner(checker, "hand", np.diag([2.0, 1.0, 1.0, 1.0]))
    moving = checker.with_obstacle("drone", swept.Shape.sphere(0.1), [0.0, 1.0], [np.eye(4), np.eye(4)])
    with pytest.raises(swept.ArgumentError, match="moving"):
        swept.ToolLinePlanner(moving, "hand")
    with pytest.raises(swept.ArgumentError, match=r"^start: expected finite float64 values of shape \(7,\)"):
        planner.plan(home[:3].copy(), goal)
    with pytest.raises(swept.ArgumentError, match="^displacement: "):
        planner.plan_by(home, [0.0, math.nan, 0.0])
    with pytest.raises(swept.ArgumentError):
        planner.plan(home, np.diag([2.0, 1.0, 1.0, 1.0]))
    for options in ({"position": 0.0}, {"angle": -1.0}, {"least_step": math.nan}, {"max_way_points": 1}):
        with pytest.raises(swept.ArgumentError):
            planner.plan(home, goal, **options)
