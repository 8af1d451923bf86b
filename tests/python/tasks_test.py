# SPDX-License-Identifier: BSD-3-Clause
"""Tasks in files with proofs: what is written, against the file itself, numpy and sampled states."""
import copy
import json

import numpy as np
import pytest
from conftest import MODELS

import swept
from swept import ChangeKind, Shape, TaskChange, TaskPhase, Trajectory, Verdict

CUP = Shape.cylinder(radius=0.03, length=0.1)
GRIP = np.eye(4)
GRIP[2, 3] = 0.25  # m, in front of the hand: as of a magnet


def straight(checker, start, end, begin, seconds=1.5):
    """A trajectory from rest to rest, on the task's clock."""
    rest = np.zeros((2, len(start)))
    return Trajectory(checker.group.variable_names, [begin, begin + seconds], np.array([start, end]), rest)


def world(robot, grasp, wall=0.9):
    made = swept.World()
    made.add("cup", CUP, robot.link_pose("arm", "hand", grasp) @ GRIP)
    pose = np.eye(4)
    pose[:3, 3] = wall, 0.8, 0.5
    made.add("wall", Shape.box([0.1, 0.1, 1.0]), pose)
    return made


def held(checker):
    return checker.without_body("cup").with_attached("cup", "hand", CUP, GRIP)


ATTACHED, PLACED, SENSED = (TaskChange(kind, body) for kind, body in (
    (ChangeKind.ATTACHED, "cup"), (ChangeKind.PLACED, "cup"), (ChangeKind.SENSED, "wall")))


@pytest.fixture(scope="module")
def stations(robot):
    """Three configurations: the first reaches the cup from above, the others are near."""
    ready = robot.named_state("arm", "ready")
    return [ready, ready + [0.3, 0.1, 0.0, 0.1, 0.0, 0.1, 0.0], ready + [0.6, 0.0, 0.1, 0.0, 0.1, 0.0, 0.1]]


def make(robot, stations, clock=0.0, **joins):
    """To the cup, with it to another place, and back without it; the wall is sensed anew."""
    a, b, c = stations
    first = swept.Checker(robot, "arm", world(robot, b))
    second = held(first)
    third = second.with_detached("cup", c).with_replaced("wall", Shape.box([0.1, 0.1, 0.9]), wall_at(0.95))
    changes = {"carry": [ATTACHED], "back": [PLACED, SENSED], **joins}
    return [TaskPhase("reach", first, straight(first, a, b, clock)),
            TaskPhase("carry", second, straight(second, b, c, clock + 1.5), changes["carry"]),
            TaskPhase("back", third, straight(third, c, a, clock + 3.0), changes["back"])]


def wall_at(x):
    pose = np.eye(4)
    pose[:3, 3] = x, 0.8, 0.5
    return pose


@pytest.fixture(scope="module")
def phases(robot, stations):
    return make(robot, stations)


@pytest.fixture(scope="module")
def file(phases, tmp_path_factory):
    written = tmp_path_factory.mktemp("task") / "task.json"
    swept.write_task(written, phases)
    return written


def test_tasks_hold_and_say_what_changes(phases, file):
    task = swept.verify_task(file)
    assert task and task.holds and task.refusal == "" and len(task.phases) == 3
    assert [phase.changes for phase in task.phases] == [
        (), ("cup attached to hand",), ("cup placed", "wall sensed")]
    for i, (phase, own) in enumerate(zip(task.phases, phases)):
        assert phase.name == own.name and phase.group == "arm"
        assert (phase.begin, phase.end) == (1.5 * i, 1.5 * (i + 1)) == tuple(own.trajectory.times)
        # The proof is of fewer metres than what is measured.
        found = own.checker.certify_trajectory(own.trajectory, clearances=True)
        assert phase.proof and 0.0 < phase.proof.clearance_world <= found.world.upper
        assert 0.0 < phase.proof.clearance_self <= found.self_pairs.upper and phase.proof.duration == 1.5
    assert "reach" in repr(task.phases[0]) and copy.copy(task) is task


def test_states_of_a_task_are_free(phases, file, random):
    for step, phase in zip(swept.read_task(file), phases):
        curve = step.trajectory.curve
        states = np.array([curve.position(t) for t in random.uniform(*step.trajectory.times[[0, -1]], 300)])
        assert (phase.checker.check_states(states) == Verdict.FREE).all()


def test_tasks_are_read_again(phases, file):
    steps, raw = swept.read_task(file), json.loads(file.read_text())["phases"]
    assert len(steps) == len(phases) == len(raw)
    for step, phase, json_phase in zip(steps, phases, raw):
        assert step.name == phase.name == json_phase["phase"] and step.group == json_phase["path"]["group"] == "arm"
        own, points = phase.trajectory, json_phase["path"]["trajectory"]["points"]
        assert step.trajectory.variable_names == own.variable_names
        for name in ("times", "positions", "velocities"):
            assert (getattr(step.trajectory, name) == getattr(own, name)).all()
        assert [point["time"] for point in points] == own.times.tolist()
        assert [point["positions"] for point in points] == own.positions.tolist()
        assert [(one.kind, one.body) for one in step.changes] == [(one.kind, one.body) for one in phase.changes]
        assert [f"{one.kind}" for one in step.changes] == [one["change"] for one in json_phase["changes"]]


def test_certificates_are_taken(robot, stations, tmp_path):
    """Of a phase that is FREE, whatever else was asked; a phase in collision is not written."""
    phases = make(robot, stations)
    proven = []
    for phase in phases:
        for clearances in (True, False):
            certificate = phase.checker.certify_trajectory(phase.trajectory, clearances=clearances)
            proven.append(TaskPhase(phase.name, phase.checker, phase.trajectory, phase.changes,
                                    certificate=certificate, warnings=["a remark"]))
    for some in (proven[::2], proven[1::2]):
        swept.write_task(tmp_path / "task.json", some)
        assert swept.verify_task(tmp_path / "task.json")
    assert "a remark" in (tmp_path / "task.json").read_text() and proven[0].warnings == ("a remark",)
    first = phases[0]
    blocked = first.checker.with_body("block", Shape.box([3.0, 3.0, 3.0]))
    with pytest.raises(swept.UsageError, match="phase 1 .reach."):
        swept.write_task(tmp_path / "no.json", [TaskPhase("reach", blocked, first.trajectory)])
    assert not (tmp_path / "no.json").exists()


def test_delayed(phases, random):
    for seconds in [0.0, *random.uniform(0.0, 100.0, 20)]:
        own = phases[1].trajectory
        later = own.delayed(seconds)
        assert (later.times == own.times + seconds).all() and (later.positions == own.positions).all()
        assert (later.velocities == own.velocities).all() and later.accelerations is None
        for t in np.linspace(*own.times, 7):
            assert np.allclose(later.curve.position(t + seconds), own.curve.position(t), atol=1e-9)
    with pytest.raises(swept.ArgumentError):
        phases[1].trajectory.delayed(np.inf)
    with pytest.raises(swept.ArgumentError):
        phases[1].trajectory.delayed(-100.0)


def test_phases_that_do_not_join(robot, stations, tmp_path):
    a, b, c = stations

    def refused(phases, message):
        with pytest.raises(swept.UsageError) as caught:
            swept.write_task(tmp_path / "task.json", phases)
        assert str(caught.value) == f"'{tmp_path / 'task.json'}': {message}"
        assert not (tmp_path / "task.json").exists()

    good = make(robot, stations)
    first, second = good[0].checker, good[1].checker
    late = TaskPhase("carry", second, straight(second, b, c, 2.0), [ATTACHED])
    refused([good[0], late], "phase 2 (carry): it begins at 2 s, and phase 1 ends at 1.5 s")
    off = TaskPhase("carry", second, straight(second, b + np.eye(7)[0] * 0.01, c, 1.5), [ATTACHED])
    refused([good[0], off], f"phase 2 (carry), joint joint1: it begins at {b[0] + 0.01:.9g}, "
                            f"and phase 1 ends at {b[0]:.9g}")
    refused([good[0], make(robot, stations, carry=[])[1]],
            "phase 2 (carry), body cup: it is carried by hand, and was in the world in phase 1; no change says so")
    refused([good[0], make(robot, stations, carry=[PLACED])[1]],
            "phase 2 (carry), body cup: it is carried by hand, and was in the world in phase 1; "
            "it is said to be placed")
    away = first.without_body("cup").with_attached("cup", "hand", CUP, GRIP + 0.01 * np.eye(4, k=3))
    refused([good[0], TaskPhase("carry", away, straight(away, b, c, 1.5), [ATTACHED])],
            "phase 2 (carry), body cup: it is 0.01 m from where it was in phase 1")
    refused([*good[:2], make(robot, stations, back=[PLACED])[2]],
            "phase 3 (back), body wall: its shape is not what it was in phase 2")
    refused([], "a task has one phase or more")
    with pytest.raises(swept.UsageError, match="a file with a proof ends in .json$"):
        swept.write_task(tmp_path / "task.yaml", good)


def test_whoever_changes_a_file_is_found_out(file, tmp_path, random):
    text, changed = file.read_text(), tmp_path / "changed.json"
    found = 0
    digits = [i for i, letter in enumerate(text) if letter.isdigit()]
    for place in random.choice(digits, 25, replace=False):
        other = str((int(text[place]) + 1 + random.integers(0, 9)) % 10)
        changed.write_text(text[:place] + other + text[place + 1:])
        try:
            task = swept.verify_task(changed)
            assert not task and not task.holds and task.refusal and task.phases == ()
        except swept.InputError:
            pass  # 01 is no number
        found += 1
    assert found == 25


def test_what_is_no_task(file, tmp_path, robot, checker, home):
    with pytest.raises(swept.InputError):
        swept.verify_task(tmp_path / "absent.json")
    other = tmp_path / "other.json"
    other.write_text("{}")
    for read in (swept.verify_task, swept.read_task):
        with pytest.raises(swept.InputError, match="it is no task: there are no phases$") as caught:
            read(other)
        assert caught.value.file == str(other)
    other.write_text(json.dumps({"phases": [{"phase": "reach", "changes": [], "path": {}}]}))
    with pytest.raises(swept.InputError, match="group"):
        swept.read_task(other)
    with pytest.raises(swept.ArgumentTypeError, match="^kind: expected a member of swept.ChangeKind, got 1$"):
        TaskChange(1, "cup")
    with pytest.raises(TypeError):
        TaskPhase("reach", checker, home)


def test_pages(phases, robot, tmp_path):
    page = swept.show_task(phases, file=tmp_path / "task.html", title="over the <table>")
    assert (tmp_path / "task.html").read_text() == page.html and "3 phases" in page.html
    for text in ("cup attached to hand", "cup placed", "wall sensed", "carry"):
        assert text in page.html
    assert "iframe" in page._repr_html_() and "over the <table>" not in page.html
    limits = swept.RateLimits(phases[0].checker, velocity=0.01)
    headed = swept.TaskPage(robot, headline="to be seen", facts=[("place", "here")])
    headed.add_phase(phases[0], limits)
    headed.write(tmp_path / "headed.html")
    assert "to be seen" in headed.html and "here" in headed.html and headed.html != page.html
    with pytest.raises(swept.ArgumentError):
        headed.add_phase(phases[0])  # it begins before that one ends
    with pytest.raises(swept.UsageError, match="^a task without a phase cannot be shown$"):
        swept.show_task([])
    with pytest.raises(swept.ArgumentError, match="^a page of nothing$"):
        swept.TaskPage(robot).html
    with pytest.raises(swept.UsageError, match="a page ends in .html or .htm$"):
        headed.write(tmp_path / "task.txt")


def test_arms_of_a_cell_take_turns(tmp_path):
    """Phases of different groups of one robot, while the other arm stands."""
    arms = swept.WorkCell.load(MODELS / "cells/two_rooks.yaml").robot()
    poses, phases = {}, []
    for arm in ("left/arm", "right/arm"):
        poses[arm] = arms.named_state(arm, "tucked")
    for i, arm in enumerate(("left/arm", "right/arm", "left/arm")):
        checker = swept.Checker(arms, arm, reference=arms.standing(poses))
        goal = poses[arm] - 0.2 * np.sign(poses[arm])
        phases.append(TaskPhase(f"move {i}", checker, straight(checker, poses[arm], goal, 1.5 * i)))
        poses[arm] = goal
    swept.write_task(tmp_path / "task.json", phases)
    task = swept.verify_task(tmp_path / "task.json")
    assert task and [phase.group for phase in task.phases] == ["left/arm", "right/arm", "left/arm"]
    assert "right/hand" in swept.show_task(phases).html
