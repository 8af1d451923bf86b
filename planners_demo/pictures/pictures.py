#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of planners_demo/pictures: pages of `swept` and of an example, seen in Chromium.

pictures.py SWEPT [NAME ...], where SWEPT is the program, with the examples in a folder beside it; without
names all; run from anywhere.
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "planners_demo/pictures"
ROBOT = "models/robots/rook7/rook7.urdf"
# Command, and what follows the page's address: the share of the path that is shown.
PICTURES = {
    "page": (["plan", ROBOT, "0.23,0.53,0.12,1.44,0.35,-0.73,0.11",
              "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14", "--group", "arm", "--scene",
              "models/scenes/shelf.yaml", "--seed", "2"], "#t=0.9"),
    "collision": (["motion", ROBOT, "home", "ready", "--group", "arm", "--scene",
                   "models/scenes/narrow_slot.yaml"], "#t=0.42"),
    "cloud": (["plan", ROBOT, "-0.9,0.4,0,1.9,0,0.8,0", "0.9,0.4,0,1.9,0,0.8,0", "--group", "arm",
               "--cloud", "models/clouds/shelf.bt"], "#t=0.5"),
}
# The example that writes the page, in the same way.
EXAMPLES = {"trajectory": ("example_17_trajectory_page", "#t=0.35")}


def command_and_address(swept, name, page):
    if name in EXAMPLES:
        example, address = EXAMPLES[name]
        return [swept.parent / "examples" / example, "models", page.name], address
    command, address = PICTURES[name]
    return [swept, *command, "--html", page.name], address


def draw(swept, name):
    picture = FOLDER / f"{name}.png"
    with tempfile.TemporaryDirectory() as folder:
        # Pages show their command: as a reader would type it.
        page = pathlib.Path(folder) / "page.html"
        page.with_name("models").symlink_to(ROOT / "models")
        command, address = command_and_address(swept, name, page)
        # Exit code 1: a collision, which is what there is to see.
        run = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL)
        if run.returncode not in (0, 1):
            sys.exit(f"pictures.py: {command[0].name} ended with exit code {run.returncode}")
        subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--hide-scrollbars", "--window-size=1200,720",
             "--virtual-time-budget=8000", f"--screenshot={picture}", page.as_uri() + address],
            check=True, stderr=subprocess.DEVNULL)
    print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size} bytes")


def main():
    swept = pathlib.Path(sys.argv[1]).resolve()
    FOLDER.mkdir(exist_ok=True)
    for name in sys.argv[2:] or [*PICTURES, *EXAMPLES]:
        draw(swept, name)


if __name__ == "__main__":
    main()
