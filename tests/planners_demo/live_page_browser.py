#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A page that proves where its sliders and bodies are dragged to: live_page_browser.py SWEPT SOURCE_FOLDER.

SWEPT_LIVE names the module, which tests/packaging/wasm.sh makes.
"""
import json
import math
import os
import pathlib
import sys

if not os.environ.get("SWEPT_LIVE"):
    print("skipped: SWEPT_LIVE names no module for WebAssembly, which tests/packaging/wasm.sh makes")
    sys.exit(0)

from browser_page import BUSY, ROOK, BrowserTest, main, run_swept  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml", "--margin-self", "0.001"]
LARGEST = 4 << 20  # bytes of the demo's page
# Boxes beside the arm: size (m), and pose as scene files have it.
PLATES = {"left": ([0.02, 0.5, 0.86], {"position": [0.42, 0.45, 0.48], "orientation": [0, 0, 0, 1]}),
          "right": ([0.02, 0.5, 0.86], {"position": [0.42, -0.45, 0.48], "orientation": [0, 0, 0, 1]})}


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

    def judge_moved(self, at):
        """Compares the page, whose state has these values, with `swept check` among bodies as the page says that
        they are; what it says."""
        moved = self.js("return [...swept.liveBodies.moves].map(([body, move]) => "
                        "  [swept.data.bodies[body].name, move.parts[0]])")
        bodies = {name: (size, pose) for name, (size, pose) in PLATES.items()}
        for name, pose in moved:
            bodies[name] = (bodies[name][0], pose)
        scene = self.write_scene("moved.yaml", bodies)
        run = run_swept(["check", ROOK, at, "--group", "arm", "--scene", scene, "--json"])
        expected = json.loads(run.stdout)["states"][0]
        answer = self.js("return swept.live.state.answer")
        self.assertEqual([(c["body_a"], c["body_b"]) for c in answer["contacts"]],
                         [(c["body_a"], c["body_b"]) for c in expected["contacts"]])
        for key in ("verdict", "nearest"):
            self.assertEqual(answer[key], expected[key])
        self.assertAlmostEqual(answer["clearance"], expected["clearance"], delta=1e-9)
        text = self.text("#now")
        self.assertTrue(text.startswith("moved by hand: " + expected["verdict"]), text)
        print(f"{moved}: {text}; {self.js('return swept.live.state.took'):.2f} ms")
        return expected["verdict"]

    def write_scene(self, name, bodies):
        """YAML has JSON in it."""
        objects = [{"id": each, "header": {"frame_id": "world"}, "operation": "add",
                    "primitives": [{"type": "box", "dimensions": size}], "primitive_poses": [pose]}
                   for each, (size, pose) in bodies.items()]
        file = pathlib.Path(self.folder.name) / name
        file.write_text(json.dumps({"name": "plates", "world": {"collision_objects": objects}}))
        return str(file)

    def type_move(self, way, value):
        """Into a field of the card of the picked body."""
        field = self.find(f"#picked-move input[type=number][aria-label^='move, {way},']")[0]
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(repr(value), Keys.ENTER)
        self.drawn()

    def drag_body(self, name, right, down, shift=False):
        """Presses the mouse where a body is seen, and moves it by so many pixels."""
        found = self.js(
            "const c = swept.scene.canvas, body = arguments[0];"
            "for (let y = 60; y < c.clientHeight - 4; y += 6) for (let x = 4; x < c.clientWidth - 4; x += 6)"
            "  if (swept.scene.bodyAt(x, y) === body && document.elementFromPoint(x, y) === c) return [x, y];",
            self.body(name))
        size = self.find("#view")[0].size
        chain = ActionChains(self.browser)
        if shift:
            chain.key_down(Keys.SHIFT)
        chain.move_to_element_with_offset(self.find("#view")[0], found[0] - size["width"] // 2,
                                          found[1] - size["height"] // 2).click_and_hold()
        for _ in range(4):
            chain.move_by_offset(right // 4, down // 4)
        chain.release()
        if shift:
            chain.key_up(Keys.SHIFT)
        chain.perform()
        self.drawn()

    def by(self, name):
        return self.js("const m = swept.liveBodies.moves.get(arguments[0]); return m ? m.by : null", self.body(name))

    def test_verdict_follows_bodies(self):
        at = "0.3,0.9,0,1.2,0,0.6,0"
        scene = self.write_scene("plates.yaml", PLATES)
        self.open_live("plates", ["check", ROOK, at, "--group", "arm", "--scene", scene])
        recorded = self.text("#now")
        self.assertTrue(recorded.startswith("as at "), recorded)
        self.assertEqual(self.find("#picked-move")[0].is_displayed(), False)
        self.click_on("left")
        said = []
        for way, value in (("y", -0.15), ("x", -0.07), ("turn", 30), ("z", -0.6)):
            self.type_move(way, value)
            said.append(self.judge_moved(at))
        self.assertEqual(self.by("left"), [-0.07, -0.15, -0.6, 30])
        self.assertEqual(set(said), {"free", "collision"})
        self.assertIn("1 body is moved", self.text("#moved-note"))
        took = self.js("const begin = performance.now(); swept.liveBodies.move(arguments[0], [-0.07, -0.15, -0.6, 31]);"
                       "const took = performance.now() - begin;"
                       "swept.liveBodies.move(arguments[0], [-0.07, -0.15, -0.6, 30]); return took", self.body("left"))
        print(f"from a body's move to the words: {took:.2f} ms")
        # Where it is seen is where it is checked: a corner, in the model frame.
        corner = self.js("swept.scene.scene.updateMatrixWorld(true);"
                         "return swept.scene.bodies[arguments[0]].meshes[0].localToWorld("
                         "  new THREE.Vector3(0.01, 0.2, 0.4)).toArray()", self.body("left"))
        pose = self.js("return swept.liveBodies.moves.get(arguments[0]).parts[0]", self.body("left"))
        turn = 2 * math.atan2(pose["orientation"][2], pose["orientation"][3])
        self.assert_near(corner, [pose["position"][0] + 0.01 * math.cos(turn) - 0.2 * math.sin(turn),
                                  pose["position"][1] + 0.01 * math.sin(turn) + 0.2 * math.cos(turn),
                                  pose["position"][2] + 0.4], 1e-5)
        # Dragged: level, then up; the view stays.
        camera = self.camera()
        self.click_on("right")
        self.drag_body("right", -40, 8)
        x, y, z, turn = self.by("right")
        self.assertGreater(math.hypot(x, y), 0.02)
        self.assertEqual([z, turn], [0, 0])
        self.judge_moved(at)
        self.drag_body("right", 0, -40, shift=True)
        self.assertEqual(self.by("right")[:2], [x, y])
        self.assertGreater(self.by("right")[2], 0.02)
        self.judge_moved(at)
        self.assertIn("2 bodies are moved", self.text("#moved-note"))
        self.assert_near(self.camera(), camera, 1e-9)
        # The robot by its slider, too.
        self.unfold("#joints-box")
        self.drag("joint1", 0.45)
        values = self.js("return swept.data.tree.group.map((i) => swept.playback.state.values[i])")
        self.judge_moved(",".join(map(repr, values)))
        self.find("#joints-back")[0].click()
        self.drawn()
        # One is put back by its card, all others by escape; then the record holds again.
        self.find("#picked-back")[0].click()
        self.drawn()
        self.assertIsNone(self.by("right"))
        self.judge_moved(at)
        self.press(Keys.ESCAPE)
        self.assertEqual(self.js("return swept.liveBodies.moves.size"), 0)
        self.assertEqual(self.text("#now"), recorded)
        self.assertEqual(self.text("#moved-note"), "")
        self.assert_quiet()

    def test_path_beside_moved_bodies(self):
        self.open_live("motion", ["motion", ROOK, "home", "0.3,0.9,0,1.2,0,0.6,0", "--group", "arm", "--scene",
                                  self.write_scene("plates.yaml", PLATES)])
        self.click_on("left")
        self.type_move("y", -0.25)
        said = set()
        for share in (0, 0.25, 0.5, 0.75, 1):
            self.js("swept.playback.setTime(arguments[0] * swept.data.duration)", share)
            values = self.js("return swept.data.tree.group.map((i) => "
                             "  swept.kinematics.valuesAt(swept.playback.state.time)[i])")
            said.add(self.judge_moved(",".join(map(repr, values))))
        self.assertEqual(said, {"free", "collision"})
        self.assertNotEqual(self.find(".contact-label"), [])
        self.press(Keys.ESCAPE)
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
