#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bodies and joints of a page, in a browser: robot_page_browser.py SWEPT SOURCE_FOLDER."""
import pathlib

import picture_file
from browser_page import ROOK, BrowserTest, main
from selenium.webdriver.common.keys import Keys

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml"]
HIT = "0.2,0.4,0,1.2,0,0.8,0"  # link5 is in plate_left
CHECK = ["check", ROOK, "home", "ready", HIT, *SLOT]
PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]

# Every kind of joint, at odd angles, and two that follow another one.
JOINTS = (("slide", "prismatic", 'axis xyz="0.6 0 0.8"', '<limit lower="-1" upper="1" effort="1" velocity="1"/>'),
          ("turn", "continuous", 'axis xyz="0 1 0"', ""),
          ("bend", "revolute", 'axis xyz="1 2 2"', '<limit lower="-2" upper="2" effort="1" velocity="1"/>'),
          ("held", "fixed", None, ""),
          ("follow", "revolute", 'axis xyz="0 0 1"',
           '<limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="bend" multiplier="-1.5" offset="0.2"/>'),
          ("creep", "prismatic", 'axis xyz="0 1 0"',
           '<limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="slide" multiplier="0.5" offset="0.1"/>'),
          ("drive", "planar", 'axis xyz="1 -1 0.5"', ""),
          ("float", "floating", None, ""))

# Of these joints, with values for all of them.
STATES = ["0.4,2.9,-1.2,0.5,-0.7,2.5,0.3,-0.2,0.6,0.1,0.7,0.5,0.5",
          "-0.3,-2.8,1.7,-0.6,0.2,-2.9,0.1,0.5,-0.4,0.8,0,0,0.6"]


def odd_robot():
    links = "".join(
        f'<link name="l{i}"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>'
        for i in range(len(JOINTS) + 1))
    joints = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/>'
        f'<origin xyz="0.3 {0.1 * i} 0.2" rpy="{0.3 * i} -0.4 {0.5 + i}"/>'
        + (f"<{axis}/>" if axis else "") + more + "</joint>"
        for i, (name, kind, axis, more) in enumerate(JOINTS))
    return f'<robot name="odd">{links}{joints}</robot>'


class RobotPage(BrowserTest):
    """What is hidden, what is moved, and what is said of it."""

    def odd(self):
        file = pathlib.Path(self.folder.name) / "odd.urdf"
        file.write_text(odd_robot(), encoding="utf-8")
        return str(file)

    def test_bodies_are_hidden_and_isolated(self):
        self.open("check", CHECK)
        all_of_it = self.picture()
        self.unfold("#bodies-box")
        count = len(self.find("#bodies li"))
        self.assertEqual(count, self.js("return swept.data.bodies.length"))
        plate = self.body("plate_left")
        box = self.find("#bodies input")[plate]
        box.click()
        self.drawn()
        self.assertEqual([i for i, on in enumerate(self.shown()) if not on], [plate])
        self.assertIn("1 body is hidden; what is proven is about all", self.text("#hidden-note"))
        self.assertGreater(picture_file.share_changed(all_of_it, self.picture()), 0.01)
        self.assertFalse(self.js(
            "for (let y = 0; y < 500; y += 9) for (let x = 0; x < 460; x += 9)"
            "  if (swept.scene.bodyAt(x, y) === arguments[0]) return true; return false;", plate))
        box.send_keys(Keys.SPACE)  # the box takes it
        self.drawn()
        self.assertLess(picture_file.share_changed(all_of_it, self.picture()), 0.001)
        self.assertFalse(self.find("#hidden-note")[0].is_displayed())
        hand = self.body("hand")
        self.find("#bodies li button")[hand].click()
        self.drawn()
        self.assertEqual([i for i, on in enumerate(self.shown()) if on], [hand])
        self.press("a")
        self.assertTrue(all(self.shown()))
        self.assert_quiet()

    def test_bodies_are_found_by_name(self):
        self.open("check", CHECK)
        self.press("/", *"FING", "a")
        listed = [item.text.split("\n")[0] for item in self.find("#bodies li") if item.is_displayed()]
        self.assertEqual(listed, [])
        self.press(Keys.BACK_SPACE)
        listed = [item.text.split("\n")[0] for item in self.find("#bodies li") if item.is_displayed()]
        self.assertEqual(listed, ["finger_left", "finger_right"])
        self.find("#bodies-none")[0].click()
        self.drawn()
        hidden = [i for i, on in enumerate(self.shown()) if not on]
        self.assertEqual(hidden, [self.body("finger_left"), self.body("finger_right")])

    def test_picked_body_alone(self):
        self.open("check", CHECK)
        self.click_on("link2")
        self.find("#picked-only")[0].click()
        self.drawn()
        self.assertEqual([i for i, on in enumerate(self.shown()) if on], [self.body("link2")])

    def pose_errors(self, frame_of):
        """Largest differences (m, and of quaternions) of the page's own poses and the checker's."""
        return self.js(
            "const d = swept.data, frame = " + frame_of + ";"
            "let worst = [0, 0];"
            "const times = d.isPath ? [].concat(...d.motions.map((m, i) =>"
            "  Array.from({length: m.steps + 1}, (_, k) => [i, k / m.steps])))"
            "  : d.states.map((s, i) => [i, 0]);"
            "for (const [index, t] of times) {"
            "  const time = d.isPath && t === 1 ? d.timeOf(index, 1 - 1e-12) : d.timeOf(index, t);"
            "  const poses = swept.kinematics.poses(swept.kinematics.valuesAt(time));"
            "  d.frames.links.forEach((name, link) => {"
            "    const at = d.poseAt(frame(index, t), link), p = new THREE.Vector3();"
            "    const q = new THREE.Quaternion(), s = new THREE.Vector3();"
            "    poses[d.tree.links.indexOf(name)].decompose(p, q, s);"
            "    worst[0] = Math.max(worst[0], p.distanceTo(new THREE.Vector3().fromArray(d.poses, at)));"
            "    const dot = Math.abs(q.dot(new THREE.Quaternion().fromArray(d.poses, at + 3)));"
            "    worst[1] = Math.max(worst[1], 1 - dot);"
            "  }); } return worst.concat([times.length]);")

    def test_own_kinematics_are_the_checkers_for_every_joint(self):
        """Poses of the page's own kinematics, against those that the program stored."""
        self.open("odd_states", ["check", self.odd(), "--", *STATES])
        self.assertEqual(sorted({joint["type"] for joint in self.js("return swept.data.tree.joints")}),
                         ["continuous", "fixed", "floating", "planar", "prismatic", "revolute"])
        metres, turn, looked_at = self.pose_errors("(index) => index")
        self.assertEqual(looked_at, 2)
        self.assertLess(metres, 2e-6)
        self.assertLess(turn, 1e-6)
        # On the way, too: angles the shorter way, orientations around one axis.
        self.open("odd_motion", ["motion", self.odd(), "--", *STATES])
        metres, turn, looked_at = self.pose_errors("(i, t) => d.motions[i].first_frame + t * d.motions[i].steps")
        self.assertEqual(looked_at, 49)
        self.assertLess(metres, 2e-6)
        self.assertLess(turn, 1e-6)
        self.assert_quiet()

    def test_sliders_move_the_robot_and_say_that_it_is_not_checked(self):
        self.open("check", CHECK)
        before = self.picture()
        self.unfold("#joints-box")
        number = self.find('.slider input[type="number"]')[1]
        self.assertEqual(float(number.get_attribute("value")), self.js("return swept.data.states[0].values[1]"))
        number.send_keys(Keys.CONTROL + "a", Keys.NULL, "0.9", Keys.TAB)
        self.drawn()
        self.assertRegex(self.text("#now"), r"^moved by hand: not checked\. The nearest that is, with "
                         r"joint\d \d\.\d{3} rad away, is state \d")
        self.assertGreater(picture_file.share_changed(before, self.picture()), 0.01)
        self.assertEqual(self.find(".contact-label"), [])
        where = self.tip()
        expected = self.js("const d = swept.data, v = d.tree.reference.slice();"
                           "d.tree.group.forEach((g, i) => { v[g] = d.states[0].values[i]; });"
                           "v[d.tree.group[1]] = 0.9;"
                           "const p = swept.kinematics.poses(v)[d.tree.links.indexOf(d.tip)];"
                           "return p.elements.slice(12, 15);")
        self.assert_near(where, expected, 1e-6)
        self.js("swept.panel.pick(arguments[0])", self.body("hand"))
        self.assertIn("moved by hand: not checked", self.text("#picked-facts"))
        self.find("#joints-back")[0].click()
        self.drawn()
        self.assertEqual(self.text("#now")[:19], "as at state 1 (home")
        self.js("swept.panel.pick(-1)")
        self.assertLess(picture_file.share_changed(before, self.picture()), 0.001)
        self.assert_quiet()

    def test_typed_values_keep_limits_where_there_are_some(self):
        self.open("odd_states", ["check", self.odd(), "--", *STATES])
        self.unfold("#joints-box")
        shown = [(name, self.find(f'input[type="number"][aria-label="{name}"]')[0])
                 for name in ("bend, rad", "drive/x, m")]
        for (name, box), kept in zip(shown, (2.0, 7.0)):  # what has no limits is where it was sent
            box.send_keys(Keys.CONTROL + "a", Keys.NULL, "7", Keys.TAB)
            self.drawn()
            self.assertEqual(float(box.get_attribute("value")), kept, name)
        self.assertEqual(self.text("#notice"), "bend is limited to -2.0000 to 2.0000")
        before = self.text("#now")
        shown[0][1].send_keys(Keys.CONTROL + "a", Keys.NULL, Keys.DELETE, Keys.TAB)  # nothing is no value
        self.assertEqual(float(shown[0][1].get_attribute("value")), 2.0)
        self.assertEqual(self.text("#now"), before)
        self.assert_quiet()

    def test_values_of_a_checked_state_have_its_verdict(self):
        """Moved by hand to exactly what was checked, the robot is as it was there."""
        self.open("check", CHECK)
        for state, word in ((1, "free"), (2, "collision")):
            self.js("const d = swept.data, v = d.tree.reference.slice();"
                    "d.tree.group.forEach((g, i) => { v[g] = d.states[arguments[0]].values[i]; });"
                    "swept.playback.setValues(v);", state)
            self.assertRegex(self.text("#now"), rf"^as at state {state + 1}.*: {word}")
        self.js("const v = swept.playback.state.values.slice(); v[0] += 1e-6; swept.playback.setValues(v);")
        self.assertRegex(self.text("#now"), "^moved by hand: not checked")

    def test_arrows_of_a_slider_are_the_sliders(self):
        self.open("plan", PLAN)
        self.unfold("#joints-box")
        slider = self.find('.slider input[type="range"]')[0]
        before = float(slider.get_attribute("value"))
        slider.send_keys(Keys.ARROW_RIGHT)
        self.drawn()
        self.assertGreater(float(slider.get_attribute("value")), before)
        self.assertEqual(self.now(), 0)
        self.assertRegex(self.text("#now"), "^moved by hand")
        self.press(Keys.ESCAPE)
        self.assertRegex(self.text("#now"), r"^as at path point 0\.000: free")


if __name__ == "__main__":
    main()
