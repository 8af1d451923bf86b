# SPDX-License-Identifier: BSD-3-Clause
"""The stubs name what there is, mypy accepts them and the examples, and everything has a docstring."""
import ast
import inspect
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import swept
from swept import _swept

PACKAGE = Path(swept.__file__).parent


def stub_members():
    """Names of the stub, and of the members of its classes."""
    tree = ast.parse((PACKAGE / "_swept.pyi").read_text())
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = None
    return found


def test_stubs_name_what_there_is():
    public = {name for name in dir(_swept) if not name.startswith("_")}
    stubs = stub_members()
    assert public == set(stubs)
    for name, members in stubs.items():
        if members is None:
            continue
        actual = {part for part in vars(getattr(_swept, name)) if not part.startswith("_")}
        assert {part for part in members if not part.startswith("_")} == actual, name
        for part in members:
            assert hasattr(getattr(_swept, name), part), f"{name}.{part}"


def test_arguments_of_stubs_are_those_of_docstrings():
    """pybind11 puts a signature at the head of a docstring: names and order have to be the stub's."""
    tree = ast.parse((PACKAGE / "_swept.pyi").read_text())
    functions = [(None, node) for node in tree.body if isinstance(node, ast.FunctionDef)]
    for owner in (node for node in tree.body if isinstance(node, ast.ClassDef)):
        for node in owner.body:
            decorators = {getattr(decorator, "id", "") for decorator in getattr(node, "decorator_list", [])}
            if isinstance(node, ast.FunctionDef) and not decorators & {"property", "overload"}:
                functions.append((owner.name, node))
    compared = 0
    for owner, node in functions:
        if node.name.startswith("__") and node.name != "__init__":
            continue
        actual = getattr(getattr(_swept, owner), node.name) if owner else getattr(_swept, node.name)
        head = (actual.__doc__ or "").split("\n")[0]
        if not head.startswith(node.name + "("):
            continue
        names = [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"]
        found = re.findall(r"[(,] ?(\w+): ", head)
        assert [name for name in found if name != "self"] == names, f"{owner}.{node.name}: {head}"
        compared += 1
    assert compared > 80


def test_everything_has_a_docstring():
    for name in swept.__all__:
        one = getattr(swept, name)
        assert one.__doc__, name
        if inspect.isclass(one) and one.__module__.startswith("swept"):
            for part, value in vars(one).items():
                if not part.startswith("_") and (callable(value) or inspect.isdatadescriptor(value)):
                    assert inspect.getdoc(value), f"{name}.{part}"


def test_pages_show_what_runs():
    program = Path("planners_demo/examples/python/01_plan.py").read_text().split('"""\n')[-1].strip()
    assert f"```python\n{program}\n```" in Path("README.md").read_text()
    page = Path("ompl_bridge/python/README.md").read_text()
    exec(page.split("```python\n")[1].split("```")[0], {})
    for name in swept.__all__:
        assert re.search(rf"\b{name}\b", page) or inspect.isclass(getattr(swept, name)), name


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_mypy_accepts_stubs_and_examples(tmp_path):
    # One program at a time: all are scripts of the same name for mypy.
    examples = sorted(str(path) for path in Path("planners_demo/examples/python").rglob("*.py"))
    assert len(examples) >= 10
    command = [shutil.which("mypy"), "--python-version", "3.11", "--cache-dir", str(tmp_path), "--scripts-are-modules"]
    for arguments in (["--strict", "--no-warn-unused-ignores", str(PACKAGE)], examples):
        result = subprocess.run(command + arguments, capture_output=True, text=True, timeout=500)
        assert result.returncode == 0, result.stdout + result.stderr
