# SPDX-License-Identifier: BSD-3-Clause
"""answers_test.py RECORDER: a short record is the same on one thread and on three, and compare.py notices what is not."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

RECORDER = sys.argv.pop(1)
COMPARE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "compare.py")


def run(*arguments):
    # The answers about robots that not everyone has take too long here.
    environment = {name: value for name, value in os.environ.items() if name != "SWEPT_DATA"}
    return subprocess.run(arguments, capture_output=True, text=True, env=environment, check=False)


class Answers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, name):
        return os.path.join(self.folder, name)

    def record(self, name, *options):
        result = run(RECORDER, "--count", "4000", "--robots", "^(drifter:body|rook6:arm)$", "--out", self.file(name),
                     "--each", self.file(name + "_each"), *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file(name), encoding="utf-8") as file:
            return file.read()

    def compare(self, first, second):
        return run(sys.executable, "-B", COMPARE, self.file(first), self.file(second))

    def changed(self, text, pattern, name):
        text, count = re.subn(pattern, lambda match: match[1] + "0123", text, count=1)
        self.assertEqual(count, 1)
        with open(self.file(name), "w", encoding="utf-8") as file:
            file.write(text)

    def test_record(self):
        text = self.record("one", "--threads", "1")
        self.assertNotIn("refused", text)
        self.record("three", "--threads", "3")
        for name in ("", "_each"):
            same = self.compare("one" + name, "three" + name)
            self.assertEqual(same.returncode, 0, same.stdout)
            self.assertRegex(same.stdout, r"^\d+ and \d+ lines: 0 differ in the verdict, 0 in the full digest only\n$")
        self.changed(text, r"( full=\w{12})\w{4}", "other_full")
        other = self.compare("one", "other_full")
        self.assertEqual(other.returncode, 0)
        self.assertIn("full only ", other.stdout)
        self.assertNotIn("VERDICT ", other.stdout)
        self.changed(text, r"( verdict=\w{12})\w{4}", "other_verdict")
        other = self.compare("one", "other_verdict")
        self.assertEqual(other.returncode, 1)
        self.assertIn("VERDICT ", other.stdout)
        self.changed(text, r"(\n)\w+:.*\n", "line_gone")
        self.assertEqual(self.compare("one", "line_gone").returncode, 1)
        self.question_again()

    def question_again(self):
        with open(self.file("one_each"), encoding="utf-8") as file:
            words = next(line for line in file if " everything touching 0 " in line).split()
        again = run(RECORDER, "--robots", "^(drifter:body|rook6:arm)$", "--only", "/".join(words[:4]))
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(again.stdout.splitlines()[-1], " ".join(words[4:]))

    def test_refuses(self):
        few = run(RECORDER, "--count", "1", "--robots", "^drifter$")
        self.assertEqual(few.returncode, 1, few.stderr)
        self.assertIn("fewer than a tenth", few.stderr)
        self.assertEqual(run(RECORDER, "--robots", "^nobody$").returncode, 3)
        self.assertEqual(run(RECORDER, "--robots", "^drifter$", "--only", "drifter:body/empty.yaml/x/0").returncode, 3)
        self.assertEqual(run(RECORDER, "--target", "x").returncode, 3)


if __name__ == "__main__":
    unittest.main()
