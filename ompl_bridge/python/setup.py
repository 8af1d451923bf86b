# SPDX-License-Identifier: BSD-3-Clause
"""`pip install ./ompl_bridge/python`: CMake builds the package `swept` for the Python that runs this. Needs the packages of
.ci/apt-packages.txt, and no network.

SWEPT_CMAKE_ARGUMENTS: more arguments of CMake, as a shell has them.
"""
import os
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
# All that it makes is there, where git ignores it.
BUILD = ROOT / "build" / "pip"


class CMakeBuild(build_ext):
    """Builds the module, and puts it where setuptools expects it."""

    def build_extension(self, extension: Extension) -> None:
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        folder = Path(self.build_temp).resolve()
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "Python_EXECUTABLE": sys.executable,
            "SWEPT_BUILD_PYTHON": "REQUIRED",
            "SWEPT_BUILD_PROGRAM": "OFF",
            "SWEPT_BUILD_TESTS": "OFF",
            "SWEPT_INSTALL": "OFF",
        }
        command = ["cmake", "-S", str(ROOT), "-B", str(folder)]
        command += [f"-D{name}={value}" for name, value in options.items()]
        subprocess.run(command + shlex.split(os.environ.get("SWEPT_CMAKE_ARGUMENTS", "")), check=True)
        build = ["cmake", "--build", str(folder), "--target", "swept_python", "--parallel", str(os.cpu_count() or 1)]
        subprocess.run(build, check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(folder / "ompl_bridge/python/swept" / target.name), str(target))


BUILD.mkdir(parents=True, exist_ok=True)
setup(
    options={"build": {"build_base": str(BUILD)}, "egg_info": {"egg_base": str(BUILD)}},
    ext_modules=[Extension("swept._swept", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
