# SPDX-License-Identifier: BSD-3-Clause
"""What depth cameras see of a scene, with their noise, as PCD, and the same as an OctoMap.

Noise along the ray: normal, with the standard deviation that Nguyen, Izadi and Lovell (2012, "Modeling Kinect
sensor noise for improved 3D reconstruction and tracking") measured; no return beyond 80 degrees of incidence.
"""
import math
import random
import struct

from .vectors import add, apply, cross, dot, norm, scale, sub, unit

COLUMNS, ROWS = 96, 72
FIELD = math.radians(58.0)        # across the columns
RANGE = (0.4, 3.0)                # m
STEEPEST = math.cos(math.radians(80.0))
CAMERAS = (((-0.25, 0.75, 0.95), (0.6, 0.0, 0.25)),   # position and what it looks at, m
           ((-0.25, -0.75, 0.95), (0.6, 0.0, 0.25)),
           ((1.45, 0.0, 1.15), (0.5, 0.0, 0.2)))


class Part:
    """Triangles in the world, as corner and edges, in a ball."""

    def __init__(self, triangles):
        points = [p for t in triangles for p in t]
        self.center = scale((sum(p[0] for p in points), sum(p[1] for p in points), sum(p[2] for p in points)),
                            1.0 / len(points))
        self.reach = max(norm(sub(p, self.center)) for p in points)
        self.triangles = [(a, sub(b, a), sub(c, a)) for a, b, c in triangles]

    def misses(self, origin, ray):
        off = sub(self.center, origin)
        along = dot(off, ray)
        return dot(off, off) - along * along > self.reach * self.reach

    def hit(self, origin, ray):
        """(distance, cosine of incidence) of the first triangle (Moeller, Trumbore 1997)."""
        best = (math.inf, 0.0)
        for corner, e, f in self.triangles:
            p = cross(ray, f)
            determinant = dot(e, p)
            if abs(determinant) < 1e-12:
                continue
            off = sub(origin, corner)
            u = dot(off, p) / determinant
            if not 0.0 <= u <= 1.0:
                continue
            q = cross(off, e)
            v = dot(ray, q) / determinant
            if v < 0.0 or u + v > 1.0:
                continue
            distance = dot(f, q) / determinant
            if 0.0 < distance < best[0]:
                best = (distance, abs(dot(unit(cross(e, f)), ray)))
        return best


def parts_of(scene):
    parts = []
    for _, shape, at in scene.parts():
        parts.append(Part([tuple(apply(at, p) for p in t) for t in shape.surface()]))
    return parts


def rays(position, target):
    """Unit vectors, row by row."""
    forward = unit(sub(target, position))
    right = unit(cross(forward, (0.0, 0.0, 1.0)))
    down = cross(forward, right)
    step = 2.0 * math.tan(FIELD / 2.0) / COLUMNS
    for row in range(ROWS):
        for column in range(COLUMNS):
            x, y = (column + 0.5 - COLUMNS / 2) * step, (row + 0.5 - ROWS / 2) * step
            yield unit(add(forward, add(scale(right, x), scale(down, y))))


def scan(scene):
    """A point per pixel; None where nothing came back."""
    source, parts, points = random.Random("scan " + scene.name), parts_of(scene), []
    for position, target in CAMERAS:
        for ray in rays(position, target):
            distance, cosine = min((part.hit(position, ray) for part in parts if not part.misses(position, ray)),
                                   default=(math.inf, 0.0))
            if not RANGE[0] <= distance <= RANGE[1] or cosine < STEEPEST:
                points.append(None)
                continue
            distance += source.gauss(0.0, 0.0012 + 0.0019 * (distance - 0.4) ** 2)
            points.append(add(position, scale(ray, distance)))
    return points


def to_pcd(points):
    rows = len(points) // COLUMNS
    header = ("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
              f"COUNT 1 1 1\nWIDTH {COLUMNS}\nHEIGHT {rows}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n")
    nothing = (math.nan,) * 3
    return header.encode() + b"".join(struct.pack("<3f", *(p or nothing)) for p in points)


DEPTH = 16


def to_octomap(points, resolution):
    """Binary OcTree of the cubes that hold a point; eight full siblings are one."""
    keys = {tuple(math.floor(c / resolution) + (1 << (DEPTH - 1)) for c in p) for p in points if p}
    levels = [keys]
    for _ in range(DEPTH):
        levels.append({(x >> 1, y >> 1, z >> 1) for x, y, z in levels[-1]})
    full = [keys]
    for k in range(DEPTH):
        full.append({key for key in levels[k + 1] if all(child in full[k] for child in children(key))})
    data, nodes = bytearray(), 1

    def write(key, height):
        nonlocal nodes
        bits, inner = 0, []
        for i, child in enumerate(children(key)):
            if child not in levels[height - 1]:
                continue
            nodes += 1
            if child in full[height - 1]:
                bits |= 2 << (2 * i)
            else:
                bits |= 3 << (2 * i)
                inner.append(child)
        data.extend(struct.pack("<H", bits))
        for child in inner:
            write(child, height - 1)

    write((0, 0, 0), DEPTH)
    header = f"# Octomap OcTree binary file\nid OcTree\nsize {nodes}\nres {resolution:g}\ndata\n"
    return header.encode() + bytes(data)


def children(key):
    x, y, z = (2 * c for c in key)
    return [(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2 & 1)) for i in range(8)]
