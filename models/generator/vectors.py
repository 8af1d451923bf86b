# SPDX-License-Identifier: BSD-3-Clause
"""Vectors as 3-tuples, rotations as three rows, poses as (rotation, translation). Metres, radians."""
import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(a, 1.0 / norm(a))


IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def rotate(r, p):
    return (dot(r[0], p), dot(r[1], p), dot(r[2], p))


def transpose(r):
    return tuple(zip(*r))


def matmul(a, b):
    columns = transpose(b)
    return tuple(tuple(dot(row, c) for c in columns) for row in a)


def axis_angle(axis, angle):
    """Rotation about a unit axis (Rodrigues)."""
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    d = 1.0 - c
    return ((c + x * x * d, x * y * d - z * s, x * z * d + y * s),
            (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
            (z * x * d - y * s, z * y * d + x * s, c + z * z * d))


def from_rpy(roll, pitch, yaw):
    """URDF: about fixed x, then y, then z."""
    return matmul(axis_angle((0, 0, 1), yaw),
                  matmul(axis_angle((0, 1, 0), pitch), axis_angle((1, 0, 0), roll)))


def to_rpy(r):
    if abs(r[2][0]) > 1.0 - 1e-9:  # gimbal lock: yaw is free, take zero
        return (math.atan2(-r[0][1] * r[2][0], r[1][1]), math.copysign(math.pi / 2, -r[2][0]), 0.0)
    return (math.atan2(r[2][1], r[2][2]), math.asin(-r[2][0]), math.atan2(r[1][0], r[0][0]))


def from_quaternion(q):
    """x, y, z, w; unit."""
    x, y, z, w = q
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))


def quaternion_of_rpy(roll, pitch, yaw):
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


IDENTITY_POSE = (IDENTITY, (0.0, 0.0, 0.0))


def pose(xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0)):
    return (from_rpy(*rpy), tuple(map(float, xyz)))


def compose(a, b):
    return (matmul(a[0], b[0]), add(rotate(a[0], b[1]), a[1]))


def apply(a, p):
    r, t = a
    x, y, z = p
    return (r[0][0] * x + r[0][1] * y + r[0][2] * z + t[0],
            r[1][0] * x + r[1][1] * y + r[1][2] * z + t[1],
            r[2][0] * x + r[2][1] * y + r[2][2] * z + t[2])


def inverse(a):
    rt = transpose(a[0])
    return (rt, scale(rotate(rt, a[1]), -1.0))
