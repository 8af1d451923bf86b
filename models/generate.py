# SPDX-License-Identifier: BSD-3-Clause
"""Writes every robot and scene of this folder anew. Needs Python 3 and nothing else: `python3 generate.py`."""
import json
import pathlib
import random
import shutil

from generator import arms, clouds, disabled_pairs, edges, mesh_files, queries, scenes, tunnel
from generator.clearance import Collider

HERE = pathlib.Path(__file__).resolve().parent
STATE_CLEARANCE = 0.005    # m, of the named states, alone and in every scene
SCANNED = ("shelf",)       # scenes that are given as clouds, too
VOXEL = 0.02               # m, of their OctoMaps
OVERLAP_BY_DESIGN = {"rook7": (("link4", "elbow_ring"),)}  # the ring turns about link4's end


def write_robots(robots):
    for name, (robot, meshes) in robots.items():
        folder = HERE / "robots" / name
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "meshes" if meshes else folder).mkdir(parents=True)
        for file, (mesh, kind, factor) in meshes.items():
            mesh_files.write(folder / "meshes" / file, mesh, kind, factor)
        (folder / f"{name}.urdf").write_text(robot.urdf())
        (folder / f"{name}.srdf").write_text(robot.srdf())


def check_states(robots, worlds):
    """The named states are free by STATE_CLEARANCE; home, ready and tucked of the arms in every scene.
    Random states are not all free: the check can fail."""
    for name, (robot, _) in robots.items():
        around = worlds.values() if name in ("rook7", "rook6") else [None]
        for scene in around:
            collider = Collider(robot, scene)
            for (state, _), values in robot.states.items():
                if scene and scene.name != "empty" and state in ("upright", "closed", "open"):
                    continue  # meant for an arm that stands alone
                found = collider.violations(robot.forward(values), STATE_CLEARANCE)
                assert not found, (name, scene and scene.name, state, found)
    arm = queries.Arm(robots["rook7"][0])
    collider, source = Collider(arm.robot, worlds["cage"]), random.Random("check")
    free = sum(collider.free("arm", arm.random(source), STATE_CLEARANCE) for _ in range(100))
    assert 0 < free < 90, free


def write_scenes(worlds):
    folder = HERE / "scenes"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, scene in worlds.items():
        (folder / f"{name}.yaml").write_text(scenes.to_yaml(scene))
    (folder / "table_objects.scene").write_text(scenes.to_moveit_text(worlds["table_objects"]))


def write_clouds(worlds):
    folder = HERE / "clouds"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name in SCANNED:
        points = clouds.scan(worlds[name])
        seen = sum(p is not None for p in points)
        assert len(points) / 3 < seen < len(points), (name, seen)
        (folder / f"{name}.pcd").write_bytes(clouds.to_pcd(points))
        (folder / f"{name}.bt").write_bytes(clouds.to_octomap(points, VOXEL))


def problems_of(robot, worlds, asked):
    """In MotionBenchMaker's layout; only scenes made of primitives."""
    sets = {}
    for q in asked:
        if q["robot"] != robot.name or not worlds[q["scene"]].only_primitives():
            continue
        problems = sets.setdefault(q["scene"], [])
        problems.append({"index": len(problems) + 1, "world": scenes.to_problem_world(worlds[q["scene"]]),
                         "start": q["start"], "goals": [q["goal"]], "joint_names": robot.group("arm").joints})
    return sets


def write_problems(robot, sets):
    """One JSON file per arm."""
    lines = []
    for name, problems in sets.items():
        rows = ",\n  ".join(json.dumps(p) for p in problems)
        lines.append(f'"{name}": [\n  {rows}\n]')
    file = "problems.json" if robot.name == "rook7" else f"problems_{robot.name}.json"
    (HERE / file).write_text("{\n" + ",\n".join(lines) + "\n}\n")


def main():
    robots, worlds = arms.build(), scenes.build()
    for name, (robot, _) in robots.items():
        disabled_pairs.fill(robot, OVERLAP_BY_DESIGN.get(name, ()))
    check_states(robots, worlds)
    asked = queries.build({name: robot for name, (robot, _) in robots.items()}, worlds)
    trap = worlds["tunnel_trap"]
    motions = tunnel.search(robots["rook7"][0], trap, ("hand", "finger_left", "finger_right"),
                            ((0.0, -0.006), (0.0, 0.006)), 32, "rook7 motions")
    motions += tunnel.search(robots["rook6"][0], trap, ("wrist_3", "bracket"),
                             ((-0.039, 0.0), (0.039, 0.0)), 28, "rook6 motions")

    write_robots(robots)
    write_scenes(worlds)
    write_clouds(worlds)
    (HERE / "queries.yaml").write_text(queries.to_yaml(asked))
    for name in ("rook7", "rook6"):
        write_problems(robots[name][0], problems_of(robots[name][0], worlds, asked))
    rook7 = robots["rook7"][0]
    (HERE / "edges.csv").write_text(edges.to_csv(queries.Arm(rook7), problems_of(rook7, worlds, asked)))
    (HERE / "scenes" / "tunnel_motions.csv").write_text(tunnel.to_csv(motions))


if __name__ == "__main__":
    main()
