#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The checks of recipes and workflows find no fault with the tree, and each of these faults in a copy of it.

usage: checks_test.py ROOT
"""
import shutil
import sys
import tempfile
from pathlib import Path

import check_conan
import check_vcpkg
import check_workflows

CONAN = "tests/packaging/conan/conanfile.py"
TESTED = "tests/packaging/conan/test_package/conanfile.py"
PORT = "tests/packaging/vcpkg/swept/"
BUILD = ".github/workflows/build.yml"
NIGHTLY = ".github/workflows/nightly.yml"
# Of Debian 12 and 13.
VERSIONS = {"liburdfdom-dev": {12: "3.0.1", 13: "4.0.0"}, "libssl-dev": {12: "3.0.19", 13: "3.5.9"},
            "libtbb-dev": {12: "2021.8.0", 13: "2022.1.0"}}


def conan(root):
    return check_conan.check(root, lambda package: VERSIONS.get(package, {}))


def vcpkg(root):
    return check_vcpkg.check(root)


def workflows(root):
    return check_workflows.check(root)


# A file, what is replaced in it by what, who must notice, and a part of what that says.
FAULTS = [
    (conan, "CMakeLists.txt", " AND tinyxml2_FOUND", "", "requires ['assimp'"),
    (conan, "CMakeLists.txt", "VERSION 0.1.0", "VERSION 0.2.0\n  #", None),
    (conan, "planners_demo/packaging/CMakeLists.txt", "TBB urdfdom assimp", "TBB assimp",
     "component robot_model: links ['assimp', 'onetbb', 'tinyxml2', 'urdfdom', 'yaml-cpp'], and in CMake ['TBB', 'assimp'"),
    (conan, "planners_demo/packaging/CMakeLists.txt", "FLAGS -ffp-contract=off", "FLAGS -ffp-contract=on",
     "programs are compiled with ['-ffp-contract=off'], and in CMake with ['-ffp-contract=on']"),
    (conan, "core/CMakeLists.txt", "get_target_property(highway_headers hwy::hwy ",
     "get_target_property(highway_headers highway ", "cmake_target_name of highway::hwy is hwy::hwy"),
    (conan, CONAN, '["OMPL"]', '["Ompl"]', "CMake's files have no '${Ompl_INCLUDE_DIRS}'"),
    (conan, CONAN, '"robot_model", "openssl::crypto"', '"robot_model"', "component proofs: links []"),
    (conan, CONAN, '"proofs": ["robot_model", ', '"proofs": ["core", ', "component proofs: is built on ['core']"),
    (conan, CONAN, '("ompl_bridge", ["robot_model"]),', "", "is accepted"),
    (conan, CONAN, '"SWEPT_INSTALL": True', '"SWEPT_INSTALLED": True', "sets SWEPT_INSTALLED"),
    (conan, CONAN, '"proofs": "OpenSSL"', '"proofs": "Openssl"', "packages of proofs that CMake shall not find: []"),
    (conan, CONAN, '"program" in self._parts(),', "False,", "SWEPT_BUILD_PROGRAM is False"),
    (conan, CONAN, '= ("eigen", "ompl")', '= ("ompl",)', "component core: its headers include those of ['eigen']"),
    (conan, CONAN, '"nlohmann_json", "cli11"', '"nlohmann_json", "assimp", "cli11"', "which programs do not see"),
    (conan, CONAN, '"ompl_bridge", "planners_demo"):', '"ompl_bridge"):', "takes the folders"),
    (conan, CONAN, "urdfdom/[>=3.0.1 <5]", "urdfdom/[>=3.1.1 <5]", "the tests run with 3.0.1"),
    (conan, CONAN, "urdfdom/[>=3.0.1 <5]", "urdfdom/[>=3.0.1 <4]", "urdfdom/[>=3.0.1 <4] has not Debian 13's 4.0.0"),
    (conan, CONAN, "onetbb/[>=2021.8.0 <2023]", "onetbb/[>=2021.8.0 <2022]", "has not Debian 13's 2022.1.0"),
    (conan, CONAN, "ompl/[>=1.5.2 <2]", "ompl/1.5.2", "ompl/1.5.2 is no range"),
    (conan, CONAN, "check_min_cppstd(self, 20)", "check_min_cppstd(self, 17)", "asks for C++17, and CMake for 20"),
    (conan, CONAN, '"swept_{part}"', '"swept-{part}"', "is ['swept-core']"),
    (conan, CONAN, 'os != "Linux"', 'os == "Macos"', "is accepted on Windows"),
    (conan, TESTED, '"full" if', '"whole" if', "which is no program with ompl_bridge"),
    (conan, TESTED, "programs / 'motion'", "programs / 'motions'", "runs programs/motions, and full has motion"),
    (conan, TESTED, "rook7.urdf", "rook8.urdf", "rook8.urdf is not there"),
    (conan, TESTED, 'if self._has("robot_model") and not', "if", "is refused: no program"),
    (vcpkg, "CMakeLists.txt", "VERSION 0.1.0", "VERSION 0.2.0", "is swept 0.1.0, and in CMake swept 0.2.0"),
    (vcpkg, "CMakeLists.txt", "if(TARGET swept_robot_model AND OPENSSL_FOUND)", "if(OPENSSL_FOUND)",
     "proofs is built on ['robot_model'], in CMake on ['core']"),
    (vcpkg, PORT + "vcpkg.json", '"tbb", ', "", "robot_model needs ['assimp', 'nlohmann-json', 'tinyxml2'"),
    (vcpkg, PORT + "vcpkg.json", '"ccd",\n', "", "core needs ['eigen3', 'highway']"),
    (vcpkg, PORT + "vcpkg.json", '"default-features": ["ompl-bridge"', '"default-features": ["bridge"', "no features ['bridge']"),
    (vcpkg, PORT + "portfile.cmake", "/../../../..", "/../../..", "builds ["),
    (vcpkg, PORT + "portfile.cmake", "-DSWEPT_BUILD_TESTS=OFF", "-DSWEPT_TESTS=OFF", "sets SWEPT_TESTS"),
    (vcpkg, PORT + "portfile.cmake", "  INVERTED_FEATURES\n", "", "packages of proofs that CMake shall not find: []"),
    (vcpkg, PORT + "portfile.cmake", "lib/cmake/swept", "lib/swept", "looks for CMake's files in lib/swept"),
    (vcpkg, PORT + "portfile.cmake", "TOOL_NAMES swept", "TOOL_NAMES swept-mpi", "keeps the programs ['swept-mpi']"),
    (vcpkg, PORT + "portfile.cmake", "}/LICENSE", "}/COPYING", "licence is"),
    (workflows, BUILD, "run: ./.ci/run", "run: ./.ci/runs", ".ci/runs is no program"),
    (workflows, BUILD, "run: ./.ci/run", "run: cmake --preset release", "'cmake --preset release' is no script"),
    (workflows, BUILD, "run: ./.ci/run", "run: ./tests/run.sh --fast", "tests/run.sh is told nothing elsewhere"),
    (workflows, BUILD, "runner: ubuntu-24.04 }", "runner: ubuntu-latest }", "which is no system with a version"),
    (workflows, BUILD, "contents: read", "contents: write", "may do more than read"),
    (workflows, BUILD, "    timeout-minutes: 180\n", "", "has no timeout-minutes"),
    (workflows, BUILD, "jobs:", "jobs: {", "build.yml: while parsing"),
    (workflows, BUILD, '"ubuntu:24.04"', '"ubuntu:25.10"', "has no row of Ubuntu 25.10"),
    (workflows, NIGHTLY, "[asan, tsan,", "[msan, tsan,", "no workflow has .ci/nightly do ['asan']"),
    (workflows, NIGHTLY, "[asan, tsan,", "[msan, asan, tsan,", "'./.ci/nightly msan': .ci/nightly knows ['arm', 'asan'"),
    (workflows, NIGHTLY, "nightly ${{ matrix.what }}", "nightly ${{ matrix.which }}", "'which' has no value"),
    (workflows, NIGHTLY, "checkout@v4", "checkout@main", "uses actions/checkout@main"),
    (workflows, ".ci/setup.sh", "cmake --preset release", "cmake --preset fast", "configure presets that are not there: ['fast']"),
    (workflows, "CMakePresets.json", '"name": "tsan",\n      "configurePreset"', '"name": "races",\n      "configurePreset"',
     ".ci/nightly names test presets that are not there: ['tsan']"),
    (workflows, ".ci/not-on-ubuntu.txt", "chromium-driver", "chromium-drivers", "chromium-drivers is in no list"),
]


def copy_tree(root, to):
    """What the checks read: no sources."""
    ignored = shutil.ignore_patterns("*.cpp", "*.hpp", "*.js", "*.png", "__pycache__")
    for folder in (".ci", ".github", "core", "robot_model", "ompl_bridge", "planners_demo", "tests/packaging", "tests/fuzz"):
        shutil.copytree(root / folder, to / folder, ignore=ignored)
    for file in ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "tests/run.sh",
                 "models/robots/rook7/rook7.urdf", "models/scenes/narrow_slot.yaml"):
        (to / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / file, to / file)


def noticed(tree, checker, name, old, new, said):
    """Whether a fault in a copy of the tree is noticed; None: whether it is none."""
    file = tree / name
    text = file.read_text(encoding="utf-8")
    if old not in text:
        print(f"{name} has no '{old}' to replace")
        return False
    file.write_text(text.replace(old, new), encoding="utf-8")
    found, seen = False, []
    try:
        for fault in checker(tree):
            seen.append(fault)
            if said is not None and said in fault:
                found = True
                break
    except ValueError as error:
        seen.append(str(error))
    file.write_text(text, encoding="utf-8")
    if found or (said is None and not seen):
        return True
    print(f"{name} with '{new}' for '{old}': not '{said}' but", *(seen or ["no fault"]), sep="\n  ")
    return False


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: checks_test.py ROOT")
    root = Path(sys.argv[1]).resolve()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        copy_tree(root, tree)
        for checker in (conan, vcpkg, workflows):
            faults = list(checker(tree))
            failed += bool(faults)
            print(f"{checker.__name__}: {len(faults)} faults", *faults, sep="\n  ")
        for fault in FAULTS:
            failed += not noticed(tree, *fault)
    print(f"{len(FAULTS)} changes, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
