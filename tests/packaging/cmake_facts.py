# SPDX-License-Identifier: BSD-3-Clause
"""What the project's files for CMake say of its parts, for comparison with what recipes and workflows say."""
import re
from pathlib import Path

# Folders of the parts that CMakeLists.txt adds. The program is a part, and no component that is installed.
FOLDERS = {"core": "core", "robot_model": "robot_model", "robot_model/proofs": "proofs",
           "robot_model/pages": "pages", "ompl_bridge": "ompl_bridge", "planners_demo": "program"}
# Threads is of the system, and comes with the compiler.
OF_THE_SYSTEM = {"Threads"}


class CMakeFacts:
    """Of the tree `root`:

    version, standard: of project(), and of C++
    packages: part -> names that find_package looks for, without which it is left out
    below: part -> parts without which it is left out
    installed: component -> the names that swept_install_library has behind each of its keywords
    settings: names of options and of other settings of a build
    sought: all names that find_package looks for
    code: all the files that are compared with, as one text
    """

    def __init__(self, root):
        self.root = Path(root)
        text = self._read("CMakeLists.txt")
        files = [path for folder in ("core", "robot_model", "ompl_bridge", "planners_demo")
                 for pattern in ("CMakeLists.txt", "*.cmake") for path in sorted((self.root / folder).rglob(pattern))]
        self.code = "\n".join([text, *(path.read_text(encoding="utf-8") for path in files)])
        self.code = re.sub(r"(?m)(^|\s)#.*$", "", self.code)
        self.version = re.search(r"project\(swept VERSION (\S+)", text).group(1)
        self.standard = int(re.search(r"set\(CMAKE_CXX_STANDARD (\d+)\)", text).group(1))
        self.sought = set(re.findall(r"find_package\((\w[\w-]*)", self.code))
        self.settings = set(re.findall(r"(?:option|find_path|find_program)\((\w+)", self.code))
        self.settings |= set(re.findall(r"set\((\w+)[^)]*\bCACHE\b", self.code))
        self._read_parts(text)
        self._read_installed()

    def _read(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def _read_parts(self, text):
        by_case = {name.lower(): name for name in self.sought}
        self.packages, self.below = {}, {}
        condition = ""
        for line in text.splitlines():
            asked = re.match(r"\s*(?:else)?if\((.*)\)", line)
            if asked:
                condition = asked.group(1)
            added = re.match(r"(\s*)add_subdirectory\((\S+)\)", line)
            if not added or added.group(2) not in FOLDERS:
                continue
            part = FOLDERS[added.group(2)]
            asked = condition if added.group(1) else ""
            self.packages[part] = {by_case[name.lower()] for name in re.findall(r"([\w-]+)_FOUND", asked)}
            self.below[part] = set(re.findall(r"TARGET swept_(\w+)", asked))
        required = re.findall(r"find_package\((\w+) REQUIRED", self._read("core/CMakeLists.txt"))
        self.packages["core"] = set(required) - OF_THE_SYSTEM
        for part in self.below.keys() - {"core"}:
            self.below[part].add("core")
        self.below = {part: self.closure(below) for part, below in self.below.items()}

    def _read_installed(self):
        self.installed = {}
        text = self._read("planners_demo/packaging/CMakeLists.txt")
        for call in re.findall(r"(?m)^ *swept_install_library\(([^()]*(?:\([^()]*\)[^()]*)*)\)", text):
            component, *words = re.findall(r'"[^"]*"|\S+', call)
            behind, keyword = {}, None
            for word in words:
                if re.fullmatch(r"[A-Z_]{5,}", word):
                    keyword = behind.setdefault(word, [])
                else:
                    keyword.append(word)
            self.installed[component] = behind

    def links(self, component):
        """Packages that who links a component, as a static library, needs."""
        behind = self.installed[component]
        return {*behind.get("PACKAGES", []), *behind.get("STATIC_PACKAGES", [])} - OF_THE_SYSTEM

    def closure(self, parts):
        """These parts with all that they are built on."""
        found = set()
        pending = list(parts)
        while pending:
            part = pending.pop()
            if part not in found:
                found.add(part)
                pending += self.below[part]
        return found
