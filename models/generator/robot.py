# SPDX-License-Identifier: BSD-3-Clause
"""Kinematic trees, described in an upright zero pose, and their URDF and SRDF text.

A link's `at` is its joint's position and `axis` the joint's axis in the zero pose, both along the model
frame's axes; `frame` (rpy) is how the link's own frame is turned there. Collision geometry is given
relative to `at`, along the model frame's axes. The URDF's origins follow from these.
"""
import math

from .vectors import (IDENTITY_POSE, add, apply, axis_angle, compose, from_quaternion, from_rpy, inverse,
                      matmul, pose, rotate, to_rpy, transpose)


def text(values):
    return " ".join(f"{round(v, 9) + 0.0:.9g}" for v in values)


class Box:
    def __init__(self, x, y, z):
        self.size = (x, y, z)

    def urdf(self):
        return f'<box size="{text(self.size)}"/>'

    def pieces(self):
        x, y, z = (s / 2 for s in self.size)
        return [([(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], 0.0)]

    def surface(self):
        p = self.pieces()[0][0]
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        return [t for a, b, c, d in quads for t in ((p[a], p[b], p[c]), (p[a], p[c], p[d]))]


class Cylinder:
    """Along local z."""

    def __init__(self, radius, length):
        self.radius, self.length = radius, length

    def urdf(self):
        return f'<cylinder radius="{text([self.radius])}" length="{text([self.length])}"/>'

    def ring(self, n, radius, z):
        return [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n), z)
                for i in range(n)]

    def pieces(self, n=16):
        outer = self.radius / math.cos(math.pi / n)
        return [(self.ring(n, outer, -self.length / 2) + self.ring(n, outer, self.length / 2), 0.0)]

    def surface(self, n=24):
        lower, upper = (self.ring(n, self.radius, s * self.length / 2) for s in (-1, 1))
        triangles = []
        for i in range(n):
            j = (i + 1) % n
            triangles += [(lower[i], lower[j], upper[j]), (lower[i], upper[j], upper[i]),
                          ((0, 0, -self.length / 2), lower[j], lower[i]),
                          ((0, 0, self.length / 2), upper[i], upper[j])]
        return triangles


class Sphere:
    def __init__(self, radius):
        self.radius = radius

    def urdf(self):
        return f'<sphere radius="{text([self.radius])}"/>'

    def pieces(self):
        return [([(0.0, 0.0, 0.0)], self.radius)]

    def surface(self, n=16):
        def point(i, j):
            a, b = 2 * math.pi * i / n, math.pi * j / (n // 2)
            direction = (math.cos(a) * math.sin(b), math.sin(a) * math.sin(b), math.cos(b))
            return tuple(self.radius * c for c in direction)
        return [t for i in range(n) for j in range(n // 2)
                for t in ((point(i, j), point(i, j + 1), point(i + 1, j + 1)),
                          (point(i, j), point(i + 1, j + 1), point(i + 1, j)))]


class MeshFile:
    """A mesh as a URDF names it. `factor`: units of the file per metre; `scale`: of the solid on top."""

    def __init__(self, mesh, uri, factor=1.0, scale=1.0):
        self.mesh, self.uri, self.factor, self.scale = mesh, uri, factor, scale

    def urdf(self):
        s = self.scale / self.factor
        attribute = "" if s == 1.0 else f' scale="{text([s, s, s])}"'
        return f'<mesh filename="{self.uri}"{attribute}/>'

    def pieces(self):
        return [([tuple(c * self.scale for c in p) for p in piece], 0.0) for piece in self.mesh.pieces]

    def surface(self):
        v = [tuple(c * self.scale for c in p) for p in self.mesh.vertices]
        return [(v[a], v[b], v[c]) for a, b, c in self.mesh.triangles]


class Link:
    def __init__(self, name, parent=None, joint=None, kind="fixed", at=(0, 0, 0), axis=(0, 0, 1), limits=None,
                 frame=(0, 0, 0), collision=(), mimic=None, speed=2.0, effort=80.0):
        self.name, self.parent, self.joint, self.kind = name, parent, joint, kind
        self.axis, self.limits, self.mimic, self.speed, self.effort = axis, limits, mimic, speed, effort
        self.zero = (from_rpy(*frame), tuple(map(float, at)))
        turn = transpose(self.zero[0])
        self.collision = [(shape, compose((turn, (0.0, 0.0, 0.0)), pose(xyz, rpy))) for shape, xyz, rpy in collision]

    def pieces(self):
        """Convex point sets (and radii) in the link frame; together they cover the link."""
        return [([apply(p, x) for x in points], radius)
                for shape, p in self.collision for points, radius in shape.pieces()]

    def surface(self):
        """Triangles in the link frame."""
        return [tuple(apply(p, x) for x in t) for shape, p in self.collision for t in shape.surface()]


class Group:
    """`body`: SRDF lines; `joints`: names of the joints with variables, in order."""

    def __init__(self, name, body, joints):
        self.name, self.body, self.joints = name, body, joints


class Robot:
    def __init__(self, name, links, groups, states, virtual=None, root_frame="world"):
        self.name, self.links, self.groups, self.states = name, links, groups, states
        self.virtual, self.root_frame = virtual, root_frame  # virtual: (joint name, planar or floating)
        self.index = {link.name: i for i, link in enumerate(links)}
        self.parent = [self.index[l.parent] if l.parent else -1 for l in links]
        self.by_joint = {l.joint: l for l in links if l.joint}
        self.axes = [rotate(transpose(l.zero[0]), l.axis) for l in links]
        self.origins = [compose(inverse(links[p].zero), l.zero) if p >= 0 else l.zero
                        for l, p in zip(links, self.parent)]
        self.disabled = []  # (link, link, reason)
        self.materials = {}  # of <robot>: rgba by name
        self.paint = {}  # names of materials by link

    def group(self, name):
        return next(g for g in self.groups if g.name == name)

    def state(self, name, group):
        """Values of a named state in the order of the group's variables."""
        values = self.states[(name, group)]
        entries = [values[j] for j in self.group(group).joints]
        return [x for e in entries for x in (e if isinstance(e, tuple) else (e,))]

    def joint_values(self, group, q):
        """A group's configuration by joint; a planar joint takes three numbers, a floating one seven."""
        values, k = {}, 0
        for j in self.group(group).joints:
            size = {"planar": 3, "floating": 7}[self.virtual[1]] if self.virtual and j == self.virtual[0] else 1
            values[j] = tuple(q[k:k + size]) if size > 1 else q[k]
            k += size
        return values

    def forward(self, values):
        """Poses of all links; joints not named are at zero."""
        poses = []
        for i in range(len(self.links)):
            base = self.base_pose(values) if self.parent[i] < 0 else poses[self.parent[i]]
            poses.append(compose(base, self.joint_pose(i, values)))
        return poses

    def joint_pose(self, i, values):
        """Pose of link i in its parent."""
        link = self.links[i]
        q = values.get(link.joint, 0.0)
        if link.mimic:
            q = link.mimic[1] * values.get(link.mimic[0], 0.0) + link.mimic[2]
        rotation, shift = self.origins[i]
        if link.kind in ("revolute", "continuous") and q:
            return matmul(rotation, axis_angle(self.axes[i], q)), shift
        if link.kind == "prismatic" and q:
            return rotation, add(shift, rotate(rotation, tuple(a * q for a in self.axes[i])))
        return self.origins[i]

    def base_pose(self, values):
        if not self.virtual or self.virtual[0] not in values:
            return IDENTITY_POSE
        q = values[self.virtual[0]]
        if self.virtual[1] == "planar":
            return pose((q[0], q[1], 0.0), (0.0, 0.0, q[2]))
        return (from_quaternion(q[3:]), tuple(q[:3]))

    def urdf(self):
        lines = ['<?xml version="1.0"?>', "<!-- SPDX-License-Identifier: BSD-3-Clause -->",
                 f'<robot name="{self.name}">']
        for name, rgba in self.materials.items():
            lines.append(f'  <material name="{name}"><color rgba="{text(rgba)}"/></material>')
        for link in self.links:
            lines += link_lines(link, self.paint.get(link.name))
        for i, link in enumerate(self.links):
            if link.parent:
                lines += self.joint_lines(i)
        return "\n".join(lines + ["</robot>"]) + "\n"

    def joint_lines(self, i):
        link = self.links[i]
        lines = [f'  <joint name="{link.joint}" type="{link.kind}">', f"    {origin(self.origins[i])}",
                 f'    <parent link="{link.parent}"/>', f'    <child link="{link.name}"/>']
        if link.kind != "fixed":
            lines.append(f'    <axis xyz="{text(self.axes[i])}"/>')
            bounds = "" if link.limits is None else f'lower="{link.limits[0]}" upper="{link.limits[1]}" '
            lines.append(f'    <limit {bounds}effort="{link.effort:g}" velocity="{link.speed:g}"/>')
        if link.mimic:
            lines.append('    <mimic joint="{}" multiplier="{}" offset="{}"/>'.format(*link.mimic))
        return lines + ["  </joint>"]

    def srdf(self):
        lines = ['<?xml version="1.0"?>', "<!-- SPDX-License-Identifier: BSD-3-Clause -->",
                 f'<robot name="{self.name}">']
        for g in self.groups:
            lines += [f'  <group name="{g.name}">'] + [f"    {b}" for b in g.body] + ["  </group>"]
        for (name, group), values in self.states.items():
            lines.append(f'  <group_state name="{name}" group="{group}">')
            for joint, v in values.items():
                lines.append(f'    <joint name="{joint}" value="{text(v if isinstance(v, tuple) else (v,))}"/>')
            lines.append("  </group_state>")
        if self.virtual:
            lines.append(f'  <virtual_joint name="{self.virtual[0]}" type="{self.virtual[1]}" '
                         f'parent_frame="{self.root_frame}" child_link="{self.links[0].name}"/>')
        for a, b, reason in self.disabled:
            lines.append(f'  <disable_collisions link1="{a}" link2="{b}" reason="{reason}"/>')
        return "\n".join(lines + ["</robot>"]) + "\n"


def origin(p):
    return f'<origin xyz="{text(p[1])}" rpy="{text(to_rpy(p[0]))}"/>'


def link_lines(link, material):
    if not link.collision:
        return [f'  <link name="{link.name}"/>']
    lines = [f'  <link name="{link.name}">']
    for tag in ("visual", "collision"):
        for shape, p in link.collision:
            lines += [f"    <{tag}>", f"      {origin(p)}", f"      <geometry>{shape.urdf()}</geometry>"]
            if tag == "visual" and material:
                lines.append(f'      <material name="{material}"/>')
            lines.append(f"    </{tag}>")
    return lines + ["  </link>"]
