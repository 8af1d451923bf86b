#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The port for vcpkg says what the files for CMake say. Neither vcpkg nor the network is needed.

usage: check_vcpkg.py ROOT

The port is run with each set of its features. Names of other ports are not looked up in vcpkg: what this finds no fault
with has not been built. tests/packaging/recipes.sh builds it.
"""
import itertools
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from cmake_facts import CMakeFacts

# Names of ports that differ from CMake's.
PORTS = {"Eigen3": "eigen3", "hwy": "highway", "TBB": "tbb", "OpenSSL": "openssl", "CLI11": "cli11", "ZLIB": "zlib",
         "nlohmann_json": "nlohmann-json"}
HOST_PORTS = {"vcpkg-cmake", "vcpkg-cmake-config"}


def ports_of(packages):
    return {PORTS.get(package, package) for package in packages}


def part_of(feature):
    return feature.replace("-", "_")


def split(dependencies):
    """Names of other ports, of ports for the machine that builds, and of features of this port."""
    others, host, own = set(), set(), set()
    for dependency in dependencies:
        if isinstance(dependency, str):
            others.add(dependency)
        elif dependency["name"] == "swept" and dependency.get("default-features") is False:
            own |= {part_of(feature) for feature in dependency["features"]}
        else:
            (host if dependency.get("host") else others).add(dependency["name"])
    return others, host, own


def check_manifest(facts, manifest):
    if (manifest["name"], manifest["version"]) != ("swept", facts.version):
        yield f"is {manifest['name']} {manifest['version']}, and in CMake swept {facts.version}"
    licence = (facts.root / "LICENSE").read_text(encoding="utf-8")
    if manifest["license"] != "BSD-3-Clause" or not licence.startswith("BSD 3-Clause"):
        yield f"licence {manifest['license']} is not that of LICENSE"
    features = {part_of(name): feature for name, feature in manifest["features"].items()}
    parts = facts.below.keys() - {"core", "pages"}
    if features.keys() != parts:
        yield f"has the features {sorted(features)}, and CMake the parts {sorted(parts)}"
        return
    unknown = {part_of(name) for name in manifest["default-features"]} - parts
    if unknown:
        yield f"has no features {sorted(unknown)}, which are on by default"
    others, host, _ = split(manifest["dependencies"])
    if others != ports_of(facts.packages["core"]) or host != HOST_PORTS:
        yield f"core needs {sorted(others)} and {sorted(host)}, in CMake {sorted(facts.packages['core'])}"
    for part, feature in features.items():
        others, host, own = split(feature["dependencies"])
        if others != ports_of(facts.packages[part]) or host:
            yield f"{part} needs {sorted(others | host)}, in CMake {sorted(facts.packages[part])}"
        if facts.closure(own | {"core"}) != facts.below[part]:
            yield f"{part} is built on {sorted(own)}, in CMake on {sorted(facts.below[part])}"


def run_port(port, features):
    """First words of the lines that the port prints -> the rest of these lines."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            ["cmake", f"-DPORT={port}", f"-DFEATURES={';'.join(features)}", f"-DCURRENT_PACKAGES_DIR={folder}", "-P",
             Path(__file__).resolve().parent / "fake_vcpkg.cmake"], text=True, capture_output=True, check=False)
    if done.returncode:
        raise ValueError(f"portfile.cmake does not run: {done.stderr.strip()}")
    said = {}
    for line in done.stdout.splitlines():
        word, _, rest = line.partition(" ")
        said.setdefault(word, []).append(rest)
    return said


def check_port(facts, port, features):
    said = run_port(port, features)
    on = {"core", *map(part_of, features)}
    if [Path(folder).resolve() for folder in said["source"]] != [facts.root.resolve()]:
        yield f"builds {said['source']}, not {facts.root.resolve()}"
    options = dict(option.removeprefix("-D").split("=") for option in said["option"])
    for variable in {*options, *said.get("unused", [])}:
        package = variable.removeprefix("CMAKE_DISABLE_FIND_PACKAGE_")
        if variable not in facts.settings and (package == variable or package not in facts.sought):
            yield f"sets {variable}, which CMake's files do not know"
        elif variable not in options:
            yield f"may not use {variable}, which it does not set"
    for part in facts.below.keys() - {"core", "pages", "program"}:
        disabled = {package for package in facts.packages[part]
                    if options.get(f"CMAKE_DISABLE_FIND_PACKAGE_{package}") == "ON"}
        if bool(disabled) == (part in on):
            yield f"packages of {part} that CMake shall not find: {sorted(disabled)}"
    if options.get("SWEPT_BUILD_PROGRAM") != ("ON" if "program" in on else "OFF"):
        yield f"SWEPT_BUILD_PROGRAM is {options.get('SWEPT_BUILD_PROGRAM')}"
    if said.get("tools", []) != (["swept"] if "program" in on else []):
        yield f"keeps the programs {said.get('tools', [])}"
    folder = said["config"][0].split()
    if folder[0] != "swept" or "set(cmake_folder ${CMAKE_INSTALL_LIBDIR}" + folder[1].removeprefix("lib") not in facts.code:
        yield f"looks for CMake's files in {folder[1]}"
    if [Path(file).resolve() for file in said["licence"]] != [facts.root.resolve() / "LICENSE"]:
        yield f"licence is {said['licence']}"


def check(root):
    """One line for each fault."""
    facts = CMakeFacts(root)
    port = facts.root.resolve() / "tests/packaging/vcpkg/swept"
    manifest = json.loads((port / "vcpkg.json").read_text(encoding="utf-8"))
    yield from (f"vcpkg.json: {fault}" for fault in check_manifest(facts, manifest))
    features = sorted(manifest["features"])
    for count in range(len(features) + 1):
        for on in itertools.combinations(features, count):
            if facts.closure({"core", *map(part_of, on)} & facts.below.keys()) != {"core", *map(part_of, on)}:
                continue  # vcpkg turns on what these need
            yield from (f"portfile.cmake with {list(on)}: {fault}" for fault in check_port(facts, port, on))
    asked = set(run_port(port, []).get("feature", []))
    if asked != manifest["features"].keys():
        yield f"portfile.cmake asks for the features {sorted(asked)}, and vcpkg.json has {features}"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_vcpkg.py ROOT")
    try:
        faults = list(check(sys.argv[1]))
    except ValueError as error:
        faults = [str(error)]
    print("\n".join([*faults, f"vcpkg: {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
