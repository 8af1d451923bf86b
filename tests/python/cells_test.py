# SPDX-License-Identifier: BSD-3-Clause
"""Work cells, and problems of files."""
import copy
import json
import pickle

import numpy as np
import pytest
from conftest import MODELS, Oracle, numbers

import swept

CELL = MODELS / "cells/two_rooks.yaml"
SCENE = "models/scenes/bin.yaml"


@pytest.fixture(scope="module")
def cell():
    return swept.WorkCell.load(CELL)


@pytest.fixture(scope="module")
def arms(cell):
    return cell.robot()


@pytest.fixture(scope="module")
def postures(arms):
    """(150, 14); in half of them both arms reach over the table between them."""
    group, random = arms.group("both"), np.random.default_rng(3)
    anywhere = random.uniform(group.lower, group.upper, (150, 14))
    reaching = np.tile([0, 1.3, 0, 0.3, 0, 0, 0], 2) + random.uniform(-0.4, 0.4, (150, 14))
    return np.where(np.arange(150)[:, None] % 2, reaching, anywhere)


def rook(name, **options):
    return swept.CellRobot(name, MODELS / "robots/rook7/rook7.urdf", **options)


def facing():
    pose = np.diag([-1.0, -1.0, 1.0, 1.0])
    pose[0, 3] = 1.2
    return pose


def test_cells_of_files(cell, arms):
    assert cell.name == "two_rooks" and [robot.name for robot in cell.robots] == ["left", "right"]
    assert cell.groups == {"both": ("left/arm", "right/arm")} and cell.robots[1].parent == ""
    assert np.allclose(cell.robots[1].pose, facing()) and cell.robots[0].srdf.name == "rook7.srdf"
    assert {"left/arm", "right/arm", "both"} <= set(arms.group_names) and "left/hand" in arms.link_names
    assert arms.model_frame == "world" and len(arms.group("both")) == 14
    assert arms.group("left/arm").variable_names == tuple(f"left/joint{i}" for i in range(1, 8))


def test_cells_of_robots(arms, postures):
    made = swept.WorkCell([rook("left"), rook("right", pose=facing())], {"both": ["left/arm", "right/arm"]}).robot()
    assert made.name == "cell" and made.link_names == arms.link_names
    empty = swept.World()
    a, b = swept.Checker(arms, "both", empty), swept.Checker(made, "both", empty)
    assert (a.check_states(postures) == b.check_states(postures)).all()
    lone = swept.WorkCell([rook("a", srdf=MODELS / "robots/rook7/rook7.srdf"), rook("b", parent="a/hand")]).robot()
    assert "all" in lone.group_names and len(lone.group("all")) >= 14
    q = np.zeros(len(lone.group("all")))
    assert np.allclose(lone.link_pose("all", "a/hand", q), lone.link_pose("all", "b/link0", q))


def test_cells_against_cpp(arms, postures):
    both = swept.Checker(arms, "both", swept.World.load(SCENE))
    verdicts = [both.check_state(q) for q in postures]
    assert [words[0] for words in Oracle(str(CELL), "both", SCENE).ask("check_state", postures)] == [
        verdict.name.lower() for verdict in verdicts]
    assert verdicts.count(swept.Verdict.FREE) > 10 and verdicts.count(swept.Verdict.COLLISION) > 30


def test_standing_against_cpp(arms, postures):
    oracle = Oracle(str(CELL), "left/arm", SCENE)
    scene, verdicts = swept.World.load(SCENE), []
    for words, q in zip(oracle.ask("beside", postures[:40]), postures):
        standing = arms.standing({"right/arm": q[7:]})
        left = swept.Checker(arms, "left/arm", scene, reference=standing)
        assert words[0] == left.check_state(q[:7]).name.lower()
        assert numbers(words[1:]).tolist() == [left.clearance(q[:7])]
        verdicts.append(words[0])
    assert verdicts.count("free") > 5 and verdicts.count("collision") > 5


def test_standing(arms, robot):
    named = arms.standing({"right/arm": "tucked"})
    values = arms.standing({"right/arm": arms.named_state("right/arm", "tucked")})
    names = arms.variable_names
    assert (named == values).all() and len(named) == len(names)
    tucked = robot.named_state("arm", "tucked")
    assert [named[names.index(f"right/joint{i}")] for i in range(1, 8)] == tucked.tolist()
    default = arms.default_state()
    others = [i for i, name in enumerate(names) if not name.startswith("right/joint")]
    assert (named[others] == default[others]).all() and (arms.standing({}) == default).all()
    assert len(robot.standing({"arm": "ready"})) == len(robot.variable_names)
    with pytest.raises(swept.ArgumentError, match="has no group 'arm'; it has: .*left/arm"):
        arms.standing({"arm": "ready"})
    with pytest.raises(swept.ArgumentError, match="redy"):
        arms.standing({"left/arm": "redy"})
    with pytest.raises(swept.ArgumentError, match=r"^posture of 'left/arm': expected finite float64 values of shape"):
        arms.standing({"left/arm": np.zeros(3)})


def test_pickles(cell, arms, postures):
    again = pickle.loads(pickle.dumps(arms.with_group("wrists", ["left/joint7", "right/joint7"])))
    assert again.link_names == arms.link_names and len(again.group("wrists")) == 2
    a, b = swept.Checker(arms, "both"), swept.Checker(again, "both")
    assert (a.check_states(postures) == b.check_states(postures)).all()
    twin = pickle.loads(pickle.dumps(cell))
    assert twin.groups == cell.groups and (twin.robots[1].pose == cell.robots[1].pose).all()
    assert copy.copy(cell) is cell and "WorkCell" in repr(cell) and "CellRobot" in repr(cell.robots[0])


def test_pages_show_cells(arms):
    both = swept.Checker(arms, "both")
    page = swept.show(both, both.named_state("ready"))
    assert "right/hand" in page.html


def test_cells_that_cannot_be_made(tmp_path):
    with pytest.raises(swept.InputError) as caught:
        swept.WorkCell([rook("left"), rook("left")]).robot()
    assert "left" in str(caught.value)
    with pytest.raises(swept.InputError):
        swept.WorkCell([]).robot()
    with pytest.raises(swept.InputError, match="left/arms"):
        swept.WorkCell([rook("left")], {"both": ["left/arms"]}).robot()
    with pytest.raises(swept.InputError):
        swept.WorkCell([rook("left", pose=np.diag([2.0, 2.0, 2.0, 1.0]))]).robot()
    with pytest.raises(swept.InputError, match="nowhere"):
        swept.WorkCell([rook("left", parent="nowhere/hand")]).robot()
    (tmp_path / "cell.yaml").write_text("robots:\n  - name: a\n    urfd: x.urdf\n")
    with pytest.raises(swept.InputError, match="urfd"):
        swept.WorkCell.load(tmp_path / "cell.yaml")
    arms = swept.WorkCell([rook("left")]).robot()
    model = swept.SphereModel({"left/hand": [[0.0, 0.0, 0.0, 0.1]]})
    with pytest.raises(swept.UsageError, match="has no URDF of its own"):
        model.save(tmp_path / "spheres.urdf", arms)


def test_problems(robot, tmp_path):
    file = swept.ProblemFile.load(MODELS / "problems.json")
    content = json.loads((MODELS / "problems.json").read_text())
    content = content.get("problems", content)
    assert set(file.sets) == set(content)
    count = 0
    for name in file.sets:
        for index in file.indices(name):
            problem = file.problem(name, index)
            (raw,) = [one for one in content[name] if one["index"] == index]
            assert problem.start.tolist() == raw["start"] and problem.goals.tolist() == raw["goals"]
            assert problem.joint_names == tuple(raw["joint_names"]) and (problem.set, problem.index) == (name, index)
            assert len(problem.world) == sum(len(raw["world"].get(kind, [])) for kind in ("sphere", "cylinder", "box"))
            checker = swept.Checker(robot, "arm", problem.world)
            q = checker.configuration(dict(zip(problem.joint_names, problem.start)))
            assert checker.check_state(q) is not None
            count += 1
    assert count > 1 and file.indices("absent") == ()
    with pytest.raises(swept.InputError, match="absent"):
        file.problem("absent", 1)
    with pytest.raises(swept.InputError):
        swept.ProblemFile.load(MODELS / "scenes/shelf.yaml")
