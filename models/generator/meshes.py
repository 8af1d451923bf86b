# SPDX-License-Identifier: BSD-3-Clause
"""Closed triangle meshes of housings, elbows, forks and brackets, with convex pieces that cover them."""
import math

from .vectors import add, cross, dot, norm, scale, sub, unit


class Mesh:
    """Vertices (m), triangles (outward), and `pieces`: point sets whose hulls together cover the solid."""

    def __init__(self, vertices, triangles, pieces):
        self.vertices = [tuple(round(c, 6) + 0.0 for c in v) for v in vertices]
        self.triangles = triangles
        if self.volume() < 0:
            self.triangles = [(a, c, b) for a, b, c in triangles]
        self.pieces = [[self.vertices[i] for i in sorted(set(piece))] for piece in pieces]
        self.check()

    def volume(self):
        v = self.vertices
        return sum(dot(v[a], cross(v[b], v[c])) for a, b, c in self.triangles) / 6.0

    def check(self):
        """Closed, consistently oriented, no sliver without area, no vertex given twice."""
        seen = set()
        for t in self.triangles:
            for i in range(3):
                edge = (t[i], t[(i + 1) % 3])
                assert edge not in seen, "edge used twice in one direction"
                seen.add(edge)
            a, b, c = (self.vertices[i] for i in t)
            assert norm(cross(sub(b, a), sub(c, a))) > 1e-9, "triangle without area"
        assert all((b, a) in seen for a, b in seen), "open edge"
        assert len(set(self.vertices)) == len(self.vertices), "vertex given twice"
        assert self.volume() > 0

    def is_convex(self, tolerance=1e-5):
        return all_behind(self.vertices, self.triangles, self.vertices, tolerance)


def all_behind(vertices, triangles, points, tolerance):
    for t in triangles:
        a, b, c = (vertices[i] for i in t)
        n = unit(cross(sub(b, a), sub(c, a)))
        limit = dot(n, a) + tolerance
        if any(dot(n, p) > limit for p in points):
            return False
    return True


def loft(rings):
    """Skin over closed rings of equally many points; each end is closed by a fan around its middle."""
    n = len(rings[0])
    vertices = [p for ring in rings for p in ring]
    slabs = []
    for k in range(len(rings) - 1):
        slab = []
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            slab += [(a, b, b + n), (a, b + n, a + n)]
        slabs.append(slab)
    first, last = len(vertices), len(vertices) + 1
    for ring in (rings[0], rings[-1]):
        vertices.append(tuple(sum(p[i] for p in ring) / n for i in range(3)))
    top = (len(rings) - 1) * n
    slabs[0] = [(first, (i + 1) % n, i) for i in range(n)] + slabs[0]
    slabs[-1] = slabs[-1] + [(last, top + i, top + (i + 1) % n) for i in range(n)]
    triangles = [t for slab in slabs for t in slab]
    v = vertices
    if sum(dot(v[a], cross(v[b], v[c])) for a, b, c in triangles) < 0:
        slabs = [[(a, c, b) for a, b, c in slab] for slab in slabs]
        triangles = [t for slab in slabs for t in slab]
    return Mesh(vertices, triangles, merge_slabs(vertices, slabs))


def merge_slabs(vertices, slabs):
    """Joins neighbouring slabs while their union stays convex to a tenth of a millimetre."""
    pieces, group = [], []
    for slab in slabs:
        trial = group + slab
        points = [vertices[i] for i in {i for t in trial for i in t}]
        if group and not all_behind(vertices, trial, points, 1e-4):
            pieces.append([i for t in group for i in t])
            trial = list(slab)
        group = trial
    pieces.append([i for t in group for i in t])
    return pieces


def superellipse(a, b, power, n):
    """n points of |u/a|^power + |v/b|^power = 1."""
    points = []
    for i in range(n):
        c, s = math.cos(2 * math.pi * (i + 0.5) / n), math.sin(2 * math.pi * (i + 0.5) / n)
        points.append((math.copysign(abs(c) ** (2.0 / power), c) * a,
                       math.copysign(abs(s) ** (2.0 / power), s) * b))
    return points


def housing(profile, n=24, power=2.0):
    """Loft along z; profile: (z, half width in x, half width in y)."""
    return loft([[(u, v, z) for u, v in superellipse(a, b, power, n)] for z, a, b in profile])


def tube(stations, side, n=20):
    """Loft along a plane curve. stations: (centre, tangent, radius along `side`, radius across)."""
    rings = []
    for centre, tangent, along, across in stations:
        other = unit(cross(tangent, side))
        rings.append([add(centre, add(scale(side, u), scale(other, v)))
                      for u, v in superellipse(along, across, 2.0, n)])
    return loft(rings)


def dome(centre, tangent, radius, across, length, steps=3):
    """Stations of a rounded end that starts at `centre` and bulges along `tangent`."""
    stations = []
    for k in range(1, steps + 1):
        angle = 0.5 * math.pi * k / (steps + 0.35)
        stations.append((add(centre, scale(tangent, length * math.sin(angle))), tangent,
                         radius * math.cos(angle), across * math.cos(angle)))
    return stations


def elbow(start, end, bend, radius_start, radius_end, side, steps=6, rounded=True):
    """Quarter-like bend: from `start` through the corner (0, 0, 0) to `end`, turning on a circle that
    begins and ends at distance `bend` from the corner; radii vary linearly along the way."""
    d0, d1 = unit(scale(start, -1.0)), unit(end)
    path = [(start, d0)]
    for k in range(steps + 1):
        s = k / steps  # quadratic Bezier through the corner: tangents match at both ends
        p = add(scale(d0, -bend * (1 - s) ** 2), scale(d1, bend * s * s))
        path.append((p, unit(add(scale(d0, 1 - s), scale(d1, s)))))
    path.append((end, d1))
    stations = []
    for k, (p, t) in enumerate(path):
        r = radius_start + (radius_end - radius_start) * k / (len(path) - 1)
        stations.append((p, t, r, r))
    if rounded:
        back = dome(start, scale(d0, -1.0), radius_start, radius_start, 0.35 * radius_start)
        stations = [(p, d0, a, b) for p, _, a, b in reversed(back)] + stations
        stations += dome(end, d1, radius_end, radius_end, 0.35 * radius_end)
    return tube(stations, side)


def s_bend(offset, length, lead, radii_start, radii_end, steps=8, rounded_end=True):
    """Tube from the origin along z that shifts by `offset` in x over `length`, straight for `lead` at
    both ends; radii: (along y, across)."""
    def centre(s):
        blend = s * s * (3 - 2 * s)
        return (offset * blend, 0.0, lead + (length - 2 * lead) * s)

    path = [((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))]
    for k in range(steps + 1):
        s = k / steps
        slope = offset * 6 * s * (1 - s)
        path.append((centre(s), unit((slope, 0.0, length - 2 * lead))))
    path.append(((offset, 0.0, length), (0.0, 0.0, 1.0)))
    stations = []
    for k, (p, t) in enumerate(path):
        s = k / (len(path) - 1)
        stations.append((p, t, radii_start[0] + (radii_end[0] - radii_start[0]) * s,
                         radii_start[1] + (radii_end[1] - radii_start[1]) * s))
    if rounded_end:
        stations += dome(path[-1][0], path[-1][1], *radii_end, 0.8 * radii_end[1])
    return tube(stations, (0.0, 1.0, 0.0))


def rounded(corners, steps=4):
    """Polygon with rounded corners from (u, v, radius)."""
    result = []
    n = len(corners)
    for i, (u, v, r) in enumerate(corners):
        if r == 0:
            result.append((u, v))
            continue
        def towards(j):
            du, dv = corners[j][0] - u, corners[j][1] - v
            length = math.hypot(du, dv)
            return du / length, dv / length
        a, b = towards(i - 1), towards((i + 1) % n)
        half = 0.5 * math.acos(max(-1.0, min(1.0, a[0] * b[0] + a[1] * b[1])))
        reach = r / math.tan(half)
        middle = (a[0] + b[0], a[1] + b[1])
        s = r / math.sin(half) / math.hypot(*middle)
        centre = (u + middle[0] * s, v + middle[1] * s)
        first = (u + a[0] * reach - centre[0], v + a[1] * reach - centre[1])
        last = (u + b[0] * reach - centre[0], v + b[1] * reach - centre[1])
        turn = math.atan2(first[0] * last[1] - first[1] * last[0], first[0] * last[0] + first[1] * last[1])
        for k in range(steps + 1):
            angle = turn * k / steps
            c, s2 = math.cos(angle), math.sin(angle)
            result.append((centre[0] + c * first[0] - s2 * first[1], centre[1] + s2 * first[0] + c * first[1]))
    return result


def area2(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def ear_clip(polygon):
    """Triangles of a simple counter-clockwise polygon; picks the ear with the widest smallest angle."""
    ring, triangles = list(range(len(polygon))), []
    while len(ring) > 3:
        best = None
        for i in range(len(ring)):
            a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
            pa, pb, pc = polygon[a], polygon[b], polygon[c]
            height = area2(pa, pb, pc)
            if height <= 1e-10:
                continue
            if any(min(area2(pa, pb, polygon[k]), area2(pb, pc, polygon[k]), area2(pc, pa, polygon[k])) >= -1e-12
                   for k in ring if k not in (a, b, c)):
                continue
            quality = height / max(math.dist(pa, pb), math.dist(pb, pc), math.dist(pc, pa)) ** 2
            if best is None or quality > best[0]:
                best = (quality, i)
        i = best[1]
        triangles.append((ring[i - 1], ring[i], ring[(i + 1) % len(ring)]))
        del ring[i]
    triangles.append(tuple(ring))
    return triangles


def convex_parts(polygon, triangles):
    """Joins triangles over shared edges while convex (Hertel and Mehlhorn 1983)."""
    parts = [list(t) for t in triangles]
    joined = True
    while joined:
        joined = False
        for i in range(len(parts)):
            for j in range(i + 1, len(parts)):
                union = join(parts[i], parts[j])
                if union and all(area2(polygon[union[k - 2]], polygon[union[k - 1]], polygon[union[k]]) >= -1e-10
                                 for k in range(len(union))):
                    parts[i] = union
                    del parts[j]
                    joined = True
                    break
            if joined:
                break
    return parts


def join(a, b):
    for i in range(len(a)):
        u, v = a[i], a[(i + 1) % len(a)]
        for j in range(len(b)):
            if b[j] == v and b[(j + 1) % len(b)] == u:
                rest = [b[(j + 2 + k) % len(b)] for k in range(len(b) - 2)]
                return a[:i + 1] + rest + a[i + 1:]
    return None


def extrusion(polygon, half_depth, bevel, place):
    """Polygon (counter-clockwise) with thickness and bevelled rims; place(u, v, w) gives the point."""
    n = len(polygon)
    inner = []
    for i in range(n):
        (x0, y0), (x1, y1), (x2, y2) = polygon[i - 1], polygon[i], polygon[(i + 1) % n]
        l0, l1 = math.hypot(x1 - x0, y1 - y0), math.hypot(x2 - x1, y2 - y1)
        nx = -(y1 - y0) / l0 - (y2 - y1) / l1
        ny = (x1 - x0) / l0 + (x2 - x1) / l1
        s = 2 * bevel / (nx * nx + ny * ny)
        inner.append((x1 + nx * s, y1 + ny * s))
    layers = [(inner, -half_depth), (polygon, -half_depth + bevel), (polygon, half_depth - bevel),
              (inner, half_depth)]
    vertices = [place(u, v, w) for ring, w in layers for u, v in ring]
    triangles = []
    for k in range(3):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    cap = ear_clip(inner)
    triangles += [(a, c, b) for a, b, c in cap] + [(3 * n + a, 3 * n + b, 3 * n + c) for a, b, c in cap]
    parts = convex_parts(inner, cap)
    return Mesh(vertices, triangles, [[i + k * n for i in part for k in range(4)] for part in parts])


def bowl(radius, height, wall, n=20):
    """Thick-walled open bowl standing on z = 0, closed surface; a solid of revolution."""
    profile = [(0.55 * radius, 0.0), (0.85 * radius, 0.35 * height), (radius, height),
               (radius - wall, height), (0.85 * radius - wall, 0.4 * height), (0.45 * radius, wall)]
    vertices = [(r * math.cos(2 * math.pi * i / n), r * math.sin(2 * math.pi * i / n), z)
                for r, z in profile for i in range(n)]
    triangles = []
    for k in range(len(profile) - 1):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    bottom, inside = len(vertices), len(vertices) + 1
    vertices += [(0.0, 0.0, 0.0), (0.0, 0.0, wall)]
    top = (len(profile) - 1) * n
    triangles += [(bottom, (i + 1) % n, i) for i in range(n)]
    triangles += [(inside, top + i, top + (i + 1) % n) for i in range(n)]
    return Mesh(vertices, triangles, [range(len(vertices))])  # covered by its hull: obstacles are filled
