#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""compare.py A B: prints the lines in which two records of swept_answers_record differ; see README.md.

Exit code 1 if any verdict differs, or a line is in one record only; 3 for bad usage; else 0."""
import sys


def parsed(name):
    """Lines by what they are of, and the lines about the whole record."""
    lines, remarks = {}, []
    with open(name, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if line.startswith("#"):
                remarks.append(line.rstrip("\n"))
                continue
            fields = [word.partition("=") for word in words if "=" in word]
            key = tuple(word for word in words if "=" not in word)
            lines[key] = {name: value for name, _, value in fields if name != "seconds"}
    return lines, remarks


def shown(fields):
    return " ".join(f"{name}={value}" for name, value in fields.items())


def compare(first, second):
    """Number of lines that differ in the verdict, and of those that differ in the rest alone."""
    wrong = other = 0
    for key in first.keys() | second.keys():
        if key not in first or key not in second:
            wrong += 1
    for key, before in first.items():
        if key not in second:
            print("missing", *key)
            continue
        after = second[key]
        if before == after:
            continue
        # Everything but the full digest decides.
        if {**before, "full": ""} == {**after, "full": ""}:
            other += 1
            print("full only", *key)
        else:
            wrong += 1
            print("VERDICT", *key)
        print(f"  {shown(before)}\n  {shown(after)}")
    for key in second:
        if key not in first:
            print("added", *key)
    return wrong, other


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 3
    (first, remarks), (second, moreRemarks) = map(parsed, arguments)
    if remarks != moreRemarks:
        for name, lines in zip(arguments, (remarks, moreRemarks)):
            for line in lines:
                print(f"{name}: {line}")
    wrong, other = compare(first, second)
    print(f"{len(first)} and {len(second)} lines: {wrong} differ in the verdict, {other} in the full digest only")
    return 1 if wrong or not first else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (OSError, UnicodeDecodeError) as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(3)
