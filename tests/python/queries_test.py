# SPDX-License-Identifier: BSD-3-Clause
"""Queries about states and motions give what C++ gives, bit for bit, on random inputs."""
import numpy as np
from conftest import numbers

import swept
from swept import Verdict


def words_of(value):
    """As the oracle writes it."""
    if isinstance(value, (float, int)) and not isinstance(value, (bool, Verdict)):
        return [float(value).hex()]
    if isinstance(value, np.ndarray):
        return [x.hex() for x in value.ravel().tolist()]
    return [value.name.lower() if isinstance(value, Verdict) else str(value)]


def same(words, *values):
    expected = sum((words_of(value) for value in values), [])
    assert len(words) == len(expected)
    for word, other in zip(words, expected):
        if word.lstrip("-").startswith("0x") or word in ("inf", "-inf"):
            assert float.fromhex(word) == float.fromhex(other)
        else:
            assert word == other


def certificate_values(found):
    values = [found.verdict, found.free_until, found.effort.intervals, found.effort.lanes]
    if found.witness is not None:
        w = found.witness
        values += [w.t, w.body_a, w.body_b, w.distance, w.point_a, w.point_b]
    return values


def motions(states):
    """Short ones and long ones."""
    starts = states[:-1]
    ends = np.where(np.arange(len(starts))[:, None] % 2, states[1:], starts + 0.2 * (states[1:] - starts))
    return starts, np.ascontiguousarray(ends)


def test_check_state(checker, oracle, states):
    answers = oracle.ask("check_state", states)
    found = [checker.check_state(q) for q in states]
    for words, verdict in zip(answers, found):
        same(words, verdict)
    assert found.count(Verdict.FREE) > 30 and found.count(Verdict.COLLISION) > 30
    batch = checker.check_states(states)
    assert batch.dtype == np.uint8 and batch.tolist() == [int(v) for v in found]
    assert (checker.check_states(states, threads=1) == batch).all()


def test_certify_motion(checker, oracle, states):
    starts, ends = motions(states)
    answers = oracle.ask("certify_motion", np.hstack([starts, ends]))
    found = [checker.certify_motion(a, b) for a, b in zip(starts, ends)]
    for words, certificate in zip(answers, found):
        same(words, *certificate_values(certificate))
    verdicts = [certificate.verdict for certificate in found]
    assert verdicts.count(Verdict.FREE) > 60 and verdicts.count(Verdict.COLLISION) > 60
    batch = checker.certify_motions(starts, ends)
    assert len(batch) == len(found)
    assert batch.verdicts.tolist() == [int(v) for v in verdicts]
    assert batch.free_until.tolist() == [certificate.free_until for certificate in found]
    for words, certificate in zip(answers, batch):
        same(words, *certificate_values(certificate))


def test_verdict_only(checker, oracle, states):
    starts, ends = motions(states)
    query = swept.MotionQuery.VERDICT_ONLY
    answers = oracle.ask("verdict_only", np.hstack([starts, ends]))
    for words, a, b in zip(answers, starts, ends):
        same(words, *certificate_values(checker.certify_motion(a, b, query)))
        same(words, *certificate_values(checker.certify_motion(start=a, end=b, query=query)))


def test_measures_of_states(checker, oracle, states):
    states = states[:60]
    for words, q in zip(oracle.ask("clearance", states), states):
        same(words, checker.clearance(q))
    for words, q in zip(oracle.ask("within_limits", states * 1.1), states * 1.1):
        same(words, checker.within_limits(q))
    for words, q in zip(oracle.ask("report_state", states), states):
        report = checker.report_state(q)
        contacts = sum(([c.body_a, c.body_b, c.point_a, c.point_b] for c in report.contacts), [])
        same(words, report.verdict, report.clearance, report.nearest_a, report.nearest_b,
             report.world.clearance, report.self_pairs.clearance, len(report.contacts), *contacts)


def test_signed_clearance(checker, oracle, states):
    for words, q in zip(oracle.ask("signed_clearance", states[:60]), states[:60]):
        found, gradient = checker.signed_clearance(q, gradient=True)
        same(words, found.lower, found.upper, found.point_a, found.point_b, found.normal, gradient)
        assert checker.signed_clearance(q).upper == found.upper
        assert gradient.shape == q.shape


def test_signed_clearance_gradient_is_that_of_differences(checker, states):
    compared = 0
    for q in states:
        found, gradient = checker.signed_clearance(q, gradient=True)
        step = 1e-6 * np.eye(len(q))
        sides = [checker.signed_clearance(q + s).upper - checker.signed_clearance(q - s).upper for s in step]
        if 0.01 < found.upper and np.allclose(np.array(sides) / 2e-6, gradient, atol=1e-4):
            compared += 1
    assert compared > 30  # the others are in contact, or where the nearest pair changes


def test_measures_of_motions(checker, oracle, states):
    starts, ends = motions(states[:40])
    rows = np.hstack([starts, ends])
    for words, a, b in zip(oracle.ask("motion_clearance", rows), starts, ends):
        found = checker.motion_clearance(a, b, 1e-3)
        same(words, found.lower, found.upper, found.t, found.body_a, found.body_b)
    for words, a, b in zip(oracle.ask("interpolate", rows), starts, ends):
        same(words, checker.interpolate(a, b, 0.375))


def test_link_pose(checker, oracle, states):
    for words, q in zip(oracle.ask("link_pose", states), states):
        pose = checker.robot.link_pose("arm", "hand", q)
        assert pose.shape == (4, 4)
        assert (numbers(words).reshape(4, 4) == pose).all()


def test_explain(checker):
    assert "checked" in checker.explain("hand", "board_1")
    assert checker.explain("link1", "link2").split(":")[1:] == checker.explain("link2", "link1").split(":")[1:]
    skipped = [(p.body_a, p.body_b, p.reason) for p in checker.skipped_pairs]
    assert any("adjacent" in reason or "SRDF" in reason for _, _, reason in skipped)
