#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a page's tools do, in a browser: view_page_browser.py SWEPT SOURCE_FOLDER."""
import pathlib
import time

import picture_file
from browser_page import ROOK, SHRUNK, BrowserTest, main, run_swept
from selenium.webdriver.common.keys import Keys

SLOT = ["--group", "arm", "--scene", "models/scenes/narrow_slot.yaml"]
HIT = "0.2,0.4,0,1.2,0,0.8,0"  # link5 is in plate_left
CHECK = ["check", ROOK, "home", "ready", HIT, *SLOT]
PLAN = ["plan", ROOK, "--group", "arm", "--problems", "models/problems.json", "--set", "shelf",
        "--index", "1"]
ENDS = ["0.23,0.53,0.12,1.44,0.35,-0.73,0.11", "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14"]

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


class ViewPage(BrowserTest):
    """Cameras, bodies, joints, paths, pictures and addresses."""

    def odd(self):
        file = pathlib.Path(self.folder.name) / "odd.urdf"
        file.write_text(odd_robot(), encoding="utf-8")
        return str(file)

    def unfold(self, selector):
        """Opens a part of the panel that is folded at first."""
        self.assertFalse(self.js("return document.querySelector(arguments[0]).open", selector))
        self.find(selector + " summary")[0].click()
        self.drawn()
        self.assertTrue(self.js("return document.querySelector(arguments[0]).open", selector))

    def camera(self):
        return self.js("return swept.scene.camera.position.toArray()"
                       "  .concat(swept.scene.controls().target.toArray());")

    def body(self, name):
        return self.js("return swept.data.bodies.findIndex((b) => b.name === arguments[0])", name)

    def shown(self):
        return self.js("return swept.scene.bodies.map((b) => b.group.visible)")

    def assert_near(self, values, others, delta):
        self.assertEqual(len(values), len(others))
        for a, b in zip(values, others):
            self.assertAlmostEqual(a, b, delta=delta)

    # A plan that failed.

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
        self.open("bad_start", [], at="#t=1&shadows=on")  # the address has the last word
        self.assertEqual(self.now(), 1)

    def test_failed_plan_with_both_ends_bad_says_so_in_a_line(self):
        self.open("bad_ends", ["plan", ROOK, HIT, "0.21,0.4,0,1.2,0,0.8,0", *SLOT])
        self.assertEqual(self.text("#verdict"), "not solved: start and goal are in collision")

    # Bodies.

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

    # Joints.

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
        states = ["0.4,2.9,-1.2,0.5,-0.7,2.5,0.3,-0.2,0.6,0.1,0.7,0.5,0.5",
                  "-0.3,-2.8,1.7,-0.6,0.2,-2.9,0.1,0.5,-0.4,0.8,0,0,0.6"]
        self.open("odd_states", ["check", self.odd(), "--", *states])
        self.assertEqual(sorted({joint["type"] for joint in self.js("return swept.data.tree.joints")}),
                         ["continuous", "fixed", "floating", "planar", "prismatic", "revolute"])
        metres, turn, looked_at = self.pose_errors("(index) => index")
        self.assertEqual(looked_at, 2)
        self.assertLess(metres, 2e-6)
        self.assertLess(turn, 1e-6)
        # On the way, too: angles the shorter way, orientations around one axis.
        self.open("odd_motion", ["motion", self.odd(), "--", *states])
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
        number.clear()
        number.send_keys("0.9", Keys.TAB)
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

    def test_moment_of_a_path_has_the_verdict_of_its_part(self):
        self.open("motion", ["motion", ROOK, "home", "ready", *SLOT])
        tiers = self.js("return swept.data.motions[0].pieces.tiers")
        for piece, tier in enumerate(tiers):
            self.js("swept.playback.setTime(swept.data.timeOf(0, arguments[0]))", (piece + 0.5) / len(tiers))
            words = {"collision": "in a part that is in collision", "undecided": "undecided"}
            self.assertIn(words.get(tier, "free, keeps"), self.text("#now"))
        self.assertIn("collision", tiers)

    # Cameras.

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

    # Pictures.

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

    # The worst moment.

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

    # Several paths.

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

    # Shadows.

    def open_with_clock(self, step):
        """The page, with a clock that goes on by so many ms from each picture to the next."""
        script = self.tell("Page.addScriptToEvaluateOnNewDocument", {"source": (
            "{ const real = window.requestAnimationFrame.bind(window); let now = 0, seen = null;"
            "const tell = (f) => (time) => {"
            f"  if (time !== seen) now += {step};"
            "  seen = time; f(now); };"
            "window.requestAnimationFrame = (f) => real(tell(f)); }")})
        try:
            self.open("plan", PLAN, at="")
        finally:
            self.tell("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script["identifier"]})

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

    # For everyone.

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
