# SPDX-License-Identifier: BSD-3-Clause
"""Schedules that are planned: what C++ plans, bit for bit, and truths by samples."""
import math
import threading
import time

import numpy as np
import pytest
from conftest import MODELS, Oracle, numbers

import swept
from swept import ScheduleStatus, Verdict

CELL = MODELS / "cells/two_rooks.yaml"
REACHING = [0, 1.3, 0, 0.3, 0, 0, 0]


@pytest.fixture(scope="module")
def arms():
    return swept.WorkCell.load(CELL).robot()


@pytest.fixture(scope="module")
def both(arms):
    return swept.Checker(arms, "both", swept.World())


def limits_of(arms, group):
    return swept.RateLimits(swept.Checker(arms, group, swept.World()), acceleration=5.0)


def tasks_of(arms, starts, goals):
    return [swept.ScheduleTask(group, start, [goal], limits_of(arms, group))
            for group, start, goal in zip(("left/arm", "right/arm"), starts, goals)]


def tucked(arms, group):
    return arms.named_state(group, "tucked")


def test_plans_against_cpp(arms, both):
    asked = Oracle(str(CELL), "both", "models/scenes/empty.yaml")
    random = np.random.default_rng(5)
    reach, tuck = np.array(REACHING, float), tucked(arms, "left/arm")
    rows = []
    for seed, delay, slowest in ((1, 0.0, 1.0), (3, 0.1, 1.02)):
        near = random.uniform(-0.1, 0.1, (4, 7))
        rows.append(np.hstack([tuck + near[0], reach + near[1], reach + near[2], tuck + near[3],
                               [seed, delay, slowest]]))
    for words, row in zip(asked.ask("plan_schedule", rows), rows):
        tasks = tasks_of(arms, (row[:7], row[7:14]), (row[14:21], row[21:28]))
        found = swept.plan_schedule(both, tasks, seconds=600, improvements=30, seed=int(row[28]), delay=row[29],
                                    slowest=row[30])
        assert found and found.status is ScheduleStatus.FOUND and found.task is None
        assert str(found.status).replace(" ", "_") == words[0]
        expected = [value for trajectory in found.trajectories
                    for t, q in zip(trajectory.times, trajectory.positions) for value in (t, *q)]
        assert numbers(words[1:]).tolist() == expected
        assert found.certificate.verdict is Verdict.FREE and len(found.delays) == (2 if row[29] else 0)
        assert all(found.delays)
        for curve, trajectory, task in zip(found.curves, found.trajectories, tasks):
            assert curve.variable_names == trajectory.variable_names
            assert np.allclose(trajectory.positions[0], task.start) and np.allclose(trajectory.positions[-1], task.goals[0])
        assert swept.certify_schedule(both, found.curves).verdict is Verdict.FREE


def test_plans_beside_known_curves(arms, both):
    tuck, rest = tucked(arms, "left/arm"), np.zeros((4, 7))
    there = swept.Trajectory(arms.group("left/arm").variable_names, [0.0, 1.5, 2.5, 4.0],
                             [tuck, REACHING, REACHING, tuck], rest)
    known = [swept.ScheduledCurve(there)]
    start = tucked(arms, "right/arm")
    task = swept.ScheduleTask("right/arm", start, [REACHING, start], limits_of(arms, "right/arm"))
    assert task.group == "right/arm" and task.start.tolist() == start.tolist() and len(task.goals) == 2
    only = swept.ScheduleTask("right/arm", start, [REACHING], task.limits)
    found = swept.plan_schedule(both, [only], known)
    alone = swept.plan_schedule(both, [only], still=np.hstack([tuck, start]))
    assert found and alone and alone.curves[0].curve.knots[-1] + 0.5 < found.curves[0].curve.knots[-1]
    # Each ms both arms are apart.
    curve = found.curves[0].curve
    for t in np.arange(0.0, max(curve.knots[-1], 4.0), 1e-2):
        q = np.hstack([known[0].curve.position(min(t, 4.0)), curve.position(min(t, curve.knots[-1]))])
        assert both.check_state(q) is Verdict.FREE


def test_checker_beside_others(arms, both):
    tuck, rest = tucked(arms, "left/arm"), np.zeros((2, 7))
    left, right = (arms.group(name).variable_names for name in ("left/arm", "right/arm"))
    reach = swept.Trajectory(left, [0.0, 1.5], [tuck, REACHING], rest)
    beside = swept.ScheduleChecker(both, right, [swept.ScheduledCurve(reach)])
    assert beside.variable_names == tuple(right) and beside.end == 1.5
    counts = {Verdict.FREE: 0, Verdict.COLLISION: 0}
    for share in np.linspace(0.0, 1.0, 9):
        there = tuck + share * (np.array(REACHING) - tuck)
        # It ends when the other one does, so that both proofs are about the same time.
        other = swept.Trajectory(right, [0.0, 1.0, 1.5], [tuck, there, there], np.zeros((3, 7)))
        found = beside.certify(other)
        whole = swept.certify_schedule(both, [swept.ScheduledCurve(reach), swept.ScheduledCurve(other)])
        assert found.verdict is whole.verdict
        counts[found.verdict] += 1
    assert min(counts.values()) >= 2
    assert swept.ScheduleChecker(both, right, still=np.hstack([tuck, tuck]), ignored=left).certify(
        swept.Trajectory(right, [0.0, 1.0], [tuck, REACHING], rest)).verdict is Verdict.FREE


def test_what_is_not_free(arms, both):
    found = swept.plan_schedule(both, tasks_of(arms, (tucked(arms, "left/arm"), tucked(arms, "right/arm")),
                                               (REACHING, REACHING)))
    assert not found and found.status is ScheduleStatus.GOAL_NOT_FREE and found.task == 1
    assert found.contact.body_a.startswith("left/") and found.contact.body_b.startswith("right/")
    assert found.curves == () and found.trajectories == () and found.certificate is None and found.delays == ()


def test_what_is_refused(arms, both):
    start, limits = tucked(arms, "left/arm"), limits_of(arms, "left/arm")
    with pytest.raises(swept.ArgumentError, match=r"goals: expected finite"):
        swept.ScheduleTask("left/arm", start, [[0.0]], limits)
    with pytest.raises(swept.ArgumentError, match="start: .*finite"):
        swept.ScheduleTask("left/arm", [math.nan] * 7, [start], limits)
    task = swept.ScheduleTask("left/arm", start, [start], limits)
    with pytest.raises(swept.ArgumentError, match="nothing says where 'right/joint1' is"):
        swept.plan_schedule(both, [task])
    with pytest.raises(swept.ArgumentError, match="delay is -1 s; allowed are finite numbers from 0 on"):
        swept.plan_schedule(both, [task], still=np.zeros(14), delay=-1)
    with pytest.raises(swept.ArgumentError, match="slowest is 0.5; allowed are finite numbers from 1 on"):
        swept.plan_schedule(both, [task], still=np.zeros(14), slowest=0.5)
    with pytest.raises(swept.ArgumentError, match="the slowest factor is 0.5; allowed are finite numbers from 1 on"):
        swept.ScheduleChecker(both, arms.group("left/arm").variable_names, still=np.zeros(14), slowest=0.5)
    with pytest.raises(swept.ArgumentError, match="there is no group 'arm'"):
        swept.plan_schedule(both, [swept.ScheduleTask("arm", start, [start], limits)], still=np.zeros(14))
    with pytest.raises(swept.ArgumentError, match="there is no own variable"):
        swept.ScheduleChecker(both, [], still=np.zeros(14))


def test_cancel_ends_it(arms, both):
    # Both arms rest at one place: the second has no way to its goal, and never will.
    start, there = tucked(arms, "left/arm"), np.array(REACHING, float)
    stands = swept.Trajectory(arms.group("left/arm").variable_names, [0.0, 1.0], [there, there])
    task = swept.ScheduleTask("right/arm", start, [start + [0, 0, 0, 0, 0, 0, 1e-3]], limits_of(arms, "right/arm"))
    token = swept.CancellationToken()
    threading.Timer(0.2, token.cancel).start()
    begin = time.monotonic()
    with pytest.raises(swept.Cancelled):
        swept.plan_schedule(both, [task], [swept.ScheduledCurve(stands)], improvements=10**9, seconds=600, cancel=token)
    assert time.monotonic() - begin < 60
