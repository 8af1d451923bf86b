#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a page shows from where, in a browser: view_page_browser.py SWEPT SOURCE_FOLDER."""
import pathlib
import time

import picture_file
from browser_page import ROOK, SHRUNK, BrowserTest, main
from selenium.webdriver.common.keys import Keys

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml"]
HIT = "0.2,0.4,0,1.2,0,0.8,0"  # link5 is in plate_left
CHECK = ["check", ROOK, "home", "ready", HIT, *SLOT]
PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]


class ViewPage(BrowserTest):
    """Cameras, addresses, pictures and shadows."""

    def test_presets_look_from_where_they_say(self):
        self.open("check", CHECK)
        pictures = [self.picture()]
        for key, away in (("1", (1, 0, 0)), ("2", (0, -1, 0)), ("3", (0, 0, 1)), ("4", (-0.61, -0.61, 0.5))):
            self.press(key)
            camera = self.camera()
            way = [camera[i] - camera[i + 3] for i in range(3)]
            length = sum(w * w for w in way) ** 0.5
            self.assert_near([w / length for w in way], away, 0.01)
            pictures.append(self.picture())
            self.assert_shows_something(pictures[-1])
        for i, picture in enumerate(pictures):
            for other in pictures[:i]:
                self.assertGreater(picture_file.share_changed(other, picture), 0.03)
        self.assert_quiet()

    def test_fit_shows_all_that_is_shown(self):
        self.open("check", CHECK)
        before = self.camera()
        self.js("swept.bodies.only(arguments[0])", self.body("finger_left"))
        self.press("f")
        after = self.camera()
        distance = [sum((c[i] - c[i + 3]) ** 2 for i in range(3)) ** 0.5 for c in (before, after)]
        self.assertLess(distance[1], 0.2 * distance[0])
        corners = self.js("const b = swept.scene.shownBounds(), all = [];"
                          "for (const p of [b.min, b.max]) all.push(swept.scene.project(p));"
                          "return all.map((p) => [p.x, p.y]);")
        for x, y in corners:
            self.assertTrue(0 <= x <= 460 and 0 <= y <= 500, (x, y))

    def test_address_leads_back_to_the_view(self):
        self.open("plan", PLAN)
        self.js("swept.playback.setTime(0.4 * swept.data.duration); swept.bodies.set(3, false);"
                "swept.bodies.set(7, false); swept.views.preset('isometric');")
        self.press("l")
        hash_, camera, seen = self.js("return location.hash"), self.camera(), self.picture()
        self.assertTrue(self.find("#notice")[0].is_displayed())
        self.open("plan", PLAN, at=hash_)
        self.assert_near(self.camera(), camera, 1e-3)
        self.assertEqual([i for i, on in enumerate(self.shown()) if not on], [3, 7])
        self.assertAlmostEqual(self.now(), 0.4 * self.js("return swept.data.duration"), delta=1e-3)
        self.assertLess(picture_file.share_changed(seen, self.picture()), 0.01)
        # By hand.
        self.js("const v = swept.kinematics.valuesAt(0); v[1] += 0.3; swept.playback.setValues(v);")
        self.press("l")
        hash_, tip = self.js("return location.hash"), self.tip()
        self.open("plan", PLAN, at=hash_)
        self.assert_near(self.tip(), tip, 1e-4)
        self.assertRegex(self.text("#now"), "^moved by hand")
        self.assert_quiet()

    def test_addresses_of_nonsense_open_the_page(self):
        for nonsense in ("#", "#x", "#t=abc&view=1,2&hide=z,99&q=1&path=7", "#view=0,0,0,0,0,0", "#hide=", "#t=-5", "#t=9"):
            self.open("check", CHECK, at=nonsense)
            self.assert_shows_something(self.picture())
            self.assertTrue(all(self.shown()))
            self.assert_quiet()

    def test_picture_is_saved_as_it_is_seen(self):
        self.open("check", CHECK)
        folder = pathlib.Path(self.folder.name) / "saved"
        folder.mkdir(exist_ok=True)
        self.tell("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
        self.press("p")
        file = folder / "rook7-swept-check.png"
        for _ in range(200):
            if file.exists():
                break
            time.sleep(0.05)
        rows = picture_file.read_png(file.read_bytes())
        size = self.js("return [swept.scene.canvas.width, swept.scene.canvas.height]")
        self.assertEqual([len(rows[0]), len(rows)], size)
        screen = self.picture()
        shrunk = picture_file.shrunk(rows, SHRUNK)
        self.assertLess(picture_file.share_changed(screen, shrunk), 0.01)
        self.assert_shows_something(shrunk)
        # A label over it is in it.
        self.js("swept.playback.setTime(2)")
        red = self.js("const sheet = swept.views.drawn(), at = document.querySelector('.contact-label');"
                      "const x = parseFloat(at.style.left) + 15, y = parseFloat(at.style.top) - 7;"
                      "return Array.from(sheet.getContext('2d').getImageData(x, y, 1, 1).data);")
        self.assertEqual(red, [193, 39, 45, 255])

    def test_picture_is_not_stretched(self):
        self.open("check", CHECK)
        sizes = "const c = swept.scene.canvas; return [c.width, c.height, c.clientWidth, c.clientHeight];"
        width, height, shown_width, shown_height = self.js(sizes)
        self.assertEqual([width, height], [shown_width, shown_height])
        self.js("document.getElementById('timeline').style.height = '150px'")
        self.drawn()
        self.drawn()
        width, height, shown_width, lower = self.js(sizes)
        self.assertEqual([width, height], [shown_width, lower])
        self.assertLess(lower, shown_height)
        self.assertAlmostEqual(self.js("return swept.scene.camera.aspect"), width / height)

    def open_after(self, source, at):
        """The page of a plan, whose scripts find the browser as `source` leaves it."""
        script = self.tell("Page.addScriptToEvaluateOnNewDocument", {"source": source})
        try:
            self.open("plan", PLAN, at=at)
        finally:
            self.tell("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script["identifier"]})

    def open_with_clock(self, step):
        """The page, with a clock that goes on by so many ms from each picture to the next."""
        self.open_after((
            "{ const real = window.requestAnimationFrame.bind(window); let now = 0, seen = null;"
            "const tell = (f) => (time) => {"
            f"  if (time !== seen) now += {step};"
            "  seen = time; f(now); };"
            "window.requestAnimationFrame = (f) => real(tell(f)); }"), "")

    def play_a_while(self):
        self.press(Keys.SPACE)
        for _ in range(12):
            self.drawn()
        self.press(Keys.SPACE)

    def test_slow_pictures_have_no_shadows(self):
        self.open_with_clock(40)
        self.play_a_while()
        self.assertTrue(self.js("return swept.pace.shadows()"))
        self.assertFalse(self.find("#pace-note")[0].is_displayed())
        self.open_with_clock(150)
        self.assertTrue(self.js("return swept.pace.shadows()"))
        with_shadows = self.picture()
        self.play_a_while()
        self.assertFalse(self.js("return swept.pace.shadows() || swept.scene.scene.children.some("
                                 "  (c) => c.isDirectionalLight && c.castShadow)"))
        self.assertEqual(self.text("#pace-note"), "no shadows: a picture takes 150 ms")
        self.js("swept.playback.setTime(0)")
        without = self.picture()
        self.assertGreater(picture_file.share_changed(with_shadows, without, 8), 0.005)
        self.press("s")  # wanted all the same
        self.assertLess(picture_file.share_changed(with_shadows, self.picture(), 8), 0.001)
        self.play_a_while()
        self.assertTrue(self.js("return swept.pace.shadows()"))
        self.assert_quiet()

    def test_browser_without_webgl_shows_the_rest(self):
        self.open_after("HTMLCanvasElement.prototype.getContext = () => null;", "#t=0.5&view=1,1,1,0,0,0")
        self.assertTrue(self.find("#no-webgl")[0].is_displayed())
        self.assertEqual(self.text("#verdict")[:7], "solved:")
        for key in ("1", "f", "p", "a", "/", "c", "r", "w", "n"):
            self.press(key)
        self.assertRegex(self.text("#now"), "^as at path point")
        self.unfold("#joints-box")
        self.find(".link-name")[0].click()
        self.assertFalse(self.find("#picked-only")[0].is_displayed())
        errors = [entry["message"] for entry in self.browser.get_log("browser")]
        self.assertEqual([error for error in errors if "WebGL" not in error], [])

    def test_controls_have_names(self):
        self.open("check", CHECK)
        self.js("for (const box of document.querySelectorAll('details')) box.open = true;")
        nameless = self.js(
            "return Array.from(document.querySelectorAll('button, input, select, summary, canvas'))"
            "  .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() ||"
            "    (e.closest('label') && e.closest('label').textContent.trim())))"
            "  .map((e) => e.outerHTML);")
        self.assertEqual(nameless, [])

    def test_phone_holds_all_of_it(self):
        self.open("check", CHECK, 390, 844, phone=True)
        self.js("for (const box of document.querySelectorAll('details')) box.open = true;")
        self.drawn()
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 390)
        over = self.js(
            "const boxes = ['legend', 'views', 'tools'].map((id) => document.getElementById(id))"
            "  .filter((e) => e.offsetParent).map((e) => e.getBoundingClientRect());"
            "return boxes.some((a, i) => boxes.slice(0, i).some((b) => a.left < b.right &&"
            "  b.left < a.right && a.top < b.bottom && b.top < a.bottom));")
        self.assertFalse(over)
        self.assert_quiet()


if __name__ == "__main__":
    main()
