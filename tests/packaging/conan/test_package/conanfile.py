# SPDX-License-Identifier: BSD-3-Clause
"""The program of tests/packaging/full with Conan's package, or that of core if the package has no more."""
from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class SweptTest(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"

    @property
    def _packaging(self):
        return Path(self.recipe_folder).resolve().parents[1]

    def _has(self, component):
        return bool(self.dependencies["swept"].options.get_safe(component))

    def requirements(self):
        self.requires(self.tested_reference_str)

    def validate(self):
        if self._has("robot_model") and not self._has("ompl_bridge"):
            raise ConanInvalidConfiguration("no program is for these options: use --test-folder=")

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder=str(self._packaging / ("full" if self._has("ompl_bridge") else "core")))
        cmake.build()

    def test(self):
        if not can_run(self):
            return
        programs = Path(self.cpp.build.bindir)
        if self._has("ompl_bridge"):
            models = self._packaging.parents[1] / "models"
            self.run(f"{programs / 'motion'} {models / 'robots/rook7/rook7.urdf'} {models / 'scenes/narrow_slot.yaml'}",
                     env="conanrun")
        else:
            self.run(str(programs / "distance"), env="conanrun")
