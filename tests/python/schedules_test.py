# SPDX-License-Identifier: BSD-3-Clause
"""Several curves on one clock: what C++ says, bit for bit, and truths by hand and by samples."""
import copy
import math
import threading

import numpy as np
import pytest
from conftest import MODELS, Oracle, numbers

import swept
from swept import Verdict

CELL, SCENE = MODELS / "cells/two_rooks.yaml", "models/scenes/bin.yaml"


@pytest.fixture(scope="module")
def arms():
    return swept.WorkCell.load(CELL).robot()


@pytest.fixture(scope="module")
def both(arms):
    return swept.Checker(arms, "both", swept.World.load(SCENE))


@pytest.fixture(scope="module")
def asked():
    return Oracle(str(CELL), "both", SCENE)


@pytest.fixture(scope="module")
def questions():
    """(40, 32): both ends of 14 values, two starts and two slowdowns. The arms reach over the table between them,
    farther in some than in others.
    """
    random = np.random.default_rng(11)
    reaching = random.uniform(0.1, 1.0, (40, 1, 1)) * np.tile([0, 1.1, 0, 0.3, 0, 0, 0], 2)
    ends = reaching + random.uniform(-0.3, 0.3, (40, 2, 14))
    clocks = np.hstack([random.uniform(0.0, 1.5, (40, 2)), random.uniform(0.5, 2.0, (40, 2))])
    clocks[::4, :2], clocks[::5, 2:] = 0.0, 1.0
    return np.hstack([ends.reshape(40, 28), clocks])


def schedule_of(arms, row):
    """What tests/python/schedule_answers.cpp makes of a question."""
    curves, rest = [], np.zeros((2, 7))
    for i, arm in enumerate(("left/arm", "right/arm")):
        ends = np.array([row[7 * i:7 * i + 7], row[14 + 7 * i:21 + 7 * i]])
        trajectory = swept.Trajectory(arms.group(arm).variable_names, [0.0, 1.0], ends, rest)
        curves.append(swept.ScheduledCurve(trajectory, start=row[28 + i], slowdown=row[30 + i]))
    return curves


def test_schedules_against_cpp(arms, both, asked, questions):
    verdicts = []
    for words, row in zip(asked.ask("schedule", questions), questions):
        found = swept.certify_schedule(both, schedule_of(arms, row))
        assert words[0] == found.verdict.name.lower() and numbers(words[1:2]).tolist() == [found.free_until]
        if found.witness is not None:
            assert numbers(words[2:3]).tolist() == [found.contact_time]
            assert words[3:] == [found.witness.body_a, found.witness.body_b]
        verdicts.append(found.verdict)
    assert verdicts.count(Verdict.FREE) > 8 and verdicts.count(Verdict.COLLISION) > 8


def test_combined_curves_against_cpp_and_each_alone(arms, both, asked, questions):
    for words, row in zip(asked.ask("combine", questions), questions):
        curves = schedule_of(arms, row)
        combined = swept.combined_curve(both, curves)
        knots, rounding = combined.curve.knots, combined.rounding
        expected = [*rounding, *(value for knot in knots for value in [knot, *combined.curve.position(knot)])]
        assert numbers(words).tolist() == expected and rounding.shape == (14,) and (rounding < 1e-11).all()
        assert knots[-1] == pytest.approx(max(one.start + one.slowdown for one in curves), rel=1e-12)
        for time in np.linspace(0.0, knots[-1], 23):
            alone = np.concatenate([one.curve.position((time - one.start) / one.slowdown) for one in curves])
            assert (np.abs(combined.curve.position(time) - alone) <= rounding).all()


def test_delays_against_cpp(arms, both, asked, questions):
    rows = np.hstack([questions[:24], np.tile([[0, 0.4, 1.0, 0.1], [1, 0.2, 1.1, 0.1], [0, 0.0, 1.2, 0.1]], (8, 1))])
    verdicts, contacts = [], 0
    for words, row in zip(asked.ask("delays", rows), rows):
        curve, latest, slowest, resolution = row[32:]
        found = swept.certify_delays(both, schedule_of(arms, row), int(curve), latest=latest, slowest=slowest,
                                     resolution=resolution)
        proven = -1.0 if found.proven is None else found.proven
        assert words[0] == found.verdict.name.lower() and numbers(words[1:3]).tolist() == [proven, found.curves]
        assert bool(found) == (found.verdict is Verdict.FREE) == (proven == latest)
        assert (found.contact is None) == (found.verdict is not Verdict.COLLISION)
        verdicts.append(found.verdict)
        if found.contact is None:
            continue
        contact = found.contact
        assert numbers(words[3:6]).tolist() == [contact.delay, contact.slowdown, contact.time]
        assert words[6:] == [contact.witness.body_a, contact.witness.body_b]
        assert contact.configuration.shape == (14,) and contact.delay >= proven
        contacts += both.check_state(contact.configuration) is Verdict.COLLISION
    assert verdicts.count(Verdict.FREE) > 5 and verdicts.count(Verdict.COLLISION) > 5 and contacts > 2


def test_nothing_refutes_a_delay(arms, both, questions):
    """States of late schedules, each curve evaluated alone."""
    random, proven = np.random.default_rng(5), 0
    for row in questions[24:]:
        curves = schedule_of(arms, row)
        found = swept.certify_delays(both, curves, 0, latest=0.2, slowest=1.05, resolution=0.1)
        if found.proven is None:
            continue
        proven += 1
        delays, slow = random.uniform(0.0, found.proven, 200), random.uniform(1.0, 1.05, 200)
        times = random.uniform(0.0, 4.0, 200)
        states = [np.concatenate([curves[0].curve.position((time - row[28] - delay) / (row[30] * factor)),
                                  curves[1].curve.position((time - row[29]) / row[31])])
                  for time, delay, factor in zip(times, delays, slow)]
        assert (both.check_states(np.array(states)) != Verdict.COLLISION).all()
    assert proven > 2


def wandering(arms):
    """Both arms wander beside one another for 40 s: all of their delays take long to prove."""
    random, curves = np.random.default_rng(2), []
    for arm in ("left/arm", "right/arm"):
        path = arms.named_state(arm, "tucked") + 0.4 * np.sin(np.cumsum(random.uniform(-0.3, 0.3, (400, 7)), axis=0))
        trajectory = swept.Trajectory(arms.group(arm).variable_names, 0.1 * np.arange(400), path)
        curves.append(swept.ScheduledCurve(trajectory))
    return curves


@pytest.fixture(scope="module")
def crossing(tmp_path_factory):
    """Cubes of 0.2 m: `east` slides along x, `north` along y, through one another at the origin."""
    file = tmp_path_factory.mktemp("crossing") / "crossing.urdf"
    slides = "".join(
        f"<link name='{name}_cube'><collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>"
        f"<joint name='{name}' type='prismatic'><parent link='base'/><child link='{name}_cube'/><axis xyz='{axis}'/>"
        "<limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
        for name, axis in (("east", "1 0 0"), ("north", "0 1 0")))
    file.write_text(f"<robot name='crossing'><link name='base'/>{slides}</robot>")
    return swept.Checker(swept.Robot.load(file), "all")


def passes(start, names=("east", "north")):
    """Each from -1 m to 1 m at 1 m/s: within 0.2 m of the origin from 0.8 s to 1.2 s."""
    line = swept.Curve([0.0, 2.0], [[[-1.0, 1.0]]])
    return [swept.ScheduledCurve(line, names[:1]), swept.ScheduledCurve(line, names[1:], start=start)]


def test_who_meets_at_a_crossing_is_known_by_hand(crossing):
    for start in (0.0, 0.2, 0.39, 0.41, 0.5, 3.0):
        found = swept.certify_schedule(crossing, passes(start))
        assert found.verdict is (Verdict.COLLISION if start < 0.4 else Verdict.FREE)
        if start < 0.4:
            assert found.contact_time == pytest.approx(0.8 + start, abs=1e-3)
    # The first one may be late until it leaves when the second one arrives: 1.2 + d = 1.8.
    late = swept.certify_delays(crossing, passes(1.0), 0, latest=2.0)
    assert late.verdict is Verdict.COLLISION and 0.596 < late.proven <= 0.6
    assert late.contact.delay == pytest.approx(0.6, abs=4e-3) and late.contact.slowdown == 1.0
    assert late.contact.time == pytest.approx(1.8, abs=4e-3)
    assert {late.contact.witness.body_a, late.contact.witness.body_b} == {"east_cube", "north_cube"}
    enough = swept.certify_delays(crossing, passes(1.0), 0, latest=0.55)
    assert enough and enough.proven == 0.55 and enough.contact is None
    # It leaves at d + 1.2 s; 1.25 times as slow, after d + 1.5 s.
    slow = swept.certify_delays(crossing, passes(1.0), 0, latest=2.0, slowest=1.25)
    assert 0.296 < slow.proven <= 0.3
    nothing = swept.certify_delays(crossing, passes(0.1), 1, latest=5.0)
    assert nothing.proven is None and nothing.contact.delay == 0.0 and not nothing


def test_what_no_curve_moves_rests(crossing):
    east = passes(0.0)[:1]
    away, near = np.array([0.0, 2.0]), np.array([0.0, 0.1])
    assert swept.certify_schedule(crossing, east, still=away)
    assert swept.certify_schedule(crossing, east, still=near).verdict is Verdict.COLLISION
    assert swept.certify_delays(crossing, east, 0, latest=1.0, still=away)
    combined = swept.combined_curve(crossing, east, away)
    assert all(combined.curve.position(time)[1] == 2.0 for time in (0.0, 0.7, 9.0)) and combined.rounding[1] == 0.0


def test_queries(crossing):
    limits = swept.RateLimits(crossing, velocity=0.5)
    found = swept.certify_schedule(crossing, passes(1.0), limits=limits, clearances=True)
    assert found and found.self_pairs.lower > 0.1 and found.world.lower == math.inf
    assert {(one.variable, one.kind) for one in found.violations} == {
        ("east", swept.LimitKind.VELOCITY), ("north", swept.LimitKind.VELOCITY)}
    meeting = swept.certify_schedule(crossing, passes(0.0), query=swept.MotionQuery.VERDICT_ONLY)
    assert meeting.verdict is Verdict.COLLISION and meeting.free_until == 0.0
    # An obstacle's clock begins later than the schedule's.
    far, there = np.eye(4), np.eye(4)
    far[2, 3], there[0, 3] = 5.0, 1.0
    beside = crossing.with_obstacle("hammer", swept.Shape.box([0.2] * 3), [0.0, 10.0, 11.0], [far, far, there])
    assert swept.certify_schedule(beside, passes(1.0))
    assert swept.certify_schedule(beside, passes(1.0), clock=9.0).verdict is Verdict.COLLISION


def test_trajectories_for_controllers(arms, both, questions):
    names = both.group.variable_names
    for row in questions[:10]:
        curve = swept.combined_curve(both, schedule_of(arms, row)).curve
        trajectory = swept.controller_trajectory(curve, names)
        assert trajectory.variable_names == names and (trajectory.times == curve.knots).all()
        for time in np.linspace(0.0, curve.knots[-1], 17):
            assert np.allclose(trajectory.curve.position(time), curve.position(time), atol=1e-9)
    corner = swept.Curve([0.0, 1.0, 2.0], [[[0.0, 0.0, 1.0]], [[1.0, 1.0, 0.0]]])
    assert swept.controller_trajectory(corner, ["x"]) is None
    line = swept.controller_trajectory(swept.Curve([0.0, 1.0], [[[0.0, 1.0]]]), ["x"])
    assert line.positions.tolist() == [[0.0], [1.0]] and line.velocities is None


def test_scheduled_curves_are_values(arms, questions):
    one = schedule_of(arms, questions[1])[0]
    assert one.variable_names == arms.group("left/arm").variable_names and one.curve.dimension == 7
    assert (one.start, one.slowdown) == (questions[1, 28], questions[1, 30])
    renamed = swept.ScheduledCurve(swept.Trajectory(["a"], [0.0, 1.0], [[0.0], [1.0]]), ["b"])
    assert renamed.variable_names == ("b",) and (renamed.start, renamed.slowdown) == (0.0, 1.0)
    assert copy.copy(one) is one and repr(renamed).startswith("ScheduledCurve(variable_names=('b',)")


def test_delays_end_with_their_token(crossing, arms, both):
    """And after their time; Ctrl-C is in threads_test.py."""
    token = swept.CancellationToken()
    token.cancel()
    with pytest.raises(swept.Cancelled, match="^cancelled by its token$"):
        swept.certify_delays(crossing, passes(1.0), 0, latest=1.0, cancel=token)
    with pytest.raises(swept.Cancelled, match="^the time was up before the work was done$"):
        swept.certify_delays(crossing, passes(1.0), 0, latest=1.0, seconds=0.0)
    own, ended = swept.CancellationToken(), []

    def work():
        with pytest.raises(swept.Cancelled):
            swept.certify_delays(both, wandering(arms), 0, latest=20.0, cancel=own)
        ended.append(True)

    worker = threading.Thread(target=work)
    worker.start()
    worker.join(0.1)
    own.cancel()
    worker.join()
    assert ended == [True]


def test_what_schedules_refuse(crossing):
    ask, delays = swept.certify_schedule, swept.certify_delays
    east, north = passes(0.0)
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: there is no curve$"):
        ask(crossing, [])
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: no curve moves 'north'$"):
        ask(crossing, [east])
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: two curves move 'east'$"):
        swept.combined_curve(crossing, [east, east])
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: group 'all' has no variable 'south'$"):
        ask(crossing, passes(0.0, ("east", "south")))
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: curve 2 starts at -1 s; allowed are 0 and later$"):
        ask(crossing, passes(-1.0))
    slow = swept.ScheduledCurve(east.curve, ["north"], slowdown=0.0)
    with pytest.raises(swept.ArgumentError, match="^combinedCurve: curve 2 has a slowdown of 0; allowed are positive"):
        ask(crossing, [east, slow])
    with pytest.raises(swept.ArgumentError, match=r"^still: expected finite float64 values of shape \(2,\)"):
        ask(crossing, [east], still=[0.0])
    with pytest.raises(swept.ArgumentError, match="^variable_names: a swept.Curve needs a name for each of its values"):
        swept.ScheduledCurve(east.curve)
    with pytest.raises(swept.ArgumentTypeError, match="^trajectory: expected a swept.Trajectory or a swept.Curve"):
        swept.ScheduledCurve([0.0, 1.0])
    with pytest.raises(swept.ArgumentError, match="^controllerTrajectory: the curve has 1 values and 2 names$"):
        swept.controller_trajectory(east.curve, ["a", "b"])
    with pytest.raises(swept.ArgumentError, match="^certifyDelays: there is no curve 3, there are 2$"):
        delays(crossing, [east, north], 2)
    with pytest.raises(swept.ArgumentError, match="^certifyDelays: the latest delay is -1 s; allowed are finite"):
        delays(crossing, [east, north], 0, latest=-1.0)
    with pytest.raises(swept.ArgumentError, match="^certifyDelays: the slowest factor is 0.5; allowed are finite"):
        delays(crossing, [east, north], 0, slowest=0.5)
    with pytest.raises(swept.ArgumentError, match="^certifyDelays: the resolution is 0 s; allowed are positive"):
        delays(crossing, [east, north], 0, resolution=0.0)
    with pytest.raises(swept.ArgumentTypeError, match="^query: expected a member of swept.MotionQuery"):
        ask(crossing, [east, north], query=1)
