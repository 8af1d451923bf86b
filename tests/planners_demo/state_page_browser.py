#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages of `check` and `motion` in a browser: state_page_browser.py SWEPT SOURCE_FOLDER."""
import json
import pathlib

from browser_page import ROOK, BrowserTest, main
from selenium.webdriver.common.keys import Keys

HOSTILE = "</script><img src=x onerror=\"console.error('broken out')\">"


class StatePage(BrowserTest):
    """States, contacts, clouds and bodies as scene files have them."""

    def test_states_and_contacts(self):
        self.open("check", ["check", ROOK, "home", "ready", "0.2,0.4,0,1.2,0,0.8,0", "--group", "arm",
                            "--scene", "models/scenes/narrow_slot.yaml"])
        self.assertEqual(self.text("#verdict"), "3 states: 2 free, 1 in collision")
        chips = self.find(".state-chip")
        self.assertEqual([chip.text for chip in chips], ["state 1 (home)", "state 2 (ready)", "state 3"])
        self.assertEqual(self.find(".contact-label"), [])
        chips[2].click()
        self.drawn()
        self.assertEqual(self.text(".contact-label"), "link5 – plate_left")
        self.assertIn("0.2000 rad", self.text("#values"))
        self.press(Keys.ARROW_LEFT)
        self.assertEqual(self.now(), 1)
        self.assertEqual(self.find(".contact-label"), [])
        self.assert_quiet()

    def test_many_states_have_a_scrub_bar(self):
        states = [f"{i / 40},0.4,0,1.2,0,0.8,0" for i in range(20)]
        self.open("many", ["check", ROOK, *states, "--group", "arm"])
        self.assertEqual(self.find(".state-chip"), [])
        self.assertFalse(self.find("#play")[0].is_displayed())
        self.assertEqual(self.text("#clock"), "1 / 20")
        self.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.text("#clock"), "3 / 20")
        for a, b in zip(self.tip(), self.tip_of_data(2)):
            self.assertAlmostEqual(a, b, places=6)
        self.assert_quiet()

    def test_motion_in_collision(self):
        self.open("motion", ["motion", ROOK, "home", "ready", "--group", "arm", "--scene",
                             "models/scenes/narrow_slot.yaml"])
        self.assertGreater(len(self.find(".piece.collision")), 0)
        self.assertEqual(self.text(".contact-label"), "finger_left – lintel")
        self.find("#contacts button")[0].click()
        self.assertAlmostEqual(self.js("return swept.data.locate(swept.playback.state.time).t"),
                               self.js("return swept.data.motions[0].contacts[0].t"), places=6)
        self.assert_quiet()

    def test_cloud_says_what_is_proven(self):
        self.open("cloud", ["check", ROOK, "ready", "--group", "arm", "--cloud",
                            "models/clouds/shelf.bt"])
        self.assertEqual(self.text("#clouds"), "The proof is for: body shelf is 6107 balls of radius "
                         "0.0173205 m and 12 boxes")
        self.assert_shows_something(self.picture())
        self.click_on("shelf")
        self.assertEqual(self.text("#picked-name"), "shelf")
        self.assert_quiet()

    def test_primitives_have_their_sizes(self):
        """Boxes of what is drawn, against the scene file's numbers."""
        half = 0.5 ** 0.5
        things = {"box": ([0.2, 0.3, 0.4], [0, 0, 0, 1], [0.2, 0.3, 0.4]),
                  "cylinder": ([0.4, 0.1], [half, 0, 0, half], [0.2, 0.4, 0.2]),
                  "cone": ([0.6, 0.1], [0, half, 0, half], [0.6, 0.2, 0.2]),
                  "sphere": ([0.15], [0, 0, 0, 1], [0.3, 0.3, 0.3])}
        objects = [{"id": kind, "header": {"frame_id": "world"}, "operation": "add",
                    "primitives": [{"type": kind, "dimensions": given}],
                    "primitive_poses": [{"position": [1, i, 0.5], "orientation": turn}]}
                   for i, (kind, (given, turn, _)) in enumerate(things.items())]
        objects.append({"id": "floor", "header": {"frame_id": "world"}, "operation": "add",
                        "planes": [{"coef": [0, 0, 2, 0.4]}],
                        "plane_poses": [{"position": [0, 0, 0], "orientation": [0, 0, 0, 1]}]})
        scene = pathlib.Path(self.folder.name) / "primitives.yaml"
        scene.write_text(json.dumps({"world": {"collision_objects": objects}}), encoding="utf-8")
        self.open("primitives", ["check", ROOK, "ready", "--group", "arm", "--scene", str(scene)])
        drawn = self.js("swept.scene.scene.updateMatrixWorld(true); const found = {};"
                        "swept.data.bodies.forEach((body, b) => {"
                        "  const box = new THREE.Box3().setFromObject(swept.scene.bodies[b].meshes[0]);"
                        "  found[body.name] = [box.min.toArray(), box.max.toArray()]; });"
                        "return found;")
        for i, (kind, (_, _, size)) in enumerate(things.items()):
            for axis, middle in enumerate((1, i, 0.5)):
                low, high = drawn[kind][0][axis], drawn[kind][1][axis]
                self.assertAlmostEqual((low + high) / 2, middle, delta=1e-3, msg=kind)
                self.assertAlmostEqual(high - low, size[axis], delta=2e-3, msg=kind)
        self.assertAlmostEqual(drawn["floor"][0][2], -0.2, places=6)
        self.assertAlmostEqual(drawn["floor"][1][2], -0.2, places=6)
        corners = self.js(
            "const b = swept.data.bodies.findIndex((body) => body.name === 'cone');"
            "const mesh = swept.scene.bodies[b].meshes[0], p = new THREE.Vector3(), all = [];"
            "const given = mesh.geometry.getAttribute('position');"
            "for (let i = 0; i < given.count; ++i)"
            "  all.push(p.fromBufferAttribute(given, i).applyMatrix4(mesh.matrixWorld).toArray());"
            "return all;")
        for x, y, z in corners:  # the apex is ahead, along x
            self.assertLess(((y - 2) ** 2 + (z - 0.5) ** 2) ** 0.5, 0.1 * (1.3 - x) / 0.6 + 1e-5)
        self.assert_quiet()

    def test_names_are_only_text(self):
        scene = pathlib.Path(self.folder.name) / "hostile.yaml"
        scene.write_text(json.dumps({"world": {"collision_objects": [{
            "id": HOSTILE, "header": {"frame_id": "world"},
            "primitives": [{"type": "box", "dimensions": [0.3, 0.3, 0.3]}],
            "primitive_poses": [{"position": [0.9, 0, 0.5], "orientation": [0, 0, 0, 1]}],
            "operation": "add"}]}}), encoding="utf-8")
        self.open("hostile", ["check", ROOK, "ready", "--group", "arm", "--scene", str(scene)])
        self.click_on(HOSTILE)
        self.assertEqual(self.text("#picked-name"), HOSTILE)
        self.assertEqual(self.find("img"), [])
        self.assert_quiet()


if __name__ == "__main__":
    main()
