# SPDX-License-Identifier: BSD-3-Clause
"""Recipe of swept for Conan 2, of the tree that this file is in: conan create tests/packaging/conan.

The component pages is left out, and so is the Python package: pages contain three.js, which is no library of C++.
"""
from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.4"

# What each component needs beyond those below it. The lowest versions are those of Debian 12, and the
# ranges end after those of Debian 13: with both, the tests run.
NEEDS = {
    "core": ["eigen/[>=3.4.0 <4]", "libccd/[>=2.1 <3]", "highway/[>=1.0.3 <2]"],
    "robot_model": ["urdfdom/[>=3.0.1 <5]", "assimp/[>=5.2.5 <6]", "yaml-cpp/[>=0.7.0 <1]",
                    "nlohmann_json/[>=3.11.2 <4]", "tinyxml2/[>=9.0.0 <12]", "onetbb/[>=2021.8.0 <2023]"],
    "proofs": ["openssl/[>=3.0 <4]"],
    "ompl_bridge": ["ompl/[>=1.5.2 <2]"],
    "program": ["cli11/[>=2.1.2 <3]", "zlib/[>=1.2.13 <2]"],
}
# Who links what, of components and of Conan's packages.
LINKS = {
    "core": ["eigen::eigen", "libccd::libccd"],
    "robot_model": ["core", "onetbb::libtbb", "urdfdom::urdfdom", "assimp::assimp", "yaml-cpp::yaml-cpp",
                    "tinyxml2::tinyxml2"],
    "proofs": ["robot_model", "openssl::crypto"],
    "ompl_bridge": ["robot_model", "ompl::ompl"],
}
# Headers of swept include those of these two.
IN_HEADERS = ("eigen", "ompl")
# The library itself is not linked, or only by the program.
BUILD_ONLY = ("highway", "nlohmann_json", "cli11", "zlib")
# What CMake finds a package by that makes it leave out a component.
TURNS_ON = {"robot_model": "urdfdom", "proofs": "OpenSSL", "ompl_bridge": "ompl"}


class SweptRecipe(ConanFile):
    name = "swept"
    description = "State and motion validity for motion planners, with proofs"
    license = "BSD-3-Clause"
    topics = ("robotics", "motion-planning", "collision-detection")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {
        "shared": [True, False],
        "fPIC": [True, False],
        "robot_model": [True, False],
        "proofs": [True, False],
        "ompl_bridge": [True, False],
        "program": [True, False],
    }
    default_options = {
        "shared": False,
        "fPIC": True,
        "robot_model": True,
        "proofs": True,
        "ompl_bridge": True,
        "program": False,
        # As in Debian: swept gives it coordinates in double precision.
        "libccd/*:enable_double_precision": True,
        # Conan's recipe of OMPL makes no other on Linux.
        "ompl/*:shared": True,
    }
    implements = ["auto_shared_fpic"]

    @property
    def _tree(self):
        return Path(self.recipe_folder).resolve().parents[2]

    def set_version(self):
        text = load(self, self._tree / "CMakeLists.txt")
        self.version = text.partition("project(swept VERSION ")[2].split()[0]

    def export_sources(self):
        for name in ("CMakeLists.txt", "LICENSE", "README.md"):
            copy(self, name, src=str(self._tree), dst=self.export_sources_folder)
        for folder in ("core", "robot_model", "ompl_bridge", "planners_demo"):
            copy(self, "*", src=str(self._tree / folder), dst=str(Path(self.export_sources_folder) / folder))

    def layout(self):
        cmake_layout(self)

    def _parts(self):
        return [part for part in NEEDS if part == "core" or self.options.get_safe(part)]

    def requirements(self):
        for part in self._parts():
            for reference in NEEDS[part]:
                package = reference.partition("/")[0]
                self.requires(reference, transitive_headers=package in IN_HEADERS, visible=package not in BUILD_ONLY)

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("swept is built on Linux alone so far")
        for part, below in (("proofs", ["robot_model"]), ("ompl_bridge", ["robot_model"]),
                            ("program", ["ompl_bridge", "proofs"])):
            for needed in below:
                if part in self._parts() and needed not in self._parts():
                    raise ConanInvalidConfiguration(f"the option {part} needs the option {needed}")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({
            "SWEPT_BUILD_PROGRAM": "program" in self._parts(),
            "SWEPT_BUILD_PYTHON": "OFF",
            "SWEPT_BUILD_TESTS": False,
            "SWEPT_INSTALL": True,
            "SWEPT_MPI": False,
            "SWEPT_THREE_FOLDER": "OFF",
            "CMAKE_DISABLE_FIND_PACKAGE_fcl": True,
        })
        for part, package in TURNS_ON.items():
            # So that none of the system's own is found instead.
            toolchain.cache_variables[f"CMAKE_DISABLE_FIND_PACKAGE_{package}"] = part not in self._parts()
        toolchain.generate()
        dependencies = CMakeDeps(self)
        # Names that the packages' own files for CMake have, and Conan's have not.
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway::hwy", "cmake_target_name", "hwy::hwy")
        dependencies.set_property("urdfdom", "cmake_target_name", "urdfdom::urdfdom_model")
        dependencies.set_property("yaml-cpp", "cmake_target_name", "yaml-cpp")
        dependencies.set_property("ompl", "cmake_additional_variables_prefixes", ["OMPL"])
        dependencies.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=str(Path(self.package_folder) / "licenses"))
        CMake(self).install()
        # Conan's generators write what programs find it by.
        for folder in ("lib/cmake", "lib/pkgconfig", "share"):
            rmdir(self, str(Path(self.package_folder) / folder))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "swept")
        self.cpp_info.set_property("cmake_config_version_compat", "SameMinorVersion")
        for part in self._parts():
            if part not in LINKS:
                continue
            component = self.cpp_info.components[part]
            component.set_property("cmake_target_name", f"swept::{part}")
            component.set_property("pkg_config_name", f"swept-{part.replace('_', '-')}")
            component.libs = [f"swept_{part}"]
            component.requires = LINKS[part]
            component.system_libs = ["m", "pthread"]
        # Templates and inline functions of the headers are part of proofs.
        self.cpp_info.components["core"].cxxflags = ["-ffp-contract=off"]
