# SPDX-License-Identifier: BSD-3-Clause
"""Mutations as they stand in mutations/*.txt, and whether they still fit the tree."""

import hashlib
import pathlib
import re
from dataclasses import dataclass

KEYS = ("file", "why", "tests")
OPENING, MIDDLE, CLOSING = "<<<<", "====", ">>>>"


class Malformed(Exception):
    """A file of mutations cannot be read; says where and why."""


@dataclass(frozen=True)
class Mutation:
    name: str
    component: str  # the stem of its file: core, lanes, ...
    where: str  # FILE:LINE of its name
    file: str  # in the tree
    why: str
    tests: str  # a regular expression of ctest names, of which all of a name has to match
    original: str
    replacement: str

    def digest(self):
        """Changes with what is done to the tree, not with what is said about it."""
        text = "\0".join((self.file, self.original, self.replacement))
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def fault(self, tree):
        """Why it cannot be applied to the tree; None if it can."""
        try:
            re.compile(self.tests)
        except re.error as error:
            return f"its tests are no regular expression: {error}"
        path = pathlib.Path(tree) / self.file
        if not path.is_file():
            return f"no file {self.file}"
        found = path.read_text().count(self.original)
        if found != 1:
            return f"its text occurs {found} times in {self.file} instead of once"
        if self.original == self.replacement:
            return "its replacement is the text itself"
        return None


class Lines:
    """Of one file, with the number of the next, from 1."""

    def __init__(self, path):
        self.path = path
        self.lines = path.read_text().splitlines(keepends=True)
        self.at = 0

    def place(self):
        return f"{self.path.name}:{self.at + 1}"

    def refuse(self, what):
        raise Malformed(f"{self.place()}: {what}")

    def next(self):
        if self.at == len(self.lines):
            self.refuse("the file ends within a mutation")
        line = self.lines[self.at]
        self.at += 1
        return line

    def skip_blank(self):
        while self.at < len(self.lines) and (
            not self.lines[self.at].strip() or self.lines[self.at].startswith("#")
        ):
            self.at += 1
        return self.at < len(self.lines)

    def until(self, marker):
        text = ""
        while (line := self.next()).rstrip("\n") != marker:
            text += line
        return text


def read_one(lines, component):
    where = lines.place()
    heading = re.fullmatch(r"= (\w+)\n", lines.next())
    if not heading:
        lines.at -= 1
        lines.refuse("expected '= NAME'")
    fields = {}
    while (line := lines.next().rstrip("\n")) != OPENING:
        key, _, value = line.partition(": ")
        if key not in KEYS or key in fields or not value:
            lines.at -= 1
            lines.refuse(f"expected each of {', '.join(KEYS)} once, as 'KEY: VALUE', then {OPENING}")
        fields[key] = value
    if len(fields) != len(KEYS):
        lines.refuse(f"{heading[1]} lacks one of {', '.join(KEYS)}")
    original = lines.until(MIDDLE)
    replacement = lines.until(CLOSING)
    if not original.strip():
        lines.refuse(f"{heading[1]} replaces nothing")
    return Mutation(heading[1], component, where, original=original, replacement=replacement, **fields)


def read_all(folder):
    """In the order of the files' names; throws Malformed."""
    found = {}
    for path in sorted(pathlib.Path(folder).glob("*.txt")):
        lines = Lines(path)
        while lines.skip_blank():
            mutation = read_one(lines, path.stem)
            if mutation.name in found:
                raise Malformed(f"{mutation.where}: {mutation.name} is also at {found[mutation.name].where}")
            found[mutation.name] = mutation
    if not found:
        raise Malformed(f"no mutations in {folder}")
    return list(found.values())
