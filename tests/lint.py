#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Looks through sources of a build with clang-tidy and cppcheck.

usage: lint.py ROOT BUILD [FILE|FOLDER ...]

ROOT: the tree, with .clang-tidy and tests/cppcheck_*. BUILD: has compile_commands.json, and is given
what each tool found in each source, so that it looks again only when the source, a file of the tree that
it includes, how it is compiled, or the tool or its settings has changed. Prints
`FILE:LINE: MESSAGE [CHECK]` for each finding, once where a header is in several sources. Exit code 1:
there are findings; 2: the arguments are wrong. Sources that the build does not have are named.
"""
import concurrent.futures
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

TIDY_SETTINGS = ".clang-tidy"  # of the root, and of folders
CPPCHECK_SUPPRESSIONS = "tests/cppcheck_suppressions.txt"
CPPCHECK_GOOGLETEST = "tests/cppcheck_googletest.cfg"
FINDING = re.compile(r"^(?P<file>[^\s:][^:]*):(?P<line>\d+):\d+: (?:warning|error|fatal error): (?P<message>.*\])$")

# Ends what is said of a source that a tool could not look through, which another run may.
FAILED = " [lint]"


class Source:
    """A source, and how it is compiled."""

    def __init__(self, entry):
        self.path = Path(entry["directory"], entry["file"])
        self.folder = entry["directory"]
        words = entry.get("arguments") or shlex.split(entry["command"])
        # Before the compiler stands what launches it.
        first = next(i for i, word in enumerate(words) if re.search(r"(clang|g|c)\+\+(-\d+)?$", word))
        self.words = words[first:]


class Linter:
    def __init__(self, root, build):
        self.root, self.build = root, build
        self.tools = {"clang-tidy": self.tidy, "cppcheck": self.cppcheck}
        self.versions = {tool: output_of([tool, "--version"]) for tool in self.tools}

    def relative(self, path):
        path = os.path.realpath(path)
        root = f"{self.root}{os.sep}"
        return path[len(root):] if path.startswith(root) else None

    @staticmethod
    def settings(tool, files):
        if tool == "cppcheck":
            return [CPPCHECK_SUPPRESSIONS, CPPCHECK_GOOGLETEST]
        # clang-tidy takes the names of each folder's settings.
        return sorted({str(folder / TIDY_SETTINGS) for name in files for folder in Path(name).parents})

    def state(self, tool, source, files):
        """Of all that a tool's findings come from: equal states have equal findings."""
        digest = hashlib.sha256(json.dumps([self.versions[tool], source.words, files]).encode())
        for name in [*self.settings(tool, files), *files]:
            path = self.root / name
            digest.update(hashlib.sha256(path.read_bytes() if path.is_file() else b"").digest())
        return digest.hexdigest()

    def files_of(self, source):
        """The source and the files of the tree that it includes."""
        words, kept = iter(source.words[1:]), []
        for word in words:
            if word in ("-o", "-MF", "-MT", "-MQ"):
                next(words)
            elif word not in ("-c", "-MD", "-MMD"):
                kept.append(word)
        rule = output_of([source.words[0], *kept, "-M"], source.folder)
        names = shlex.split(rule.partition(": ")[2].replace("\\\n", " "))
        found = {self.relative(Path(source.folder, name)) for name in [str(source.path), *names]}
        return sorted(found - {None})

    def findings(self, source, command):
        """What a tool says of files of the tree; that it failed, if it says nothing and did."""
        done = subprocess.run(command, cwd=source.folder, text=True, capture_output=True, check=False)
        said, found = done.stdout + done.stderr, []
        for match in filter(None, map(FINDING.match, said.splitlines())):
            name = self.relative(Path(source.folder, match["file"]))
            if name:
                found.append([name, int(match["line"]), match["message"]])
        # By a signal it may end among its findings.
        if done.returncode < 0 or (done.returncode and not found):
            message = f"{command[0]} ends with {done.returncode}: {' '.join(said.split())}{FAILED}"
            found.append([self.relative(source.path), 1, message])
        return found

    def tidy(self, source):
        return self.findings(source, ["clang-tidy", "--quiet", "-p", str(self.build), str(source.path)])

    def cppcheck(self, source):
        # System headers are left out: cppcheck knows what the standard library's do.
        flags = [word for word in source.words if re.match(r"-[ID].", word)]
        return self.findings(source, [
            "cppcheck", "--quiet", "--enable=warning,performance,portability", "--std=c++20", "--language=c++",
            "--library=googletest", f"--library={self.root / CPPCHECK_GOOGLETEST}", "--error-exitcode=3",
            f"--suppressions-list={self.root / CPPCHECK_SUPPRESSIONS}",
            "--template={file}:{line}:0: warning: {message} [cppcheck-{id}]", "--template-location=",
            *flags, str(source.path)])

    def look(self, source):
        """Findings in a source, and whether they were known."""
        record = self.build / "lint" / f"{self.relative(source.path)}.json"
        known = json.loads(record.read_text(encoding="utf-8")) if record.is_file() else {"files": []}

        def unknown(tool, files):
            return tool not in known or known[tool]["state"] != self.state(tool, source, files)

        def found():
            return [finding for tool in self.tools for finding in known[tool]["findings"]]

        if not any(unknown(tool, known["files"]) for tool in self.tools):
            return found(), True
        try:
            files = self.files_of(source)
        except subprocess.CalledProcessError as error:
            message = f"does not compile: {' '.join(error.stderr.split())}{FAILED}"
            return [[self.relative(source.path), 1, message]], False
        for tool, findings_of in self.tools.items():
            if unknown(tool, files):
                known[tool] = {"state": self.state(tool, source, files), "findings": findings_of(source)}
        known["files"] = files
        if any(message.endswith(FAILED) for _, _, message in found()):
            return found(), False
        record.parent.mkdir(parents=True, exist_ok=True)
        # Complete or not there, should the run be stopped.
        partial = record.with_suffix(".partial")
        partial.write_text(json.dumps(known), encoding="utf-8")
        partial.replace(record)
        return found(), False


def output_of(command, folder=None):
    return subprocess.run(command, cwd=folder, text=True, capture_output=True, check=True).stdout


def not_built(linter, sources, wanted):
    """Sources below the folders named that the build leaves out: what they need is not installed."""
    for name in wanted:
        for path in sorted(Path(os.path.realpath(name)).rglob("*.cpp")):
            relative = linter.relative(path)
            if relative not in sources and not relative.startswith(("build", ".")):
                yield relative


def chosen(linter, sources, wanted):
    """Sources that are one of the names given or below it."""
    found = {}
    for name in wanted:
        path = Path(os.path.realpath(name))
        below = [key for key in sources if (linter.root / key) == path or path in (linter.root / key).parents]
        if not below:
            what = "no such file or folder" if not path.exists() else (
                "the build has no such source (a header is looked at with those that include it)"
                if path.is_file() else "the build has no source there")
            print(f"error: {name}: {what}", file=sys.stderr)
            sys.exit(2)
        found.update((key, sources[key]) for key in below)
    return found


def main():
    if len(sys.argv) < 3:
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        sys.exit(2)
    linter = Linter(Path(os.path.realpath(sys.argv[1])), Path(os.path.realpath(sys.argv[2])))
    entries = json.loads((linter.build / "compile_commands.json").read_text(encoding="utf-8"))
    sources = {}
    for entry in entries:
        source = Source(entry)
        name = linter.relative(source.path)
        # Not what is generated; a source of several targets once.
        if name and linter.build not in source.path.parents:
            sources.setdefault(name, source)
    wanted = sys.argv[3:] or [str(linter.root)]
    looked_at = chosen(linter, sources, wanted)
    for name in not_built(linter, sources, wanted):
        print(f"{name}: not in this build, and so not looked at")

    printed, known = set(), 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings, was_known in pool.map(linter.look, looked_at.values()):
            known += was_known
            for file, line, message in findings:
                text = f"{file}:{line}: {message}"
                if text not in printed:
                    print(text, flush=True)
                printed.add(text)
    print(f"{len(looked_at)} sources, {known} of them as they were, {len(printed)} findings")
    sys.exit(1 if printed else 0)


if __name__ == "__main__":
    main()
