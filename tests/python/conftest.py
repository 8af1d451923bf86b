# SPDX-License-Identifier: BSD-3-Clause
"""Robots, worlds and checkers that the tests share, and C++'s answers."""
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import swept

MODELS = Path("models")


class Oracle:
    """Asks a program of C++, tests/python/oracle.cpp, about one checker."""

    def __init__(self, robot: str, group: str, scene: str) -> None:
        self._arguments = [robot, group, scene]

    def ask(self, question, rows):
        """One list of words for each row of numbers."""
        text = "".join(question + " " + " ".join(x.hex() for x in map(float, row)) + "\n" for row in rows)
        result = subprocess.run([os.environ["SWEPT_PYTHON_ORACLE"], *self._arguments],
                                input=text, capture_output=True, text=True, check=True)
        lines = result.stdout.splitlines()
        assert len(lines) == len(rows)
        return [line.split() for line in lines]


def numbers(words):
    return np.array([float.fromhex(word) for word in words])


@pytest.fixture(scope="session")
def robot():
    return swept.Robot.load(MODELS / "robots/rook7/rook7.urdf")


@pytest.fixture(scope="session")
def world():
    return swept.World.load(MODELS / "scenes/shelf.yaml")


@pytest.fixture(scope="session")
def checker(robot, world):
    return swept.Checker(robot, "arm", world)


@pytest.fixture(scope="session")
def oracle():
    return Oracle("models/robots/rook7/rook7.urdf", "arm", "models/scenes/shelf.yaml")


@pytest.fixture()
def random():
    return np.random.default_rng(7)


@pytest.fixture()
def states(checker, random):
    """(300, 7) within the limits."""
    group = checker.group
    return random.uniform(group.lower, group.upper, (300, checker.dimension))


@pytest.fixture()
def home(checker):
    return checker.named_state("home")
