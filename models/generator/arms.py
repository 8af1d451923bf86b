# SPDX-License-Identifier: BSD-3-Clause
"""The robots: rook7, rook6, rook6_cart, drifter. Dimensions and shapes are our own."""
import math

from .meshes import dome, elbow, extrusion, housing, loft, rounded, s_bend, tube
from .robot import Box, Cylinder, Group, Link, MeshFile, Robot, Sphere

HALF_PI = math.pi / 2
HERE = (0.0, 0.0, 0.0)


def fork():
    """Yoke open towards +z, pivot at the origin along y: tines at |y| in (45, 68) mm."""
    corners = [(-0.052, -0.112, 0.008), (0.052, -0.112, 0.008), (0.068, -0.086, 0.012), (0.068, 0.046, 0.010),
               (0.045, 0.046, 0.008), (0.045, -0.066, 0.018), (-0.045, -0.066, 0.018), (-0.045, 0.046, 0.008),
               (-0.068, 0.046, 0.010), (-0.068, -0.086, 0.012)]
    return extrusion(rounded(corners), 0.050, 0.005, lambda u, v, w: (w, u, v))


def round_housing(profile):
    """Solid of revolution; convex when the profile (z, radius) is."""
    return housing([(z, r, r) for z, r in profile])


def rook7_meshes():
    """File name -> (mesh, kind, units of the file per metre)."""
    base = housing([(0.0, 0.112, 0.100), (0.018, 0.112, 0.100), (0.032, 0.100, 0.092), (0.060, 0.082, 0.080),
                    (0.105, 0.071, 0.071), (0.146, 0.070, 0.070), (0.150, 0.067, 0.067)], n=32)
    upper = housing([(-0.030, 0.030, 0.028), (-0.015, 0.044, 0.036), (0.0, 0.050, 0.038), (0.050, 0.050, 0.038),
                     (0.085, 0.054, 0.050), (0.130, 0.060, 0.060), (0.180, 0.060, 0.060), (0.184, 0.056, 0.056)])
    elbow_up = s_bend(0.06, 0.19, 0.015, (0.058, 0.058), (0.034, 0.046))
    forearm = s_bend(-0.06, 0.112, 0.012, (0.050, 0.048), (0.046, 0.046), rounded_end=False)
    sleeve = round_housing([(0.0, 0.044), (0.006, 0.047), (0.060, 0.045), (0.105, 0.038), (0.112, 0.035)])
    wrist = round_housing([(0.0, 0.026), (0.020, 0.031), (0.060, 0.038), (0.085, 0.0415), (0.104, 0.042),
                           (0.107, 0.039)])
    palm = housing([(0.0, 0.026, 0.040), (0.004, 0.030, 0.050), (0.022, 0.033, 0.078), (0.036, 0.033, 0.094),
                    (0.062, 0.031, 0.096), (0.068, 0.027, 0.092)], n=32, power=4.0)
    finger_outline = rounded([(0.0015, 0.0, 0.001), (0.021, 0.0, 0.003), (0.021, 0.014, 0.005), (0.012, 0.022, 0.008),
                              (0.010, 0.054, 0.004), (0.0015, 0.054, 0.001)], steps=5)
    finger = extrusion(finger_outline, 0.009, 0.0008, lambda u, v, w: (w, u, v))
    return {"base.stl": (base, "stl", 1.0), "fork.dae": (fork(), "dae", 1.0),
            "upper.stl": (upper, "ascii.stl", 1.0), "elbow.dae": (elbow_up, "dae", 1.0),
            "forearm.obj": (forearm, "obj", 1.0), "sleeve.stl": (sleeve, "stl", 1.0),
            "wrist.stl": (wrist, "stl", 1.0), "palm.obj": (palm, "obj", 1.0), "finger.stl": (finger, "stl", 1000.0)}


def rook7(meshes):
    def part(name, scale=1.0, relative=False):
        mesh, _, factor = meshes[name]
        return MeshFile(mesh, f"meshes/{name}" if relative else f"package://rook7/meshes/{name}", factor, scale)

    z, y = (0, 0, 1), (0, 1, 0)
    turned = (-HALF_PI, 0, 0)  # link frames of the pitching joints: their z axis is the joint's
    links = [
        Link("link0", collision=[(part("base.stl"), HERE, HERE),
                                 (Box(0.07, 0.09, 0.05), (-0.112, 0, 0.034), (0, 0.25, 0))]),
        Link("link1", "link0", "joint1", "revolute", (0, 0, 0.16), z, (-2.9, 2.9), effort=180, collision=[
            (Cylinder(0.068, 0.070), (0, 0, 0.035), HERE), (part("fork.dae"), (0, 0, 0.17), HERE)]),
        Link("link2", "link1", "joint2", "revolute", (0, 0, 0.33), y, (-1.9, 1.9), frame=turned, effort=180,
             collision=[
            (Cylinder(0.054, 0.080), HERE, (HALF_PI, 0, 0)), (part("upper.stl", relative=True), HERE, HERE)]),
        Link("link3", "link2", "joint3", "revolute", (0, 0, 0.52), z, (-2.9, 2.9), effort=120, collision=[
            (part("elbow.dae"), HERE, HERE)]),
        Link("link4", "link3", "joint4", "revolute", (0.06, 0, 0.71), y, (-0.15, 2.75), frame=turned, effort=120,
             collision=[
            (part("fork.dae", 0.85), HERE, (math.pi, 0, 0)),
             (part("forearm.obj", relative=True), (0, 0, 0.058), HERE)]),
        Link("link5", "link4", "joint5", "revolute", (0, 0, 0.88), z, (-2.9, 2.9), speed=2.6, effort=60,
             collision=[
            (part("sleeve.stl"), HERE, HERE), (part("fork.dae", 0.72), (0, 0, 0.19), HERE)]),
        Link("elbow_ring", "link5", "elbow_ring_mount", "fixed", (0, 0, 0.88), collision=[
            (Cylinder(0.056, 0.024), (0, 0, -0.008), HERE)]),
        Link("link6", "link5", "joint6", "revolute", (0, 0, 1.07), y, (-2.0, 2.0), frame=turned, speed=2.6, effort=60,
             collision=[
            (Sphere(0.031), HERE, HERE), (part("wrist.stl"), HERE, HERE)]),
        Link("link7", "link6", "joint7", "revolute", (0, 0, 1.18), z, (-2.95, 2.95), speed=2.6, effort=40, collision=[
            (Cylinder(0.041, 0.046), (0, 0, 0.025), HERE),
             (Box(0.03, 0.03, 0.02), (0.038, 0.012, 0.028), (0, 0, 0.3))]),
        Link("hand", "link7", "hand_mount", "fixed", (0, 0, 1.23), frame=(0, 0, math.pi / 4), collision=[
            (part("palm.obj"), HERE, (0, 0, math.pi / 4))]),
    ]
    across = (-math.sin(math.pi / 4), math.cos(math.pi / 4), 0.0)
    for side, sign, mimic in (("left", 1, None), ("right", -1, ("finger_joint", 1, 0))):
        axis = tuple(sign * a for a in across)
        turn = math.pi / 4 + (0 if sign > 0 else math.pi)
        links.append(Link(f"finger_{side}", "hand", "finger_joint" if sign > 0 else "finger_mimic", "prismatic",
                          (0, 0, 1.30), axis, (0.0, 0.04), frame=(0, 0, turn), mimic=mimic, speed=0.1, effort=30,
                          collision=[(part("finger.stl"), HERE, (0, 0, turn))]))
    links.append(Link("tool", "hand", "tool_mount", "fixed", (0, 0, 1.342), frame=(0, 0, math.pi / 4)))

    arm = [f"joint{i}" for i in range(1, 8)]
    groups = [Group("arm", ['<chain base_link="link0" tip_link="link7"/>'], arm),
              Group("gripper", ['<link name="hand"/>', '<joint name="finger_joint"/>', '<joint name="finger_mimic"/>'],
                    ["finger_joint"]),
              Group("arm_with_gripper", ['<group name="arm"/>', '<group name="gripper"/>'], arm + ["finger_joint"])]
    states = {}
    for name, q in (("home", (0, -0.5, 0, 1.0, 0, 0.4, 0)), ("ready", (0, -0.3, 0, 1.9, 0, 1.54, 0)),
                    ("tucked", (0, -1.1, 0, 2.6, 0, -1.0, 0)), ("upright", (0, 0, 0, 0, 0, 0, 0))):
        states[(name, "arm")] = dict(zip(arm, q))
    states[("closed", "gripper")] = {"finger_joint": 0.0}
    states[("open", "gripper")] = {"finger_joint": 0.04}
    robot = Robot("rook7", links, groups, states)
    robot.materials = {"shell": (0.93, 0.93, 0.94, 1), "slate": (0.44, 0.50, 0.58, 1), "amber": (0.91, 0.51, 0.16, 1)}
    robot.paint = {link.name: "slate" if i % 2 == 0 else "shell" for i, link in enumerate(links)}
    robot.paint.update({name: "amber" for name in ("elbow_ring", "finger_left", "finger_right")})
    return robot


def rook6_meshes():
    """File name -> (mesh, kind, units of the file per metre)."""
    foot = housing([(0.0, 0.095, 0.095), (0.012, 0.095, 0.095), (0.018, 0.088, 0.088), (0.050, 0.072, 0.072),
                    (0.094, 0.066, 0.066), (0.098, 0.062, 0.062)], n=28)
    shoulder = elbow((0, 0, -0.070), (0, 0.056, 0), 0.045, 0.060, 0.055, (1, 0, 0))
    across, up = (1, 0, 0), (0, 0, 1)
    lower_end = dome((0, 0, -0.012), (0, 0, -1), 0.054, 0.050, 0.045, 4)
    profile = ((-0.012, 0.054, 0.050), (0.020, 0.054, 0.050), (0.090, 0.046, 0.044), (0.215, 0.041, 0.041),
               (0.340, 0.043, 0.042), (0.410, 0.047, 0.044), (0.436, 0.047, 0.044))
    stations = [(p, up, a, b) for p, _, a, b in reversed(lower_end)]
    stations += [((0, 0, h), up, a, b) for h, a, b in profile]
    stations += dome((0, 0, 0.436), up, 0.047, 0.044, 0.038, 4)
    upper = tube(stations, across, n=24)
    wrist = elbow((0, -0.058, 0), (0, 0, 0.050), 0.034, 0.036, 0.034, (1, 0, 0))
    bracket_outline = rounded([(-0.036, 0.0, 0.004), (0.036, 0.0, 0.004), (0.044, 0.012, 0.006), (0.044, 0.090, 0.004),
                               (0.034, 0.090, 0.004), (0.034, 0.014, 0.007), (-0.034, 0.014, 0.007),
                               (-0.034, 0.090, 0.004), (-0.044, 0.090, 0.004), (-0.044, 0.012, 0.006)], steps=3)
    bracket = extrusion(bracket_outline, 0.013, 0.002, lambda u, v, w: (u, w, v))
    return {"foot.stl": (foot, "stl", 1.0), "shoulder.dae": (shoulder, "dae", 1.0),
            "upper_arm.obj": (upper, "obj", 1.0), "wrist.stl": (wrist, "ascii.stl", 1.0),
            "bracket_mm.stl": (bracket, "stl", 1000.0)}


def rook6_links(meshes, height, parent=None):
    def part(name, scale=1.0, relative=False):
        mesh, _, factor = meshes[name]
        relative = relative and parent is None
        return MeshFile(mesh, f"meshes/{name}" if relative else f"package://rook6/meshes/{name}", factor, scale)

    y, z = (0, 1, 0), (0, 0, 1)
    h = height
    return [
        Link("base_link", parent, "arm_mount" if parent else None, "fixed", (0, 0, h),
             collision=[(part("foot.stl"), HERE, HERE)]),
        Link("shoulder", "base_link", "shoulder_pan", "continuous", (0, 0, h + 0.105), z, effort=150, collision=[
            (part("shoulder.dae"), (0, 0, 0.075), HERE)]),
        Link("upper_arm", "shoulder", "shoulder_lift", "revolute", (0, 0.125, h + 0.18), y, (-2.2, 2.2), effort=150,
             collision=[
            (part("upper_arm.obj", relative=True), HERE, HERE)]),
        Link("forearm", "upper_arm", "elbow", "revolute", (0, 0.015, h + 0.61), y, (-2.65, 2.65), effort=150,
             collision=[
            (Cylinder(0.043, 0.076), (0, 0.018, 0), (HALF_PI, 0, 0)), (Cylinder(0.036, 0.345), (0, 0, 0.180), HERE),
            (Sphere(0.038), (0, 0, 0.385), HERE), (Box(0.05, 0.016, 0.12), (0.012, -0.033, 0.17), (0, 0.04, 0))]),
        Link("wrist_1", "forearm", "wrist_1_joint", "revolute", (0, 0.110, h + 0.995), y, (-3.1, 3.1),
             frame=(HALF_PI, 0, 0), speed=3.0, effort=28, collision=[(part("wrist.stl"), HERE, HERE)]),
        Link("wrist_2", "wrist_1", "wrist_2_joint", "revolute", (0, 0.110, h + 1.090), z, (-3.1, 3.1), speed=3.0,
             effort=28, collision=[
            (part("wrist.stl", 0.95), (0, 0, 0), (HALF_PI, 0, math.pi))]),
        Link("wrist_3", "wrist_2", "wrist_3_joint", "continuous", (0, 0.190, h + 1.090), y,
             frame=(-HALF_PI, 0, 0), speed=3.0, effort=28,
             collision=[(Cylinder(0.033, 0.036), (0, -0.002, 0), (HALF_PI, 0, 0))]),
        Link("bracket", "wrist_3", "bracket_mount", "fixed", (0, 0.207, h + 1.090), frame=(-HALF_PI, 0, 0),
             collision=[(part("bracket_mm.stl"), HERE, (-HALF_PI, 0, 0)),
                        (Box(0.016, 0.030, 0.030), (0, 0.028, 0), (0, HALF_PI / 2, 0))]),
        Link("tool", "bracket", "tool_mount", "fixed", (0, 0.297, h + 1.090), frame=(-HALF_PI, 0, 0)),
    ]


ARM6 = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
ARM6_STATES = (("home", (0, -0.6, 1.2, -0.6, 0, 0)), ("ready", (0, -0.5, 1.75, 0.32, -1.5708, 0)),
               ("tucked", (0, -1.3, 2.4, -2.2, -1.5708, 0)), ("upright", (0, 0, 0, 0, 0, 0)))


def rook6(meshes):
    groups = [Group("arm", ['<chain base_link="base_link" tip_link="wrist_3"/>'], ARM6),
              Group("arm_with_tool", ['<group name="arm"/>', '<link name="bracket"/>', '<link name="tool"/>'], ARM6)]
    states = {(name, "arm"): dict(zip(ARM6, q)) for name, q in ARM6_STATES}
    return Robot("rook6", rook6_links(meshes, 0.0), groups, states)


def rook6_cart(meshes):
    wheels = [(Cylinder(0.075, 0.04), (x, y, 0.08), (HALF_PI, 0, 0)) for x in (-0.2, 0.2) for y in (-0.20, 0.20)]
    cart = Link("cart", collision=[(Box(0.60, 0.42, 0.22), (0, 0, 0.20), HERE)] + wheels)
    links = [cart, Link("mast", "cart", "mast_mount", "fixed", (-0.24, 0, 0.31), collision=[
        (Box(0.05, 0.20, 0.10), (0, 0, 0.05), (0, 0, 0))])]
    arm_links = rook6_links(meshes, 0.31, "cart")
    for link in arm_links:  # the arm stands in the front half of the cart
        link.zero = (link.zero[0], (link.zero[1][0] + 0.08,) + link.zero[1][1:])
    links += arm_links
    groups = [Group("arm", ['<chain base_link="base_link" tip_link="wrist_3"/>'], ARM6),
              Group("base", ['<joint name="floor"/>'], ["floor"]),
              Group("whole_body", ['<group name="base"/>', '<group name="arm"/>'], ["floor"] + ARM6)]
    states = {(name, "arm"): dict(zip(ARM6, q)) for name, q in ARM6_STATES}
    for name, q in ARM6_STATES[:2]:
        states[(name, "whole_body")] = {"floor": (0.0, 0.0, 0.0), **dict(zip(ARM6, q))}
    return Robot("rook6_cart", links, groups, states, ("floor", "planar"))


def drifter_meshes():
    outline = rounded([(-0.11, -0.06, 0.015), (0.11, -0.06, 0.015), (0.11, 0.09, 0.012), (0.075, 0.09, 0.010),
                       (0.075, -0.02, 0.015), (-0.075, -0.02, 0.015), (-0.075, 0.05, 0.010), (-0.11, 0.05, 0.012)])
    return {"hull.obj": (extrusion(outline, 0.03, 0.006, lambda u, v, w: (u, v, w)), "obj", 1.0)}


def drifter(meshes):
    links = [Link("hull", collision=[(MeshFile(meshes["hull.obj"][0], "meshes/hull.obj"), HERE, (0, 0, 0))]),
             Link("pod", "hull", "pod_mount", "fixed", (0, -0.06, 0), frame=(0, 0, HALF_PI), collision=[
                 (Sphere(0.03), (0, -0.025, 0), HERE)])]
    groups = [Group("body", ['<joint name="flight"/>'], ["flight"])]
    states = {("home", "body"): {"flight": (0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.0)}}
    return Robot("drifter", links, groups, states, ("flight", "floating"))


def build():
    """name -> (robot, meshes it owns)."""
    seven, six, free = rook7_meshes(), rook6_meshes(), drifter_meshes()
    return {"rook7": (rook7(seven), seven), "rook6": (rook6(six), six),
            "rook6_cart": (rook6_cart(six), {}), "drifter": (drifter(free), free)}
