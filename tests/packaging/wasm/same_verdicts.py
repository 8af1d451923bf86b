#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the module for WebAssembly answers as the program does, for random states of the project's own robots.

usage: same_verdicts.py SWEPT SOURCE_FOLDER LIVE_FOLDER
"""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

STATES = 1500  # of each case; `check` lists the verdicts of more than 1000
REPORTS = 150  # of each case
# m. The two have other sines and cosines, by a last place: joints turn a link of a metre by 1e-15 of it.
SAME = 1e-9

# Robot, group, further inputs of a path file, and the least share that must be free, and that must not.
CASES = [
    ("rook7", "arm", {"scene": "scenes/shelf.yaml"}, 0.1),
    ("rook7", "arm", {"scene": "scenes/cage.yaml", "margin": 0.02}, 0.02),
    ("rook7", "arm_with_gripper", {"clouds": ["clouds/shelf.bt"], "allow": ["hand,*"]}, 0.02),
    ("rook7", "arm", {"problems": "problems.json", "set": "shelf", "index": 1}, 0.02),
    ("rook6", "arm", {"scene": "scenes/table_objects.yaml", "pad": ["*=0.01"]}, 0.02),
    ("rook6_cart", "whole_body", {"scene": "scenes/bin.yaml", "attach": ["box:0.1,0.1,0.2@tool"]}, 0.02),
    ("drifter", "body", {"scene": "scenes/narrow_slot.yaml"}, 0.005),
]


class Module:
    """The module in node."""

    def __init__(self, live, files):
        self.node = subprocess.Popen(["node", str(pathlib.Path(__file__).parent / "ask.js"), live, str(files)],
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, question):
        self.node.stdin.write(json.dumps(question) + "\n")
        self.node.stdin.flush()
        line = self.node.stdout.readline()
        if not line:
            raise RuntimeError("the module ended")
        answer = json.loads(line)
        if "error" in answer:
            raise RuntimeError(answer["error"])
        return answer


def run(swept, arguments):
    done = subprocess.run([swept, *arguments, "--json", "--quiet"], capture_output=True, text=True, check=False)
    if done.returncode > 2:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def options(inputs, models):
    """The command line of these inputs."""
    given = []
    for key, value in inputs.items():
        for each in value if isinstance(value, list) else [value]:
            name = {"clouds": "cloud"}.get(key, key)
            text = str(models / each) if key in ("scene", "clouds", "problems") else str(each)
            given += [f"--{name}", text]
    return given


def random_state(variables, generator):
    """Within the limits; without them half a turn or a metre and a half to each side."""
    state = []
    for variable in variables:
        low, high = variable.get("lower"), variable.get("upper")
        if "/rot_" in variable["name"]:
            state.append(generator.gauss(0, 1))
            if variable["name"].endswith("_w"):
                norm = math.hypot(*state[-4:])
                state[-4:] = [value / norm for value in state[-4:]]
        elif low is None or high is None:
            state.append(generator.uniform(-1.5, 1.5))
        else:
            state.append(generator.uniform(low, high))
    return state


def written(state):
    return ",".join(repr(value) for value in state)


def main():
    swept, source, live = sys.argv[1:]
    models, generator, faults = pathlib.Path(source) / "models", random.Random(1), []
    module = Module(live, models)
    for name, group, inputs, share in CASES:
        urdf = f"robots/{name}/{name}.urdf"
        info = run(swept, ["info", str(models / urdf)])
        groups = {each["name"]: each for each in info["groups"]}
        about = {variable["name"]: variable for joint in info["joints"] for variable in joint["variables"]}
        variables = [about[each] for each in groups[group]["variables"]]
        states = [random_state(variables, generator) for _ in range(STATES)]
        where = f"{name}, {group}, {json.dumps(inputs)}"

        srdf = f"robots/{name}/{name}.srdf"
        command = [str(models / urdf), "--group", group, *options(inputs, models)]
        opened = module.ask({"open": {"robot": urdf, "srdf": srdf, "group": group, **inputs}})
        expected = None
        if "problems" not in inputs:  # beside which the program takes no states
            with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
                file.write("\n".join(map(written, states)))
                file.flush()
                expected = run(swept, ["check", command[0], "@" + file.name, *command[1:]])["verdicts"]
        verdicts = module.ask({"verdicts": states})
        free = verdicts["verdicts"].count("free") / STATES
        if expected is not None:
            differing = [i for i in range(STATES) if expected[i] != verdicts["verdicts"][i]]
            faults += [f"{where}: {written(states[i])} is {expected[i]}, and {verdicts['verdicts'][i]} in the module"
                       for i in differing]
        if not share <= free <= 1 - share:
            faults.append(f"{where}: {free:.3f} of the states are free, which shows little")

        if expected is None:
            told = run(swept, ["check", *command])["states"]
            reports = module.ask({"reports": [each["values"] for each in told]})
        else:
            reports = module.ask({"reports": states[:REPORTS]})
            told = run(swept, ["check", command[0], *map(written, states[:REPORTS]), *command[1:]])["states"]
        for here, there in zip(told, reports["reports"]):
            if here["verdict"] != there["verdict"] or here["nearest"] != there["nearest"] or \
                    [(c["body_a"], c["body_b"]) for c in here["contacts"]] != \
                    [(c["body_a"], c["body_b"]) for c in there["contacts"]] or \
                    abs((here["clearance"] or 0) - (there["clearance"] or 0)) > SAME:
                faults.append(f"{where}: {json.dumps(here)}\n  in the module {json.dumps(there)}")
        print(f"{where}: {free:.1%} free; opened in {opened['seconds']:.2f} s, a verdict in "
              f"{verdicts['seconds'] / STATES * 1e6:.0f} us, a report in "
              f"{reports['seconds'] / len(told) * 1e3:.2f} ms", flush=True)
    module.node.stdin.close()
    module.node.wait()
    print(*faults[:20], sep="\n")
    print(f"{len(faults)} differences")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
