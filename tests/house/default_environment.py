#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every public function that computes asks for the floating-point environment first.

usage: default_environment.py OBJDUMP LIST LIBRARY ...

Looks at the machine code of the libraries: a function of namespace swept (detail:: is not public) that has
arithmetic in it, or calls a function of swept that has, asks with `stmxcsr` itself, or LIST names it, with the
reason. Calls of functions that ask are of no account, and those through pointers cannot be followed. A name in
LIST that needs not be there is a fault, too.
"""
import re
import subprocess
import sys
from fnmatch import fnmatchcase

FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
CALL = re.compile(r"^\s*[0-9a-f]+:\s+(?:call|jmp|j[a-z]+)\s+[0-9a-f]+ <(.*?)(?:\+0x[0-9a-f]+)?>")
RELOCATION = re.compile(r"R_X86_64_(?:PLT32|PC32|GOTPCREL\w*)\s+(.*?)(?:[-+]0x[0-9a-f]+)?$")
ARITHMETIC = re.compile(r"^\s*[0-9a-f]+:\s+(?:lock )?(v?(?:add|sub|mul|div|sqrt|hadd|hsub|round)[sp][sd]"
                        r"|v?cvt\w+|f(?:add|sub|mul|div|sqrt|chs|ild|ist)\w*)\b")
ASKS = re.compile(r"\bv?stmxcsr\b|in(?:Foreign|Default)Environment")


def plain(name):
    """Without what the compiler adds to the names of parts of a function, and without @plt."""
    return re.sub(r" \[clone .*?\]|\[abi:\w+\]|@plt", "", name).strip()


def path(name):
    """swept::Aabb::fit of `swept::Aabb swept::Aabb::fit<3>(std::span<...>)`."""
    name = name.replace("(anonymous namespace)", "{anonymous}").replace("operator()", "operator{}")
    depth, out = 0, ""
    for character in name:
        depth += character == "<"
        if depth == 0:
            if character == "(":
                break
            out += character
        depth -= character == ">"
    return out.split(" ")[-1].replace("operator{}", "operator()")


def is_public(name):
    """Destructors and copies move memory; what they would compute is of others."""
    where = path(name).split("::")
    return (where[0] == "swept" and len(where) > 1 and where[1] not in ("detail", "verify")
            and not any(part.startswith(("{", "~", "operator=")) for part in where) and "{lambda" not in name)


def functions(objdump, library):
    """Per function: whether it asks before there is arithmetic in it, whether there is any, and what it calls.
    Functions that are not public do not ask: what does so in them is a small public function that was inlined."""
    text = subprocess.run([objdump, "-dr", "--no-show-raw-insn", "-C", library], check=True,
                          capture_output=True, text=True).stdout
    found, current, called = {}, None, None
    for line in text.split("\n"):
        match = FUNCTION.match(line)
        if match:
            name = plain(match.group(1))
            current = found.setdefault(name, {"name": name, "asks": False, "computes": False, "calls": set()})
            continue
        if current is None:
            continue
        if ASKS.search(line) and not current["computes"]:
            current["asks"] = is_public(current["name"])
        current["computes"] = current["computes"] or bool(ARITHMETIC.match(line))
        # Where a relocation follows, the address before it means nothing yet.
        match = CALL.match(line)
        relocation = RELOCATION.search(line)
        if relocation:
            current["calls"].add(plain(relocation.group(1)))
        elif called:
            current["calls"].add(called)
        called = plain(match.group(1)) if match else None
    return found


def computing(found):
    """Names of functions with arithmetic in them or below, short of functions that ask."""
    those = {name for name, function in found.items() if function["computes"] and not function["asks"]}
    callers = {}
    for name, function in found.items():
        for called in function["calls"]:
            callers.setdefault(called, set()).add(name)
    waiting = list(those)
    while waiting:
        for caller in callers.get(waiting.pop(), ()):
            if caller not in those and not found[caller]["asks"]:
                those.add(caller)
                waiting.append(caller)
    return those


def main():
    objdump, allowed = sys.argv[1], {}
    with open(sys.argv[2], encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                name, _, reason = line.strip().partition(": ")
                allowed[name] = reason
    asking, faults, needed = 0, [], set()
    for library in sys.argv[3:]:
        found = functions(objdump, library)
        asking += sum(function["asks"] and is_public(name) for name, function in found.items())
        for name in sorted(computing(found)):
            if not is_public(name):
                continue
            where = path(name).removeprefix("swept::")
            fits = [pattern for pattern in allowed if fnmatchcase(where, pattern)]
            needed.update(fits)
            if not fits:
                faults.append(f"{where} computes in whatever environment it is called: {name}")
    faults += [f"{name} is listed, and needs not be" for name in sorted(set(allowed) - needed)]
    faults += [f"{name} is listed without a reason" for name, reason in allowed.items() if not reason]
    print("\n".join([*faults, f"{asking} public functions ask, {len(allowed)} need not"]))
    sys.exit(1 if faults or asking < 100 else 0)


if __name__ == "__main__":
    main()
