# SPDX-License-Identifier: BSD-3-Clause
"""Pages of `swept`, opened from disk in headless Chromium. Tests derive from BrowserTest."""
import base64
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import picture_file

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(0)

SWEPT, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
ROOK = "models/robots/rook7/rook7.urdf"
BUSY = 120  # s; a busy machine draws slowly
SHRUNK = 4  # how many pixels of the screen are one of a picture, each way


def run_swept(arguments):
    return subprocess.run([SWEPT, *arguments], cwd=SOURCE, capture_output=True, text=True, check=False)


def new_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader", "--hide-scrollbars", "--force-device-scale-factor=1"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
    browser = webdriver.Chrome(service=service, options=options)
    browser.set_script_timeout(BUSY)
    return browser


class BrowserTest(unittest.TestCase):
    """One browser and one folder for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = new_browser()
        cls.made = {}

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def make(self, name, arguments):
        """Makes a page once; (file, what the program said)."""
        file = pathlib.Path(self.folder.name) / (name + ".html")
        if name not in self.made:
            self.made[name] = run_swept([*arguments, "--html", str(file)])
            self.assertTrue(file.exists(), self.made[name].stderr)
        return file, self.made[name]

    def open(self, name, arguments, width=800, height=500, phone=False, at="#shadows=off"):
        """Opens a page, at what follows its name; what the browser logged so far is forgotten.

        Shadows double the time that a page takes to open; left to itself it may leave them out later, and pictures of
        one test would differ.
        """
        file, run = self.make(name, arguments)
        self.tell("Emulation.setDeviceMetricsOverride",
                  {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone})
        self.browser.get("about:blank")
        self.browser.get_log("browser")
        self.browser.get_log("performance")
        self.browser.get(file.as_uri() + at)
        # On a busy machine the driver may come back before all of the page's scripts have run.
        WebDriverWait(self.browser, BUSY).until(
            lambda _: self.js("return document.readyState") == "complete")
        if not self.js("return swept.ready"):
            self.fail(f"the page is not ready: {self.browser.get_log('browser')}")
        self.drawn()
        return run

    def tell(self, command, arguments):
        return self.browser.execute_cdp_cmd(command, arguments)

    def js(self, code, *arguments):
        return self.browser.execute_script(code, *arguments)

    def drawn(self):
        """Waits until what was changed is on the screen."""
        self.browser.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => done()));")

    def press(self, *keys):
        ActionChains(self.browser).send_keys(*keys).perform()
        self.drawn()

    def find(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.find(selector)[0].text

    def picture(self):
        """Rows of pixels of the canvas, without what lies over it, a quarter as wide and high."""
        over = "for (const id of ['tools', 'views', 'notes', 'legend', 'contact-labels', 'picked'])" \
               "  document.getElementById(id).style.visibility = arguments[0];"
        self.js(over, "hidden")
        self.drawn()
        at = self.find("#view")[0].rect
        clip = {"x": at["x"], "y": at["y"], "width": at["width"], "height": at["height"],
                "scale": 1 / SHRUNK}
        shot = self.tell("Page.captureScreenshot", {"format": "png", "clip": clip})
        self.js(over, "")
        return picture_file.read_png(base64.b64decode(shot["data"]))

    def assert_shows_something(self, rows):
        """Neither blank nor filled: the corners are background."""
        share = picture_file.share_unlike(rows, rows[0][0])
        self.assertGreater(share, 0.05)
        self.assertLess(share, 0.8)

    def assert_quiet(self):
        """Nothing went wrong and nothing was asked of a network."""
        self.assertEqual([entry["message"] for entry in self.browser.get_log("browser")], [])
        urls = []
        for entry in self.browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                urls.append(message["params"]["request"]["url"])
        self.assertEqual([url for url in urls if not url.startswith("file:///")], [])
        self.assertEqual(len(urls), 1)

    def tip(self):
        """Where the tip's frame is in the picture, m."""
        return self.js("swept.scene.scene.updateMatrixWorld(true);"
                       "const p = new THREE.Vector3().setFromMatrixPosition("
                       "  swept.scene.links[swept.data.tipIndex].matrixWorld);"
                       "return [p.x, p.y, p.z];")

    def tip_of_data(self, frame):
        return self.js("const d = swept.data, at = d.poseAt(arguments[0], d.tipIndex);"
                       "return Array.from(d.poses.slice(at, at + 3));", frame)

    def now(self):
        return self.js("return swept.playback.state.time")

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

    def click_on(self, name):
        """Presses the mouse where a body is seen; where that is."""
        found = self.js(
            "const c = swept.scene.canvas;"
            "for (let y = 60; y < c.clientHeight - 4; y += 12)"
            "  for (let x = 4; x < c.clientWidth - 4; x += 12) {"
            "    const b = swept.scene.bodyAt(x, y);"
            "    if (b >= 0 && swept.data.bodies[b].name === arguments[0] &&"
            "        document.elementFromPoint(x, y) === c) return [x, y];"
            "  } return null;", name)
        self.assertIsNotNone(found, name)
        canvas = self.find("#view")[0]
        size = canvas.size
        ActionChains(self.browser).move_to_element_with_offset(
            canvas, found[0] - size["width"] // 2, found[1] - size["height"] // 2).click().perform()
        self.drawn()
        return found


def run_tests():
    """Runs the tests of the program, or says why it cannot."""
    for program in ("chromium", "chromedriver"):
        if shutil.which(program) is None:
            print(f"skipped: {program} is not installed")
            sys.exit(0)
    unittest.main(argv=sys.argv[:1])


def main():
    """The same where `swept` makes the pages."""
    if "--html" not in run_swept(["plan", "--help"]).stdout:
        print("skipped: swept was built without three.js")
        sys.exit(0)
    run_tests()
