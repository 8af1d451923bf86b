# SPDX-License-Identifier: BSD-3-Clause
"""Finds the link pairs that can never touch, by proof: sphere covers of the links, and subdivision of the
joint ranges between them with a bound on how far a sphere can move. Nothing is listed as Never without it."""
import itertools
import math
import random

from .clearance import ball
from .vectors import IDENTITY_POSE, apply, compose, inverse, norm

SLACK = 0.002      # m, kept between the covers everywhere
MAX_NODES = 8000  # boxes of joint values examined before a pair is given up (and stays checked)


def cover(pieces):
    """Balls that contain the convex hulls: each hull is cut into slabs across its longest side."""
    balls = []
    for points, radius in pieces:
        if len(points) == 1:
            balls.append((points[0], radius))
            continue
        spans = [max(p[i] for p in points) - min(p[i] for p in points) for i in range(3)]
        i = spans.index(max(spans))
        thickness = max(0.35 * sorted(spans)[1], 0.008)
        count = max(1, math.ceil(spans[i] / thickness))
        low = min(p[i] for p in points)
        cuts = [low + spans[i] * k / count for k in range(count + 1)]
        for lower, upper in zip(cuts, cuts[1:]):
            balls.append(tight_ball(slab(points, i, lower, upper)))
    return balls


def slab(points, i, lower, upper):
    """Points whose hull is the part of the hull between two planes."""
    inside = [p for p in points if lower - 1e-12 <= p[i] <= upper + 1e-12]
    for plane in (lower, upper):
        below = [p for p in points if p[i] < plane]
        above = [p for p in points if p[i] > plane]
        for p, q in itertools.product(below, above):
            s = (plane - p[i]) / (q[i] - p[i])
            inside.append(tuple(a + s * (b - a) for a, b in zip(p, q)))
    return inside


def tight_ball(points):
    """Badoiu and Clarkson 2003: walk towards the farthest point with shrinking steps."""
    centre, _ = ball(points)
    for k in range(1, 30):
        far = max(points, key=lambda p: math.dist(centre, p))
        centre = tuple(c + (f - c) / (k + 4) for c, f in zip(centre, far))
    first = ball(points)
    second = (centre, max(math.dist(centre, p) for p in points))
    return min(first, second, key=lambda b: b[1])


def gap(balls_a, balls_b, a_from_b):
    """Least distance between balls; negative when some overlap."""
    moved = [(apply(a_from_b, c), r) for c, r in balls_b]
    return min(math.dist(c, d) - r - s for c, r in balls_a for d, s in moved)


def path(robot, i, j):
    """Links on the tree path between links i and j, each side from its tip to below the common ancestor."""
    def ancestors(k):
        chain = []
        while k >= 0:
            chain.append(k)
            k = robot.parent[k]
        return chain

    a, b = ancestors(i), ancestors(j)
    common = set(a) & set(b)
    return [k for k in a if k not in common], [k for k in b if k not in common]


def lever(robot, chain, balls):
    """For each moving joint of a chain (tip first): largest distance of the tip's balls from its origin."""
    reach = max(norm(c) + r for c, r in balls)
    levers = {}
    for k in chain:
        link = robot.links[k]
        stroke = max(map(abs, link.limits)) if link.kind == "prismatic" else 0.0
        levers[k] = 1.0 if link.kind == "prismatic" else reach
        reach += norm(robot.origins[k][1]) + stroke
    return levers


def driver(robot, k):
    """The joint whose value moves link k, and its multiplier."""
    link = robot.links[k]
    return (link.mimic[0], link.mimic[1]) if link.mimic else (link.joint, 1.0)


def relative_pose(robot, side_a, side_b, values):
    """Pose of the second chain's tip in the first one's."""
    a, b = (chain_pose(robot, side, values) for side in (side_a, side_b))
    return compose(inverse(a), b)


def chain_pose(robot, side, values):
    pose = IDENTITY_POSE
    for k in reversed(side):
        pose = compose(pose, robot.joint_pose(k, values))
    return pose


def never_touch(robot, i, j, balls):
    """True when proven: for all joint values within the limits the covers keep more than SLACK."""
    side_a, side_b = path(robot, i, j)
    moving = [k for k in side_a + side_b if robot.links[k].kind != "fixed"]
    levers = {**lever(robot, side_a, balls[i]), **lever(robot, side_b, balls[j])}
    speed, ranges = {}, {}
    for k in moving:
        joint, factor = driver(robot, k)
        speed[joint] = speed.get(joint, 0.0) + abs(factor) * levers[k]
        ranges[joint] = robot.by_joint[joint].limits or (-math.pi, math.pi)
    joints = list(ranges)

    def gap_at(values):
        return gap(balls[i], balls[j], relative_pose(robot, side_a, side_b, values))

    source = random.Random(f"{i} {j}")
    if any(gap_at({n: source.uniform(*ranges[n]) for n in joints}) <= SLACK for _ in range(200)):
        return False
    whole_a, whole_b = around(balls[i]), around(balls[j])
    stack, nodes = [[ranges[joint] for joint in joints]], 0
    while stack:
        box = stack.pop()
        nodes += 1
        values = {joint: (lo + hi) / 2 for joint, (lo, hi) in zip(joints, box)}
        sizes = [speed[joint] * (hi - lo) / 2 for joint, (lo, hi) in zip(joints, box)]
        a_from_b = relative_pose(robot, side_a, side_b, values)
        if gap([whole_a], [whole_b], a_from_b) - SLACK > sum(sizes):
            continue
        g = gap(balls[i], balls[j], a_from_b) - SLACK
        if g <= 0 or nodes > MAX_NODES:
            return False
        if sum(sizes) < g:
            continue
        k = sizes.index(max(sizes))
        middle = (box[k][0] + box[k][1]) / 2
        stack.append(box[:k] + [(middle, box[k][1])] + box[k + 1:])
        stack.append(box[:k] + [(box[k][0], middle)] + box[k + 1:])
    return True


def around(balls):
    """One ball around many."""
    centre, _ = ball([c for c, _ in balls])
    return centre, max(math.dist(centre, c) + r for c, r in balls)


def fill(robot, always=(), samples=20000):
    """Sets robot.disabled: joined links, pairs that overlap by design (`always`), and proven pairs; the
    last are also sampled, against a mistake in the proof."""
    balls = [cover(link.pieces()) for link in robot.links]
    solid = [i for i in range(len(robot.links)) if balls[i]]
    joined = {frozenset((k, p)) for k, p in enumerate(robot.parent) if p >= 0}
    names = [l.name for l in robot.links]
    pairs, never = [], []
    for i, j in itertools.combinations(solid, 2):
        if frozenset((i, j)) in joined:
            pairs.append((names[i], names[j], "Adjacent"))
        elif (names[i], names[j]) in always:
            pairs.append((names[i], names[j], "Default"))
        elif never_touch(robot, i, j, balls):
            pairs.append((names[i], names[j], "Never"))
            never.append((i, j))
    robot.disabled = pairs
    sample(robot, never, balls, samples)


def sample(robot, never, balls, samples):
    source = random.Random(f"never {robot.name}")
    wholes = [around(b) if b else None for b in balls]
    moving = [l for l in robot.links if l.kind != "fixed" and not l.mimic]
    for _ in range(samples):
        poses = robot.forward({l.joint: source.uniform(*(l.limits or (-math.pi, math.pi))) for l in moving})
        for i, j in never:
            a_from_b = compose(inverse(poses[i]), poses[j])
            if gap([wholes[i]], [wholes[j]], a_from_b) < 0:
                assert gap(balls[i], balls[j], a_from_b) > 0
