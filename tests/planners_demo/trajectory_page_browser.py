#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages that play trajectories, in a browser: trajectory_page_browser.py TRAJECTORY_PAGES SOURCE_FOLDER."""
import math
import time

import picture_file
from browser_page import ActionChains, run_tests
from selenium.webdriver.common.keys import Keys
from trajectory_browser import KINDS, TrajectoryTest


class TrajectoryPage(TrajectoryTest):
    """What a page of a trajectory plays, and when."""

    def test_curves_are_those_of_the_library(self):
        for name, count in (("shelf", 7), ("slot", 7), ("odd", 13)):
            library = self.page(name)
            for order, kind in enumerate(KINDS):
                own = self.js("const c = swept.data.motions[0].curve;"
                              "return arguments[0].map((t) => swept.curve.at(c, t, arguments[1]));",
                              library["times"], order)
                self.assertEqual(len(own), 1001)
                size = max(abs(value) for values in library[kind] for value in values)
                for mine, other in zip(own, library[kind]):
                    self.assertEqual(len(mine), count)
                    self.assert_near(mine, other, 1e-11 * max(1, size))
            self.assert_quiet()

    def test_robot_is_where_the_library_has_it(self):
        library = self.page("shelf")
        begin = library["times"][0]
        for i in range(0, 1001, 40):
            self.js("swept.playback.setTime(arguments[0])", library["times"][i] - begin)
            self.assert_near(self.tip(), library["tip"][i], 2e-6)
        # The trace goes through all of these places, within what is straight in it.
        rods = self.js("return Array.from(swept.overlays.traces[0].geometry.attributes.position.array)")
        points = [rods[i:i + 3] for i in range(0, len(rods), 36)]
        for place in library["tip"][::40]:
            self.assertLess(min(math.dist(place, point) for point in points), 0.012)
        # The poses that the program stored for its own tables say the same, for every joint.
        for name in ("shelf", "odd"):
            self.page(name)
            worst = self.js(
                "const d = swept.data, p = new THREE.Vector3(), q = new THREE.Quaternion(), s = new THREE.Vector3();"
                "let worst = [0, 0, 0];"
                "for (let i = 0; i <= d.motions[0].steps; ++i) {"
                "  const poses = swept.kinematics.poses(swept.kinematics.valuesAt(d.duration * i / d.motions[0].steps));"
                "  d.frames.links.forEach((link, l) => {"
                "    const at = d.poseAt(i, l);"
                "    poses[d.tree.links.indexOf(link)].decompose(p, q, s);"
                "    worst[0] = Math.max(worst[0], p.distanceTo(new THREE.Vector3().fromArray(d.poses, at)));"
                "    worst[1] = Math.max(worst[1], 1 - Math.abs(q.dot(new THREE.Quaternion().fromArray(d.poses, at + 3))));"
                "    ++worst[2]; }); } return worst;")
            self.assertLess(worst[0], 3e-6)
            self.assertLess(worst[1], 1e-6)
            self.assertGreaterEqual(worst[2], 193 * 7)

    def test_clock_is_real_time(self):
        self.page("two", at="#t=0&shadows=off")
        self.assertEqual(self.js("return swept.data.duration"), 2)
        self.assertEqual(self.js("return [...document.getElementById('speed').options].map((o) => Number(o.value))"),
                         [0.1, 0.25, 0.5, 1, 2, 4])
        for speed in (0.1, 0.5, 1, 2):
            self.js("const s = document.getElementById('speed'); s.value = String(arguments[0]);"
                    "s.dispatchEvent(new Event('change'));", speed)
            # What the browser says of its clock at each picture, in ms.
            played = self.js("const p = swept.playback; p.setTime(0.25); p.play();"
                             "const times = [5000, 5016, 5050, 5250].map((now) => { p.tick(now); return p.state.time; });"
                             "p.pause(); return times;")
            self.assert_near(played, [0.25, 0.25 + 0.016 * speed, 0.25 + 0.05 * speed, 0.25 + 0.25 * speed], 1e-9)
        ended = self.js("const p = swept.playback; p.setSpeed(1); p.setTime(1.9); p.play(); p.tick(0); p.tick(90);"
                        "const before = p.state.playing; p.tick(110); return [before, p.state.playing, p.state.time];")
        self.assertEqual(ended, [True, False, 2])

    def test_space_plays_in_step_with_the_browsers_clock(self):
        self.page("two")
        self.press(Keys.SPACE)
        for _ in range(400):
            if self.now() > 0.3:
                break
            time.sleep(0.05)
        self.press(Keys.SPACE)
        stopped = self.now()
        self.assertGreater(stopped, 0.3)
        self.assertEqual(self.text("#clock"), f"{stopped:.3f} / 2.000 s")
        scrub = self.find("#scrub")[0]
        self.assertEqual(scrub.get_attribute("aria-valuetext"), f"{stopped:.3f} s")
        # Each picture is as much later on the page as it is on the browser's clock.
        steps = self.browser.execute_async_script(
            "const done = arguments[0], seen = [], p = swept.playback; p.setTime(0); p.play();"
            "const look = (now) => { seen.push([now, p.state.time]);"
            "  if (seen.length < 8 && p.state.playing) requestAnimationFrame(look); else { p.pause(); done(seen); } };"
            "requestAnimationFrame(look);")
        followed = 0
        for (first, begin), (second, end) in zip(steps, steps[1:]):
            if second - first < 250 and begin > 0:
                self.assertAlmostEqual(end - begin, (second - first) / 1000, delta=1e-6)
                followed += 1
        self.assertGreater(followed + sum(b[0] - a[0] >= 250 for a, b in zip(steps, steps[1:])), 2)
        self.assert_quiet()

    def test_keys_go_from_piece_to_piece(self):
        self.page("two")  # four pieces of half a second
        seen = []
        for key in (Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_LEFT):
            ActionChains(self.browser).key_down(Keys.SHIFT).send_keys(key).key_up(Keys.SHIFT).perform()
            seen.append(self.now())
        self.assert_near(seen, [0.5, 1, 1.5, 1], 1e-12)
        self.press(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.now(), 1 + 2 / 192, delta=1e-9)

    def test_contact_beside_the_curve_is_shown(self):
        self.page("slot")
        contact = self.js("return swept.data.motions[0].curve.contact")
        self.assertTrue(contact["beside"])
        self.assertAlmostEqual(0.5 + self.now(), contact["time"], delta=1e-9)
        self.assertEqual([label.text for label in self.find(".contact-label")], ["finger_right – lintel"])
        self.assertRegex(self.text("#contacts"), r"finger_right – lintel\nstraight through, 0\.8\d\d s")
        self.assertEqual(len(self.find(".mark.contact")), 3)
        children = self.js("return swept.scene.scene.children.length")
        at_contact = self.picture()
        self.js("swept.playback.setTime(swept.playback.state.time + 0.02)")
        self.drawn()
        self.assertEqual(self.js("return swept.scene.scene.children.length"), children - 1)
        self.assertGreater(picture_file.share_changed(at_contact, self.picture()), 0.003)
        self.assertRegex(self.text("#now"), r"^as at 0\.8\d\d s: in a part that is in collision$")
        self.assert_quiet()

    def test_way_points_and_the_trajectory_in_turn(self):
        library = self.page("two")
        dots = "return swept.wayPoints.groups[0].children.slice(1).map((dot) => dot.position.toArray())"
        self.assertEqual(len(library["way_points"]), 3)
        for own, other in zip(self.js(dots), library["way_points"]):
            self.assert_near(own, other, 2e-6)
        shown = "return swept.wayPoints.groups.map((g) => g !== null && g.visible)"
        self.assertEqual(self.js(shown), [True, False])
        before, lines = self.picture(), self.lines("position")
        self.js("swept.wayPoints.groups[0].visible = false; swept.scene.changed()")
        self.drawn()
        self.assertGreater(picture_file.share_changed(before, self.picture(), 8), 0.0003)
        self.assertIn("the straight motions between 3 way points", self.text("#curve-facts"))
        self.press("n")
        self.assertEqual(self.js("return swept.data.duration"), 1)
        self.assertEqual(self.js(shown), [False, False])
        self.assertNotEqual(self.lines("position"), lines)
        self.assertNotIn("way points", self.text("#curve-facts"))
        self.assertEqual(self.text("#clock"), "0.000 / 1.000 s")
        self.assertEqual(self.js("return document.getElementById('paths-title').textContent"), "trajectories")
        self.assert_quiet()

    def test_timeline_is_in_seconds(self):
        self.page("slot")
        self.assertEqual(len(self.find(".piece")), 96)
        ticks = [tick.text for tick in self.find(".times span")]
        self.assertEqual(ticks, ["0.5 s", "0.6", "0.7", "0.8", "0.9", "1.0", "1.1", "1.2", "1.3"])
        ActionChains(self.browser).move_to_element(self.find(".piece")[12]).perform()
        self.drawn()
        self.assertRegex(self.text("#hover"), r"^straight through, 0\.600 s to 0\.608 s: free, proven .*, keeps ")
        self.assertEqual(self.text("#list .amount"), "free until 0.831 s")

    def test_phone(self):
        self.page("shelf", 400, 800, phone=True)
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 400)
        boxes = [self.find(f"#plot-{kind} svg")[0].rect for kind in KINDS]
        for box in boxes:
            self.assertGreaterEqual(box["x"], 0)
            self.assertLessEqual(box["x"] + box["width"], 400)
            self.assertGreater(box["width"], 340)
        self.assertLess(boxes[0]["y"] + boxes[0]["height"], boxes[1]["y"] + 1)
        self.assertTrue(self.find("#play")[0].is_displayed())
        self.page("slot", 400, 800, phone=True)
        label = self.find(".contact-label")[0].rect
        self.assertLessEqual(label["x"] + label["width"], 400)
        self.assert_quiet()


if __name__ == "__main__":
    run_tests()
