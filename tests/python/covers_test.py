# SPDX-License-Identifier: BSD-3-Clause
"""Spheres around bodies and robots: what C++ says, bit for bit, and what is proven, sampled."""
import copy
import math
import threading
import xml.etree.ElementTree as xml

import numpy as np
import pytest
from conftest import MODELS, numbers

import swept
from swept import EnclosingKind, EnclosingSpheresSearch, Shape, ShapeModel, SphereModel


@pytest.fixture(scope="module")
def hand(robot):
    return robot.link_shapes("hand")


@pytest.fixture(scope="module")
def model(robot):
    return SphereModel.search(robot, spheres=60, pieces=300, restarts=1, seed=3)


def test_spheres_against_cpp(oracle, hand):
    questions = np.hstack([np.zeros((6, 7)), [[count, seed] for seed, count in enumerate([1, 2, 4, 6, 8, 12], 1)]])
    for words, (count, seed) in zip(oracle.ask("spheres", questions), questions[:, 7:].astype(int)):
        search = EnclosingSpheresSearch(hand, pieces=300, restarts=1, seed=int(seed))
        found = search.at_most(int(count))
        assert numbers(words).tolist() == [found.reach, search.count_for(0.02), *found.spheres.ravel()]
        assert 1 <= len(found) <= count and found.spheres.shape == (len(found), 4)
        outside = swept.outside_spheres(hand, found.spheres)
        assert outside and outside.upper <= 0.0
        assert (found.spheres == found.spheres.astype(np.float32)).all()


def test_judgements_against_cpp(oracle, hand, random):
    spheres = np.concatenate([random.uniform(-0.1, 0.1, (12, 5, 3)), random.uniform(0.02, 0.15, (12, 5, 1))], 2)
    contained = 0
    for words, some in zip(oracle.ask("outside", np.hstack([np.zeros((12, 7)), spheres.reshape(12, 20)])), spheres):
        outside, excess = swept.outside_spheres(hand, some), swept.sphere_excess(hand, some, samples=2000)
        assert numbers(words).tolist() == [outside.lower, outside.upper, *outside.point, outside.surface_share,
                                           excess.largest_seen, excess.largest, excess.mean, excess.volume_ratio]
        assert outside.lower <= outside.upper and excess.largest_seen <= excess.largest + 1e-5
        assert bool(outside) == (outside.upper <= 0.0)
        grown = some + [0.0, 0.0, 0.0, max(0.0, outside.upper)]
        assert swept.outside_spheres(hand, grown).lower <= 0.0
        contained += bool(outside)
    assert contained < 12


def test_bodies_of_several_shapes():
    """A box by hand: its corners are what is farthest out."""
    shift = np.eye(4)
    shift[0, 3] = 0.5
    body = [(Shape.box([0.2, 0.2, 0.2]), None), (Shape.box([0.2, 0.2, 0.2]), shift)]
    outside = swept.outside_spheres(body, [[0.0, 0.0, 0.0, 0.1], [0.5, 0.0, 0.0, 0.15]])
    assert outside.lower == pytest.approx(0.1 * math.sqrt(3) - 0.1, abs=2e-5) and not outside
    assert np.abs(outside.point).max() == pytest.approx(0.1, abs=1e-9) and 0.0 < outside.surface_share < 1.0
    none = swept.outside_spheres(body, np.empty((0, 4)))
    assert none.lower == none.upper == math.inf
    found = EnclosingSpheresSearch(body).within(0.05)
    assert found.reach <= 0.05 and swept.outside_spheres(body, found.spheres)
    ball = swept.sphere_excess(Shape.sphere(0.1), [[0.0, 0.0, 0.0, 0.12]])
    assert ball.largest == pytest.approx(0.02, abs=1e-3) and ball.volume_ratio == pytest.approx(1.2 ** 3, rel=0.05)


def test_meshes():
    mesh = Shape.load_mesh(next(file for file in sorted((MODELS / "robots/rook7/meshes").iterdir())))
    found = EnclosingSpheresSearch(mesh, pieces=300, restarts=1).at_most(8)
    assert len(found) <= 8 and swept.outside_spheres(mesh, found.spheres)


def test_what_covers_refuse(hand):
    with pytest.raises(swept.ArgumentError):
        EnclosingSpheresSearch(Shape.plane([0, 0, 1]))
    with pytest.raises(swept.ArgumentError):
        EnclosingSpheresSearch([])
    with pytest.raises(swept.ArgumentError):
        EnclosingSpheresSearch(hand, pieces=0)
    search = EnclosingSpheresSearch(hand, pieces=50, restarts=1)
    for call in (lambda: search.at_most(0), lambda: search.within(0.0), lambda: search.within(-1.0),
                 lambda: swept.outside_spheres(hand, [[0, 0, 0, 1.0]], tolerance=0.0)):
        with pytest.raises(swept.ArgumentError):
            call()
    with pytest.raises(swept.ArgumentError, match="^spheres: expected finite float64 values of shape"):
        swept.outside_spheres(hand, [[0.0, 0.0, 1.0]])
    with pytest.raises(swept.ArgumentTypeError, match="^shape: expected a swept.Shape"):
        EnclosingSpheresSearch("hand")


def test_searches_of_threads(hand):
    """Two threads that share a search get what each gets alone."""
    alone = [EnclosingSpheresSearch(hand, pieces=300, restarts=1).at_most(n).spheres for n in (3, 5)]
    search, found = EnclosingSpheresSearch(hand, pieces=300, restarts=1), {}
    threads = [threading.Thread(target=lambda n=n: found.__setitem__(n, search.at_most(n).spheres)) for n in (3, 5)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found[3]) <= 3 and len(found[5]) <= 5
    assert swept.outside_spheres(hand, found[3]) and swept.outside_spheres(hand, found[5]) and len(alone) == 2


def test_models_contain_the_robot(robot, model):
    assert len(model) <= 60 and sum(len(model[link]) for link in model.links) == len(model)
    reports = model.judge(robot)
    assert [report.link for report in reports] == [link for link in robot.link_names if robot.link_shapes(link)]
    for report in reports:
        assert report and report.outside.upper <= 0.0 and report.spheres == len(model[report.link])
        assert report.excess.mean <= report.excess.largest
    fine = SphereModel.search(robot, excess=0.08, pieces=300, restarts=1, threads=1)
    again = SphereModel.search(robot, excess=0.08, pieces=300, restarts=1, threads=2)
    assert all((fine[link] == again[link]).all() for link in fine.links)
    by_hand = SphereModel({"hand": [[0.0, 0.0, 0.0, 0.01]]})
    judged = {report.link: report for report in by_hand.judge(robot)}
    assert not judged["hand"] and judged["hand"].outside.lower > 0.0 and judged["link1"].outside.upper == math.inf


@pytest.mark.parametrize("ending", ["json", "yaml", "yml", "xrdf", "srdf", "urdf"])
def test_models_in_files(robot, model, tmp_path, ending):
    file = tmp_path / f"spheres.{ending}"
    model.save(file, robot)
    read = SphereModel.load(file, robot)
    assert sorted(read.links) == sorted(model.links)
    for link in model.links:
        assert (read[link] == model[link]).all()
    if ending == "urdf":
        assert len(list(xml.parse(file).iter("sphere"))) >= len(model)
        assert swept.Robot.load(file).link_names == robot.link_names
    if ending == "srdf":
        assert len(list(xml.parse(file).iter("group"))) >= len(robot.group_names)


def test_what_models_refuse(robot, model, tmp_path):
    with pytest.raises(swept.ArgumentError, match="^expected one of spheres and excess$"):
        SphereModel.search(robot)
    with pytest.raises(swept.ArgumentError, match="^expected one of spheres and excess$"):
        SphereModel.search(robot, spheres=100, excess=0.1)
    with pytest.raises(swept.UsageError):
        SphereModel.search(robot, spheres=2)
    with pytest.raises(swept.ArgumentError):
        SphereModel.search(robot, excess=-1.0)
    with pytest.raises(swept.ArgumentError, match="^the model has no spheres for a link 'nose'$"):
        model["nose"]
    with pytest.raises(swept.ArgumentError, match="^spheres of 'hand': expected finite"):
        SphereModel({"hand": [[0.0, 0.0, 0.0]]})
    with pytest.raises(swept.UsageError, match="ends in '.txt'; allowed: .urdf, .yaml, .yml"):
        model.save(tmp_path / "spheres.txt", robot)
    with pytest.raises(swept.UsageError, match="cannot be written$"):
        model.save(tmp_path / "absent" / "spheres.json", robot)
    with pytest.raises(swept.InputError):
        SphereModel.load(tmp_path / "absent.json", robot)
    (tmp_path / "other.json").write_text('{"links": [{"link": "nose", "spheres": [[0, 0, 0, 1]]}]}')
    with pytest.raises(swept.InputError, match="nose"):
        SphereModel.load(tmp_path / "other.json", robot)
    with pytest.raises(swept.ArgumentError, match="no link 'nose'"):
        robot.link_shapes("nose")
    assert copy.copy(model) is model and "SphereModel of" in repr(model)


def test_models_of_scenes(tmp_path):
    """Each body of a world is contained; files say so again; others are judged by hand."""
    world = swept.World.load(str(MODELS / "scenes/table_objects.yaml"))
    model = SphereModel.search(world, spheres=14, pieces=200, restarts=1)
    assert len(model) <= 14 and "table" in model.links and all(model.judge(world))
    for ending in (".json", ".yaml", ".scene"):
        model.save(tmp_path / f"model{ending}", world)
        again = SphereModel.load(tmp_path / f"model{ending}", world)
        assert all((again[name] == model[name]).all() for name in model.links)
    boxes = ShapeModel.search(world, EnclosingKind.BOX, shapes=14, pieces=40)
    boxes.save(tmp_path / "boxes.yaml", world)
    assert all(ShapeModel.load(tmp_path / "boxes.yaml", world).judge(world))
    with pytest.raises(swept.InputError, match="ShapeModel.load reads it"):
        SphereModel.load(tmp_path / "boxes.yaml", world)
    with pytest.raises(swept.UsageError, match="allowed for a scene"):
        model.save(tmp_path / "model.urdf", world)
    with pytest.raises(swept.UsageError, match="3 spheres are too few for 12 bodies"):
        SphereModel.search(world, spheres=3)
    with pytest.raises(swept.ArgumentTypeError, match="expected a swept.Robot or a swept.World"):
        SphereModel.search("robot.urdf", spheres=3)
    world = swept.World()
    pose = np.eye(4)
    pose[2, 3] = 5.0
    world.add("cube", Shape.box([0.2, 0.2, 0.2]), pose)
    report, = SphereModel({"cube": [[0.0, 0.0, 5.0, 0.1]]}).judge(world)
    assert not report and report.outside.lower == pytest.approx(0.1 * math.sqrt(3) - 0.1, abs=2e-5)
