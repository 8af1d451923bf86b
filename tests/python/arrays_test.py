# SPDX-License-Identifier: BSD-3-Clause
"""What is taken as a configuration and what is refused, and that nothing is copied that need not be."""
import pickle
import sys

import numpy as np
import pytest

import swept
from swept import Verdict


def refused(error, text, call, *args, **kwargs):
    with pytest.raises(error) as caught:
        call(*args, **kwargs)
    assert isinstance(caught.value, swept.Error)
    assert str(caught.value) == text


def test_state_of_another_type(checker, home):
    expected = "q: expected finite float64 values of shape (7,), C-contiguous; got "
    refused(TypeError, expected + "float32 of shape (7,)", checker.check_state, home.astype(np.float32))
    refused(TypeError, expected + "int64 of shape (7,)", checker.check_state, home.astype(np.int64))
    refused(TypeError, expected + ">f8 of shape (7,)", checker.check_state, home.astype(">f8"))
    refused(TypeError, expected + "an object of type NoneType", checker.check_state, None)
    refused(TypeError, expected + "an object of type float", checker.check_state, 1.0)
    refused(TypeError, expected + "an object of type str", checker.clearance, "home")


def test_state_of_another_shape_or_order(checker, home):
    expected = "q: expected finite float64 values of shape (7,), C-contiguous; got float64 of shape "
    refused(ValueError, expected + "(6,)", checker.check_state, home[:6].copy())
    refused(ValueError, expected + "(1, 7)", checker.check_state, home[None])
    refused(ValueError, expected + "()", checker.check_state, np.array(1.0))
    refused(ValueError, expected + "(7,), not C-contiguous: numpy.ascontiguousarray makes it so",
            checker.check_state, np.repeat(home, 2)[::2])


def test_numbers_that_are_not_finite(checker, home):
    for value, text in [(np.nan, "nan"), (np.inf, "inf"), (-np.inf, "-inf")]:
        for place in range(7):
            q = home.copy()
            q[place] = value
            refused(ValueError, "q: expected finite float64 values of shape (7,), C-contiguous; got "
                    f"{text} at [{place}]", checker.check_state, q)
            refused(ValueError, "end: expected finite float64 values of shape (7,), C-contiguous; got "
                    f"{text} at [{place}]", checker.certify_motion, home, q)
    for huge in (1e308, 5e-324, -0.0):  # finite
        assert checker.check_state(np.full(7, huge)) in tuple(Verdict)


def test_batches(checker, states):
    expected = "states: expected finite float64 values of shape (n, 7), C-contiguous; got "
    refused(ValueError, expected + "float64 of shape (7,)", checker.check_states, states[0])
    refused(ValueError, expected + "float64 of shape (300, 6)", checker.check_states, states[:, :6].copy())
    refused(ValueError, expected + "float64 of shape (300, 7), not C-contiguous: "
            "numpy.ascontiguousarray makes it so", checker.check_states, np.asfortranarray(states))
    refused(TypeError, expected + "float32 of shape (300, 7)", checker.check_states, states.astype("f4"))
    states[5, 3] = np.nan
    refused(ValueError, expected + "nan at [5, 3]", checker.check_states, states)
    refused(ValueError, "ends: expected as many rows as starts, 2; got 3",
            checker.certify_motions, states[:2], states[:3])
    assert len(checker.check_states(np.empty((0, 7)))) == 0
    assert len(checker.certify_motions(np.empty((0, 7)), np.empty((0, 7)))) == 0


def test_arguments_by_name(checker, home):
    assert checker.check_state(q=home) is checker.check_state(home)
    assert checker.certify_motion(end=home, start=home).verdict is Verdict.FREE
    for call in (lambda: checker.check_state(), lambda: checker.check_state(home, home),
                 lambda: checker.check_state(state=home), lambda: checker.check_state(home, q=home),
                 lambda: checker.certify_motion(home), lambda: checker.certify_motion(home, home, 1),
                 lambda: checker.certify_motion(home, home, Verdict.FREE),
                 lambda: swept.Checker.check_state(home)):
        with pytest.raises(TypeError):
            call()


def test_lists_will_do(checker, home):
    assert checker.check_state(home.tolist()) is checker.check_state(home)
    assert checker.check_state(tuple(home)) is checker.check_state(home)
    assert checker.check_states([home.tolist(), home.tolist()]).tolist() == [1, 1]
    with pytest.raises(TypeError, match="^q: expected finite float64 .* got a list: could not convert"):
        checker.check_state(["home"] * 7)


def test_read_only_and_subclassed_arrays_are_read_in_place(checker, states):
    states.flags.writeable = False
    before = sys.getrefcount(states)
    assert checker.check_state(states[0]) is checker.check_state(states[0].copy())
    checker.check_states(states)
    assert sys.getrefcount(states) == before
    assert checker.check_state(states[0].view(np.ma.MaskedArray)) is checker.check_state(states[0])


def test_views_of_certificates_keep_them_alive(checker, states):
    certificates = checker.certify_motions(states[:-1], states[1:])
    verdicts, until, copy = certificates.verdicts, certificates.free_until, certificates.verdicts.copy()
    with pytest.raises(ValueError):
        verdicts[0] = 1
    item = certificates[-1]
    witness = next(c.witness for c in certificates if c.witness is not None)
    name, point = witness.body_a, witness.point_a
    del certificates, witness
    np.full(100000, 255, np.uint8)
    assert (verdicts == copy).all() and ((until == 1) == (verdicts == Verdict.FREE)).all()
    assert item.verdict == verdicts[-1] and isinstance(name, str) and np.isfinite(point).all()


def test_results_outlive_what_they_came_from():
    def certificate():
        robot = swept.Robot.load("models/robots/rook7/rook7.urdf")
        checker = swept.Checker(robot, "arm", swept.World.load("models/scenes/narrow_slot.yaml"))
        return checker.certify_motion(checker.named_state("home"), checker.named_state("ready")), checker.group

    found, group = certificate()
    assert found.witness.body_b == "lintel" and group.variable_names[0] == "joint1"


def test_verdicts():
    assert str(Verdict.UNDECIDED) == f"{Verdict.UNDECIDED}" == "undecided" and repr(Verdict.FREE) == "<Verdict.FREE: 1>"
    assert bool(Verdict.FREE) and not Verdict.UNDECIDED and not Verdict.COLLISION
    assert pickle.loads(pickle.dumps(Verdict.FREE)) is Verdict.FREE


def test_certificates_cannot_be_made(checker, home):
    with pytest.raises(TypeError):
        swept.MotionCertificate()
    found = checker.certify_motion(home, home)
    assert repr(found) == "<swept.MotionCertificate free, free until t = 1.0>"
    assert found and found.witness is None and found.undecided_at is None
    with pytest.raises(AttributeError):
        found.verdict = Verdict.FREE
