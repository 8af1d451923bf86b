#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The recipe for Conan says what the files for CMake say. Neither Conan nor the network is needed.

usage: check_conan.py ROOT

The recipe's methods are run with each set of its options. Names of versions and packages of Conan's own index are not
looked up there: what this finds no fault with has not been built. tests/packaging/recipes.sh builds it.
"""
import itertools
import re
import subprocess
import sys
from pathlib import Path

from cmake_facts import CMakeFacts
from fake_conan import answers_of, load_recipe, test_of

# Names that differ, of CMake and Conan, and of Debian's packages with the headers.
CONAN_NAMES = {"Eigen3": "eigen", "ccd": "libccd", "hwy": "highway", "TBB": "onetbb", "OpenSSL": "openssl",
               "CLI11": "cli11", "ZLIB": "zlib"}
DEBIAN_NAMES = {"eigen": "libeigen3-dev", "libccd": "libccd-dev", "highway": "libhwy-dev", "urdfdom": "liburdfdom-dev",
                "assimp": "libassimp-dev", "yaml-cpp": "libyaml-cpp-dev", "nlohmann_json": "nlohmann-json3-dev",
                "tinyxml2": "libtinyxml2-dev", "onetbb": "libtbb-dev", "openssl": "libssl-dev", "ompl": "libompl-dev",
                "cli11": "libcli11-dev", "zlib": "zlib1g-dev"}


def conan_names(packages):
    return {CONAN_NAMES.get(package, package) for package in packages}


def package_of(reference):
    return re.split("/|::", reference)[0]


def check_parts(facts, recipe, on):
    """For one set of parts that are on."""
    accepted = facts.closure(on) == on
    if accepted == bool(recipe.refused):
        yield f"is {'refused' if accepted else 'accepted'}: {recipe.refused}"
    if not accepted:
        return
    needed = conan_names(set().union(*(facts.packages[part] for part in on)))
    named = {package_of(reference) for reference in recipe.required}
    if named != needed:
        yield f"requires {sorted(named)}, and CMake looks for {sorted(needed)}"

    for part in facts.below.keys() - {"core", "pages", "program"}:
        disabled = {package for package in facts.packages[part]
                    if recipe.cache_variables.get(f"CMAKE_DISABLE_FIND_PACKAGE_{package}")}
        if bool(disabled) == (part in on):
            yield f"packages of {part} that CMake shall not find: {sorted(disabled)}"
    if recipe.cache_variables.get("SWEPT_BUILD_PROGRAM") != ("program" in on):
        yield f"SWEPT_BUILD_PROGRAM is {recipe.cache_variables.get('SWEPT_BUILD_PROGRAM')}"

    components = recipe.cpp_info.components
    if components.keys() != on & facts.installed.keys():
        yield f"has the components {sorted(components)}"
    for name, component in components.items():
        yield from (f"component {name}: {fault}" for fault in check_component(facts, recipe, name, component))


def check_component(facts, recipe, name, component):
    own = {other for other in component.requires if "::" not in other}
    others = {package_of(other) for other in component.requires if "::" in other}
    if set().union(*(facts.closure([part]) for part in own)) != facts.below[name]:
        yield f"is built on {sorted(own)}, and in CMake on {sorted(facts.below[name])}"
    if others != conan_names(facts.links(name)):
        yield f"links {sorted(others)}, and in CMake {sorted(facts.links(name))}"
    hidden = {package_of(ref) for ref, traits in recipe.required.items() if not traits["visible"]}
    if others & hidden:
        yield f"links {sorted(others & hidden)}, which programs do not see"
    public = conan_names(facts.installed[name].get("PACKAGES", []))
    in_headers = {package_of(ref) for ref, traits in recipe.required.items() if traits["transitive_headers"]}
    if not public <= in_headers:
        yield f"its headers include those of {sorted(public)}, of which programs see {sorted(in_headers)}"
    if component.libs != [f"swept_{name}"] or component.properties != {
            "cmake_target_name": f"swept::{name}", "pkg_config_name": "swept-" + name.replace("_", "-")}:
        yield f"is {component.libs}, {component.properties}"
    flags = [flag for flag in facts.installed[name].get("FLAGS", []) if not flag.startswith("${")]
    if component.cxxflags != flags:
        yield f"programs are compiled with {component.cxxflags}, and in CMake with {flags}"
    if "-pthread" in facts.installed[name].get("STATIC_LIBRARIES", []) and "pthread" not in component.system_libs:
        yield "does not link pthread"


def check_names(facts, recipe):
    """What of the recipe must be the same with all options."""
    if recipe.name != "swept" or recipe.version != facts.version:
        yield f"is {recipe.name} {recipe.version}, and in CMake swept {facts.version}"
    if recipe.standard != facts.standard:
        yield f"asks for C++{recipe.standard}, and CMake for {facts.standard}"
    licence = (facts.root / "LICENSE").read_text(encoding="utf-8").split("\n")[0]
    if recipe.license != "BSD-3-Clause" or not licence.startswith("BSD 3-Clause"):
        yield f"licence {recipe.license}, and LICENSE has {licence}"
    for variable in recipe.cache_variables:
        package = variable.removeprefix("CMAKE_DISABLE_FIND_PACKAGE_")
        if variable not in facts.settings and (package == variable or package not in facts.sought):
            yield f"sets {variable}, which CMake's files do not know"
    for package, name, value in recipe.properties:
        sought = {"cmake_file_name": f"find_package({value} ", "cmake_target_name": value,
                  "cmake_additional_variables_prefixes": f"${{{value[0]}_INCLUDE_DIRS}}"}[name]
        if sought not in facts.code:
            yield f"{name} of {package} is {value}, and CMake's files have no '{sought}'"
    folders = {Path(src).name for pattern, src, _ in recipe.copied if pattern == "*"}
    added = set(re.findall(r"\n *add_subdirectory\((\w+)", (facts.root / "CMakeLists.txt").read_text(encoding="utf-8")))
    if folders != added - {"tests"}:
        yield f"takes the folders {sorted(folders)}, and CMake adds {sorted(added - {'tests'})}"
    for pattern, src, _ in recipe.copied:
        if not Path(src, "" if pattern == "*" else pattern).exists():
            yield f"takes {src}/{pattern}, which is not there"


def numbers(version):
    return [int(number) for number in version.split(".")]


def check_versions(facts, references, installed_versions):
    """The lowest versions are those of Debian 12, and the ranges have those of Debian 13."""
    listed = (facts.root / ".ci/apt-packages.txt").read_text(encoding="utf-8").split("\n")
    for reference in references:
        name, _, versions = reference.partition("/")
        debian = DEBIAN_NAMES.get(name)
        if debian not in listed:
            yield f"{name} is {debian} in Debian, which .ci/apt-packages.txt does not list"
            continue
        limits = re.fullmatch(r"\[>=(\d+(?:\.\d+)*) <(\d+)\]", versions)
        if not limits:
            yield f"{reference} is no range [>=LOWEST <NEXT]"
            continue
        lowest, following = limits.groups()
        for release, there in installed_versions(debian).items():
            if release == 12 and not f"{there}.".startswith(f"{lowest}."):
                yield f"{reference}: the tests run with {there}"
            if not numbers(lowest) <= numbers(there) < numbers(following):
                yield f"{reference} has not Debian {release}'s {there}"


def versions_here(package):
    """The version of a package that is installed, by the release of Debian that this is; nothing elsewhere."""
    try:
        release = Path("/etc/os-release").read_text(encoding="utf-8")
        said = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], text=True, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return {}
    for number in (12, 13):
        if {"ID=debian", f'VERSION_ID="{number}"'} <= set(release.split("\n")):
            return {number: re.match(r"(?:\d+:)?(\d+(?:\.\d+)*)", said.stdout).group(1)}
    return {}


def check_test(root, path, options):
    """The program that tests a package takes no more of it than there is, and is there with its arguments."""
    recipe = test_of(load_recipe(path).SweptTest, path, options)
    if recipe.refused:
        if options["ompl_bridge"] or not options["robot_model"]:
            yield f"is refused: {recipe.refused}"
        return
    project = Path(recipe.project).resolve()
    taken = "ompl_bridge" if options["ompl_bridge"] else "core"
    text = (project / "CMakeLists.txt").read_text(encoding="utf-8") if project.is_dir() else ""
    program = re.search(rf"target_link_libraries\((\w+) PRIVATE swept::{taken}\)", text)
    if not program:
        yield f"builds {project}, which is no program with {taken}"
        return
    (command, _), = recipe.commands
    started, *arguments = command.split()
    if Path(started) != Path("programs") / program.group(1):
        yield f"runs {started}, and {project.name} has {program.group(1)}"
    for argument in arguments:
        if not Path(argument).is_relative_to(root) or not Path(argument).is_file():
            yield f"{argument} is not there"


def check(root, installed_versions=versions_here):
    """One line for each fault."""
    facts = CMakeFacts(root)
    path = Path(root) / "tests/packaging/conan/conanfile.py"
    recipe_class = load_recipe(path).SweptRecipe
    parts = facts.below.keys() - {"core", "pages"}
    usual = {"shared", "fPIC"}
    if recipe_class.options.keys() - usual != parts or not parts <= recipe_class.default_options.keys():
        yield f"has the options {sorted(recipe_class.options)}, and CMake the parts {sorted(parts)}"
        return
    for count in range(len(parts) + 1):
        for on in itertools.combinations(sorted(parts), count):
            recipe = answers_of(recipe_class, path, {part: part in on for part in parts})
            yield from (f"with {list(on)}: {fault}" for fault in check_parts(facts, recipe, {"core", *on}))
    whole = answers_of(recipe_class, path, {part: True for part in parts})
    yield from check_names(facts, whole)
    yield from check_versions(facts, whole.required, installed_versions)
    if not answers_of(recipe_class, path, {part: True for part in parts}, os="Windows").refused:
        yield "is accepted on Windows"
    for robot_model, ompl_bridge in ((False, False), (True, False), (True, True)):
        options = {"robot_model": robot_model, "ompl_bridge": ompl_bridge}
        for fault in check_test(Path(root).resolve(), path.resolve().parent / "test_package/conanfile.py", options):
            yield f"test_package with {options}: {fault}"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_conan.py ROOT")
    faults = list(check(sys.argv[1]))
    print("\n".join([*(f"conanfile.py: {fault}" for fault in faults), f"conan: {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
