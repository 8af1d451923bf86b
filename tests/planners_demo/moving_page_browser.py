#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages beside objects that move, in a browser: moving_page_browser.py SWEPT SOURCE_FOLDER."""
import math

import picture_file
from browser_page import ROOK, BrowserTest, main

REACH = ["trajectory", ROOK, "models/trajectories/rook7_reach.csv", "--group", "arm",
         "--scene", "models/moving_scenes/conveyor.yaml"]
# The crate of that scene: s, m, and rad about z.
WAY = [(0, -2, 0), (4, 0, 0), (8, 2, math.pi / 3)]


def crate_at(clock):
    """(y, angle about z), from the numbers of the scene."""
    if clock <= WAY[0][0]:
        return WAY[0][1:]
    for (begin, y, angle), (end, next_y, next_angle) in zip(WAY, WAY[1:]):
        if clock <= end:
            share = (clock - begin) / (end - begin)
            return y + share * (next_y - y), angle + share * (next_angle - angle)
    return WAY[-1][1:]


SCENE = [ROOK, "--group", "arm", "--scene", "models/moving_scenes/conveyor.yaml"]
REACHING = "0,1.3,0,0.3,0,0,0"  # to where the crate is at 4 s


class MovingPage(BrowserTest):
    """A crate on a conveyor."""

    def crate(self):
        """Where the page has drawn it: x, y, z, and the angle about z."""
        at = self.js(
            "const b = swept.data.bodies.findIndex((body) => body.name === 'crate');"
            "swept.scene.scene.updateMatrixWorld(true);"
            "const m = swept.scene.bodies[b].meshes[0].matrixWorld;"
            "const p = new THREE.Vector3(), q = new THREE.Quaternion(), s = new THREE.Vector3();"
            "m.decompose(p, q, s); return [p.x, p.y, p.z, 2 * Math.atan2(q.z, q.w)];")
        return at

    def assert_crate(self, clock):
        x, y, z, angle = self.crate()
        wanted_y, wanted_angle = crate_at(clock)
        for own, wanted in ((x, 0.6), (y, wanted_y), (z, 0.25), (angle, wanted_angle)):
            self.assertAlmostEqual(own, wanted, delta=1e-6)

    def test_it_is_where_the_clock_says(self):
        for name, clock in (("zero", 0), ("later", 3.25), ("before", -3), ("after", 9)):
            self.open(name, [*REACH, "--clock", str(clock)])
            for time in (0, 0.5, 1.7, 2.5, 4.1, 5):
                self.js("swept.playback.setTime(arguments[0])", time)
                self.assert_crate(clock + time)
            self.assertIn("crate; the clock shows %.3f s at the begin" % clock,
                          self.text("#curve-facts"))
            self.assert_quiet()

    def test_states_show_it_at_their_time(self):
        for clock, verdict in ((4, "1 free, 1 in collision"), (6.5, "all free")):
            self.open("check at %g" % clock, ["check", *SCENE, "tucked", REACHING, "--time", str(clock)])
            self.assertEqual(self.text("#verdict"), "2 states: " + verdict)
            for state in (0, 1):
                self.js("swept.playback.setTime(arguments[0])", state)
                self.assert_crate(clock)
            self.assertIn("at %g s" % clock, self.text("#list"))
            self.assert_quiet()
        # By hand the robot moves, and the crate stays.
        self.js("const v = swept.kinematics.valuesAt(1).slice(); v[0] += 0.5; swept.playback.setValues(v)")
        self.assert_crate(6.5)
        self.assertEqual(self.text("#now"), "moved by hand: not checked")

    def test_motions_take_its_time(self):
        run = self.open("motion", ["motion", *SCENE, "tucked", REACHING, "tucked", "--times", "4.5,6,9"])
        self.assertEqual(run.returncode, 0)
        self.assertAlmostEqual(self.js("return swept.data.duration"), 4.5, delta=1e-9)
        for time in (0, 0.7, 1.5, 2.2, 4.5):
            self.js("swept.playback.setTime(arguments[0])", time)
            self.assert_crate(4.5 + time)
            self.assertIn("at %.3f s" % (4.5 + time), self.text("#clock"))
        self.assert_quiet()

    def test_info_shows_where_it_begins(self):
        for name, words in (("grouped", SCENE), ("whole", [ROOK, *SCENE[3:]])):
            self.open("info " + name, ["info", *words])
            self.assert_crate(0)
            self.assertIn("default state at 0 s", self.text("#list"))
            self.assert_quiet()

    def test_it_is_seen_to_move(self):
        self.open("zero", REACH)
        # The robot is at the same place at both ends, and only the crate is not.
        self.js("swept.playback.setTime(0)")
        first = self.picture()
        # The conveyor is long, so that what is beside it is small.
        self.assertGreater(picture_file.share_unlike(first, first[0][0]), 0.02)
        self.js("swept.playback.setTime(5)")
        last = self.picture()
        self.js("swept.playback.setTime(0)")
        again = self.picture()
        self.assertEqual(first, again)
        self.assertNotEqual(first, last)
        # It plays by itself, too.
        self.js("const p = swept.playback; p.setTime(0.25); p.play(); p.tick(5000); p.tick(5200); p.pause();")
        self.assert_crate(self.js("return swept.playback.state.time"))
        self.assertGreater(self.js("return swept.playback.state.time"), 0.4)

    def test_a_contact_is_shown_where_it_is(self):
        # At 1.5 s of the clock the arm starts to where the crate is at 4 s.
        run = self.open("met", [*REACH, "--clock", "1.5"])
        self.assertEqual(run.returncode, 1)
        self.assertEqual(self.text("#verdict"), "trajectory: in collision")
        contact = self.js("return swept.data.motions[0].contacts[0]")
        self.assertEqual(contact["body_b"], "crate")
        # The page opens there: the point is on the crate.
        x, y, z, angle = self.crate()
        self.assert_crate(1.5 + self.js("return swept.playback.state.time"))
        dx, dy, dz = (p - c for p, c in zip(contact["point_b"], (x, y, z)))
        own = (math.cos(angle) * dx + math.sin(angle) * dy, math.cos(angle) * dy - math.sin(angle) * dx, dz)
        for value, half in zip(own, (0.1, 0.15, 0.15)):
            self.assertLessEqual(abs(value), half + 1e-3)
        self.assert_quiet()

    def test_distances_are_those_of_the_moment(self):
        self.open("zero", REACH)
        # Of the crate, to whichever link: as near as the clearances of the parts say, and no farther
        # than the crate is from the arm's base.
        crate = self.js("return swept.data.bodies.findIndex((body) => body.name === 'crate')")
        near = [self.js("return swept.data.nearest(arguments[0], arguments[1], 'world')", crate, frame)
                for frame in (0, 96, 192)]
        self.assertGreater(near[0]["distance"], near[1]["distance"])
        self.assertGreater(near[0]["distance"], near[2]["distance"])
        self.assertGreater(near[0]["distance"], 1.0)
        parts = self.js("return swept.data.motions[0].pieces.lower_world || swept.data.motions[0].pieces.lower")
        self.assertLessEqual(min(parts), min(one["distance"] for one in near) + 1e-3)


if __name__ == "__main__":
    main()
