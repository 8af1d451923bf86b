#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""No two folders of a component's sources include each other, neither directly nor through others.

usage: include_cycles.py ROOT [--draw]

Without a cycle the folders that include others, or are included, are written in layers, those that include none
of the others first; with --draw, each with what it includes. A cycle is written with the lines that make it.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')


def source_roots(root):
    """The folders that quoted includes are looked for in."""
    return sorted(folder for folder in root.glob("**/src")
                  if folder.is_dir() and "build" not in folder.relative_to(root).parts)


def edges_of(source):
    """(folder, included folder) -> the lines that include, as FILE:LINE: FILE."""
    edges = {}
    for path in sorted(source.rglob("*")):
        if path.suffix not in (".hpp", ".cpp"):
            continue
        folder = path.parent.relative_to(source)
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            match = INCLUDE.match(line)
            if not match or not (source / match.group(1)).is_file():
                continue
            other = Path(match.group(1)).parent
            if other != folder:
                edges.setdefault((folder, other), []).append(
                    f"{path.relative_to(source)}:{number}: {match.group(1)}")
    return edges


def layers_of(folders, edges):
    """The folders in layers, and those that are left because they are in or above a cycle."""
    left = set(folders)
    layers = []
    while left:
        free = sorted(f for f in left if not any(a == f and b in left for a, b in edges))
        if not free:
            break
        layers.append(free)
        left.difference_update(free)
    return layers, left


def cycle_in(left, edges):
    """Folders, each of which includes the next; the last one includes the first."""
    way = [min(left)]
    while True:
        following = min(b for a, b in edges if a == way[-1] and b in left)
        if following in way:
            return way[way.index(following):]
        way.append(following)


def main():
    root = Path(sys.argv[1])
    draw = "--draw" in sys.argv[2:]
    failed = False
    for source in source_roots(root):
        edges = edges_of(source)
        folders = {folder for edge in edges for folder in edge}
        if not folders:
            continue
        layers, left = layers_of(folders, edges)
        name = source.relative_to(root)
        if left:
            failed = True
            cycle = cycle_in(left, edges)
            print(f"{name}: folders include each other:")
            for a, b in zip(cycle, cycle[1:] + cycle[:1]):
                print(f"  {a} includes {b}:")
                for line in edges[a, b]:
                    print(f"    {line}")
            continue
        print(f"{name}: " + " | ".join(", ".join(map(str, layer)) for layer in layers))
        if draw:
            for layer in layers:
                for folder in layer:
                    included = sorted(str(b) for a, b in edges if a == folder)
                    if included:
                        print(f"  {folder} -> {', '.join(included)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
