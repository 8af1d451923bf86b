#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What came of plans and motions, in a browser: outcome_page_browser.py SWEPT SOURCE_FOLDER."""
import pathlib

import picture_file
from browser_page import ROOK, BrowserTest, main, run_swept

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml"]
HIT = "0.2,0.4,0,1.2,0,0.8,0"  # link5 is in plate_left
CHECK = ["check", ROOK, "home", "ready", HIT, *SLOT]
PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]
ENDS = ["0.23,0.53,0.12,1.44,0.35,-0.73,0.11", "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14"]


class OutcomePage(BrowserTest):
    """Plans that failed, worst moments and several paths."""

    def assert_opens_at(self, index, label):
        self.assertEqual(self.now(), index)
        self.assertEqual(self.text(".contact-label"), label)
        self.assertEqual(self.find(".state-chip")[index].get_attribute("aria-current"), "true")
        contacts = self.js("return swept.data.states[arguments[0]].contacts", index)
        at = self.js("const p = new THREE.Vector3().fromArray(arguments[0]);"
                     "const at = swept.scene.project(p), c = swept.scene.canvas;"
                     "return [at.x / c.clientWidth, at.y / c.clientHeight];", contacts[0]["point_a"])
        for share in at:
            self.assertAlmostEqual(share, 0.5, delta=0.2)
        self.assertTrue(self.js("return swept.scene.isSeen(arguments[0])", contacts[0]))
        near = self.camera()
        self.press("r")
        far = self.camera()
        distance = [sum((c[i] - c[i + 3]) ** 2 for i in range(3)) ** 0.5 for c in (near, far)]
        self.assertLess(distance[0], 0.75 * distance[1])

    def test_failed_plan_opens_at_the_goal_that_collides(self):
        self.open("bad_goal", ["plan", ROOK, "home", HIT, *SLOT])
        self.assertEqual(self.text("#verdict"), "not solved: goal is in collision")
        self.assertFalse(self.find("#reason-text")[0].is_displayed())
        self.unfold("#reason")
        self.assertRegex(self.text("#reason-text"), r"link5 - plate_left \(0\.\d+ m deep, at \[")
        self.assertEqual(self.text("#now"), "as at goal: collision")
        self.assert_opens_at(1, "link5 – plate_left")
        self.assert_quiet()

    def test_failed_plan_opens_at_the_start_that_collides(self):
        self.open("bad_start", ["plan", ROOK, HIT, "home", *SLOT])
        self.assertEqual(self.text("#verdict"), "not solved: start is in collision")
        self.assert_opens_at(0, "link5 – plate_left")
        self.open("bad_start", [], at="#t=1&shadows=off")  # the address has the last word
        self.assertEqual(self.now(), 1)

    def test_failed_plan_with_both_ends_bad_says_so_in_a_line(self):
        self.open("bad_ends", ["plan", ROOK, HIT, "0.21,0.4,0,1.2,0,0.8,0", *SLOT])
        self.assertEqual(self.text("#verdict"), "not solved: start and goal are in collision")

    def test_moment_of_a_path_has_the_verdict_of_its_part(self):
        self.open("motion", ["motion", ROOK, "home", "ready", *SLOT])
        tiers = self.js("return swept.data.motions[0].pieces.tiers")
        for piece, tier in enumerate(tiers):
            self.js("swept.playback.setTime(swept.data.timeOf(0, arguments[0]))", (piece + 0.5) / len(tiers))
            words = {"collision": "in a part that is in collision", "undecided": "undecided"}
            self.assertIn(words.get(tier, "free, keeps"), self.text("#now"))
        self.assertIn("collision", tiers)

    def test_worst_moment_is_in_the_part_that_keeps_least(self):
        self.open("plan", PLAN)
        self.press("w")
        found = self.js(
            "const d = swept.data, at = d.locate(swept.playback.state.time);"
            "const lower = d.motions[at.index].pieces.lower;"
            "return [Math.min(...[].concat(...d.motions.map((m) => m.pieces.lower))),"
            "  lower[Math.min(lower.length - 1, Math.floor(at.t * lower.length - 1e-9))],"
            "  lower[Math.min(lower.length - 1, Math.floor(at.t * lower.length + 1e-9))]];")
        self.assertIn(found[0], found[1:])
        self.assertRegex(self.text("#notice"), r"^worst moment: segment \d keeps [0-9.]+ mm or more$")
        self.assertTrue(self.find("#picked")[0].is_displayed())

    def test_worst_moment_of_states_is_the_collision(self):
        self.open("check", CHECK)
        self.press("w")
        self.assertEqual(self.now(), 2)

    def test_worst_moment_of_a_motion_is_its_contact(self):
        self.open("motion", ["motion", ROOK, "home", "ready", *SLOT])
        self.press("w")
        self.assertAlmostEqual(self.js("return swept.data.locate(swept.playback.state.time).t"),
                               self.js("return swept.data.motions[0].contacts[0].t"), places=6)

    def paths(self):
        files = []
        for seed in ("1", "2"):
            file = pathlib.Path(self.folder.name) / f"seed{seed}.json"
            files.append(str(file))
            if file.exists():
                continue
            run = run_swept(["plan", ROOK, *ENDS, "--group", "arm", "--scene", "models/scenes/shelf.yaml",
                             "--seed", seed, "-o", str(file)])
            self.assertEqual(run.returncode, 0, run.stderr)
        return files

    def make(self, name, arguments):
        """`view` has another name for the option of the page."""
        if name == "two" and name not in self.made:
            file = pathlib.Path(self.folder.name) / "two.html"
            self.made[name] = run_swept(["view", ROOK, *arguments, "-o", str(file)])
            self.assertTrue(file.exists(), self.made[name].stderr)
        return super().make(name, arguments)

    def test_several_paths_take_turns(self):
        self.open("two", self.paths())
        self.assertEqual(self.text("#verdict"), "2 paths: all free")
        self.assertEqual([b.text.split("\n")[0] for b in self.find("#paths button")], ["seed1.json", "seed2.json"])
        dots = [dot.value_of_css_property("background-color") for dot in self.find("#paths .dot")]
        self.assertNotEqual(dots[0], dots[1])
        first = self.picture()
        counts = self.js("return [0, 1].map((p) => swept.data.allMotions.filter((m) => m.path === p).length)")
        self.assertEqual(len(self.find(".segment")), counts[0])
        self.js("swept.playback.setTime(swept.data.duration / 2)")
        self.press("n")
        self.assertEqual(self.now(), 0)
        self.assertEqual(self.find("#paths button")[1].get_attribute("aria-current"), "true")
        self.assertEqual(len(self.find(".segment")), counts[1])
        self.assertEqual(len(self.find("#list button")), counts[1])
        # What is below and beside the picture is of the second path.
        said = self.js("return Array.from(document.querySelectorAll('.piece')).map((p) => p.dataset.text)")
        keeps = self.js("const d = swept.data; return [].concat(...d.allMotions.filter((m) => m.path === 1)"
                        "  .map((m) => m.pieces.lower.map((v) => d.millimetres(v))));")
        self.assertEqual([text.split("keeps ")[1].split(" (world")[0] for text in said], [keep + " or more" for keep in keeps])
        amounts = [b.text.split("\n")[1] for b in self.find("#list button")]
        self.assertEqual(amounts, self.js(
            "const d = swept.data; return d.allMotions.filter((m) => m.path === 1)"
            "  .map((m) => '\u2265 ' + d.millimetres(Math.min(...m.pieces.lower)));"))
        self.assertGreater(picture_file.share_changed(first, self.picture(), 8), 0.001)
        # The robot is on the second path: at the frames that are stored for it.
        self.js("swept.playback.setTime(swept.data.duration)")
        frame = self.js("return swept.data.lastFrame()")
        self.assertEqual(frame, self.js("return swept.data.frames.count - 1"))
        self.assert_near(self.tip(), self.tip_of_data(frame), 1e-6)
        self.press("l")
        hash_ = self.js("return location.hash")
        self.open("two", [], at=hash_)
        self.assertEqual(self.find("#paths button")[1].get_attribute("aria-current"), "true")
        self.press("n")
        self.assertEqual(len(self.find(".segment")), counts[0])
        self.assert_quiet()


if __name__ == "__main__":
    main()
