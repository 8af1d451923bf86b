# SPDX-License-Identifier: BSD-3-Clause
"""Capsules, boxes and hulls around bodies and robots: what C++ says, bit for bit, and what is proven, sampled."""
import copy
import json
import math
import threading
import xml.etree.ElementTree as xml

import numpy as np
import pytest
from conftest import MODELS, numbers

import swept
from swept import EnclosingKind, EnclosingShapesSearch, Shape, ShapeModel

KINDS = list(EnclosingKind)


@pytest.fixture(scope="module")
def hand(robot):
    return robot.link_shapes("hand")


@pytest.fixture(scope="module")
def models(robot):
    return {kind: ShapeModel.search(robot, kind, shapes=20, pieces=12) for kind in KINDS}


def moved(x):
    pose = np.eye(4)
    pose[0, 3] = x
    return pose


def inside(shape, pose, points, slack=1e-9):
    """Which points (m, 3) a shape contains, by numpy alone."""
    local, own = (points - pose[:3, 3]) @ pose[:3, :3], shape.parameters
    if shape.kind == "box":
        return (np.abs(local) <= own["size"] / 2 + slack).all(axis=1)
    if shape.kind == "capsule":
        along = np.clip(local[:, 2], -own["length"] / 2, own["length"] / 2)
        return np.linalg.norm(local - np.outer(along, [0, 0, 1]), axis=1) <= own["radius"] + slack
    if shape.kind == "sphere":
        return np.linalg.norm(local, axis=1) <= own["radius"] + slack
    # Nothing in a hull is farther along any direction than its farthest corner.
    directions = np.random.default_rng(1).normal(size=(400, 3))
    return (local @ directions.T <= (own["points"] @ directions.T).max(axis=0) + slack).all(axis=1)


def points_of(body, random):
    """Points of boxes, cylinders, spheres, capsules and meshes."""
    found = []
    for shape, pose in body:
        own = shape.parameters
        if shape.kind == "box":
            local = random.uniform(-0.5, 0.5, (400, 3)) * own["size"]
        elif shape.kind in ("cylinder", "capsule"):
            angle, radius = random.uniform(0, 2 * math.pi, 400), own["radius"] * np.sqrt(random.uniform(0, 1, 400))
            local = np.column_stack([radius * np.cos(angle), radius * np.sin(angle),
                                     random.uniform(-0.5, 0.5, 400) * own["length"]])
        elif shape.kind == "mesh":
            local = own["vertices"]
        else:
            local = np.zeros((1, 3))
        found.append(local @ pose[:3, :3].T + pose[:3, 3])
    return np.concatenate(found)


def test_shapes_against_cpp(oracle, hand, random):
    questions = [[int(kind), count] for kind in KINDS for count in (2, 5)]
    points = points_of(hand, random)
    for words, (kind, count) in zip(oracle.ask("shapes", np.hstack([np.zeros((6, 7)), questions])), questions):
        search = EnclosingShapesSearch(hand, EnclosingKind(kind), pieces=20)
        expected = [search.count_for(0.02), search.reach_for(count)]
        found = search.at_most(count)
        expected.append(found.reach)
        contained = np.zeros(len(points), bool)
        for shape, pose in found.shapes:
            assert shape.kind == ("capsule", "box", "convex")[kind]
            expected.extend([*pose.ravel(), *(x for value in shape.parameters.values() for x in np.ravel(value))])
            contained |= inside(shape, pose, points)
        outside = swept.outside_shapes(hand, found.shapes, most_splits=3000, samples=500)
        excess = swept.shapes_excess(hand, found.shapes, 0.01, samples=300, most_distances=1000)
        expected.extend([outside.lower, outside.upper, *outside.point, outside.surface_share,
                         excess.largest_seen, excess.largest, excess.mean, excess.volume_ratio])
        assert numbers(words).tolist() == expected
        assert 1 <= len(found) <= count and outside and outside.upper <= 0.0 and contained.all()
        assert "EnclosingShapes, " in repr(found) and copy.copy(found) is found


def test_shapes_within(hand):
    for kind in KINDS:
        search = EnclosingShapesSearch(hand, kind, pieces=60)
        found = search.within(0.03)
        assert swept.outside_shapes(hand, found.shapes, samples=100)
        assert swept.shapes_excess(hand, found.shapes, samples=2000, most_distances=2000).largest_seen <= 0.03 + 1e-5


def test_judgements_known_by_hand():
    cube, wide = Shape.box([0.2] * 3), Shape.box([0.3] * 3)
    outside = swept.outside_shapes(cube, wide)
    assert outside and outside.upper == pytest.approx(-0.05, abs=2e-5)
    out = swept.outside_shapes(cube, Shape.capsule(0.1, 0.2))
    assert out.lower == pytest.approx(0.1 * math.sqrt(2) - 0.1, abs=2e-5) and not out
    assert out.lower <= out.upper and abs(out.point[:2]).min() == pytest.approx(0.1, abs=1e-3)
    excess = swept.shapes_excess(cube, wide)
    corner = 0.05 * math.sqrt(3)
    assert corner * 0.97 <= excess.largest_seen <= corner + 1e-5 and corner <= excess.largest <= corner * 1.03
    assert excess.volume_ratio == pytest.approx(1.5 ** 3, rel=0.05)
    grown = swept.shapes_excess(cube, wide, 0.05)  # in all directions: corners become round
    assert (corner + 0.05) * 0.97 <= grown.largest_seen <= corner + 0.05 + 1e-5
    halves = [(Shape.box([0.1001, 0.2, 0.2]), moved(x)) for x in (-0.05, 0.05)]
    assert swept.outside_shapes(cube, halves).upper <= 1e-4


def test_parameters_make_the_same_shape(robot, random):
    shapes = [Shape.sphere(0.1), Shape.box([0.1, 0.2, 0.3]), Shape.cylinder(0.1, 0.3), Shape.capsule(0.1, 0.3),
              Shape.cone(0.1, 0.4), Shape.ellipsoid([0.1, 0.2, 0.3]), Shape.plane([0.0, 0.6, 0.8], 0.3),
              Shape.half_space([0.0, 0.6, 0.8], 0.3), Shape.convex(random.uniform(-1, 1, (30, 3))),
              Shape.mesh(random.uniform(-1, 1, (6, 3)), [[0, 1, 2], [3, 4, 5]], solid=False),
              Shape.cloud(random.uniform(-1, 1, (20, 3)), random.uniform(0.01, 0.1, 20)),
              Shape.load_mesh(next(file for file in sorted((MODELS / "robots/rook7/meshes").iterdir())))]
    for shape in shapes:
        again = getattr(Shape, shape.kind)(**shape.parameters)
        assert again.kind == shape.kind and set(again.parameters) == set(shape.parameters)
        if shape.kind not in ("mesh", "cloud"):
            for name, value in shape.parameters.items():
                assert np.array_equal(again.parameters[name], value), (shape, name)
        near, far = swept.World(), swept.World()
        near.add("thing", shape, moved(0.4))
        far.add("thing", again, moved(0.4))
        a, b = swept.Checker(robot, "arm", near), swept.Checker(robot, "arm", far)
        q = robot.named_state("arm", "ready")
        assert a.signed_clearance(q).upper == pytest.approx(b.signed_clearance(q).upper, abs=1e-9)
    assert shapes[1].parameters["size"].tolist() == [0.1, 0.2, 0.3] and shapes[2].parameters["length"] == 0.3
    assert shapes[0].parameters == {"radius": 0.1} and shapes[6].parameters["offset"] == 0.3
    cloud = shapes[10].parameters
    assert sorted(cloud["radius"]) == sorted(getattr(Shape, "cloud")(**cloud).parameters["radius"])


def test_models_contain_the_robot(robot, models, random):
    solid = tuple(link for link in robot.link_names if robot.link_shapes(link))
    for kind, model in models.items():
        assert len(model) <= 20 and sum(len(model[link]) for link in model.links) == len(model)
        assert sorted(model.links) == sorted(solid)
        for link in solid:
            points = points_of(robot.link_shapes(link), random)
            contained = [inside(shape, pose, points) for shape, pose in model[link]]
            assert np.any(contained, axis=0).all(), (kind, link)
    reports = models[EnclosingKind.CAPSULE].judge(robot, samples=500)
    assert tuple(report.link for report in reports) == solid
    for report in reports:
        assert report and report.outside.upper <= 0.0
        assert report.spheres == len(models[EnclosingKind.CAPSULE][report.link])
    fine = ShapeModel.search(robot, EnclosingKind.BOX, excess=0.1, pieces=12, threads=1)
    again = ShapeModel.search(robot, EnclosingKind.BOX, excess=0.1, pieces=12, threads=2)
    for link in fine.links:
        for (a, place), (b, there) in zip(fine[link], again[link]):
            assert (place == there).all() and (a.parameters["size"] == b.parameters["size"]).all()
    by_hand = ShapeModel({"hand": Shape.sphere(0.01), "link1": [(Shape.box([2.0] * 3), None)]})
    judged = {report.link: report for report in by_hand.judge(robot, samples=500)}
    assert not judged["hand"] and judged["hand"].outside.lower > 0.0 and judged["link1"]
    assert judged["link2"].outside.upper == math.inf and by_hand.links == ("hand", "link1")


@pytest.mark.parametrize("ending", ["json", "urdf"])
def test_models_in_files(robot, models, tmp_path, ending):
    for kind, model in models.items():
        if ending == "json" and kind is EnclosingKind.CONVEX:
            model = ShapeModel({"hand": model["hand"], "link1": model["link1"]})
        file = tmp_path / f"{kind}.{ending}"
        model.save(file, robot)
        read = ShapeModel.load(file, robot)
        assert sorted(read.links) == sorted(model.links) and len(read) == len(model)
        for link in model.links:
            for (a, place), (b, there) in zip(model[link], read[link]):
                # A capsule without length is a sphere in a URDF, a hull a mesh.
                assert a.kind == b.kind or (ending == "urdf" and (a.kind, b.kind) in {
                    ("capsule", "sphere"), ("convex", "mesh")})
                assert np.allclose(place, there, atol=1e-9)
                if a.kind == "box":
                    assert (a.parameters["size"] == b.parameters["size"]).all()
        for link in ("hand", "link1"):
            assert swept.outside_shapes(robot.link_shapes(link), read[link], samples=100).upper <= 1e-9
        if ending == "json":
            content = json.loads(file.read_text())
            assert content["shapes"] == len(model) and {entry["link"] for entry in content["links"]} == set(model.links)
        else:
            assert (tmp_path / f"{kind}_meshes").exists() == (kind is EnclosingKind.CONVEX)
            assert swept.Robot.load(file).link_names == robot.link_names
            assert len(list(xml.parse(file).iter("collision"))) >= len(model)


def test_sphere_models_are_shape_models(robot, tmp_path):
    spheres = swept.SphereModel.search(robot, spheres=30, pieces=50, restarts=1)
    spheres.save(tmp_path / "spheres.json", robot)
    shapes = ShapeModel.load(tmp_path / "spheres.json", robot)
    for link in spheres.links:
        for (x, y, z, radius), (shape, pose) in zip(spheres[link], shapes[link]):
            assert shape.kind == "sphere" and shape.parameters["radius"] == radius
            assert pose[:3, 3].tolist() == [x, y, z]


def test_what_shapes_refuse(robot, hand, models, tmp_path):
    with pytest.raises(swept.ArgumentTypeError, match="^kind: expected a member of swept.EnclosingKind, got 'box'$"):
        EnclosingShapesSearch(hand, "box")
    with pytest.raises(swept.ArgumentError, match="a body without shapes needs none around it"):
        EnclosingShapesSearch([], EnclosingKind.BOX)
    with pytest.raises(swept.ArgumentError):
        EnclosingShapesSearch(Shape.plane([0, 0, 1]), EnclosingKind.BOX)
    with pytest.raises(swept.ArgumentError):
        EnclosingShapesSearch(hand, EnclosingKind.BOX, pieces=0)
    search = EnclosingShapesSearch(hand, EnclosingKind.BOX, pieces=10)
    for call in (lambda: search.at_most(0), lambda: search.within(0.0), lambda: search.reach_for(0),
                 lambda: swept.outside_shapes(hand, Shape.cone(0.1, 0.1)),
                 lambda: swept.shapes_excess(hand, Shape.ellipsoid([0.1] * 3)),
                 lambda: swept.outside_shapes(hand, Shape.sphere(1.0), tolerance=0.0)):
        with pytest.raises(swept.ArgumentError):
            call()
    for options in ({}, {"shapes": 20, "excess": 0.1}):
        with pytest.raises(swept.ArgumentError, match="^expected one of shapes and excess$"):
            ShapeModel.search(robot, EnclosingKind.BOX, **options)
    with pytest.raises(swept.UsageError, match="2 shapes are too few for robot 'rook7'"):
        ShapeModel.search(robot, EnclosingKind.BOX, shapes=2)
    model = models[EnclosingKind.BOX]
    with pytest.raises(swept.ArgumentError, match="^the model has no shapes for a link 'nose'$"):
        model["nose"]
    with pytest.raises(swept.UsageError, match="ends in '.yaml'; allowed: .urdf, .json$"):
        model.save(tmp_path / "shapes.yaml", robot)
    with pytest.raises(swept.UsageError, match="cannot be written$"):
        model.save(tmp_path / "absent" / "shapes.json", robot)
    with pytest.raises(swept.ArgumentError, match="a shape that is neither sphere, box, cylinder, capsule nor hull$"):
        ShapeModel({"hand": Shape.cone(0.1, 0.1)}).save(tmp_path / "cone.urdf", robot)
    arms = swept.WorkCell.load(MODELS / "cells/two_rooks.yaml").robot()
    with pytest.raises(swept.UsageError, match="has no URDF of its own"):
        ShapeModel({"left/hand": Shape.sphere(0.1)}).save(tmp_path / "arms.urdf", arms)
    with pytest.raises(swept.InputError):
        ShapeModel.load(tmp_path / "absent.json", robot)
    with pytest.raises(swept.ArgumentTypeError, match="^shape: expected a swept.Shape"):
        ShapeModel({"hand": [[0.0, 0.0, 0.0, 0.1]]})
    assert copy.copy(model) is model and "ShapeModel of" in repr(model)


def test_searches_of_threads(hand):
    """Two threads that share a search get what each gets alone."""
    alone = {n: EnclosingShapesSearch(hand, EnclosingKind.BOX, pieces=40).at_most(n) for n in (3, 5)}
    search, found = EnclosingShapesSearch(hand, EnclosingKind.BOX, pieces=40), {}
    threads = [threading.Thread(target=lambda n=n: found.__setitem__(n, search.at_most(n))) for n in (3, 5)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for n in (3, 5):
        assert found[n].reach == alone[n].reach and swept.outside_shapes(hand, found[n].shapes)
