#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of trajectories, in a browser: trajectory_page_browser.py TRAJECTORY_PAGES SOURCE_FOLDER."""
import json
import re
import time

import picture_file
from browser_page import ActionChains, BrowserTest, run_tests
from selenium.webdriver.common.keys import Keys

KINDS = ("position", "velocity", "acceleration")

# Places in a plot as its axes say, by the labels: [a, b, c, d] of value = a + b * y, time = c + d * x.
AXES = """
const svg = document.querySelector('#plot-' + arguments[0] + ' svg');
const fit = (points) => {
  const [first, last] = [points[0], points[points.length - 1]];
  const slope = (last[1] - first[1]) / (last[0] - first[0]);
  return [first[1] - slope * first[0], slope];
};
const side = [...svg.querySelectorAll('.side')].map((t, i) =>
    [Number(svg.querySelectorAll('.grid')[i].getAttribute('y1')), parseFloat(t.textContent)]);
const below = [...svg.querySelectorAll('.below')].map((t) => [Number(t.getAttribute('x')), parseFloat(t.textContent)]);
return fit(side).concat(fit(below));
"""


def points_of(path):
    return [tuple(map(float, point)) for point in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path)]


class TrajectoryPage(BrowserTest):
    """What a page of a trajectory plays and plots."""

    def page(self, name, width=1280, height=800, **more):
        self.open(name, [name], width, height, **more)
        file, _ = self.make(name, [name])
        return json.loads(file.with_suffix(".json").read_text(encoding="utf-8"))

    def axes(self, kind):
        return self.js(AXES, kind)

    def lines(self, kind, selector=".line"):
        return self.js("return [...document.querySelectorAll('#plot-' + arguments[0] + ' ' + arguments[1])]"
                       ".map((p) => p.getAttribute('d'));", kind, selector)

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
        self.page("two", at="#t=0&shadows=on")
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

    def test_lines_are_the_curves_on_their_axes(self):
        for name in ("shelf", "slot"):
            self.page(name)
            for order, kind in enumerate(KINDS):
                a, b, c, d = self.axes(kind)
                drawn = self.lines(kind)
                self.assertEqual(len(drawn), 7)
                for joint, path in enumerate(drawn):
                    points = points_of(path)
                    self.assertGreater(len(points), 60)
                    times = [c + d * x for x, _ in points]
                    values = self.js("const c = swept.data.motions[0].curve;"
                                     "return arguments[0].map((t) => swept.curve.at(c, t, arguments[1])[arguments[2]]);",
                                     times, order, joint)
                    # A tenth of a pixel, and where lines are steep as much of time.
                    for i, (_, y) in enumerate(points):
                        near = [values[k] for k in (i - 1, i, i + 1) if 0 <= k < len(values)]
                        slack = 0.15 * abs(b) + 0.1 * (max(near) - min(near))
                        self.assertAlmostEqual(a + b * y, values[i], delta=slack)
            self.assertEqual(self.text("#plot-acceleration .plot-name"), "acceleration, rad/s²")

    def test_tube_is_a_band(self):
        self.page("two")
        a, b, _, _ = self.axes("position")
        for line, band in zip(self.lines("position"), self.lines("position", ".tube")):
            points, edges = points_of(line), points_of(band)
            self.assertEqual(len(edges), 2 * len(points))
            for (_, y), (_, up), (_, down) in zip(points, edges, reversed(edges)):
                self.assertAlmostEqual(b * (up - y), 0.03, delta=0.11 * abs(b))
                self.assertAlmostEqual(b * (down - y), -0.03, delta=0.11 * abs(b))
        self.assertEqual(set(self.lines("velocity", ".tube")), {""})
        self.assertIn("±0.03 rad each", self.text("#curve-facts"))

    def test_limits_and_where_they_are_left(self):
        self.page("slot")
        self.assertEqual(self.text("#verdict"), "trajectory: in collision, beyond 4 limits")
        for kind, limits, leaving in (("velocity", {2.0, 2.6}, {"joint4": 2, "joint6": 2.6}),
                                      ("acceleration", {8.0, -8.0}, {"joint4": 8, "joint6": 8})):
            a, b, c, d = self.axes(kind)
            shown = self.js("return [...document.querySelectorAll('#plot-' + arguments[0] + ' .limit')]"
                            ".map((l) => Number(l.getAttribute('y1')));", kind)
            self.assertEqual({round(a + b * y, 3) for y in shown}, limits)
            rings = self.find(f"#plot-{kind} .violation")
            self.assertEqual(len(rings), 2)
            violations = [v for v in self.js("return swept.data.motions[0].curve.violations") if v["kind"] == kind]
            for ring, violation in zip(rings, violations):
                self.assertIn(violation["variable"], ring.get_attribute("textContent"))
                self.assertAlmostEqual(c + d * float(ring.get_attribute("cx")), violation["time"], delta=abs(d))
                self.assertAlmostEqual(a + b * float(ring.get_attribute("cy")), violation["value"], delta=abs(b))
            for path, limit in zip(self.lines(kind, ".beyond"), leaving.values()):
                beyond = points_of(path)
                self.assertGreater(len(beyond), 3)
                for _, y in beyond:
                    self.assertGreater(abs(a + b * y), limit - 0.1 * abs(b))
        marked = [button.text for button in self.find("#plot-legend button.beyond")]
        self.assertEqual(marked, ["joint4", "joint6"])
        self.assertEqual(len(self.find("#violations button")), 4)
        self.find("#violations button")[0].click()
        self.assertAlmostEqual(self.now(), 0.4, delta=1e-6)  # the curve begins at 0.5 s
        self.assertEqual(self.text("#clock"), "0.900 / 1.300 s")
        self.page("shelf")
        self.assertEqual(self.find(".violation"), [])
        self.assertIn("position, velocity, acceleration: kept", self.text("#curve-facts"))

    def test_plots_seek(self):
        self.page("slot")
        svg = self.find("#plot-velocity svg")[0]
        _, _, c, d = self.axes("velocity")
        ActionChains(self.browser).move_to_element(svg).click().perform()
        middle = c + d * svg.rect["width"] / 2
        self.assertAlmostEqual(0.5 + self.now(), middle, delta=2 * d)
        ActionChains(self.browser).move_to_element(svg).click_and_hold().move_by_offset(40, 0).release().perform()
        self.assertAlmostEqual(0.5 + self.now(), middle + 40 * d, delta=2 * d)
        self.drawn()
        for kind in KINDS:
            _, _, c, d = self.axes(kind)
            cursor = float(self.find(f"#plot-{kind} .now")[0].get_attribute("x1"))
            self.assertAlmostEqual(c + d * cursor, 0.5 + self.now(), delta=0.01 * d)
        self.assertFalse(self.js("return swept.playback.state.playing"))
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

    def test_pointer_and_legend_say_names_and_values(self):
        library = self.page("slot")
        a, b, c, d = self.axes("velocity")
        svg, i = self.find("#plot-velocity svg")[0], 300
        x, y = (library["times"][i] - c) / d, (library["velocity"][i][5] - a) / b
        ActionChains(self.browser).move_to_element_with_offset(
            svg, round(x - svg.rect["width"] / 2), round(y - svg.rect["height"] / 2)).perform()
        self.drawn()
        said = self.text("#plot-velocity .plot-value")
        self.assertRegex(said, r"^joint6 \d\.\d{3} rad/s \(±2\.6\)$")
        self.assertAlmostEqual(float(said.split()[1]), library["velocity"][i][5], delta=0.05)
        self.assertRegex(self.text("#plot-position .plot-value"), r"^joint6 \d\.\d{3} rad \(±2\)$")
        self.assertRegex(self.text("#plot-time"), r"^at 0\.7\d\d s$")
        self.assertEqual(len(self.find("#plot-velocity .line.faint")), 6)
        button = self.find("#plot-legend button")[3]
        button.click()
        ActionChains(self.browser).move_to_element(self.find("#verdict")[0]).perform()
        self.drawn()
        self.assertEqual(button.get_attribute("aria-pressed"), "true")
        self.assertRegex(self.text("#plot-position .plot-value"), r"^joint4 \d\.\d{3} rad \(-0\.15 to 2\.75\)$")
        self.press(Keys.ESCAPE)
        self.assertEqual(button.get_attribute("aria-pressed"), "false")
        self.assertEqual(self.text("#plot-position .plot-value"), "")
        label = self.find("#plot-velocity svg")[0].get_attribute("aria-label")
        self.assertIn("joint6 0.00 to 2.67 rad/s, beyond its limit", label)
        self.assert_quiet()

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

    def test_light_dark_and_hidden(self):
        self.page("two")
        line = "return getComputedStyle(document.querySelector('#plot-position .line')).stroke"
        light = self.js(line)
        self.press("d")
        self.assertNotEqual(self.js(line), light)
        height = self.find("#view")[0].rect["height"]
        self.press("t")
        self.assertFalse(self.find("#plots")[0].is_displayed())
        self.assertGreater(self.find("#view")[0].rect["height"], height + 100)
        self.find("#tool-plots")[0].click()
        self.drawn()
        self.assertTrue(self.find("#plots")[0].is_displayed())
        self.page("two", 1000, 560)  # too low a window for both
        self.assertFalse(self.find("#plots")[0].is_displayed())
        self.assertEqual(self.find("#tool-plots")[0].get_attribute("aria-pressed"), "false")
        self.press("t")
        self.assertEqual(len(self.lines("position")), 7)
        self.assert_quiet()

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
        self.assert_quiet()


if __name__ == "__main__":
    run_tests()
