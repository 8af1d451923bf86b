#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes planners_demo/pictures/page.png: a page of `swept plan`, seen in Chromium.

picture.py SWEPT, where SWEPT is the program; run from anywhere.
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURE = ROOT / "planners_demo/pictures/page.png"
COMMAND = ["plan", "models/robots/rook7/rook7.urdf", "0.23,0.53,0.12,1.44,0.35,-0.73,0.11",
           "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14", "--group", "arm", "--scene",
           "models/scenes/shelf.yaml", "--seed", "2"]
MOMENT = 0.9  # share of the path


def main():
    swept = pathlib.Path(sys.argv[1]).resolve()
    PICTURE.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.html"
        subprocess.run([swept, *COMMAND, "--html", page], cwd=ROOT, check=True)
        subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--hide-scrollbars", "--window-size=1200,720",
             "--virtual-time-budget=8000", f"--screenshot={PICTURE}", f"{page.as_uri()}#t={MOMENT}"],
            check=True, stderr=subprocess.DEVNULL)
    print(f"{PICTURE.relative_to(ROOT)}: {PICTURE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
