#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page of a planned path, in a browser: path_page_browser.py SWEPT SOURCE_FOLDER."""
import re
import time

import picture_file
from browser_page import ROOK, SHRUNK, ActionChains, BrowserTest, main
from selenium.webdriver.common.keys import Keys

PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]


class PathPage(BrowserTest):
    """What a page of `plan` shows, and what it does when it is told to."""

    def test_path_is_there(self):
        run = self.open("plan", PLAN)
        segments = int(re.search(r"solved: (\d+) segments, all proven free", run.stdout)[1])
        self.assertEqual(self.text("#verdict"), f"solved: {segments} segments, all proven free")
        self.assertEqual(self.browser.title, "rook7, swept plan")
        self.assertEqual(len(self.find(".segment")), segments)
        self.assertEqual(len(self.find("#list button")), segments)
        self.assertEqual(len(self.find(".piece")), 24 * segments)
        self.assertEqual(len(self.find(".piece.lanes, .piece.exact")), 24 * segments)
        self.assertIn("CertifiedConnect", self.text("#facts"))
        self.assertIn("swept plan " + ROOK, self.text("#facts dd.command"))
        self.assertTrue(self.find("#legend")[0].is_displayed())
        # A path has no time: nothing is plotted over it.
        self.assertFalse(self.find("#plots")[0].is_displayed())
        self.assertFalse(self.find("#tool-plots")[0].is_displayed())
        self.assert_shows_something(self.picture())
        self.assert_quiet()

    def test_parts_say_what_is_proven(self):
        self.open("plan", PLAN)
        # In a narrow segment a part is less than a pixel wide.
        widths = [segment.size["width"] for segment in self.find(".segment")]
        widest = widths.index(max(widths)) + 1
        piece = self.find(f".segment:nth-child({widest}) .piece")[2]
        ActionChains(self.browser).move_to_element(piece).perform()
        self.drawn()
        self.assertRegex(self.text("#hover"),
                         rf"^segment {widest}, t 0\.083 to 0\.125: free, proven .*, keeps [0-9.]+ mm or more "
                         r"\(world [0-9.]+ m?m, itself [0-9.]+ m?m\)$")
        # A chart of the world, and one of the robot itself.
        segments = len(self.find(".segment"))
        self.assertEqual(len(self.find(".bounds.world")), segments)
        self.assertEqual(len(self.find(".bounds.self")), segments)
        bounds = self.js("return [].concat(...swept.data.motions.map((m) => m.pieces.lower))")
        shown = [float(re.search(r"keeps ([0-9.]+) mm", piece.get_attribute("data-text"))[1])
                 for piece in self.find(".piece")]
        for bound, text in zip(bounds, shown):
            self.assertLessEqual(text, bound * 1e3)
            self.assertGreater(text, bound * 1e3 - 0.11)

    def test_time_moves_the_robot(self):
        self.open("plan", PLAN)
        last = self.js("return swept.data.frames.count - 1")
        self.js("swept.playback.setTime(0)")
        self.assertEqual(self.tip(), self.tip_of_data(0))
        self.press(Keys.ARROW_RIGHT)
        for a, b in zip(self.tip(), self.tip_of_data(1)):
            self.assertAlmostEqual(a, b, places=6)
        self.press(Keys.ARROW_RIGHT, Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        self.assertEqual(self.now(), 0)
        self.js("swept.playback.setTime(swept.data.duration)")
        for a, b in zip(self.tip(), self.tip_of_data(last)):
            self.assertAlmostEqual(a, b, places=6)
        ActionChains(self.browser).key_down(Keys.SHIFT).send_keys(Keys.ARROW_LEFT).key_up(
            Keys.SHIFT).perform()
        self.assertAlmostEqual(self.now(), self.js("return swept.data.motions.slice(-1)[0].start"))

    def test_space_plays_and_stops(self):
        self.open("plan", PLAN)
        before = self.picture()
        self.press(Keys.SPACE)
        for _ in range(200):
            if self.now() > 0.3:
                break
            time.sleep(0.05)
        self.press(Keys.SPACE)
        stopped = self.now()
        self.assertGreater(stopped, 0.3)
        time.sleep(0.2)
        self.assertEqual(self.now(), stopped)
        self.assertGreater(picture_file.share_changed(before, self.picture()), 0.001)
        self.assertGreater(int(self.find("#scrub")[0].get_attribute("value")), 0)
        self.assert_quiet()

    def test_address_says_when(self):
        self.open("plan", PLAN, at="#t=0.25&shadows=off")
        self.assertAlmostEqual(self.now(), 0.25 * self.js("return swept.data.duration"))

    def test_click_on_the_timeline_goes_there(self):
        self.open("plan", PLAN)
        third = self.find(".segment")[2]
        ActionChains(self.browser).move_to_element(third).click().perform()
        at = self.js("return swept.data.locate(swept.playback.state.time)")
        self.assertEqual(at["index"], 2)
        self.assertAlmostEqual(at["t"], 0.5, delta=0.03)

    def test_click_shows_name_and_nearest(self):
        self.open("plan", PLAN)
        before = self.picture()
        x, y = self.click_on("link3")
        self.assertEqual(self.text("#picked-name"), "link3")
        self.assertIn("link:", self.text("#picked-kind"))
        self.assertRegex(self.text("#picked-facts"), r"nearest now\n.+, [0-9.]+ mm\nover the path\n")
        rows = self.picture()
        self.assertNotEqual(rows[y // SHRUNK][x // SHRUNK], before[y // SHRUNK][x // SHRUNK])
        self.press(Keys.ESCAPE)
        self.assertFalse(self.find("#picked")[0].is_displayed())
        self.assertLess(picture_file.share_changed(before, self.picture()), 0.001)
        self.click_on("board_2")
        self.assertIn("body of the world: box", self.text("#picked-kind"))

    def test_keys_change_the_picture_and_back(self):
        self.open("plan", PLAN)
        plain = self.picture()
        for key, button in (("c", "covers"), ("x", "world"), ("g", "ghosts")):
            self.press(key)
            self.assertEqual(self.find("#tool-" + button)[0].get_attribute("aria-pressed"), "true")
            self.assertGreater(picture_file.share_changed(plain, self.picture(), 8), 0.005, key)
            self.press(key)
            self.assertLess(picture_file.share_changed(plain, self.picture(), 8), 0.001, key)
        canvas = self.find("#view")[0]
        ActionChains(self.browser).move_to_element(canvas).click_and_hold().move_by_offset(
            80, 20).release().perform()
        self.drawn()
        self.assertGreater(picture_file.share_changed(plain, self.picture()), 0.05)
        self.assertFalse(self.find("#picked")[0].is_displayed())  # turned, not picked
        self.press("r")
        self.assertLess(picture_file.share_changed(plain, self.picture()), 0.002)
        self.press("h")
        self.assertIn("play, pause", self.text("#help"))
        self.press(Keys.ESCAPE)
        self.assertFalse(self.find("#help")[0].is_displayed())
        self.assert_quiet()

    def test_light_and_dark(self):
        for scheme, other in (("light", "dark"), ("dark", "light")):
            self.tell("Emulation.setEmulatedMedia",
                      {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            self.open("plan", PLAN)
            level = {scheme: picture_file.brightness(self.picture())}
            self.assert_shows_something(self.picture())
            self.press("d")
            level[other] = picture_file.brightness(self.picture())
            self.assertGreater(level["light"], level["dark"] + 60)
        self.tell("Emulation.setEmulatedMedia", {"features": []})

    def test_phone(self):
        self.open("plan", PLAN, 390, 844, phone=True)
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 390)
        before = self.picture()
        self.assert_shows_something(before)
        self.assertTrue(self.find("#play")[0].is_displayed())
        self.assertGreater(self.find("#timeline")[0].size["width"], 300)
        for kind, x in (("touchStart", 100), ("touchMove", 150), ("touchMove", 220)):
            self.tell("Input.dispatchTouchEvent",
                      {"type": kind, "touchPoints": [{"x": x, "y": 220}]})
        self.tell("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        self.drawn()
        self.assertGreater(picture_file.share_changed(before, self.picture()), 0.05)
        self.assert_quiet()


if __name__ == "__main__":
    main()
