#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots of trajectories, in a browser: plots_page_browser.py TRAJECTORY_PAGES SOURCE_FOLDER."""
import random

from browser_page import ActionChains, run_tests
from selenium.webdriver.common.keys import Keys
from trajectory_browser import KINDS, TrajectoryTest, points_of


class PlotsPage(TrajectoryTest):
    """What the plots below the picture show, and what they do when they are pressed."""

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

    def test_lines_of_many_points_keep_what_is_seen(self):
        self.page("two")
        random.seed(3)
        columns = sorted(random.randrange(40) for _ in range(2000))
        values = [random.gauss(0, 1) for _ in columns]
        kept = self.js("return swept.axis.thinned(arguments[0], arguments[1])", columns, values)
        self.assertEqual(kept, sorted(set(kept)))
        self.assertLessEqual(len(kept), 4 * 40)
        for column in set(columns):
            every = [i for i, other in enumerate(columns) if other == column]
            own = [i for i in kept if columns[i] == column]
            self.assertEqual((own[0], own[-1]), (every[0], every[-1]))
            for extreme in (min, max):
                self.assertEqual(extreme(values[i] for i in own), extreme(values[i] for i in every))

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


if __name__ == "__main__":
    run_tests()
