#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A page that proves where its sliders are dragged to: live_page_browser.py SWEPT SOURCE_FOLDER.

SWEPT_LIVE names the module, which tests/packaging/wasm.sh makes.
"""
import json
import os
import pathlib
import sys

if not os.environ.get("SWEPT_LIVE"):
    print("skipped: SWEPT_LIVE names no module for WebAssembly, which tests/packaging/wasm.sh makes")
    sys.exit(0)

from browser_page import BUSY, ROOK, BrowserTest, main, run_swept  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml", "--margin-self", "0.001"]
LARGEST = 4 << 20  # bytes of the demo's page


class LivePage(BrowserTest):
    """What the page says of states that no program has seen before."""

    def open_live(self, name, arguments, **how):
        run = self.open(name, arguments, width=1100, height=900, **how)
        WebDriverWait(self.browser, BUSY).until(
            lambda _: self.js("return document.getElementById('panel').dataset.live"))
        self.assertEqual(self.js("return document.getElementById('panel').dataset.live"), "ready",
                         self.js("return swept.live.state.problem"))
        return run

    def drag(self, joint, share):
        """Presses the slider of a joint where it is and lets it go at a share of its length."""
        slider = self.find(f"#tree input[type=range][aria-label^='{joint},']")[0]
        self.js("arguments[0].scrollIntoView({block: 'center'})", slider)
        width, now = slider.size["width"], self.js(
            "const s = arguments[0]; return (s.value - s.min) / (s.max - s.min)", slider)
        thumb = 16  # pixels; it stays within the slider
        place = lambda at: round((at - 0.5) * (width - thumb))
        ActionChains(self.browser).move_to_element_with_offset(slider, place(now), 0).click_and_hold() \
            .move_to_element_with_offset(slider, place((now + share) / 2), 0) \
            .move_to_element_with_offset(slider, place(share), 0).release().perform()
        self.drawn()

    def judged(self):
        """What `swept check` says of the state on the page."""
        values = self.js("return swept.data.tree.group.map((i) => swept.playback.state.values[i])")
        run = run_swept(["check", ROOK, ",".join(map(repr, values)), *SLOT, "--json"])
        return json.loads(run.stdout)["states"][0]

    def test_verdict_follows_the_slider(self):
        self.open_live("slot", ["check", ROOK, "home", *SLOT])
        self.unfold("#joints-box")
        said = set()
        for joint, share in (("joint1", 0.6), ("joint2", 0.8), ("joint4", 0.3), ("joint2", 0.95), ("joint2", 0.5)):
            self.drag(joint, share)
            expected = self.judged()
            text = self.text("#now")
            said.add(expected["verdict"])
            self.assertTrue(text.startswith("moved by hand: " + expected["verdict"]), text)
            answer = self.js("return swept.live.state.answer")
            self.assertEqual(answer["verdict"], expected["verdict"])
            self.assertEqual(answer["nearest"], expected["nearest"])
            self.assertAlmostEqual(answer["clearance"], expected["clearance"], delta=1e-9)
            pairs = [[contact["body_a"], contact["body_b"]] for contact in expected["contacts"]]
            self.assertEqual([[c["body_a"], c["body_b"]] for c in answer["contacts"]], pairs)
            self.assertEqual([label.text for label in self.find(".contact-label")],
                             [f"{a} – {b}" for a, b in pairs])
            print(f"{joint} at {share}: {text}; {self.js('return swept.live.state.took'):.2f} ms")
        self.assertEqual(said, {"free", "collision"})
        self.find("#joints-back")[0].click()
        self.drawn()
        self.assertTrue(self.text("#now").startswith("as at "))
        self.assertEqual(self.find(".contact-label"), [])
        self.assert_quiet()

    def test_page_of_the_demo(self):
        self.open_live("plan", ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json",
                                "--set", "shelf", "--index", "1"])
        size = (pathlib.Path(self.folder.name) / "plan.html").stat().st_size
        print(f"the demo's page: {size} bytes")
        self.assertLessEqual(size, LARGEST)
        # Where the recorded proof has a bound, the module's clearance is no less.
        found = self.js(
            "const d = swept.data, least = [];"
            "for (const motion of d.motions) motion.pieces.lower.forEach((lower, i) => {"
            "  const t = (i + 0.5) / motion.pieces.lower.length;"
            "  const q = swept.kinematics.whole(swept.kinematics.onMotion(motion, t));"
            "  const answer = swept.live.ask(d.tree.group.map((v) => q[v]));"
            "  least.push([lower, answer.clearance, answer.verdict]); });"
            "return least;")
        self.assertGreater(len(found), 20)
        for lower, clearance, verdict in found:
            self.assertEqual(verdict, "free")
            self.assertLessEqual(lower, clearance + 1e-6)
        self.assert_quiet()


if __name__ == "__main__":
    main()
