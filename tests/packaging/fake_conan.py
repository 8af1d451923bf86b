# SPDX-License-Identifier: BSD-3-Clause
"""Stands in for Conan: runs the methods of a recipe and keeps what they say, without building anything."""
import sys
import types
from collections import defaultdict
from importlib import util
from pathlib import Path
from types import SimpleNamespace


class ConanInvalidConfiguration(Exception):
    pass


class Options(SimpleNamespace):
    def get_safe(self, name):
        return getattr(self, name, None)


class Info(SimpleNamespace):
    """cpp_info of a package, or one of its components."""

    def __init__(self):
        super().__init__(components=defaultdict(Info), properties={}, libs=[], requires=[], system_libs=[], cxxflags=[])

    def set_property(self, name, value):
        self.properties[name] = value


class ConanFile:
    def requires(self, reference, **traits):
        self.required[reference] = traits

    def run(self, command, env):
        self.commands.append((command, env))


class CMake:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self, build_script_folder):
        self.recipe.project = build_script_folder

    def build(self):
        pass


class Toolchain:
    def __init__(self, recipe):
        self.cache_variables = recipe.cache_variables

    def generate(self):
        pass


class Deps:
    def __init__(self, recipe):
        self.set_property = lambda *said: recipe.properties.append(said)

    def generate(self):
        pass


def _module(name, **content):
    module = types.ModuleType(name)
    vars(module).update(content)
    sys.modules[name] = module


def _unused(*_, **__):
    raise AssertionError("the check builds nothing")


def load_recipe(path):
    """The module of the recipe at `path`."""
    def minimum(recipe, standard):
        recipe.standard = standard

    _module("conan", ConanFile=ConanFile)
    _module("conan.errors", ConanInvalidConfiguration=ConanInvalidConfiguration)
    _module("conan.tools", __path__=[])
    _module("conan.tools.build", check_min_cppstd=minimum, can_run=lambda _: True)
    _module("conan.tools.cmake", CMake=CMake, CMakeDeps=Deps, CMakeToolchain=Toolchain, cmake_layout=_unused)
    _module("conan.tools.files", rmdir=_unused, load=lambda _, path: Path(path).read_text(encoding="utf-8"),
            copy=lambda recipe, pattern, src, dst: recipe.copied.append((pattern, src, dst)))
    spec = util.spec_from_file_location("swept_recipe", path)
    module = util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def answers_of(recipe_class, path, options, **settings):
    """The recipe after all its methods for these options; `refused` is the reason, if they are refused."""
    recipe = recipe_class()
    recipe.recipe_folder = str(Path(path).parent)
    recipe.export_sources_folder = "exported"
    recipe.options = Options(**options)
    recipe.settings = SimpleNamespace(**{"os": "Linux", **settings})
    recipe.required, recipe.cache_variables, recipe.properties, recipe.copied = {}, {}, [], []
    recipe.cpp_info, recipe.refused, recipe.standard = Info(), None, None
    recipe.set_version()
    recipe.export_sources()
    recipe.requirements()
    try:
        recipe.validate()
    except ConanInvalidConfiguration as reason:
        recipe.refused = str(reason)
    recipe.generate()
    recipe.package_info()
    return recipe


def test_of(test_class, path, options):
    """The recipe that tests the package with these options; `refused` as above."""
    recipe = test_class()
    recipe.recipe_folder = str(Path(path).parent)
    recipe.dependencies = {"swept": SimpleNamespace(options=Options(**options))}
    recipe.tested_reference_str = "swept/tested"
    recipe.cpp = SimpleNamespace(build=SimpleNamespace(bindir="programs"))
    recipe.required, recipe.commands, recipe.refused = {}, [], None
    recipe.requirements()
    try:
        recipe.validate()
    except ConanInvalidConfiguration as reason:
        recipe.refused = str(reason)
        return recipe
    recipe.build()
    recipe.test()
    return recipe
