# SPDX-License-Identifier: BSD-3-Clause
"""A copy of the tree that may be changed, and what is built of it."""

import fcntl
import json
import pathlib
import re
import shutil
import subprocess
from dataclasses import dataclass


class Failed(Exception):
    """What has to work without any mutation did not."""


@dataclass
class Failure:
    test: str
    timed_out: bool


# What a mutation leaves unused is not its fault.
# Where the command line has -Wall, GCC does not take "-Wunused" for all of them.
UNUSED = ("variable", "but-set-variable", "parameter", "but-set-parameter", "function", "value", "local-typedefs")
PREAMBLE = "".join(f'#pragma GCC diagnostic ignored "-Wunused-{what}"\n' for what in UNUSED)

# As ctest prints it: " 3/12 Test  #7: NAME .......***Failed    1.24 sec".
TEST_STATUS = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) .*\*\*\*(\w+)", re.MULTILINE)


def quoted(text):
    """Arguments of an add_test() that CMake wrote."""
    return re.findall(r'"((?:[^"\\]|\\.)*)"', text)


class WorkTree:
    def __init__(self, source, folder, jobs, timeout):
        self.source = pathlib.Path(source)
        self.folder = pathlib.Path(folder).resolve()
        self.tree = self.folder / "tree"
        # Where it is in a clone, so that ccache finds what was compiled there.
        self.build_folder = self.tree / "build" / "release"
        self.passed_file = self.folder / "passed.json"
        self.log = self.folder / "last.log"
        self.jobs = jobs
        self.timeout = timeout

    def lock(self):
        """Until the program ends: two campaigns would test each other's mutations."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self.lock_file = (self.folder / "lock").open("w")
        try:
            fcntl.flock(self.lock_file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failed(f"--work {self.folder}: another campaign is at work there")

    def sync(self):
        """Makes the copy the same as the source. What differs is written anew, so that it is newer than
        what an interrupted campaign built of something else."""
        self.tree.mkdir(parents=True, exist_ok=True)
        listed = subprocess.run(
            ["git", "-C", self.source, "ls-files", "-coz", "--exclude-standard"],
            check=True, capture_output=True, text=True,
        ).stdout.split("\0")
        files = {name for name in listed if name and (self.source / name).is_file()}
        changed = False
        for path in [p for p in self.tree.rglob("*") if p.is_file() and not p.is_relative_to(self.build_folder)]:
            if str(path.relative_to(self.tree)) not in files:
                path.unlink()
                changed = True
        for name in files:
            changed |= self.copy(name)
        if changed:
            self.passed_file.unlink(missing_ok=True)

    def copy(self, name):
        """True if what is built may change by it."""
        source, target = self.source / name, self.tree / name
        if target.is_file() and target.read_bytes() == source.read_bytes():
            return False
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        shutil.copymode(source, target)
        return not name.startswith("tests/mutation/")

    def configure(self):
        if not (self.build_folder / "build.ninja").is_file():
            # Of the library, a mutation compiles the source that it is in and no other.
            self.must(["cmake", "-S", self.tree, "-B", self.build_folder, "-G", "Ninja",
                       "-DCMAKE_BUILD_TYPE=Release", "-DSWEPT_WARNINGS_AS_ERRORS=ON", "-DSWEPT_UNITY_BUILD=OFF"])
        # Tests are known by name once CMake has run for the tree as it is.
        self.must(["ninja", "-C", self.build_folder, "build.ninja"])
        self.tests = {}
        for path in sorted(self.build_folder.rglob("CTestTestfile.cmake")):
            for name, arguments in re.findall(r"^add_test\((?:\[=*\[)?([^\s\]]+)(?:\]=*\])? (.*)\)$",
                                              path.read_text(), re.MULTILINE):
                self.tests[name] = quoted(arguments)
        # What notices speed only, and what notices any mutation by its text.
        listed = subprocess.run(["ctest", "--test-dir", self.build_folder, "-N", "-L", "^(instructions|mutation)$"],
                                check=True, capture_output=True, text=True).stdout
        for name in re.findall(r"^ *Test +#\d+: (\S+)", listed, re.MULTILINE):
            self.tests.pop(name, None)

    def matching(self, regex):
        return [name for name in self.tests if re.fullmatch(regex, name)]

    def must(self, command):
        if self.run(command) != 0:
            raise Failed(f"failed, see {self.log}: {' '.join(map(str, command))}")

    def run(self, command):
        with self.log.open("w") as log:
            return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL).returncode

    def build(self, names=None):
        """What these tests run, or everything. False: it does not compile."""
        targets = []
        for name in names or []:
            for argument in self.tests[name]:
                path = pathlib.Path(argument)
                if path.is_relative_to(self.build_folder) and path.suffix == "":
                    targets.append(str(path.relative_to(self.build_folder)))
        command = ["ninja", "-C", self.build_folder, "-j", str(self.jobs), *sorted(set(targets))]
        return self.run(command) == 0

    def first_failure(self, names):
        """None: all pass. A test that crashes fails."""
        regex = "^(" + "|".join(map(re.escape, names)) + ")$"
        command = ["ctest", "--test-dir", self.build_folder, "-R", regex, "-j", str(self.jobs),
                   "--timeout", str(self.timeout), "--stop-on-failure"]
        if self.run(command) == 0:
            return None
        for test, status in TEST_STATUS.findall(self.log.read_text(errors="replace")):
            if status in ("Timeout", "Failed", "Exception"):
                return Failure(test, status == "Timeout")
        raise Failed(f"ctest failed, and no test did, see {self.log}")

    def require_passing(self, names):
        """Builds and runs them, but for those that have passed since the tree last changed."""
        known = set(json.loads(self.passed_file.read_text())) if self.passed_file.is_file() else set()
        missing = [name for name in names if name not in known]
        if not missing:
            return
        if not self.build(missing):
            raise Failed(f"the tree does not compile without a mutation, see {self.log}")
        failure = self.first_failure(missing)
        if failure:
            raise Failed(f"{failure.test} fails without a mutation, see {self.log}")
        self.passed_file.write_text(json.dumps(sorted(known | set(missing))))

    def mutate(self, mutation):
        path = self.tree / mutation.file
        path.write_text(PREAMBLE + path.read_text().replace(mutation.original, mutation.replacement))

    def restore(self, mutation):
        """Written anew, hence newer than what was built of the mutation."""
        shutil.copyfile(self.source / mutation.file, self.tree / mutation.file)
