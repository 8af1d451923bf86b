#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Redraws the tables of measurements in the tree's pages from what record.sh wrote to tests/benchmark/results.

tables.py [--check] [TREE]: all `*.md` of TREE (this one), but for results and builds. With --check nothing is written,
and the exit code is 1 when a page is not what the results give. 2: a mark cannot be followed, or there is no page.

A table stands between a mark and `<!-- end of results -->`. Of one table of results:

    <!-- results: FILE table 2 | COLUMN | COLUMN = title | COLUMN * 1e-3 = title | where COLUMN = value or value -->

FILE is named from the folder of results; `.md` has tables counted from 1, `.csv` is one; `table 2 to 4` is the rows of
all these, if they have the same titles. Of columns with the same title
the second is `COLUMN 2`. Products have three digits. A summary of ratios, over the rows that `where` leaves:

    <!-- ratios:
    what is measured: FILE table 1 | COLUMN | where COLUMN = value
    what is measured: FILE table 1 | number 2 of COLUMN
    -->
"""
import csv
import os
import pathlib
import re
import statistics
import sys

RESULTS = pathlib.Path("tests/benchmark/results")
MARK = re.compile(r"<!-- (results|ratios):(.*?)-->\n", re.S)
END = "<!-- end of results -->"


class MarkError(Exception):
    """A mark that says nothing that can be drawn."""


def cells(line):
    return [cell.strip() for cell in line.strip()[1:-1].split("|")]


def markdown_tables(text):
    """Tables as lists of rows, the head first, without the line below it."""
    tables, inside = [], False
    for line in text.splitlines():
        if line.startswith("|"):
            if not inside:
                tables.append([])
            tables[-1].append(cells(line))
        inside = line.startswith("|")
    return [table[:1] + table[2:] for table in tables]


def read_table(root, source):
    """Rows as dictionaries by title."""
    match = re.fullmatch(r"(\S+\.md) table (\d+)( to \d+)?|(\S+\.csv)", source)
    if not match:
        raise MarkError(f"'{source}': FILE.md table N, FILE.md table N to M or FILE.csv")
    file = root / RESULTS / (match[1] or match[4])
    if not file.is_file():
        raise MarkError(f"no file {file.relative_to(root)}")
    text = file.read_text(encoding="utf-8")
    if match[4]:
        table = list(csv.reader(text.splitlines()))
    else:
        tables, first = markdown_tables(text), int(match[2])
        last = int(match[3][len(" to "):]) if match[3] else first
        if not 1 <= first <= last <= len(tables):
            raise MarkError(f"{file.relative_to(root)} has {len(tables)} tables, no {source.split(' ', 1)[1]}")
        table = tables[first - 1]
        for other in tables[first:last]:
            if other[0] != table[0]:
                raise MarkError(f"{source}: the tables have other titles than table {first}")
            table = table + other[1:]
    titles = []
    for title in table[0]:
        again = sum(re.sub(r" \d+$", "", known) == title for known in titles)
        titles.append(f"{title} {again + 1}" if again else title)
    return [dict(zip(titles, row)) for row in table[1:]]


def value_in(row, column):
    if column not in row:
        raise MarkError(f"no column '{column}', there are: {'; '.join(row)}")
    return row[column]


def selected(root, spec):
    """Rows and columns that `SOURCE | COLUMN ... | where COLUMN = value ...` asks for."""
    source, *parts = [part.strip() for part in spec.split("|")]
    rows, columns = read_table(root, source), []
    for part in parts:
        if part.startswith("where "):
            column, _, value = part[len("where "):].partition(" = ")
            rows = [row for row in rows if value_in(row, column.strip()) in value.split(" or ")]
        else:
            columns.append(part)
    if not rows:
        raise MarkError(f"no row of {source} is left")
    if not columns:
        raise MarkError(f"no column of {source} is asked for")
    return rows, columns


def product(cell, factor, column):
    try:
        return f"{float(cell) * float(factor):.3g}"
    except ValueError as error:
        raise MarkError(f"'{column} * {factor}': cell '{cell}' or the factor is no number") from error


def number_in(cell, index):
    found = re.findall(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?", cell)
    return float(found[index - 1]) if len(found) >= index else None


def line_of(row):
    return "| " + " | ".join(row) + " |\n"


def drawn(titles, rows):
    return line_of(titles) + line_of(["---"] * len(titles)) + "".join(line_of(row) for row in rows)


def part_of_table(root, spec, _):
    rows, columns = selected(root, spec)
    titles, out = [], [[] for _ in rows]
    for column in columns:
        name, _, title = column.partition(" = ")
        name, _, factor = name.partition(" * ")
        titles.append(title or name)
        for row, line in zip(rows, out):
            cell = value_in(row, name)
            line.append(product(cell, factor, name) if factor and cell else cell)
    return drawn(titles, out)


def ratios(root, spec, page):
    out = []
    for line in spec.strip().splitlines():
        what, _, rest = line.partition(": ")
        rows, columns = selected(root, rest)
        match = re.fullmatch(r"(?:number (\d) of )?(.*)", columns[0])
        numbers = [number_in(value_in(row, match[2]), int(match[1] or 1)) for row in rows]
        numbers = [number for number in numbers if number is not None]
        if not numbers:
            raise MarkError(f"no number in '{columns[0]}'")
        file = rest.split()[0]
        link = pathlib.PurePosixPath(os.path.relpath(root / RESULTS / file, page.parent))
        out.append([what, *(f"{f(numbers):.2g}" for f in (min, statistics.median, max)),
                    str(len(numbers)), f"[{pathlib.PurePosixPath(file).stem}]({link})"])
    return drawn(["", "least", "median", "most", "rows", "results"], out)


def redrawn(root, page, text):
    """The page's text with its tables drawn anew, and the lines of the marks whose tables were others."""
    parts, changed, ends, at = [], [], set(), 0
    for mark in MARK.finditer(text):
        line = text.count("\n", 0, mark.start()) + 1
        end = text.find(END, mark.end())
        if end < 0 or MARK.search(text, mark.end(), end):
            raise MarkError(f"{page.relative_to(root)}:{line}: error: no '{END}' after this mark")
        try:
            draw = part_of_table if mark[1] == "results" else ratios
            table = f"\n{draw(root, mark[2].strip(), page)}\n"
        except MarkError as error:
            raise MarkError(f"{page.relative_to(root)}:{line}: error: {error}") from error
        if text[mark.end():end] != table:
            changed.append(line)
        parts += [text[at:mark.end()], table]
        ends.add(end)
        at = end
    # Behind a mark with a slip in it stands a table that nothing compares.
    for end in re.finditer(re.escape(END), text):
        if end.start() not in ends:
            line = text.count("\n", 0, end.start()) + 1
            raise MarkError(f"{page.relative_to(root)}:{line}: error: no mark before this '{END}'")
    return "".join(parts) + text[at:], changed


def pages(root):
    for page in sorted(root.rglob("*.md")):
        inside = page.relative_to(root)
        if not inside.parts[0].startswith(("build", ".")) and RESULTS not in inside.parents:
            yield page


def main(arguments):
    check = arguments[:1] == ["--check"]
    rest = arguments[check:]
    if len(rest) > 1 or any(argument.startswith("-") for argument in rest):
        raise MarkError("usage: tables.py [--check] [TREE]")
    root = pathlib.Path(rest[0] if rest else pathlib.Path(__file__).parents[2]).resolve()
    differ, found = 0, list(pages(root))
    if not found:
        raise MarkError(f"no pages in '{root}'")
    for page in found:
        text = page.read_text(encoding="utf-8")
        new, changed = redrawn(root, page, text)
        differ += len(changed)
        for line in changed:
            print(f"{page.relative_to(root)}:{line}: " +
                  ("not what the results give; tests/benchmark/tables.py redraws it" if check else "redrawn"))
        if changed and not check:
            page.write_text(new, encoding="utf-8")
    return 1 if check and differ else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except MarkError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
