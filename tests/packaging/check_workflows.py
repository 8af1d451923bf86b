#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The workflows of .github run what is in the tree, and describe nothing of the build a second time.

usage: check_workflows.py ROOT

Each command must be a script of the tree, or install what a checkout takes, or what a recipe is for. Presets that the
scripts name are there, what a script is told to do it knows, and tests/packaging/README.md says of each system what ran.
"""
import itertools
import json
import os
import re
import sys
from pathlib import Path

import yaml

# Commands that no script can have: the tree is not there yet, or the recipe's tool.
OTHER_COMMANDS = {"apt-get update -q", "apt-get install -q -y --no-install-recommends git ca-certificates",
                  "git config --global --add safe.directory '*'", "pipx install conan"}
ACTIONS = {"actions/checkout@v4", "actions/upload-artifact@v4"}
# Scripts that are told what to do: the functions of theirs that say what they know begin so.
TOLD = {".ci/nightly": "nightly_", "tests/packaging/recipes.sh": "recipe_"}
SYSTEMS = re.compile(r"(debian|ubuntu)[:-](\d+(?:\.\d+)?)(?:-arm)?")


def combinations(job):
    """The values of a job's matrix, a dictionary for each run."""
    matrix = dict(job.get("strategy", {}).get("matrix", {}))
    included = matrix.pop("include", [])
    runs = [dict(zip(matrix, values)) for values in itertools.product(*matrix.values())]
    for more in included:
        fitting = [run for run in runs if all(run[name] == value for name, value in more.items() if name in matrix)]
        for run in fitting:
            run.update(more)
        if not fitting:
            runs.append(dict(more))
    return runs


def filled_in(text, values):
    """A text with the values of the matrix; KeyError names one that there is not."""
    return re.sub(r"\$\{\{ matrix\.([\w-]+) \}\}", lambda match: str(values[match.group(1)]), text)


def known_to(root, script):
    text = (root / script).read_text(encoding="utf-8")
    return set(re.findall(rf"(?m)^{TOLD[script]}(\w+)\(\)", text))


def check_command(root, command, told):
    if command in OTHER_COMMANDS:
        return
    words = command.split()
    script = words[0].removeprefix("./")
    if not words[0].startswith("./"):
        yield f"'{command}' is no script of the tree"
    elif not (root / script).is_file() or not os.access(root / script, os.X_OK):
        yield f"{script} is no program in the tree"
    elif script in TOLD:
        unknown = set(words[1:]) - known_to(root, script)
        if unknown or len(words) < 2:
            yield f"'{command}': {script} knows {sorted(known_to(root, script))}"
        told.setdefault(script, set()).update(words[1:])
    elif len(words) > 1:
        yield f"'{command}': {script} is told nothing elsewhere"


def check_job(root, job, told, systems):
    if not isinstance(job.get("timeout-minutes"), int):
        yield "has no timeout-minutes, and would run for six hours"
    for values in combinations(job):
        try:
            where = [filled_in(job["runs-on"], values)]
            if "container" in job:
                where.append(filled_in(job["container"]["image"], values))
            named = [SYSTEMS.fullmatch(place) for place in where]
            if not all(named):
                yield f"runs on {where}, which is no system with a version"
            else:
                systems.add(named[-1].groups())
            for step in job["steps"]:
                if "uses" in step and step["uses"] not in ACTIONS:
                    yield f"uses {step['uses']}"
                for line in filled_in(step.get("run", ""), values).splitlines():
                    yield from check_command(root, line.strip(), told)
        except KeyError as missing:
            yield f"{missing} has no value in {values}"


def check_presets(root):
    """Presets that scripts of the tree name."""
    presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
    there = {kind: {preset["name"] for preset in presets[f"{kind}Presets"] if not preset.get("hidden")}
             for kind in ("configure", "build", "test")}
    scripts = [path for path in sorted((root / ".ci").iterdir()) if path.suffix != ".txt"]
    for path in [*scripts, *sorted((root / "tests").glob("*.sh")), *sorted((root / "tests/fuzz").glob("*.sh"))]:
        text = path.read_text(encoding="utf-8")
        named = {"configure": set(re.findall(r"cmake --preset (\w+)", text)),
                 "build": set(re.findall(r"cmake --build --preset (\w+)", text)),
                 "test": set(re.findall(r"ctest --preset (\w+)", text))}
        if path.name == "nightly":
            built = set(re.findall(r"(?m)^  build (\w+)", text))
            named["configure"] |= built
            named["build"] |= built
        for kind, names in named.items():
            if names - there[kind]:
                yield f"{path.relative_to(root)} names {kind} presets that are not there: {sorted(names - there[kind])}"


def check_lists(root):
    """What a system lacks is in a list of what is installed."""
    def packages(path):
        lines = (line.partition("#")[0].strip() for line in path.read_text(encoding="utf-8").splitlines())
        return {line for line in lines if line}

    listed = set().union(*(packages(path) for path in (root / ".ci").glob("*-packages.txt")))
    for path in sorted((root / ".ci").glob("not-on-*.txt")):
        for package in sorted(packages(path) - listed):
            yield f".ci/{path.name}: {package} is in no list of packages"


def check(root):
    """One line for each fault."""
    root = Path(root)
    files = sorted((root / ".github/workflows").glob("*.yml"))
    if not files:
        yield ".github/workflows: no workflow"
    told, systems = {}, set()
    for path in files:
        try:
            workflow = yaml.safe_load(path.read_text(encoding="utf-8"))
        except yaml.YAMLError as error:
            yield f"{path.name}: {error}"
            continue
        if workflow.get("permissions") != {"contents": "read"}:
            yield f"{path.name}: may do more than read"
        for name, job in workflow["jobs"].items():
            yield from (f"{path.name}: {name}: {fault}" for fault in dict.fromkeys(check_job(root, job, told, systems)))
    for script in TOLD:
        left = known_to(root, script) - told.get(script, set())
        if left:
            yield f"no workflow has {script} do {sorted(left)}"
    page = (root / "tests/packaging/README.md").read_text(encoding="utf-8")
    for system, version in sorted(systems):
        if f"| {system.capitalize()} {version} |" not in page:
            yield f"tests/packaging/README.md has no row of {system.capitalize()} {version}"
    yield from check_presets(root)
    yield from check_lists(root)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_workflows.py ROOT")
    faults = list(check(sys.argv[1]))
    print("\n".join([*faults, f"workflows: {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
