#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the robot looks like and what is proven, on a page: look_page_browser.py SWEPT SOURCE_FOLDER."""
import pathlib

import picture_file
from browser_page import ROOK, BrowserTest, main

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml"]
HIT = "0.2,0.4,0,1.2,0,0.8,0"  # link5 is in plate_left
CHECK = ["check", ROOK, "home", HIT, *SLOT]
PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]

# A box that is checked looks like a green ball; a blue mast above it is not checked at all; the base
# has no looks, and those of a ball beside it are a mesh that is not there.
ARM = """<robot name="looks">
<link name="base"><collision><geometry><box size="0.4 0.4 0.1"/></geometry></collision></link>
<link name="arm"><visual><geometry><sphere radius="0.25"/></geometry>
  <material name="green"><color rgba="0 1 0 1"/></material></visual>
  <collision><geometry><box size="0.3 0.3 0.3"/></geometry></collision></link>
<link name="mast"><visual><geometry><box size="0.1 0.1 0.5"/></geometry>
  <material name="blue"><color rgba="0 0 1 1"/></material></visual></link>
<link name="lost"><visual><geometry><mesh filename="gone.stl"/></geometry>
  <material name="red"><color rgba="1 0 0 1"/></material></visual>
  <collision><geometry><sphere radius="0.12"/></geometry></collision></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.4"/>
  <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="held" type="fixed"><parent link="arm"/><child link="mast"/><origin xyz="0 0 0.5"/></joint>
<joint name="side" type="fixed"><parent link="base"/><child link="lost"/><origin xyz="0.6 0 0"/></joint>
</robot>"""


class LookPage(BrowserTest):
    """The switch between what the robot looks like and what is proven."""

    def arm(self):
        file = pathlib.Path(self.folder.name) / "looks.urdf"
        file.write_text(ARM, encoding="utf-8")
        return ["check", str(file), "0.3"]

    def colour_shares(self):
        """Of the pixels, how many are mostly red, green and blue."""
        rows = self.picture()
        counts = [0, 0, 0]
        for row in rows:
            for pixel in row:
                for channel in range(3):
                    others = [pixel[i] for i in range(3) if i != channel]
                    counts[channel] += pixel[channel] > 60 + max(others)
        return [count / (len(rows) * len(rows[0])) for count in counts]

    def drawn_shapes(self):
        """Names of links whose visuals, and whose proven shapes, are in the picture."""
        return self.js(
            "const v = [], p = [];"
            "swept.scene.bodies.forEach((b, i) => {"
            "  if (b.visuals.some((m) => m.visible)) v.push(swept.data.bodies[i].name);"
            "  if (b.meshes.some((m) => m.visible)) p.push(swept.data.bodies[i].name); });"
            "return [v, p];")

    def test_page_opens_with_what_is_proven_in_the_colours_of_the_robot(self):
        run = self.open("arm", self.arm())
        self.assertIn("mesh 'gone.stl' of <visual> of link 'lost' not found", run.stderr)
        self.assertEqual(self.drawn_shapes(), [[], ["base", "arm", "lost"]])
        self.assertEqual(self.find("#tool-looks")[0].get_attribute("aria-pressed"), "false")
        red, green, blue = self.colour_shares()
        self.assertGreater(red, 0.002)  # `lost` has the colour of its material, if not its mesh
        self.assertGreater(green, 0.01)
        self.assertEqual(blue, 0)
        self.assertFalse(self.find("#look-note")[0].is_displayed())
        facts = self.js("return Object.fromEntries(swept.data.facts)")
        self.assertEqual(facts["visual"], "2 shapes, 1 left out")
        self.assert_quiet()

    def test_switch_shows_what_it_looks_like_and_goes_back(self):
        self.open("arm", self.arm())
        before = self.picture()
        self.press("v")
        self.assertEqual(self.drawn_shapes(), [["arm"], ["base", "lost"]])
        red, green, blue = self.colour_shares()
        self.assertGreater(red, 0.002)
        self.assertGreater(green, 0.01)
        self.assertGreater(blue, 0.003)  # the mast
        self.assertGreater(picture_file.share_changed(before, self.picture()), 0.02)
        self.assertEqual(self.text("#look-note"), "this is what the robot looks like; what is proven is about its "
                         "collision geometry; 2 links have no visual: they are shown as proven")
        self.find("#tool-looks")[0].click()
        self.drawn()
        self.assertLess(picture_file.share_changed(before, self.picture()), 0.001)
        self.assertFalse(self.find("#look-note")[0].is_displayed())
        self.assert_quiet()

    def test_what_is_not_checked_is_not_picked(self):
        self.open("arm", self.arm(), at="#shadows=off&look=visual")
        found = self.js(
            "const c = swept.scene.canvas;"
            "for (let y = 4; y < c.clientHeight; y += 6) for (let x = 4; x < c.clientWidth; x += 6) {"
            "  const hit = swept.scene.hitAt(x, y);"
            "  if (hit.link === 'mast' && document.elementFromPoint(x, y) === c) return [x, y, hit.body];"
            "} return null;")
        self.assertEqual(found[2], -1)
        canvas = self.find("#view")[0]
        for kind in ("pointerdown", "pointerup"):
            self.js("const at = arguments[0].getBoundingClientRect();"
                    "arguments[0].dispatchEvent(new PointerEvent(arguments[3], {isPrimary: true, button: 0,"
                    "  clientX: at.left + arguments[1], clientY: at.top + arguments[2]}));",
                    canvas, found[0], found[1], kind)
        self.assertEqual(self.text("#notice"), "mast has no collision geometry: it is not checked")
        self.assertFalse(self.find("#picked")[0].is_displayed())
        self.click_on("arm")
        self.assertEqual(self.text("#picked-name"), "arm")
        # It is hidden with the link that it hangs on.
        self.js("swept.bodies.set(arguments[0], false)", self.body("arm"))
        self.drawn()
        self.assertEqual(self.colour_shares()[1:], [0, 0])
        self.assert_quiet()

    def test_it_moves_with_its_links(self):
        self.open("arm", self.arm(), at="#look=visual")
        turned = self.js(
            "const mast = () => { swept.scene.scene.updateMatrixWorld(true);"
            "  return swept.scene.links[swept.data.frames.links.indexOf('mast')].matrixWorld.elements.slice(0, 2); };"
            "const first = mast(); swept.playback.setValues([1.3]); return [first, mast()];")
        for at, angle in zip(turned, (0.3, 1.3)):
            self.assertAlmostEqual(self.js("return Math.atan2(arguments[1], arguments[0])", *at), angle, delta=1e-5)

    def test_contacts_and_picks_are_shown_in_both(self):
        self.open("check", CHECK, at="#shadows=off&t=1")
        for mode in ("proven", "visual"):
            self.assertEqual([label.text for label in self.find(".contact-label")], ["link5 – plate_left"], mode)
            before = self.picture()
            self.js("swept.panel.pick(arguments[0])", self.body("link2"))
            self.drawn()
            self.assertGreater(picture_file.share_changed(before, self.picture()), 0.003, mode)
            self.js("swept.panel.pick(-1)")
            self.drawn()
            self.assertLess(picture_file.share_changed(before, self.picture()), 0.001, mode)
            self.press("v")
        self.assert_quiet()

    def test_address_leads_back_to_what_it_looks_like(self):
        self.open("plan", PLAN, at="#shadows=off&t=0.3")
        self.press("v", "g")
        self.press("l")
        hash_, seen = self.js("return location.hash"), self.drawn_shapes()
        self.assertIn("look=visual", hash_)
        self.open("plan", PLAN, at=hash_)
        self.assertEqual(self.drawn_shapes(), seen)
        self.assertIn("link4", seen[0])
        self.assertNotIn("link4", seen[1])
        self.open("plan", PLAN, at="#look=nonsense")
        self.assertEqual(self.drawn_shapes()[0], [])
        self.assert_quiet()

    def test_pages_of_robots_without_looks_have_no_switch(self):
        file = pathlib.Path(self.folder.name) / "plain.urdf"
        file.write_text('<robot name="p"><link name="a"><collision><geometry><sphere radius="1"/></geometry>'
                        '</collision></link><link name="b"/><joint name="j" type="continuous"><parent link="a"/>'
                        '<child link="b"/></joint></robot>', encoding="utf-8")
        self.open("plain", ["check", str(file), "0"])
        self.assertFalse(self.find("#tool-looks")[0].is_displayed())
        self.press("v")
        self.assertFalse(self.find("#look-note")[0].is_displayed())
        self.assert_quiet()


if __name__ == "__main__":
    main()
