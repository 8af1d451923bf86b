# SPDX-License-Identifier: BSD-3-Clause
"""Robots, worlds, rules and versions of checkers."""
import copy
import pickle
import warnings

import numpy as np
import pytest
from conftest import MODELS

import swept
from swept import Shape, Verdict


def at(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def test_robot(robot):
    group = robot.group("arm")
    assert robot.name == "rook7" and "arm" in robot.group_names and group.tip_link in robot.link_names
    assert group.variable_names == tuple(f"joint{i}" for i in range(1, 8)) == group.joint_names
    assert (group.lower < group.upper).all() and (group.velocity > 0).all() and len(group) == 7
    assert group.cyclic == (False,) * 7
    assert set(robot.named_states("arm")) >= {"home", "ready"}
    assert (robot.named_states("arm")["home"] == robot.named_state("arm", "home")).all()
    assert len(robot.default_state()) == len(robot.variable_names)
    for call in (lambda: robot.group("leg"), lambda: robot.named_state("arm", "hom"),
                 lambda: robot.link_pose("arm", "nose", np.zeros(7))):
        with pytest.raises(ValueError) as caught:
            call()
        assert isinstance(caught.value, swept.Error)


@pytest.mark.parametrize("call, text", [
    (lambda robot, urdf: swept.Robot.load(urdf, packages=["a"]), "packages: expected a dict of names and folders"),
    (lambda robot, urdf: swept.Robot.load(urdf, packages={"a": 3}), "packages: expected a dict of names and folders"),
    (lambda robot, urdf: swept.Robot.load(urdf, 3), "a file: expected a path, got 3"),
    (lambda robot, urdf: swept.Checker(robot, [1, 2]), r"group: expected a list of joints, got \[1, 2\]"),
    (lambda robot, urdf: swept.Checker(robot, "arm", reference={"joint1": "up"}), "reference: expected values by name"),
    (lambda robot, urdf: robot.standing({1: "home"}), "postures: expected names of groups, got 1"),
    (lambda robot, urdf: swept.SphereModel({1: [[0, 0, 0, 1]]}), "links: expected names of links, got 1"),
    (lambda robot, urdf: swept.ShapeModel({1: Shape.sphere(1.0)}), "links: expected names of links, got 1"),
])
def test_wrong_types_are_named(robot, call, text):
    with pytest.raises(swept.ArgumentTypeError, match=f"^{text}"):
        call(robot, MODELS / "robots/rook7/rook7.urdf")


def test_sphere_covers(robot, checker, home):
    """At every level the balls contain what the checker sees: no body is nearer to the link than to its balls."""
    hand = robot.link_pose("arm", "hand", home)
    coarse, fine = robot.sphere_cover("hand", 0), robot.sphere_cover("hand")
    assert coarse.shape[1] == fine.shape[1] == 4 and 1 <= len(coarse) < len(fine)
    probe = np.array([0.5, 0.1, 0.9])
    world = swept.Checker(robot, "arm").with_body("probe", Shape.sphere(0.0), at(*probe))
    alone = world.with_rules(swept.CollisionRules().allow("*", "probe").check("hand", "probe"))
    true = alone.report_state(home).world.clearance
    gaps = []
    for balls in (coarse, robot.sphere_cover("hand", 2), fine):
        centres = balls[:, :3] @ hand[:3, :3].T + hand[:3, 3]
        gaps.append(true - (np.linalg.norm(centres - probe, axis=1) - balls[:, 3]).min())
    assert all(gap >= 0.0 for gap in gaps) and gaps[-1] <= gaps[0] and gaps[-1] < 0.03
    with pytest.raises(ValueError, match="no link 'nose'"):
        robot.sphere_cover("nose")
    with pytest.raises(ValueError, match="^level: "):
        robot.sphere_cover("hand", -1)


def test_groups_by_joints(robot, world):
    three = swept.Checker(robot, ["joint1", "joint2", "joint3"], world)
    assert three.dimension == 3 and three.group.name == "joint1,joint2,joint3"
    again = pickle.loads(pickle.dumps(three.robot))
    assert again.group("joint1,joint2,joint3").joint_names == ("joint1", "joint2", "joint3")
    chain = robot.with_chain("upper", robot.link_names[0], "link3")
    assert "upper" in chain.group_names and "upper" not in robot.group_names
    with pytest.raises(ValueError, match="nothing"):
        swept.Checker(robot, ["nothing"])
    with pytest.raises(TypeError, match="^group: expected the name of a group, or a list of joints"):
        swept.Checker(robot, 3)


def test_files_that_cannot_be_read(tmp_path):
    (tmp_path / "broken.urdf").write_text("<robot name='a'>\n<link/>\n</robot>")
    with pytest.raises(swept.InputError) as caught:
        swept.Robot.load(tmp_path / "broken.urdf")
    error = caught.value
    assert error.file.endswith("broken.urdf") and isinstance(error.line, int)
    assert str(error).startswith(error.file) and str(error).endswith(error.message)
    with pytest.raises(swept.InputError, match="absent"):
        swept.World.load("absent.yaml")
    with pytest.raises(swept.InputError):
        swept.load_points(MODELS / "scenes/shelf.yaml")


def test_remarks_are_warnings(tmp_path):
    empty = tmp_path / "empty.yaml"
    empty.write_text((MODELS / "scenes/empty.yaml").read_text())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        swept.World.load(empty)
    assert all(issubclass(warning.category, swept.InputWarning) for warning in caught)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        if caught:
            with pytest.raises(swept.InputWarning):
                swept.World.load(empty)


def test_pickles_and_copies(robot, world, states):
    for one in (robot, swept.TrackingTolerance(0.1), Shape.sphere(1.0)):
        assert copy.copy(one) is one and copy.deepcopy(one) is one
    other, scene = pickle.loads(pickle.dumps((robot, world)))
    a, b = swept.Checker(robot, "arm", world), swept.Checker(other, "arm", scene)
    assert (a.check_states(states) == b.check_states(states)).all()
    twin = copy.copy(world)
    twin.remove(twin.names[0])
    assert len(twin) == len(world) - 1
    with pytest.raises(swept.UsageError, match="^a World is pickled by its file"):
        pickle.dumps(twin)
    assert len(pickle.loads(pickle.dumps(swept.World()))) == 0


def test_world():
    world = swept.World()
    world.add("ball", Shape.sphere(0.1), at(1, 0, 0))
    world.add("table", [(Shape.box([1, 1, 0.1]), at(0, 0, 0.5)), (Shape.cylinder(0.05, 0.5), None)])
    assert world.names == ("ball", "table") == tuple(world) and "ball" in world and "cup" not in world
    world.replace("ball", Shape.sphere(0.2))
    for call in (lambda: world.add("ball", Shape.sphere(1.0)), lambda: world.remove("cup"),
                 lambda: world.replace("cup", Shape.sphere(1.0)),
                 lambda: world.add("c", Shape.sphere(1.0), 2 * np.eye(4)),
                 lambda: world.add("c", Shape.sphere(1.0), np.eye(3)), lambda: Shape.sphere(-1.0),
                 lambda: Shape.box([1, 2]), lambda: Shape.box([1, 2, np.nan])):
        with pytest.raises(ValueError) as caught:
            call()
        assert isinstance(caught.value, swept.Error)
    with pytest.raises(TypeError, match="^shape: expected a swept.Shape"):
        world.add("c", "sphere")
    assert world.names == ("ball", "table")


CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) / 10
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                  [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


@pytest.mark.parametrize("shape", [
    Shape.box([0.2, 0.2, 0.2]), Shape.convex(CUBE), Shape.mesh(CUBE, FACES),
    Shape.mesh(CUBE, FACES.astype(np.uint16)), Shape.mesh(CUBE.tolist(), FACES.tolist()),
    Shape.box([0.1, 0.1, 0.1]).scaled(2.0), Shape.mesh(2 * CUBE, FACES).moved(CUBE)])
def test_shapes_of_arrays(robot, shape):
    """A cube before the robot, whatever it is made of: the same distance."""
    checker = swept.Checker(robot, "arm", world_margin=0.0).with_body("cube", shape, at(0.6, 0, 0.7))
    expected = swept.Checker(robot, "arm").with_body("cube", Shape.box([0.2, 0.2, 0.2]), at(0.6, 0, 0.7))
    q = checker.named_state("home")
    assert 0.05 < expected.report_state(q).world.clearance < 0.6
    assert checker.report_state(q).world.clearance == pytest.approx(expected.report_state(q).world.clearance, abs=1e-6)


def test_clouds_of_arrays(robot, home):
    points = np.random.default_rng(1).uniform(-0.1, 0.1, (500, 3)) + [0.6, 0, 0.7]
    near = lambda shape: swept.Checker(robot, "arm").with_body("cloud", shape).report_state(home).world.clearance
    one = near(Shape.cloud(points, 0.01))
    assert near(Shape.cloud(points, np.full(500, 0.01))) == pytest.approx(one) and 0.05 < one < 0.6
    with pytest.raises(ValueError, match=r"^radius: expected finite float64 values of shape \(500,\)"):
        Shape.cloud(points, np.ones(3))


def test_meshes_that_cannot_be_made():
    with pytest.raises(ValueError, match=r"^triangles: expected indices from 0 to 8 - 1; got 8 at \[2, 1\]$"):
        Shape.mesh(CUBE, np.array([[0, 1, 2], [0, 1, 2], [0, 8, 2]]))
    with pytest.raises(ValueError, match="got -1"):
        Shape.mesh(CUBE, np.array([[0, 1, -1]]))
    with pytest.raises(TypeError, match="^triangles: expected integers"):
        Shape.mesh(CUBE, FACES.astype(float))
    with pytest.raises(ValueError, match="^triangles: expected integers"):
        Shape.mesh(CUBE, FACES[:, :2])
    with pytest.raises(ValueError, match="expected a mesh, got a box"):
        Shape.box([1, 1, 1]).moved(CUBE)


def test_shape_names():
    made = {"sphere": Shape.sphere(1), "box": Shape.box([1, 1, 1]), "cylinder": Shape.cylinder(1, 1),
            "capsule": Shape.capsule(1, 1), "cone": Shape.cone(1, 1), "ellipsoid": Shape.ellipsoid([1, 2, 3]),
            "plane": Shape.plane([0, 0, 1]), "half_space": Shape.half_space([0, 0, 1], 2), "convex": Shape.convex(CUBE),
            "mesh": Shape.mesh(CUBE, FACES), "cloud": Shape.cloud(CUBE, 0.1)}
    for name, shape in made.items():
        assert shape.kind == name and repr(shape) == f"<swept.Shape {name}>"


def test_files_of_shapes(robot):
    points = swept.load_points(MODELS / "clouds/shelf.pcd")
    assert points.ndim == 2 and points.shape[1] == 3 and np.isfinite(points).all()
    mesh = next((MODELS / "robots/rook7/meshes").iterdir())
    for scale in (1.0, 0.5, [1, 2, 1]):
        assert Shape.load_mesh(mesh, scale).kind == "mesh"


def test_margins_rules_and_explanations(robot, world, states):
    plain = swept.Checker(robot, "arm", world)
    wide = swept.Checker(robot, "arm", world, margin=0.05)
    free, wide_free = plain.check_states(states) == Verdict.FREE, wide.check_states(states) == Verdict.FREE
    assert wide.margin == 0.05 and (free >= wide_free).all() and free.sum() > wide_free.sum()
    rules = swept.CollisionRules().allow("*", "board_1", "a dummy").pad("hand", 0.02)
    assert len(rules) == 2
    ruled = plain.with_rules(rules)
    assert "a dummy" in ruled.explain("hand", "board_1") and "0.02" in ruled.explain("hand", "board_2")
    assert len(ruled.rules) == 2 and len(plain.rules) == 0
    assert "a dummy" not in plain.explain("hand", "board_1")
    assert len(rules.over(swept.CollisionRules().scale("hand", 2.0)).check("a", "b").margin("hand", "base", 0.1)) == 5
    assert len(rules) == 2
    kinds = {pair.self_pair for pair in plain.checked_pairs}
    assert kinds == {True, False} and not plain.checks_nothing
    with pytest.raises(ValueError):
        plain.explain("nose", "hand")
    with pytest.raises(ValueError):
        swept.Checker(robot, "arm", world, margin=-1.0)


def test_reference(robot):
    checker = swept.Checker(robot, ["joint1", "joint2"], reference={"joint4": 1.0})
    other = swept.Checker(robot, ["joint1", "joint2"], reference=robot.default_state())
    assert checker.clearance(np.zeros(2)) >= 0.0 and other.clearance(np.zeros(2)) >= 0.0
    with pytest.raises(ValueError):
        swept.Checker(robot, ["joint1"], reference={"joint": 1.0})


def test_versions(checker, home):
    base = checker.with_body("globe", Shape.sphere(0.3), checker.robot.link_pose("arm", "hand", home))
    assert not base.check_state(home) and checker.check_state(home)
    assert base.without_body("globe").check_state(home)
    assert base.with_replaced("globe", Shape.sphere(0.01), at(5, 5, 5)).check_state(home)
    assert base.with_world(checker.world).check_state(home) and "globe" not in checker.world
    attached = checker.with_attached("bar", "hand", Shape.box([3.0, 3.0, 0.5]), at(0, 0, 0.1), ["finger*"])
    assert attached.attached[0].name == "bar" and attached.attached[0].touch_links == ("finger*",)
    assert not attached.check_state(home) and attached.without_attached("bar").check_state(home)
    bar = swept.AttachedBody("bar", "hand", Shape.box([3.0, 3.0, 0.5]), at(0, 0, 0.1), ["finger*"])
    same = swept.Checker(checker.robot, "arm", checker.world, attached=[bar])
    assert same.report_state(home).clearance == attached.report_state(home).clearance
    assert "bar" in attached.with_detached("bar", home).world
    tube = checker.with_tracking(swept.TrackingTolerance(rotation=0.5, joints={"joint1": (0.6, 0.0)}))
    assert tube.tracking.joints == {"joint1": (0.6, 0.0)} and not tube.check_state(home)
    for call in (lambda: checker.without_body("cup"), lambda: checker.with_attached("b", "nose", Shape.sphere(1)),
                 lambda: checker.with_tracking(swept.TrackingTolerance(rotation=-1.0))):
        with pytest.raises(ValueError):
            call()


def test_moving_obstacles(checker, home):
    hand = checker.robot.link_pose("arm", "hand", home)
    away = hand.copy()
    away[2, 3] += 3.0
    moving = checker.with_obstacle("drone", Shape.sphere(0.2), [0.0, 2.0], [away, hand])
    assert moving.dimension == 8
    assert moving.check_state(np.append(home, 0.0)) and not moving.check_state(np.append(home, 2.0))
    found = moving.certify_motion(np.append(home, 0.0), np.append(home, 2.0))
    assert found.witness.body_b == "drone" and 0.0 < found.free_until < found.witness.t + 1e-3 <= 1.001
    world = swept.World()
    world.add_obstacle("drone", Shape.sphere(0.2), [0.0, 2.0], [away, hand])
    assert "drone" in world
    with pytest.raises(ValueError, match="^poses: expected as many as times, 2; got 1$"):
        world.add_obstacle("other", Shape.sphere(0.2), [0.0, 2.0], [away])


def test_configurations_by_name(checker):
    q = checker.configuration({f"joint{i}": 0.1 * i for i in range(7, 0, -1)})
    assert q.tolist() == [0.1 * i for i in range(1, 8)]
    assert checker.configuration({"joint2": 0.5}, others=q).tolist() == [0.1, 0.5] + q.tolist()[2:]
    with pytest.raises(ValueError):
        checker.configuration({"joint2": 0.5})
