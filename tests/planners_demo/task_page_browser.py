# SPDX-License-Identifier: BSD-3-Clause
"""The page of a task: a box that a cube carries over a block. tests/robot_model/carried_box.hpp has the task."""
import pathlib
import subprocess
import sys
import unittest

from selenium.webdriver.support.ui import WebDriverWait

import browser_page
from browser_page import BUSY, BrowserTest

# Of a body of the phase that is shown: where its first part is (m, model frame), whether it is drawn, what carries it.
BODY = """
const s = task.page().scene, d = task.page().data;
const i = d.bodies.findIndex((b) => b.name === arguments[0]);
if (i < 0) return null;
s.scene.updateMatrixWorld(true);
const mesh = s.bodies[i].group;
let first = null;
mesh.traverse((o) => { if (first === null && o.isMesh) first = o; });
const frame = document.querySelector('iframe.shown').contentWindow;
const box = new frame.THREE.Box3().setFromObject(first), p = box.getCenter(new frame.THREE.Vector3());
return [p.x, p.y, p.z, mesh.visible, d.bodies[i].kind];
"""


class TaskPageTest(BrowserTest):
    """Phases: reach (x -2 to -1.2), lift (z 0 to 0.5), carry (x to 1), lower (z to 0), leave (z to 1)."""

    def make(self, name, arguments):
        file = pathlib.Path(self.folder.name) / (name + ".html")
        if name not in self.made:
            self.made[name] = subprocess.run([sys.argv[1], *arguments, "--html", str(file)], cwd=browser_page.SOURCE,
                                             capture_output=True, text=True, check=False)
            self.assertTrue(file.exists(), self.made[name].stderr)
        return file, self.made[name]

    def setUp(self):
        file, _ = self.make("box", ["box"])
        self.browser.get("about:blank")
        self.browser.get_log("browser")
        self.browser.get(file.as_uri())
        self.ready()

    def ready(self):
        WebDriverWait(self.browser, BUSY).until(lambda _: self.js("return Boolean(window.task) && task.isReady()"))
        self.drawn()

    def at(self, time):
        self.js("task.setTime(arguments[0])", time)
        self.ready()

    def box(self, name="box"):
        return self.js(BODY, name)

    def phases(self):
        return self.js("return JSON.parse(document.getElementById('data').textContent).phases"
                       ".map((p) => [p.label, p.begin, p.end])")

    def test_a_bar_that_moves_is_where_its_clock_says(self):
        file, _ = self.make("bar", ["bar"])
        self.browser.get(file.as_uri())
        self.ready()
        for time in (0, 0.5, 1.9, 2.25, 3, 1):
            self.at(time)
            self.assertEqual(self.js("return task.state.phase"), 1 if time >= 2 else 0)
            self.assert_near(self.box("bar")[:3], [0, time + 2 - 3, 0.5], 1e-4)
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_bodies_are_where_the_task_has_them(self):
        phases = self.phases()
        self.assertEqual([p[0] for p in phases], ["reach", "lift", "carry", "lower", "leave"])
        middle = [0.5 * (begin + end) for _, begin, end in phases]
        cube = {0: -1.6, 2: -0.1}  # motions are symmetric in time
        for index, place in ((0, [-1.0, 0, 0]), (1, [-1.0, 0, 0.25]), (2, [cube[2] + 0.2, 0, 0.5]),
                             (3, [1.2, 0, 0.25]), (4, [1.2, 0, 0])):
            with self.subTest(phases[index][0]):
                self.at(middle[index])
                self.assertEqual(self.js("return task.state.phase"), index)
                found = self.box()
                self.assert_near(found[:3], place, 1e-4)
                self.assertTrue(found[3])
                self.assertEqual(found[4], "attached" if index in (1, 2, 3) else "world")
                self.assert_near(self.box("map")[:3], [0.3 if index == 4 else 0, 2, 0], 1e-3)
                self.assertIn(phases[index][0], self.text("#task-phase"))
                self.assertLessEqual(len(self.find("iframe")), 2)
                self.assertEqual(len(self.find("iframe.shown")), 1)
        self.assertIn("box placed, map sensed", self.text("#task-phase"))
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_says_what_it_is(self):
        self.assertEqual(self.text("#task-title"), "a box <b>carried</b>")
        self.assertEqual(self.text("#task-verdict"), "5 phases: all free")
        self.assertEqual(self.js("return document.title"), "a box <b>carried</b>")

    def test_plays_from_phase_to_phase(self):
        phases = self.phases()
        self.at(phases[0][2] - 0.05)
        self.find("#task-play")[0].click()
        WebDriverWait(self.browser, BUSY).until(
            lambda _: self.js("return task.state.phase") >= 1 and self.js("return task.isReady()"))
        WebDriverWait(self.browser, BUSY).until(lambda _: self.js("return task.state.time") > phases[1][1] + 0.05)
        self.find("#task-play")[0].click()
        now = self.js("return task.state.time")
        self.assertFalse(self.js("return task.state.playing"))
        self.drawn()
        self.assertEqual(self.js("return task.state.time"), now)
        index = self.js("return task.state.phase")
        self.assertAlmostEqual(self.js("return task.page().playback.state.time"), now - phases[index][1], delta=1e-9)

    def test_the_camera_stays(self):
        self.js("task.page().views.restore('3,-2,2,0.5,0,0')")
        before = self.js("return task.page().views.saved()")
        for index in (1, 2, 4, 0):
            self.js("task.goTo(arguments[0])", index)
            self.ready()
            self.assertEqual(self.js("return task.page().views.saved()"), before)

    def test_the_time_line_of_a_phase_sets_the_clock(self):
        phases = self.phases()
        self.at(phases[2][1])
        self.js("task.page().playback.setTime(0.5)")
        self.assertAlmostEqual(self.js("return task.state.time"), phases[2][1] + 0.5, delta=1e-9)
        self.assertEqual(self.js("return task.state.phase"), 2)


if __name__ == "__main__":
    for program in ("chromium", "chromedriver"):
        if browser_page.shutil.which(program) is None:
            print(f"skipped: {program} is not installed")
            sys.exit(0)
    unittest.main(argv=sys.argv[:1])
