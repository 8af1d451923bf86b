# SPDX-License-Identifier: BSD-3-Clause
"""Pages of trajectories, which the program trajectory_pages makes, and their plots."""
import json
import re

from browser_page import BrowserTest

KINDS = ("position", "velocity", "acceleration")

# Places in a plot as its axes say, by the labels: [a, b, c, d] of value = a + b * y, time = c + d * x.
AXES = """
const svg = document.querySelector('#plot-' + arguments[0] + ' svg');
const fit = (points) => {
  const [first, last] = [points[0], points[points.length - 1]];
  const slope = (last[1] - first[1]) / (last[0] - first[0]);
  return [first[1] - slope * first[0], slope];
};
const side = [...svg.querySelectorAll('.side')].map((t, i) =>
    [Number(svg.querySelectorAll('.grid')[i].getAttribute('y1')), parseFloat(t.textContent)]);
const below = [...svg.querySelectorAll('.below')].map((t) => [Number(t.getAttribute('x')), parseFloat(t.textContent)]);
return fit(side).concat(fit(below));
"""


def points_of(path):
    return [tuple(map(float, point)) for point in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path)]


class TrajectoryTest(BrowserTest):
    """Opens pages by their name in trajectory_pages.cpp."""

    def page(self, name, width=1280, height=800, **more):
        self.open(name, [name], width, height, **more)
        file, _ = self.make(name, [name])
        return json.loads(file.with_suffix(".json").read_text(encoding="utf-8"))

    def axes(self, kind):
        return self.js(AXES, kind)

    def lines(self, kind, selector=".line"):
        return self.js("return [...document.querySelectorAll('#plot-' + arguments[0] + ' ' + arguments[1])]"
                       ".map((p) => p.getAttribute('d'));", kind, selector)
