# SPDX-License-Identifier: BSD-3-Clause
"""Starts and goals to plan between. Arm configurations come from inverse kinematics with a fixed seed, and
are kept only when they provably clear the scene and the robot itself by CLEARANCE."""
import math
import random

from .clearance import Collider
from .vectors import add, cross, dot, norm, rotate, scale, sub, unit

CLEARANCE = 0.008  # m
DOWN, AHEAD, LEFT = (0, 0, -1), (1, 0, 0), (0, 1, 0)

# scene -> (name, start, goal). An end is a named state or (tool position, tool direction or None).
ARM_QUERIES = {
    "empty": [("reach", "home", ((0.45, -0.35, 0.30), DOWN)),
              ("swing", ((0.40, 0.40, 0.50), AHEAD), ((-0.35, 0.40, 0.60), (-1, 0, 0)))],
    "table_objects": [("between_cans", "ready", ((0.57, -0.04, 0.24), DOWN)),
                      ("around_boxes", ((0.44, -0.17, 0.29), DOWN), ((0.50, 0.42, 0.28), DOWN)),
                      ("behind_can", ((0.43, 0.20, 0.26), DOWN), ((0.61, -0.17, 0.25), DOWN))],
    "shelf": [("around_divider", ((0.62, 0.20, 0.56), AHEAD), ((0.62, -0.20, 0.56), AHEAD)),
              ("up_one", ((0.66, -0.20, 0.57), AHEAD), ((0.65, 0.08, 0.87), AHEAD)),
              ("into_bottom", "ready", ((0.58, 0.0, 0.27), AHEAD))],
    "bin": [("reach_in", "ready", ((0.47, -0.05, 0.10), DOWN)),
            ("across_arch", ((0.46, 0.0, 0.12), DOWN), ((0.65, -0.02, 0.13), DOWN))],
    "cage": [("window_to_window", ((0.64, 0.14, 0.46), AHEAD), ((0.14, 0.64, 0.46), LEFT)),
             ("upper_window", "ready", ((-0.14, 0.62, 0.77), LEFT))],
    "narrow_slot": [("forearm_through", "ready", ((0.70, 0.0, 0.50), AHEAD)),
                    ("other_height", ((0.30, 0.28, 0.55), (0, 1, 0)), ((0.66, 0.0, 0.36), AHEAD))],
    "tunnel_trap": [("weave", "ready", ((-0.30, 0.45, 0.55), None)),
                    ("weave_low", ((0.50, 0.35, 0.40), None), ((0.45, -0.45, 0.45), None))],
}

# rook6's wrist is offset from its forearm, so only its wrist and tool fit the slot.
SLOT_QUERIES_6 = [("wrist_through", "ready", ((0.53, 0.0, 0.50), AHEAD)),
                  ("other_height", ((0.30, 0.28, 0.55), (0, 1, 0)), ((0.53, 0.0, 0.36), AHEAD))]

# scene -> (name, (base x, y, heading; arm end), the same)
CART_QUERIES = {
    "shelf": [("drive_and_reach", ((-0.9, -0.7, 0.5), "ready"), ((-0.10, 0.05, 0.0), ((0.62, 0.22, 0.57), AHEAD)))],
    "narrow_slot": [("drive_and_thread", ((-0.8, 0.6, -0.8), "home"), ((-0.15, 0.0, 0.0), ((0.53, 0.0, 0.56), AHEAD)))],
}

S = math.sqrt(0.5)
FLIGHT_QUERIES = {
    "cage": [("through_window", (1.0, 0.14, 0.46, 0, 0, 0, 1), (0.1, 0.1, 0.46, 0, 0, 0, 1))],
    "narrow_slot": [("edgewise", (0.1, 0.0, 0.50, 0, 0, 0, 1), (0.8, 0.1, 0.50, 0, 0, S, S))],
}


def solve(matrix, right):
    """Gaussian elimination with partial pivoting."""
    n = len(right)
    rows = [list(row) + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        for i in range(k + 1, n):
            f = rows[i][k] / rows[k][k]
            rows[i] = [a - f * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][i] * x[i] for i in range(k + 1, n))) / rows[k][k]
    return x


class Arm:
    """The arm group of a robot, its base held at fixed values."""

    def __init__(self, robot, base=None):
        self.robot, self.base = robot, base or {}
        self.joints = robot.group("arm").joints
        self.limits = [robot.by_joint[j].limits or (-math.pi, math.pi) for j in self.joints]
        self.tip = robot.index["tool"]
        self.carriers = [robot.index[robot.by_joint[j].name] for j in self.joints]

    def values(self, q):
        return {**self.base, **dict(zip(self.joints, q))}

    def random(self, source, inset=0.0):
        return [source.uniform(lo + inset, hi - inset) for lo, hi in self.limits]

    def step(self, q, target, direction, offset=(0.0, 0.0, 0.0)):
        """One damped least-squares step; returns the new q and the errors (m, rad) before it."""
        poses = self.robot.forward(self.values(q))
        turn, at = poses[self.tip]
        point = add(at, rotate(turn, offset))
        error = sub(target, point)
        miss = norm(error)
        pull = scale(error, min(1.0, 0.15 / max(miss, 1e-9)))
        z = tuple(r[2] for r in turn)
        tilt = 0.0
        twist = (0.0, 0.0, 0.0)
        if direction:
            axis = cross(z, direction)
            tilt = math.atan2(norm(axis), dot(z, direction))
            if tilt > 1e-9:
                if norm(axis) < 1e-6:
                    axis = tuple(r[0] for r in turn)
                twist = scale(unit(axis), min(tilt, 0.4))
        wanted = list(pull) + list(twist)
        columns = []
        for k in self.carriers:
            a = rotate(poses[k][0], self.robot.axes[k])
            spin = cross(a, z)  # only what tilts the tool's axis counts: its roll is free
            columns.append(list(cross(a, sub(point, poses[k][1]))) + (list(cross(z, spin)) if direction else [0, 0, 0]))
        gram = [[sum(c[i] * c[j] for c in columns) + (0.002 if i == j else 0.0) for j in range(6)] for i in range(6)]
        y = solve(gram, wanted)
        new = [max(lo, min(hi, v + sum(a * b for a, b in zip(c, y))))
               for v, c, (lo, hi) in zip(q, columns, self.limits)]
        return new, miss, tilt

    def reach(self, source, target, direction, accept, tries=400):
        """First configuration found that brings the tool there and is accepted; rounded to 1e-4."""
        direction = unit(direction) if direction else None
        for _ in range(tries):
            q = self.random(source, 0.2)
            for _ in range(80):
                q, miss, tilt = self.step(q, target, direction)
                if miss < 0.002 and tilt < 0.02:
                    break
            else:
                continue
            q = [round(v, 4) + 0.0 for v in q]
            inside = all(lo + 0.01 < v < hi - 0.01 for v, (lo, hi) in zip(q, self.limits))
            if inside and accept(q):
                return q
        raise ValueError(f"no configuration reaches {target} along {direction}")


def blocked(collider, group, start, goal):
    return any(not collider.free(group, [a + (b - a) * k / 100 for a, b in zip(start, goal)], 0.0)
               for k in range(101))


def arm_end(robot, collider, group, base, end, source, start=None):
    """Configuration of the group; with a start, one that the straight motion does not reach freely."""
    arm = Arm(robot, base)
    prefix = [v for j in base for v in base[j]]

    def accept(q):
        if not collider.free(group, prefix + q, CLEARANCE):
            return False
        return start is None or not collider.obstacles or blocked(collider, group, start, prefix + q)

    if isinstance(end, str):
        q = robot.state(end, "arm")
        assert accept(q), (robot.name, end)
        return prefix + q
    return prefix + arm.reach(source, end[0], end[1], accept)


def build(robots, scenes):
    """List of dictionaries: name, robot, group, scene, start, goal."""
    found = []

    def put(query, robot, group, scene, start, goal):
        found.append({"name": f"{scene}/{robot}/{query}", "robot": robot, "group": group, "scene": scene,
                      "start": start, "goal": goal})

    def put_arm(query, robot, group, scene, collider, bases, ends):
        source = random.Random(f"{robot} {scene} {query}")
        start = arm_end(robots[robot], collider, group, bases[0], ends[0], source)
        goal = arm_end(robots[robot], collider, group, bases[1], ends[1], source, start)
        put(query, robot, group, scene, start, goal)

    for name in ("rook7", "rook6"):
        for scene, queries in ARM_QUERIES.items():
            collider = Collider(robots[name], scenes[scene])
            if (name, scene) == ("rook6", "narrow_slot"):
                queries = SLOT_QUERIES_6
            for query, *ends in queries:
                put_arm(query, name, "arm", scene, collider, ({}, {}), ends)
    for scene, queries in CART_QUERIES.items():
        collider = Collider(robots["rook6_cart"], scenes[scene])
        for query, *poses in queries:
            bases = [{"floor": tuple(map(float, base))} for base, _ in poses]
            put_arm(query, "rook6_cart", "whole_body", scene, collider, bases, [end for _, end in poses])
    for scene, queries in FLIGHT_QUERIES.items():
        for query, *ends in queries:
            start, goal = (list(map(float, e)) for e in ends)
            collider = Collider(robots["drifter"], scenes[scene])
            assert all(collider.free("body", e, CLEARANCE) for e in (start, goal)), query
            assert blocked(collider, "body", start, goal), query
            put(query, "drifter", "body", scene, start, goal)
    return found


def to_yaml(queries):
    lines = ["# SPDX-License-Identifier: BSD-3-Clause",
             "# Values in the order of the group's variables (rad, m; quaternions x, y, z, w)."]
    for q in queries:
        lines += [f"- name: {q['name']}", f"  robot: {q['robot']}", f"  group: {q['group']}", f"  scene: {q['scene']}"]
        for key in ("start", "goal"):
            lines.append(f"  {key}: [" + ", ".join(f"{v:.9g}" for v in q[key]) + "]")
    return "\n".join(lines) + "\n"
