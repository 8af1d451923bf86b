# SPDX-License-Identifier: BSD-3-Clause
"""Roadmaps in worlds that change: what C++ says, bit for bit, and what a checker says of every motion."""
import copy
import heapq
import json
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import numbers

import swept
from swept import CertifiedRoadmap, ProvenGraph, Shape, Verdict

CRATE = Shape.box([0.2, 0.2, 0.2])


def at(place):
    pose = np.eye(4)
    pose[:3, 3] = place
    return pose


def crated(checker, place=(-0.4, 0.3, 0.5)):
    return checker.with_body("crate", CRATE, at(place))


@pytest.fixture(scope="module")
def built(checker):
    return CertifiedRoadmap(checker, states=300, neighbours=8)


@pytest.fixture()
def roadmap(built):
    return copy.copy(built)


def ask_all(graph, checker):
    """What a checker says of each motion, asked about all of them."""
    ends = graph.states[graph.motions]
    return checker.certify_motions(ends[:, 0].copy(), ends[:, 1].copy()).verdicts


def agrees(graph, checker):
    """All pairs together may stay UNDECIDED where each alone is proven."""
    free, asked = graph.verdicts == Verdict.FREE, ask_all(graph, checker)
    return (asked[free] != Verdict.COLLISION).all() and (asked[~free] != Verdict.FREE).all()


def numbers_of(roadmap, start, goal):
    """In the order of tests/python/roadmap_answers.cpp."""
    path = roadmap.path(start, goal)
    return [len(roadmap.states), len(roadmap.motions), *roadmap.states.ravel(), *roadmap.motions.ravel(),
            *roadmap.verdicts, roadmap.free_motions, roadmap.components,
            *([0] if path is None else [len(path), *path.ravel()])]


def test_roadmaps_against_cpp(checker, oracle, random):
    q, to = random.uniform(checker.group.lower, checker.group.upper, (2, 3, 7))
    q[0], to[0] = checker.named_state("home"), checker.named_state("ready")
    options = np.array([[120, 6, 1, -0.4, 0.3, 0.5], [80, 4, 3, 0.4, -0.2, 0.6], [60, 10, 9, 3.0, 3.0, 3.0]])
    paths, blocked = 0, 0
    for words, start, goal, row in zip(oracle.ask("roadmap", np.hstack([q, to, options])), q, to, options):
        count, neighbours, seed = map(int, row[:3])
        roadmap = CertifiedRoadmap(checker, states=count, neighbours=neighbours, seed=seed)
        first = numbers_of(roadmap, start, goal)
        change = roadmap.update(crated(checker, row[3:]))
        counts = [change.bodies_gone, change.bodies_new, change.by_arithmetic, change.asked, change.motions_asked,
                  change.freed, change.blocked, change.everything]
        assert numbers(words).tolist() == [*first, *counts, *numbers_of(roadmap, start, goal)]
        assert len(roadmap.states) == count and change.bodies_new == 1 and not change.everything
        blocked += change.blocked
        paths += roadmap.path(start, goal) is not None
    assert paths >= 2 and blocked > 10


def test_verdicts_are_those_of_a_checker(checker, roadmap):
    assert roadmap.motions.dtype == np.uint32 and roadmap.motions.shape == (len(roadmap.verdicts), 2)
    assert roadmap.verdicts.dtype == np.uint8 and roadmap.free_motions == (roadmap.verdicts == Verdict.FREE).sum()
    assert (checker.check_states(roadmap.states) == Verdict.FREE).all() and agrees(roadmap, checker)
    free = roadmap.free_motions
    assert 0 < free < len(roadmap.motions)
    worlds = [crated(checker), crated(checker).with_replaced("crate", CRATE, at([0.3, 0.4, 0.4])),
              checker.without_body(checker.world.names[0]), checker]
    changes = []
    for version in worlds:
        before = roadmap.verdicts
        change = roadmap.update(version)
        now = roadmap.verdicts
        assert agrees(roadmap, version) and roadmap.checker.world.names == version.world.names
        assert change.blocked == ((before == Verdict.FREE) & (now != Verdict.FREE)).sum()
        assert change.freed == ((before != Verdict.FREE) & (now == Verdict.FREE)).sum()
        assert change.by_arithmetic + change.asked == change.bodies_new * len(now)
        changes.append(change)
    assert changes[0].blocked > 0 and changes[2].freed > 0 and changes[2].bodies_gone == 2
    assert roadmap.free_motions == free and "blocked" in repr(changes[0])
    wide = swept.Checker(checker.robot, "arm", checker.world, margin=0.02)
    assert roadmap.update(wide).everything and agrees(roadmap, wide)


def test_what_blocks_a_motion(checker, roadmap):
    roadmap.update(crated(checker))
    names, verdicts = set(), roadmap.verdicts
    for i, (a, b) in enumerate(roadmap.states[roadmap.motions]):
        blockers = roadmap.blocked_by(i)
        assert (verdicts[i] == Verdict.FREE) == (not blockers)
        names |= set(blockers)
        if i % 10 == 0 and blockers:
            without = roadmap.checker
            for name in blockers:
                without = without.without_body(name)
            assert without.certify_motion(a.copy(), b.copy())
    assert "crate" in names and len(names) > 1 and names <= set(roadmap.checker.world.names)
    assert roadmap.blocked_by(-1) == roadmap.blocked_by(len(verdicts) - 1)
    with pytest.raises(IndexError, match=f"^motion {len(verdicts)} of {len(verdicts)}$"):
        roadmap.blocked_by(len(verdicts))


def shortest(roadmap, start, goal):
    """Dijkstra over the free motions, in numpy's metric; inf without a way."""
    states, lengths = roadmap.states, [np.inf] * len(roadmap.states)
    ways = [[] for _ in states]
    for a, b in roadmap.motions[roadmap.verdicts == Verdict.FREE]:
        length = np.linalg.norm(states[a] - states[b])
        ways[a].append((b, length))
        ways[b].append((a, length))
    lengths[start], heap = 0.0, [(0.0, start)]
    while heap:
        so_far, at_state = heapq.heappop(heap)
        if so_far > lengths[at_state]:
            continue
        for other, length in ways[at_state]:
            if so_far + length < lengths[other]:
                lengths[other] = so_far + length
                heapq.heappush(heap, (lengths[other], other))
    return lengths[goal]


def test_paths_are_proven_and_shortest(checker, roadmap, random):
    long = 0
    for version in (checker, crated(checker)):
        roadmap.update(version)
        for a, b in random.integers(0, len(roadmap.states), (25, 2)):
            path = roadmap.path(roadmap.states[a].copy(), roadmap.states[b].copy())
            expected = shortest(roadmap, a, b)
            if path is None:
                assert expected == np.inf
                continue
            assert swept.certify_path(version, path, clearances=False)
            assert (path[0] == roadmap.states[a]).all() and (path[-1] == roadmap.states[b]).all()
            if len(path) > 2 and np.isfinite(expected):
                way = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
                assert way == pytest.approx(expected, rel=1e-9)
                long += 1
    assert long > 10


def test_plans_on_roadmaps(checker, roadmap, home):
    ready = checker.named_state("ready")
    plan = roadmap.plan(home, ready, shorten=False)
    assert plan and plan.planner == "RoadmapPlanner" and plan.status == "Exact solution"
    assert np.allclose(plan.path, roadmap.path(home, ready), atol=1e-12)
    short = roadmap.plan(home, ready)
    assert short and short.length <= plan.length
    pose = checker.robot.link_pose("arm", "hand", ready)
    reached = roadmap.plan(home, swept.PoseGoal("hand", pose))
    assert reached and np.allclose(checker.robot.link_pose("arm", "hand", reached.path[-1].copy()), pose, atol=2e-3)
    assert roadmap.plan(home, np.array([roadmap.states[5], ready]))
    roadmap.update(crated(checker))
    assert swept.certify_path(crated(checker), roadmap.plan(home, ready).path)
    roadmap.update(checker.with_body("block", Shape.box([9.0, 9.0, 9.0])))
    assert roadmap.free_motions == 0 and roadmap.components == len(roadmap.states)
    blocked = roadmap.plan(home, ready, seconds=0.5)
    assert not blocked and blocked.path is None


def test_files(checker, roadmap, tmp_path):
    file = tmp_path / "roadmap.json"
    roadmap.update(crated(checker))
    roadmap.save(file)
    read = ProvenGraph.load(file, crated(checker))
    for name in ("states", "motions", "verdicts"):
        assert (getattr(read, name) == getattr(roadmap, name)).all()
    again = CertifiedRoadmap.of(read)
    home, ready = checker.named_state("home"), checker.named_state("ready")
    assert (again.path(home, ready) == roadmap.path(home, ready)).all() and repr(again) == repr(roadmap)
    with pytest.raises(swept.InputError, match="crate"):
        ProvenGraph.load(file, checker)
    changed, change = ProvenGraph.load_changed(file, checker)
    assert change.bodies_gone == 1 and change.bodies_new == 0 and agrees(changed, checker)
    with pytest.raises(swept.InputError, match="margin|option"):
        ProvenGraph.load(file, swept.Checker(checker.robot, "arm", checker.world, margin=0.02))
    file.write_text(json.dumps({"states": []}))
    with pytest.raises(swept.InputError) as caught:
        ProvenGraph.load(file, checker)
    assert caught.value.file == str(file)
    with pytest.raises(swept.UsageError):
        roadmap.save(tmp_path / "absent" / "roadmap.json")


def test_graphs_of_ones_own(checker, states):
    graph = ProvenGraph(checker)
    assert len(graph.states) == len(graph.motions) == 0 and graph.states.shape == (0, 7)
    free = states[checker.check_states(states) == Verdict.FREE][:60]
    indices = graph.add_states(free)
    assert indices.dtype == np.uint32 and indices.tolist() == list(range(len(free))) and (graph.states == free).all()
    pairs = np.array([(i, j) for i in range(len(free)) for j in range(i + 1, min(i + 9, len(free)))])
    added = graph.add_motions(pairs)
    # What is left out is in contact with the robot itself.
    lone = checker.with_world(swept.World())
    kept = lone.certify_motions(free[pairs[:, 0]], free[pairs[:, 1]]).verdicts == Verdict.FREE
    assert added == kept.sum() == len(graph.motions) and (graph.motions == pairs[kept]).all() and added > 50
    assert agrees(graph, checker) and {Verdict.FREE, Verdict.COLLISION} <= set(graph.verdicts)
    assert graph.add_states(free[:2] * 0.5).tolist() == [len(free), len(free) + 1]
    assert graph.add_motions([[0, len(free)]]) in (0, 1) and graph.update(crated(checker)).bodies_new == 1
    roadmap = CertifiedRoadmap.of(graph)
    assert (roadmap.graph.motions == graph.motions).all() and "ProvenGraph of 62 states" in repr(graph)
    assert roadmap.free_motions == (graph.verdicts == Verdict.FREE).sum()


def test_seeds_and_options(checker, built):
    same = CertifiedRoadmap(checker, states=300, neighbours=8, threads=1)
    other = CertifiedRoadmap(checker, states=300, neighbours=8, seed=2)
    assert (same.motions == built.motions).all() and (same.verdicts == built.verdicts).all()
    assert not (other.states == built.states).all()
    narrow = CertifiedRoadmap(checker, states=50, limits={"joint1": (0.1, 0.2)}, weights={"joint2": 3.0})
    assert (narrow.states[:, 0] >= 0.1).all() and (narrow.states[:, 0] <= 0.2).all()


def test_copies_share_nothing(checker, built):
    mine, deep = copy.copy(built), copy.deepcopy(built)
    free = built.free_motions
    mine.update(crated(checker))
    assert mine.free_motions < free == built.free_motions == deep.free_motions


def test_threads_share_a_roadmap(checker, roadmap):
    """Some ask while one changes the world: each answer is that of one of the worlds."""
    known = {}
    home, ready = checker.named_state("home"), checker.named_state("ready")
    versions = [checker, crated(checker)]
    for version in versions:
        roadmap.update(version)
        known[roadmap.verdicts.tobytes()] = roadmap.path(home, ready).tobytes()

    def ask(_):
        return all(roadmap.verdicts.tobytes() in known and roadmap.path(home, ready).tobytes() in known.values()
                   and roadmap.free_motions > 0 and repr(roadmap) for _ in range(30))

    with ThreadPoolExecutor(5) as pool:
        asked = [pool.submit(ask, i) for i in range(4)]
        for i in range(20):
            roadmap.update(versions[i % 2])
        assert all(future.result() for future in asked)


def test_building_ends_with_its_token(checker, roadmap):
    """And after its time; Ctrl-C is in threads_test.py. An update that ends so changes nothing."""
    token = swept.CancellationToken()
    token.cancel()
    with pytest.raises(swept.Cancelled, match="^cancelled by its token$"):
        CertifiedRoadmap(checker, states=50, cancel=token)
    with pytest.raises(swept.Cancelled, match="^the time was up"):
        CertifiedRoadmap(checker, states=500_000, neighbours=40, seconds=0.05)
    before = roadmap.verdicts
    with pytest.raises(swept.Cancelled):
        roadmap.update(crated(checker), cancel=token)
    assert (roadmap.verdicts == before).all() and "crate" not in roadmap.checker.world.names
    graph, own, ended = ProvenGraph(checker), swept.CancellationToken(), []
    graph.add_states(roadmap.states)
    pairs = np.random.default_rng(1).integers(0, len(roadmap.states), (300_000, 2))

    def work():
        with pytest.raises(swept.Cancelled):
            graph.add_motions(pairs, threads=1, cancel=own)
        ended.append(True)

    worker = threading.Thread(target=work)
    worker.start()
    worker.join(0.1)
    own.cancel()
    worker.join()
    assert ended == [True] and len(graph.motions) < len(pairs) / 2 and agrees(graph, checker)


def test_what_roadmaps_refuse(checker, roadmap, home):
    with pytest.raises(swept.ArgumentError, match="^CertifiedRoadmap: 0 states and 10 neighbours are asked for"):
        CertifiedRoadmap(checker, states=0)
    with pytest.raises(swept.ArgumentError, match="^CertifiedRoadmap: none of 1000 states is proven free$"):
        CertifiedRoadmap(checker.with_body("block", Shape.box([9.0, 9.0, 9.0])), states=10)
    moving = checker.with_obstacle("drone", Shape.sphere(0.1), [0.0, 1.0], [np.eye(4), np.eye(4)])
    with pytest.raises(swept.ArgumentError, match="^ProvenGraph: the world has the moving obstacle 'drone'"):
        CertifiedRoadmap(moving)
    with pytest.raises(swept.ArgumentError, match="^ProvenGraph: the world has the moving obstacle 'drone'"):
        roadmap.update(moving)
    other = swept.Checker(swept.WorkCell.load("models/cells/two_rooks.yaml").robot(), "left/arm")
    with pytest.raises(swept.ArgumentError, match="^ProvenGraph: the checker is of group 'left/arm' of robot"):
        roadmap.update(other)
    with pytest.raises(swept.ArgumentError, match=r"^goal: expected finite float64 values of shape \(7,\)"):
        roadmap.path(home, home[:3].copy())
    with pytest.raises(swept.ArgumentError, match=r"^start: expected finite float64 values of shape \(7,\)"):
        roadmap.plan([0.0], home)
    with pytest.raises(swept.ArgumentError, match="^seconds: expected a positive number$"):
        roadmap.plan(home, home, seconds=0.0)
    with pytest.raises(swept.ArgumentError, match="nose"):
        CertifiedRoadmap(checker, states=10, limits={"nose": (0.0, 1.0)})
    graph = ProvenGraph(checker)
    graph.add_states([home, home])
    with pytest.raises(swept.ArgumentError, match="^motions: expected indices from 0 to 2 - 1; got 2 at .0, 1.$"):
        graph.add_motions([[0, 2]])
    with pytest.raises(swept.ArgumentError, match=r"^motions: expected integers of shape \(m, 2\), C-contiguous; got"):
        graph.add_motions(np.zeros((2, 3), int))
    with pytest.raises(swept.ArgumentTypeError, match=r"^motions: expected integers of shape \(m, 2\)"):
        graph.add_motions(np.zeros((2, 2)))
    with pytest.raises(swept.ArgumentError, match=r"^states: expected finite float64 values of shape"):
        graph.add_states(np.full((1, 7), np.nan))
