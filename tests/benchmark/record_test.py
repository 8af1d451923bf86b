#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What record.sh writes of programs made up here, in a tree of its own, and what it refuses."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
RUNS = """# A comment: not a run.
table: made_benchmark 3
text: swept report DATA/robot.urdf --csv RESULT.csv
broken: broken_benchmark RESULT.csv
"""
PROGRAMS = {
    "tests/benchmark/made_benchmark": 'printf "\\n## Part\\n\\n| n |\\n| --- |\\n| $1 |\\n"',
    "tests/benchmark/broken_benchmark": 'echo new >"$1"; echo half; exit 1',
    "planners_demo/swept": 'test -f "$2" && echo 1,2 >"$4" && echo "written to $4"',
}


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.folder = self.root / "tests/benchmark"
        self.folder.mkdir(parents=True)
        shutil.copy(HERE / "record.sh", self.folder)
        (self.folder / "runs.txt").write_text(RUNS)
        (self.folder / "made_benchmark.cpp").write_text("")
        for command in (["init", "-q"], ["add", "."],
                        ["-c", "user.name=x", "-c", "user.email=x@x", "commit", "-q", "-m", "x"]):
            subprocess.run(["git", *command], cwd=self.root, check=True)
        self.commit = subprocess.run(["git", "rev-parse", "--short=10", "HEAD"], cwd=self.root,
                                     check=True, text=True, capture_output=True).stdout.strip()
        build = self.root / "build/release"
        for name, text in PROGRAMS.items():
            self.program(build / name, text)
        (build / "CMakeCache.txt").write_text("SWEPT_BUILD_BENCHMARKS:BOOL=ON\nCMAKE_BUILD_TYPE:STRING=Release\n"
                                              "CMAKE_CXX_COMPILER:FILEPATH=/bin/echo\n")
        self.program(self.root / "tools/cmake", 'echo "$@" >"$(dirname "$0")/built"')
        # Of names that shells take apart, and expand.
        self.data = self.root / "else & where"
        self.data.mkdir()
        (self.data / "robot.urdf").write_text("")

    def program(self, file, text):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def record(self, *arguments, data=None):
        environment = os.environ | {"PATH": f"{self.root}/tools:{os.environ['PATH']}", "SWEPT_DATA": data or ""}
        return subprocess.run([self.folder / "record.sh", *arguments], env=environment, text=True,
                              capture_output=True)

    def result(self, name):
        return (self.folder / "results/box" / name).read_text()

    def test_writes_the_output_below_a_head(self):
        run = self.record("--machine", "box", "table", "text", data=str(self.data))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertRegex((self.root / "tools/built").read_text(), "--target made_benchmark swept\n")
        head, output = self.result("table.md").split("## Output\n")
        self.assertTrue(head.startswith("# table\n\n    made_benchmark 3\n\n"), head)
        self.assertIn(f"* sources of commit {self.commit}; 20", head)
        self.assertRegex(head, r"load average \(1, 5, 15 minutes\) before [\d. ]+, after [\d. ]+\n")
        self.assertIn("Release\n", head)
        self.assertIn("SWEPT_DATA set\n", head)
        self.assertEqual(output, "\n## Part\n\n| n |\n| --- |\n| 3 |\n")
        text = self.result("text.md")
        self.assertIn("\n    swept report DATA/robot.urdf --csv tests/benchmark/results/box/text.csv\n", text)
        self.assertTrue(text.endswith("~~~text\nwritten to tests/benchmark/results/box/text.csv\n~~~\n"), text)
        self.assertNotIn(str(self.root), text)
        self.assertEqual(self.result("text.csv"), "1,2\n")

    def test_says_that_sources_were_changed_and_data_is_missing(self):
        (self.folder / "made_benchmark.cpp").write_text("// other\n")
        self.assertEqual(self.record("--machine", "box", "text").returncode, 0)
        text = self.result("text.md")
        self.assertIn(f"{self.commit} and changes not committed; ", text)
        self.assertIn("SWEPT_DATA not set\n", text)
        self.assertTrue(text.endswith("~~~text\nskipped: SWEPT_DATA is not set\n~~~\n"), text)

    def test_a_source_that_git_does_not_know_is_a_change(self):
        (self.folder / "new.hpp").write_text("")
        self.assertEqual(self.record("--machine", "box", "table").returncode, 0)
        self.assertIn(f"{self.commit} and changes not committed; ", self.result("table.md"))

    def test_keeps_the_result_of_a_program_that_fails(self):
        (self.folder / "results/box").mkdir(parents=True)
        for name in ("broken.md", "broken.csv"):
            (self.folder / "results/box" / name).write_text("before\n")
        run = self.record("--machine", "box", "broken", "table")
        self.assertEqual((run.returncode, run.stderr), (1, "broken: FAILED, nothing written\n"))
        for name in ("broken.md", "broken.csv"):
            self.assertEqual(self.result(name), "before\n")
        self.assertIn("| 3 |", self.result("table.md"))

    def test_refuses(self):
        for arguments, message in (
                (["tables"], "unknown name 'tables'; in runs.txt: table text broken"),
                (["t.*e"], "unknown name 't.*e'; in runs.txt: table text broken"),
                (["--machines"], "unknown option '--machines'; known: --machine MACHINE, --build FOLDER"),
                (["table", "--machine"], "--machine needs a value"),
                (["--machine", "../x"], "--machine '../x': letters, digits, '.', '_' and '-' only"),
                (["--build", "nowhere"], "--build 'nowhere': no build with -DSWEPT_BUILD_BENCHMARKS=ON")):
            with self.subTest(message):
                run = self.record(*arguments)
                self.assertEqual((run.returncode, run.stdout, run.stderr), (2, "", f"record.sh: {message}\n"))


if __name__ == "__main__":
    unittest.main()
