#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What tables.py draws from results made up here, and that its --check notices a number that was typed."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TABLES = pathlib.Path(__file__).with_name("tables.py")
RESULT = """# things

| pair | query | swept, us | ratio | ratio |
|---|---|---|---|---|
| a | hit | 1.5 | 0.5, 0.25 | 2 |
| b | hit | 3 | 0.125, - | 4 |
| b | miss | 7 | - | 8 |

| other |
| --- |
| 1e-3 (FCL) |

| other |
| --- |
| 2 |
"""
TEMPLATE = """# Page

<!-- results: box/things.md table 1 | pair | swept, us = us | ratio 2 | where query = hit or none -->
{}<!-- end of results -->

<!-- ratios:
first of all: box/things.md table 1 | ratio
their second: box/things.md table 1 | number 2 of ratio
another: box/things.md table 2 to 3 | other
-->
{}<!-- end of results -->

<!-- results: box/sizes.csv | name | size [ns] * 1e-3 = size, us -->
{}<!-- end of results -->

The end.
"""
INSERTED = ("""
| pair | us | ratio 2 |
| --- | --- | --- |
| a | 1.5 | 2 |
| b | 3 | 4 |

""", """
|  | least | median | most | rows | results |
| --- | --- | --- | --- | --- | --- |
| first of all | 0.12 | 0.31 | 0.5 | 2 | [things](../tests/benchmark/results/box/things.md) |
| their second | 0.25 | 0.25 | 0.25 | 1 | [things](../tests/benchmark/results/box/things.md) |
| another | 0.001 | 1 | 2 | 2 | [things](../tests/benchmark/results/box/things.md) |

""", """
| name | size, us |
| --- | --- |
| one, two | 1.23 |
| three |  |

""")
PAGE = TEMPLATE.format("", "", "")
DRAWN = TEMPLATE.format(*INSERTED)


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.result = self.write("tests/benchmark/results/box/things.md", RESULT)
        self.write("tests/benchmark/results/box/sizes.csv", 'name,size [ns]\n"one, two",1234.5\nthree,\n')
        self.page = self.write("core/page.md", PAGE)

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def run_tables(self, *arguments):
        return subprocess.run([sys.executable, "-B", TABLES, *arguments, str(self.root)], text=True,
                              capture_output=True)

    def test_draws_what_marks_ask_for(self):
        run = self.run_tables()
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(run.stdout, "".join(f"core/page.md:{line}: redrawn\n" for line in (3, 6, 13)))
        self.assertEqual(self.page.read_text(), DRAWN)
        run = self.run_tables("--check")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_check_notices_each_changed_number(self):
        for old, new in (("| 1.5 |", "| 1.4 |"), ("| 0.12 | 0.31 |", "| 0.12 | 0.3 |"), ("1.23", "1.22")):
            with self.subTest(new):
                self.assertEqual(DRAWN.count(old), 1)
                changed = DRAWN.replace(old, new)
                self.page.write_text(changed)
                run = self.run_tables("--check")
                self.assertEqual(run.returncode, 1)
                self.assertRegex(run.stdout, r"\Acore/page.md:\d+: not what the results give; "
                                             r"tests/benchmark/tables.py redraws it\n\Z")
                self.assertEqual(self.page.read_text(), changed)

    def test_check_notices_another_result(self):
        self.page.write_text(DRAWN)
        self.result.write_text(RESULT.replace("0.5, 0.25", "0.6, 0.25"))
        run = self.run_tables("--check")
        self.assertEqual((run.returncode, run.stdout.count("\n")), (1, 1))

    def test_marks_that_cannot_be_followed(self):
        mark = "<!-- results: {} -->\n<!-- end of results -->\n"
        for page, message in (
                (mark.format("box/none.md table 1 | a"), "no file tests/benchmark/results/box/none.md"),
                (mark.format("box/things.md table 4 | a"),
                 "tests/benchmark/results/box/things.md has 3 tables, no table 4"),
                (mark.format("box/things.md table 3 to 2 | a"),
                 "tests/benchmark/results/box/things.md has 3 tables, no table 3 to 2"),
                (mark.format("box/things.md table 1 to 2 | a"),
                 "box/things.md table 1 to 2: the tables have other titles than table 1"),
                (mark.format("box/things.md | a"), "'box/things.md': FILE.md table N, FILE.md table N to M or FILE.csv"),
                (mark.format("box/things.md table 2 | a"), "no column 'a', there are: other"),
                (mark.format("box/things.md table 2"), "no column of box/things.md table 2 is asked for"),
                (mark.format("box/things.md table 1 | pair | where query = hits"),
                 "no row of box/things.md table 1 is left"),
                ("<!-- ratios:\nall: box/things.md table 1 | pair\n-->\n<!-- end of results -->\n",
                 "no number in 'pair'"),
                (mark.format("box/things.md table 1 | ratio * 2"),
                 "'ratio * 2': cell '0.5, 0.25' or the factor is no number"),
                (mark.format("box/things.md table 1 | swept, us * 1,5"),
                 "'swept, us * 1,5': cell '1.5' or the factor is no number"),
                ("<!--results: box/things.md table 2 | other --> <!-- end of results -->\n",
                 "no mark before this '<!-- end of results -->'"),
                ("<!-- results: box/things.md table 2 | other -->\n",
                 "no '<!-- end of results -->' after this mark")):
            with self.subTest(message):
                self.page.write_text("\n" + page)
                run = self.run_tables("--check")
                self.assertEqual((run.returncode, run.stdout, run.stderr),
                                 (2, "", f"core/page.md:2: error: {message}\n"))

    def test_a_tree_without_pages_is_no_tree(self):
        for file in self.root.rglob("*.md"):
            file.unlink()
        run = self.run_tables("--check")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (2, "", f"no pages in '{self.root.resolve()}'\n"))


if __name__ == "__main__":
    unittest.main()
