# SPDX-License-Identifier: BSD-3-Clause
"""Motions of which samples at a planner's usual resolution are all free while the tip of the arm passes
through a 1 mm plate or a 2 mm rod. Kept are motions whose samples provably keep SAMPLE_CLEARANCE and whose
contact is seen by exact triangles crossing the core of the thin thing."""
import math
import random

from .clearance import Collider, triangle_hits_axis, triangle_hits_box
from .queries import Arm
from .robot import Box
from .vectors import apply, compose, inverse

SAMPLE_CLEARANCE = 0.001  # m, at every discrete sample
STEP = 1e-3               # rad (joint-space length), of the dense sampling inside the contact
ROD_SHARE = 0.55          # at most, of the motions found; the rest cross plates
FRACTION = 0.01           # OMPL's default longest valid segment, of a space's extent


def segments(arm, a, b):
    """OMPL's count of discrete segments. Limited joints in a row share one space (extent: the norm of
    their ranges), a continuous joint has its own (extent pi); a compound takes the largest count."""
    counts, block = [], []

    def close():
        if block:
            extent = math.sqrt(sum((hi - lo) ** 2 for lo, hi, _, _ in block))
            counts.append(math.sqrt(sum((y - x) ** 2 for _, _, x, y in block)) / (FRACTION * extent))
        block.clear()

    for joint, x, y in zip(arm.joints, a, b):
        limits = arm.robot.by_joint[joint].limits
        if limits:
            block.append((*limits, x, y))
        else:
            close()
            counts.append(abs(y - x) / (FRACTION * math.pi))
    close()
    return max(1, math.ceil(max(counts)))


class Thin:
    """A plate or rod shrunk to nine tenths of its thickness, against the triangles of some links."""

    def __init__(self, robot, name, shape, at, links):
        self.name, self.shape, self.from_world = name, shape, inverse(at)
        self.at = at
        self.links = [(robot.links[i].name, i, robot.links[i].surface()) for i in links]
        if isinstance(shape, Box):
            self.half = tuple(s / 2 - (0.1e-3 if s > 0.01 else 0.05e-3) for s in shape.size)
        else:
            self.half = shape.length / 2 - 1e-4

    def hit(self, poses):
        """Name of a link of which some triangle crosses the core, or None."""
        for name, i, surface in self.links:
            local = compose(self.from_world, poses[i])
            for t in surface:
                corners = tuple(apply(local, p) for p in t)
                if isinstance(self.shape, Box):
                    if triangle_hits_box(corners, self.half):
                        return name
                elif triangle_hits_axis(corners, self.half):
                    return name
        return None

    def edge_point(self, source):
        """A world point just inside a free edge of the plate, or near an end of the rod."""
        if isinstance(self.shape, Box):
            x, _, z = (s / 2 for s in self.shape.size)
            inset = source.uniform(0.002, 0.012)
            p = source.choice([(source.uniform(-x, x), 0, z - inset), (source.uniform(-x, x), 0, inset - z),
                               (x - inset, 0, source.uniform(-z, z)), (inset - x, 0, source.uniform(-z, z))])
        else:
            end = self.shape.length / 2 - source.uniform(0.0, 0.3) * self.shape.length
            p = (0, 0, source.choice((-1, 1)) * end)
        return apply(self.at, p)


def interpolate(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


def contact(arm, thin, a, b, t):
    """Interval of t around a contact, found by steps of STEP; None when it is not one."""
    length = norm_of(a, b)
    dt = STEP / length

    def hit(s):
        return thin.hit(arm.robot.forward(arm.values(interpolate(a, b, s))))

    link = hit(t)
    if not link:
        return None
    low = high = t
    while low - dt > 0 and hit(low - dt):
        low -= dt
    while high + dt < 1 and hit(high + dt):
        high += dt
    return link, low, high


def norm_of(a, b):
    return math.sqrt(sum((y - x) ** 2 for x, y in zip(a, b)))


def candidate(arm, thin, tips, source):
    """A random motion across one edge of `thin` and the t at which it should touch; None when out of reach.
    tips: x, y of the tip's prongs in the tool frame (m)."""
    target = thin.edge_point(source)
    q = arm.random(source, 0.3)
    x, y = source.choice(tips)
    offset = (x + source.uniform(-0.006, 0.006), y + source.uniform(-0.003, 0.003), source.uniform(-0.012, -0.002))
    for _ in range(40):
        q, miss, _ = arm.step(q, target, None, offset)
        if miss < 5e-4:
            break
    else:
        return None
    direction = [source.gauss(0, 1) * (1.0 if arm.robot.by_joint[j].limits else 0.15) for j in arm.joints]
    size = math.sqrt(sum(d * d for d in direction))
    before, after = source.uniform(0.15, 0.9), source.uniform(0.15, 0.9)
    a = [round(v - d / size * before, 6) for v, d in zip(q, direction)]
    b = [round(v + d / size * after, 6) for v, d in zip(q, direction)]
    if any(not lo + 1e-3 < v < hi - 1e-3 for end in (a, b) for v, (lo, hi) in zip(end, arm.limits)):
        return None
    return a, b, before / (before + after)


def search(robot, scene, tip_links, tips, wanted, seed):
    """Rows: robot, group, from, to, samples, obstacle, link, contact begin and end (t)."""
    source = random.Random(seed)
    arm, collider = Arm(robot), Collider(robot, scene)
    links = [robot.index[name] for name in tip_links]
    things = [Thin(robot, name, shape, at, links) for name, shape, at in scene.parts()]
    uses = {t.name: 0 for t in things}
    rows, rods = [], 0
    for _ in range(1000 * wanted):
        if len(rows) == wanted:
            return rows
        thin = source.choice(things)
        found = candidate(arm, thin, tips, source)
        if not found or uses[thin.name] >= 4 or (not isinstance(thin.shape, Box) and rods >= ROD_SHARE * wanted):
            continue
        a, b, t = found
        count = segments(arm, a, b)
        order = sorted(range(count + 1), key=lambda k: abs(k / count - t))  # likeliest hits first
        if not all(collider.free("arm", interpolate(a, b, k / count), SAMPLE_CLEARANCE) for k in order):
            continue
        touch = contact(arm, thin, a, b, t)
        if not touch or (touch[2] - touch[1]) * norm_of(a, b) < 3 * STEP:
            continue
        uses[thin.name] += 1
        rods += not isinstance(thin.shape, Box)
        rows.append((robot.name, "arm", a, b, count, thin.name, *touch))
    raise ValueError(f"{robot.name}: only {len(rows)} of {wanted} motions found")


def to_csv(rows):
    lines = ["robot,group,from,to,samples,obstacle,link,contact_begin,contact_end"]
    for robot, group, a, b, count, obstacle, link, low, high in rows:
        ends = (" ".join(f"{v:.6f}" for v in q) for q in (a, b))
        lines.append(",".join([robot, group, *ends, str(count), obstacle, link, f"{low:.5f}", f"{high:.5f}"]))
    return "\n".join(lines) + "\n"
