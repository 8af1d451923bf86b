# SPDX-License-Identifier: BSD-3-Clause
"""The scenes, for arms that stand at the origin with z up, and their YAML and MoveIt text."""
import math
import random

from .meshes import bowl
from .robot import Box, Cylinder, Sphere
from .vectors import apply, compose, from_quaternion, quaternion_of_rpy


class Object:
    """Parts (shape, position, quaternion x y z w) under a pose (position, quaternion)."""

    def __init__(self, name, parts, at=((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))):
        self.name, self.parts, self.at = name, parts, at


class MeshShape:
    def __init__(self, mesh):
        self.mesh = mesh

    def pieces(self):
        return [(piece, 0.0) for piece in self.mesh.pieces]

    def surface(self):
        v = self.mesh.vertices
        return [(v[a], v[b], v[c]) for a, b, c in self.mesh.triangles]


def placed(shape, xyz, rpy=(0.0, 0.0, 0.0)):
    q = tuple(round(c, 9) + 0.0 for c in quaternion_of_rpy(*rpy))
    return shape, tuple(round(c, 6) + 0.0 for c in xyz), q


class Scene:
    def __init__(self, name):
        self.name, self.objects = name, []

    def add(self, name, shape, xyz, rpy=(0.0, 0.0, 0.0)):
        self.objects.append(Object(name, [placed(shape, xyz, rpy)]))

    def add_group(self, name, parts, xyz, rpy=(0.0, 0.0, 0.0)):
        _, position, q = placed(None, xyz, rpy)
        self.objects.append(Object(name, [placed(*p) for p in parts], (position, q)))

    def parts(self):
        """(object name, shape, world pose) of every part."""
        result = []
        for o in self.objects:
            base = (from_quaternion(o.at[1]), o.at[0])
            for shape, position, q in o.parts:
                result.append((o.name, shape, compose(base, (from_quaternion(q), position))))
        return result

    def bodies(self):
        return [(name, shape.pieces(), at) for name, shape, at in self.parts()]

    def only_primitives(self):
        return all(not isinstance(shape, MeshShape) for _, shape, _ in self.parts())


def table(scene, top, x0, x1, half_width, thickness=0.04):
    """A table top with four legs, as one object with a pose of its own."""
    leg = top - thickness
    parts = [(Box(x1 - x0, 2 * half_width, thickness), (0, 0, -thickness / 2))]
    for sx in (-1, 1):
        for sy in (-1, 1):
            foot = (sx * ((x1 - x0) / 2 - 0.05), sy * (half_width - 0.05), -thickness - leg / 2)
            parts.append((Cylinder(0.025, leg), foot))
    scene.add_group("table", parts, ((x0 + x1) / 2, 0, top))


def empty():
    return Scene("empty")


def table_objects():
    s = Scene("table_objects")
    top = 0.18
    table(s, top, 0.22, 0.92, 0.60)
    s.add("can_1", Cylinder(0.033, 0.12), (0.52, -0.14, top + 0.06))
    s.add("can_2", Cylinder(0.033, 0.12), (0.63, 0.05, top + 0.06))
    s.add("can_3", Cylinder(0.033, 0.12), (0.44, 0.33, top + 0.033), (math.pi / 2, 0, 0.4))
    s.add("cereal_box", Box(0.06, 0.19, 0.28), (0.70, 0.27, top + 0.14), (0, 0, 0.5))
    s.add("milk_box", Box(0.08, 0.08, 0.22), (0.55, 0.19, top + 0.11), (0, 0, 0.2))
    s.add("book", Box(0.16, 0.23, 0.03), (0.42, -0.36, top + 0.015), (0, 0, -0.3))
    s.add("book_on_top", Box(0.14, 0.20, 0.025), (0.42, -0.35, top + 0.0425), (0, 0, 0.1))
    s.add("ball", Sphere(0.05), (0.78, -0.06, top + 0.05))
    s.add("bottle", Cylinder(0.036, 0.26), (0.68, -0.27, top + 0.13))
    s.add("tilted_wedge", Box(0.10, 0.14, 0.02), (0.31, 0.15, top + 0.045), (0, 0.5, 0))
    s.add("bowl", MeshShape(bowl(0.075, 0.065, 0.006)), (0.56, -0.42, top))
    return s


def shelf():
    s = Scene("shelf")
    x0, x1, half = 0.52, 0.86, 0.46
    middle, depth = (x0 + x1) / 2, x1 - x0
    for k, z in enumerate((0.10, 0.42, 0.74, 1.06)):
        s.add(f"board_{k + 1}", Box(depth, 2 * half, 0.02), (middle, 0, z))
    for name, y in (("side_left", half + 0.01), ("side_right", -half - 0.01)):
        s.add(name, Box(depth, 0.02, 1.07), (middle, y, 0.535))
    s.add("back", Box(0.01, 2 * half + 0.04, 1.07), (x1 + 0.005, 0, 0.535))
    s.add("divider", Box(depth, 0.015, 0.30), (middle, 0.0, 0.58))
    s.add("tin_1", Cylinder(0.04, 0.14), (0.74, -0.34, 0.50))
    s.add("tin_2", Cylinder(0.04, 0.14), (0.66, 0.33, 0.50))
    s.add("carton", Box(0.10, 0.12, 0.20), (0.76, -0.12, 0.85), (0, 0, 0.3))
    s.add("ball", Sphere(0.06), (0.72, 0.28, 0.81))
    s.add("books", Box(0.18, 0.14, 0.24), (0.72, 0.32, 0.23))
    s.add("jar", Cylinder(0.05, 0.16), (0.70, -0.30, 0.19))
    return s


def bin_scene():
    s = Scene("bin")
    cx, wall, height, dx, dy = 0.56, 0.012, 0.24, 0.40, 0.52
    parts = [(Box(dx, dy, wall), (0, 0, wall / 2))]
    for sign in (-1, 1):
        parts.append((Box(wall, dy, height), (sign * (dx - wall) / 2, 0, height / 2 + wall)))
        parts.append((Box(dx - 2 * wall, wall, height), (0, sign * (dy - wall) / 2, height / 2 + wall)))
    s.add_group("bin", parts, (cx, 0, 0.02), (0, 0, 0.12))
    s.add("brick", Box(0.10, 0.05, 0.06), (0.50, 0.15, 0.075), (0, 0, 0.7))
    s.add("tube", Cylinder(0.02, 0.18), (0.63, -0.17, 0.06), (math.pi / 2, 0, 0.3))
    s.add("ball", Sphere(0.035), (0.66, 0.16, 0.075))
    s.add("arch", Box(0.03, 0.66, 0.03), (0.56, 0.0, 0.60), (0, 0, 0.12))
    for sign in (-1, 1):
        s.add(f"arch_post_{'left' if sign > 0 else 'right'}", Box(0.03, 0.03, 0.56),
              (0.56 - sign * 0.345 * math.sin(0.12), sign * 0.345 * math.cos(0.12), 0.30), (0, 0, 0.12))
    return s


def cage():
    s = Scene("cage")
    half, height = 0.56, 0.94
    k = 0
    for sx, sy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        for step in (-0.5, 0.0, 0.5):
            x, y = (sx * half, step * half) if sx else (step * half, sy * half)
            k += 1
            s.add(f"bar_{k}", Cylinder(0.012, height), (x, y, height / 2))
    for x in (-half, half):
        for y in (-half, half):
            k += 1
            s.add(f"post_{k}", Box(0.04, 0.04, height), (x, y, height / 2))
    for z, name in ((height - 0.015, "top"), (0.30, "low"), (0.62, "high")):
        for sign in (-1, 1):
            s.add(f"rail_{name}_x{'p' if sign > 0 else 'm'}", Box(0.02, 2 * half, 0.02), (sign * half, 0, z))
            s.add(f"rail_{name}_y{'p' if sign > 0 else 'm'}", Box(2 * half, 0.02, 0.02), (0, sign * half, z))
    return s


def narrow_slot():
    """A slot of 120 mm between two plates, closed above and below."""
    s = Scene("narrow_slot")
    x, gap, width = 0.42, 0.12, 0.50
    for name, sign in (("plate_left", 1), ("plate_right", -1)):
        s.add(name, Box(0.02, width, 0.86), (x, sign * (gap + width) / 2, 0.48))
    s.add("lintel", Box(0.02, 0.30, 0.06), (x + 0.021, 0, 0.88))
    s.add("sill", Box(0.02, 0.30, 0.06), (x + 0.021, 0, 0.10))
    return s


def tunnel_trap():
    """Thin plates (1 mm) and rods (2 mm) between two rings around the arm, on stands of air."""
    s = Scene("tunnel_trap")
    source = random.Random("tunnel_trap 3")
    taken = []
    for k in range(60):
        for _ in range(200):
            radius, angle = source.uniform(0.36, 0.86), source.uniform(-math.pi, math.pi)
            z = source.uniform(0.12, 1.10)
            p = (radius * math.cos(angle), radius * math.sin(angle), z)
            if all(math.dist(p, q) > 0.21 for q in taken):
                break
        else:
            break
        taken.append(p)
        roll, yaw = source.uniform(-0.5, 0.5), source.uniform(-math.pi, math.pi)
        if k % 5 < 3:
            shape = Box(round(source.uniform(0.10, 0.18), 3), 0.001, round(source.uniform(0.06, 0.16), 3))
            s.add(f"plate_{k + 1}", shape, p, (roll, 0, yaw))
        else:
            s.add(f"rod_{k + 1}", Cylinder(0.001, round(source.uniform(0.14, 0.26), 3)), p, (2.5 * roll, roll, yaw))
    return s


def build():
    scenes = [empty(), table_objects(), shelf(), bin_scene(), cage(), narrow_slot(), tunnel_trap()]
    return {s.name: s for s in scenes}


def listing(values):
    return "[" + ", ".join(f"{v:.9g}" for v in values) + "]"


def primitive(shape):
    """MoveIt's type and dimensions: full sizes; cylinders are [height, radius]."""
    if isinstance(shape, Box):
        return "box", shape.size
    if isinstance(shape, Cylinder):
        return "cylinder", (shape.length, shape.radius)
    return "sphere", (shape.radius,)


def to_yaml(scene):
    lines = ["# SPDX-License-Identifier: BSD-3-Clause", f"name: {scene.name}", "world:"]
    if not scene.objects:
        return "\n".join(lines + ["  collision_objects: []"]) + "\n"
    lines.append("  collision_objects:")
    for o in scene.objects:
        lines += [f"    - id: {o.name}", "      header:", "        frame_id: world"]
        if o.at != ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)):
            lines += ["      pose:", f"        position: {listing(o.at[0])}",
                      f"        orientation: {listing(o.at[1])}"]
        for kind, wanted in (("primitive", False), ("mesh", True)):
            parts = [p for p in o.parts if isinstance(p[0], MeshShape) == wanted]
            if not parts:
                continue
            lines.append("      meshes:" if wanted else "      primitives:")
            for shape, _, _ in parts:
                if wanted:
                    lines.append("        - vertices:")
                    lines += [f"            - {listing(v)}" for v in shape.mesh.vertices]
                    lines.append("          triangles:")
                    lines += [f"            - [{a}, {b}, {c}]" for a, b, c in shape.mesh.triangles]
                else:
                    name, sizes = primitive(shape)
                    lines += [f"        - type: {name}", f"          dimensions: {listing(sizes)}"]
            lines.append(f"      {kind}_poses:")
            for _, position, q in parts:
                lines += [f"        - position: {listing(position)}", f"          orientation: {listing(q)}"]
        lines.append("      operation: add")
    return "\n".join(lines) + "\n"


def to_moveit_text(scene):
    """The export of MoveIt since object poses and subframes were added (2020)."""
    def spaced(values):
        return " ".join(f"{v:.9g}" for v in values)

    lines = [scene.name]
    for o in scene.objects:
        lines += [f"* {o.name}", spaced(o.at[0]), spaced(o.at[1]), str(len(o.parts))]
        for shape, position, q in o.parts:
            if isinstance(shape, MeshShape):
                m = shape.mesh
                lines += ["mesh", f"{len(m.vertices)} {len(m.triangles)}"]
                lines += [spaced(v) for v in m.vertices] + [f"{a} {b} {c}" for a, b, c in m.triangles]
            elif isinstance(shape, Box):
                lines += ["box", spaced(shape.size)]
            elif isinstance(shape, Cylinder):
                lines += ["cylinder", spaced((shape.radius, shape.length))]
            else:
                lines += ["sphere", spaced((shape.radius,))]
            lines += [spaced(position), spaced(q), "0 0 0 0"]
        lines.append("0")
    return "\n".join(lines + ["."]) + "\n"


def to_problem_world(scene):
    """Obstacles in the layout of MotionBenchMaker's JSON: half extents, full lengths, world poses."""
    world = {"sphere": [], "cylinder": [], "box": []}
    for o in scene.objects:
        base = (from_quaternion(o.at[1]), o.at[0])
        for n, (shape, position, q) in enumerate(o.parts):
            name = o.name if len(o.parts) == 1 else f"{o.name}_{n + 1}"
            entry = {"name": name, "position": [round(c, 9) + 0.0 for c in apply(base, position)]}
            if not isinstance(shape, Sphere):
                entry["orientation"] = [round(c, 9) + 0.0 for c in multiply(o.at[1], q)]
            if isinstance(shape, Box):
                entry["half_extents"] = [round(c / 2, 9) for c in shape.size]
                world["box"].append(entry)
            elif isinstance(shape, Cylinder):
                entry.update(radius=shape.radius, length=round(shape.length, 9))
                world["cylinder"].append(entry)
            else:
                entry["radius"] = shape.radius
                world["sphere"].append(entry)
    return world


def multiply(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)
