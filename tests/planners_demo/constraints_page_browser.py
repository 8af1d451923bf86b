#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Constraints on pages, in a browser: constraints_page_browser.py CONSTRAINT_PAGES SOURCE_FOLDER."""
from browser_page import ActionChains, run_tests
from trajectory_browser import TrajectoryTest, points_of

ROWS = "return [...document.querySelectorAll('#constraints li')].map((li) =>" \
       "[li.querySelector('.name').textContent, li.querySelector('.amount').textContent])"
MEASURED = "return arguments[0].map((t) => swept.constraints.measureAt(t).map((own) => [own.value, own.most]))"


class ConstraintsPage(TrajectoryTest):
    """What a page says of constraints, and how far each is used."""

    def test_values_are_those_of_the_library(self):
        library = self.page("kept")
        own = self.js(MEASURED, library["times"])
        self.assertEqual(len(own), 1001)
        for mine, values, most in zip(own, library["values"], library["most"]):
            self.assertEqual(len(mine), 6)
            self.assert_near([value for value, _ in mine], values, 1e-7)
            self.assert_near([limit for _, limit in mine], most, 1e-12)
        spread = [max(row[i] for row in library["values"]) - min(row[i] for row in library["values"]) for i in range(6)]
        self.assertGreater(min(spread), 0.05)

    def test_words_and_values_beside_the_picture(self):
        library = self.page("kept")
        self.assertEqual(self.text("#constraints-title").lower(), "proven at every instant")
        self.js("swept.playback.setTime(0.75)")
        rows = self.js(ROWS)
        self.assertEqual(rows[0][0], "joint joint4 from 0.75 to 2")
        self.assertEqual(rows[5][0], "axis (0, 0, 1) of tool within 3 rad of (0.8, 0, -0.6)")
        at = library["times"].index(1.25)
        for (_, amount), value, most in zip(rows, library["values"][at], library["most"][at]):
            shown, word, limit, unit = amount.split(" ")
            self.assertEqual((word, unit in ("rad", "m")), ("of", True))
            self.assertAlmostEqual(float(shown), value, delta=0.005 * value + 1e-9)
            self.assertAlmostEqual(float(limit), most, delta=0.005 * most)
        self.assertEqual(len(self.find("#broken li")), 0)
        # By hand, too: the elbow at its limit.
        self.js("const v = swept.kinematics.valuesAt(0).slice(); v[3] = 2.25; swept.playback.setValues(v)")
        self.assertEqual(self.js(ROWS)[0][1], "0.75 of 0.5 rad")
        self.assertEqual(self.js("return document.querySelector('#constraints .amount').dataset.tone"), "bad")
        self.assert_quiet()

    def test_lines_are_shares_of_what_is_allowed(self):
        library = self.page("kept")
        a, b, c, d = self.axes("constraint")
        drawn = self.lines("constraint")
        self.assertEqual(len(drawn), 6)
        shares = [[value / limit for value, limit in zip(values, most)]
                  for values, most in zip(library["values"], library["most"])]
        for i, path in enumerate(drawn):
            points = points_of(path)
            self.assertGreater(len(points), 60)
            for x, y in points:
                time = c + d * x
                at = min(1000, max(0, round((time - 0.5) / 2 * 1000)))
                near = [shares[k][i] for k in range(max(0, at - 4), min(1001, at + 5))]
                slack = 0.15 * abs(b) + 0.25 * (max(near) - min(near))
                self.assertGreaterEqual(a + b * y, min(near) - slack)
                self.assertLessEqual(a + b * y, max(near) + slack)
        # What may not be passed is a line at 1.
        limit = self.js("return [...document.querySelectorAll('#plot-constraint .limit')].map((l) => l.getAttribute('y1'))")
        self.assertEqual(len(limit), 1)
        self.assertAlmostEqual(a + b * float(limit[0]), 1, delta=0.1 * abs(b))

    def test_the_pointer_reads_and_sets_the_time(self):
        library = self.page("kept")
        svg = self.find("#plot-constraint svg")[0]
        _, _, c, d = self.axes("constraint")
        x, y = self.js("const line = document.querySelectorAll('#plot-constraint .line')[5];"
                       "const p0 = line.getPointAtLength(0.6 * line.getTotalLength()); return [p0.x, p0.y];")
        size = svg.size
        ActionChains(self.browser).move_to_element_with_offset(
            svg, int(x) - size["width"] // 2, int(y) - size["height"] // 2).perform()
        self.assertRegex(self.text("#plot-constraint .plot-value"), r"^(axis|orientation|position) of tool [\d.]+ of 3|^joint")
        ActionChains(self.browser).click().perform()
        self.drawn()
        self.assertAlmostEqual(0.5 + self.now(), c + d * int(x), delta=2 * d)
        self.assertEqual(len(library["times"]), 1001)
        self.assert_quiet()

    def test_where_one_does_not_hold(self):
        library = self.page("broken")
        first = next(t for t, values, most in zip(library["times"], library["values"], library["most"])
                     if values[0] > most[0])
        self.assertEqual(self.text("#verdict"), "trajectory: off a constraint")
        self.assertEqual(self.text("#constraints-title").lower(), "asked of every instant")
        broken = self.find("#broken button")
        self.assertEqual(len(broken), 1)
        self.assertRegex(broken[0].text, r"^axis of 'tool' is [\d.e-]+ rad beyond its angle\nswing, \d\.\d{3} s$")
        broken[0].click()
        self.drawn()
        self.assertAlmostEqual(0.5 + self.now(), first, delta=0.01)
        self.assertRegex(self.text("#list .amount"), r"^off a constraint")
        self.assertRegex(self.text("#tiers"), "off a constraint")
        self.assertGreater(len(self.find(".piece.violation")), 5)
        self.assertEqual(len(self.find("#plot-constraint .mark.contact")), 1)
        self.assert_quiet()

    def test_without_constraints_nothing_is_said(self):
        self.page("kept")
        self.assertTrue(self.find("#plot-constraint")[0].is_displayed())
        self.page("none")
        self.assertFalse(self.find("#plot-constraint")[0].is_displayed())
        self.assertFalse(self.find("#constraints-title")[0].is_displayed())
        self.assert_quiet()

    def test_phone(self):
        self.page("kept", 400, 800, phone=True)
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 400)
        box = self.find("#plot-constraint svg")[0].rect
        self.assertLessEqual(box["x"] + box["width"], 400)
        self.assertGreater(box["width"], 340)


if __name__ == "__main__":
    run_tests()
