#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every header of the tree includes the standard headers of what it names, and every public one the public
headers of the types that it names.

usage: includes.py ROOT

The check is by text, so it knows only names that one header stands for.
"""
import re
import sys
from pathlib import Path

FOLDERS = ["core", "robot_model", "ompl_bridge", "planners_demo", "tests"]
NAMES = {
    "algorithm": "sort stable_sort min_element max_element any_of all_of none_of find_if count_if fill_n "
                 "fill clamp copy_n remove_if unique lower_bound upper_bound nth_element "
                 "partial_sort reverse",
    "array": "array",
    "atomic": "atomic atomic_bool atomic_int",
    "bit": "bit_cast countr_zero popcount has_single_bit",
    "chrono": "chrono",
    "cmath": "sqrt hypot atan2 isfinite isnan nextafter ldexp frexp fmod remainder lround ceil floor "
             "sin cos tan acos asin atan pow exp log cbrt copysign signbit",
    "condition_variable": "condition_variable",
    "cstdint": "uint8_t uint16_t uint32_t uint64_t int8_t int16_t int32_t int64_t",
    "deque": "deque",
    "exception": "exception_ptr current_exception rethrow_exception",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream fstream",
    "functional": "function hash reference_wrapper",
    "iostream": "cout cerr cin clog",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "unique_ptr shared_ptr weak_ptr make_unique make_shared enable_shared_from_this",
    "mutex": "mutex lock_guard unique_lock scoped_lock call_once once_flag",
    "new": "bad_alloc",
    "numbers": "numbers",
    "numeric": "accumulate iota reduce inner_product gcd lcm",
    "optional": "optional nullopt",
    "queue": "queue priority_queue",
    "random": "mt19937 mt19937_64 uniform_real_distribution uniform_int_distribution normal_distribution",
    "regex": "regex",
    "set": "set multiset",
    "shared_mutex": "shared_mutex shared_lock",
    "span": "span",
    "sstream": "stringstream ostringstream istringstream",
    "stdexcept": "runtime_error logic_error invalid_argument out_of_range length_error",
    "string": "string to_string stod stoi getline",
    "string_view": "string_view",
    "thread": "thread jthread this_thread",
    "tuple": "tuple make_tuple tie",
    "type_traits": "is_same_v decay_t conditional_t enable_if_t is_base_of_v remove_cvref_t",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "utility": "pair move swap exchange",
    "variant": "variant visit holds_alternative get_if monostate",
    "vector": "vector",
}
# What a standard header is bound to bring along.
BRINGS = {
    "iostream": ["istream", "ostream"],
    "map": ["utility"],
    "unordered_map": ["utility"],
    "algorithm": ["utility"],
    "vector": ["utility"],
    "variant": ["utility"],
    "memory": ["utility"],
    "string": ["string_view"],
    "fstream": ["string"],
    "sstream": ["string"],
    "filesystem": ["string"],
    "stdexcept": ["string"],
    "regex": ["string"],
    "thread": ["chrono"],
}
HEADER_OF = {name: header for header, names in NAMES.items() for name in names.split()}
NAMED = re.compile(r"\bstd::(?:ranges::)?(\w+)")
DECLARED = re.compile(r"\b(?:class|struct|enum class|union|using|concept)\s+(?:alignas\(\d+\) )?([A-Z]\w*)")
# At the start of a line: not within a class. Forward declarations end in `;`.
DEFINED = re.compile(rf"^(?:template <.*>\s+)?{DECLARED.pattern}(?! *;)", re.M)
# As a type: before a comma may stand an enumerator.
TYPE = re.compile(r"(?<!::)\b([A-Z]\w*)(?=[&*>{(<]|::| \w)")
TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)


def included(text):
    """Standard headers that a text includes, with what these bring along."""
    found = set(re.findall(r"^\s*#include\s+<([^>]+)>", text, re.M))
    return found.union(*(BRINGS.get(header, []) for header in found))


def missing(path):
    text = path.read_text(encoding="utf-8")
    there = included(text)
    code = TEXT.sub(lambda match: "\n" * match.group().count("\n"), text)
    for number, line in enumerate(code.split("\n"), 1):
        for name in NAMED.findall(line):
            header = HEADER_OF.get(name)
            if header and header not in there:
                there.add(header)
                yield f"{path}:{number}: std::{name} without #include <{header}>"


def missing_public(root):
    folders = [root / folder / "include" for folder in [*FOLDERS, "robot_model/proofs", "robot_model/pages"]]
    texts = {str(path.relative_to(folder)): path.read_text(encoding="utf-8")
             for folder in folders for path in sorted(folder.rglob("*.hpp"))}
    codes = {header: TEXT.sub("", text) for header, text in texts.items()}
    homes = {}
    for header, code in codes.items():
        for name in DEFINED.findall(code):
            homes.setdefault(name, set()).add(header)
    for header, code in codes.items():
        there = {header, *re.findall(r'^#include "([^"]+)"', texts[header], re.M)}
        for name in sorted(set(TYPE.findall(code)) - set(DECLARED.findall(code))):
            if len(homes.get(name, [])) == 1 and not homes[name] <= there:
                yield f"{header}: {name} without #include \"{min(homes[name])}\""


def main():
    root = Path(sys.argv[1])
    files = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.hpp"))
    found = [line for path in files for line in missing(path)] + list(missing_public(root))
    print("\n".join([*found, f"{len(files)} headers, {len(found)} includes are missing"]))
    sys.exit(1 if found or not files else 0)


if __name__ == "__main__":
    main()
