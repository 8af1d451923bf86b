# SPDX-License-Identifier: BSD-3-Clause
"""Conservative clearance of a robot in a scene, on convex pieces that cover the geometry, and exact
contact of mesh triangles with thin boxes and rods. Independent of the library that reads these models."""
import math

from .vectors import add, apply, compose, cross, dot, inverse, norm, scale, sub


def closest_on_simplex(points):
    """Point of the simplex nearest to the origin and the corners that carry it (Ericson 2005, chapter 5,
    by trying every face: at most 15 small systems)."""
    best = None
    n = len(points)
    for mask in range(1, 1 << n):
        face = [points[i] for i in range(n) if mask >> i & 1]
        v = interior_projection(face)
        if v is not None and (best is None or dot(v, v) < best[0]):
            best = (dot(v, v), v, face)
    return best[1], best[2]


def interior_projection(face):
    """Projection of the origin on the face's plane when it falls inside the face, else None."""
    a = face[0]
    if len(face) == 1:
        return a
    edges = [sub(p, a) for p in face[1:]]
    if len(edges) == 1:
        e = edges[0]
        s = -dot(a, e) / max(dot(e, e), 1e-30)
        return add(a, scale(e, s)) if 0 <= s <= 1 else None
    if len(edges) == 2:
        u, w = edges
        uu, ww, uw, au, aw = dot(u, u), dot(w, w), dot(u, w), dot(a, u), dot(a, w)
        det = uu * ww - uw * uw
        if det <= 1e-24:
            return None
        s, t = (uw * aw - ww * au) / det, (uw * au - uu * aw) / det
        return add(a, add(scale(u, s), scale(w, t))) if s >= 0 and t >= 0 and s + t <= 1 else None
    u, w, x = edges
    det = dot(u, cross(w, x))
    if abs(det) <= 1e-24:
        return None
    m = scale(a, -1.0)
    r, s, t = dot(m, cross(w, x)) / det, dot(u, cross(m, x)) / det, dot(u, cross(w, m)) / det
    return (0.0, 0.0, 0.0) if min(r, s, t) >= 0 and r + s + t <= 1 else None


def farther_than(a, b, limit):
    """True when the hulls of two point sets are proven farther apart than `limit` >= 0 (Gilbert, Johnson,
    Keerthi 1988); False otherwise, also when the search does not settle."""
    v = sub(a[0], b[0])
    simplex = [v]
    for _ in range(40):
        x, y, z = v
        vv = x * x + y * y + z * z
        if vv <= limit * limit or vv < 1e-18:
            return False
        pa = min(a, key=lambda p: p[0] * x + p[1] * y + p[2] * z)
        pb = max(b, key=lambda p: p[0] * x + p[1] * y + p[2] * z)
        w = sub(pa, pb)
        support = dot(w, v)
        if support > 0 and support > limit * math.sqrt(vv):
            return True
        if vv - support < 1e-12:
            return False
        simplex.append(w)
        v, simplex = closest_on_simplex(simplex)
    return False


def ball(points):
    """Centre of the bounding box and the distance of the farthest point from it."""
    centre = tuple((min(p[i] for p in points) + max(p[i] for p in points)) / 2 for i in range(3))
    return centre, max(math.dist(centre, p) for p in points)


class Body:
    """Convex pieces in one frame, each with a ball around it, and a ball around all."""

    def __init__(self, pieces):
        self.pieces = []
        for points, radius in pieces:
            centre, r = ball(points)
            self.pieces.append((points, radius, centre, r + radius))
        if self.pieces:
            self.centre, _ = ball([p for points, _ in pieces for p in points])
            self.radius = max(math.dist(self.centre, c) + r for _, _, c, r in self.pieces)


def bodies_farther(a, pose_a, b, pose_b, limit):
    """Proven: every point of body a is farther than `limit` from body b."""
    if not a.pieces or not b.pieces:
        return True
    if math.dist(apply(pose_a, a.centre), apply(pose_b, b.centre)) > a.radius + b.radius + limit:
        return True
    b_from_a = compose(inverse(pose_b), pose_a)
    for points, radius, centre, reach in a.pieces:
        c = apply(b_from_a, centre)
        if math.dist(c, b.centre) > reach + b.radius + limit:
            continue
        moved = None
        for other, other_radius, other_centre, other_reach in b.pieces:
            if math.dist(c, other_centre) > reach + other_reach + limit:
                continue
            if moved is None:
                moved = [apply(b_from_a, p) for p in points]
            if not farther_than(moved, other, limit + radius + other_radius):
                return False
    return True


class Collider:
    """Checks states of a robot. Pairs of links that a joint joins or the SRDF disables are left out."""

    def __init__(self, robot, scene):
        self.robot, self.scene = robot, scene
        self.bodies = [Body(link.pieces()) for link in robot.links]
        skipped = {frozenset(d[:2]) for d in robot.disabled}
        skipped |= {frozenset((l.name, l.parent)) for l in robot.links if l.parent}
        names = [l.name for l in robot.links]
        self.pairs = [(i, j) for i in range(len(names)) for j in range(i + 1, len(names))
                      if self.bodies[i].pieces and self.bodies[j].pieces
                      and frozenset((names[i], names[j])) not in skipped]
        # The pads of a closed gripper are near each other by design; they never touch.
        self.near_pairs = {frozenset(("finger_left", "finger_right"))}
        self.obstacles = [(name, Body(pieces), at) for name, pieces, at in scene.bodies()] if scene else []
        self.fixed = set() if robot.virtual else {0}

    def violations(self, poses, limit, stop_early=False):
        """Names of the pairs not proven farther apart than `limit`."""
        found = []
        for i, body in enumerate(self.bodies):
            if i in self.fixed or not body.pieces:
                continue
            centre = apply(poses[i], body.centre)
            for name, obstacle, at in self.obstacles:
                if math.dist(centre, apply(at, obstacle.centre)) > body.radius + obstacle.radius + limit:
                    continue
                if not bodies_farther(body, poses[i], obstacle, at, limit):
                    found.append((self.robot.links[i].name, name))
                    if stop_early:
                        return found
        for i, j in self.pairs:
            names = (self.robot.links[i].name, self.robot.links[j].name)
            bound = min(limit, 0.002) if frozenset(names) in self.near_pairs else limit
            if not bodies_farther(self.bodies[i], poses[i], self.bodies[j], poses[j], bound):
                found.append(names)
                if stop_early:
                    return found
        return found

    def free(self, group, q, limit):
        return not self.violations(self.robot.forward(self.robot.joint_values(group, q)), limit, True)


def triangle_hits_box(triangle, half):
    """Overlap of a triangle with a box around the origin, by 13 separating axes (Akenine-Moeller 2001)."""
    for i in range(3):
        if min(p[i] for p in triangle) > half[i] or max(p[i] for p in triangle) < -half[i]:
            return False
    edges = [sub(triangle[(k + 1) % 3], triangle[k]) for k in range(3)]
    normal = cross(edges[0], edges[1])
    axes = [normal] + [cross(u, e) for u in ((1, 0, 0), (0, 1, 0), (0, 0, 1)) for e in edges]
    for axis in axes:
        reach = sum(half[i] * abs(axis[i]) for i in range(3))
        shadow = [dot(axis, p) for p in triangle]
        if min(shadow) > reach or max(shadow) < -reach:
            return False
    return True


def triangle_hits_axis(triangle, half_length):
    """Whether the segment of the z axis with |z| <= half_length crosses a triangle."""
    a, b, c = triangle
    s = (a[0] * b[1] - a[1] * b[0], b[0] * c[1] - b[1] * c[0], c[0] * a[1] - c[1] * a[0])
    total = sum(s)
    if abs(total) < 1e-16 or not (min(s) >= 0 or max(s) <= 0):
        return False
    z = (s[1] * a[2] + s[2] * b[2] + s[0] * c[2]) / total
    return abs(z) <= half_length
