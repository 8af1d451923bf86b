# SPDX-License-Identifier: BSD-3-Clause
"""Enumerations. Values are those of C++; arrays of verdicts hold them."""
import enum


class _Named(enum.IntEnum):
    """Printed by name: `free`, as the program `swept` prints it."""

    def __str__(self) -> str:
        return self.name.lower().replace("_", " ")

    def __format__(self, specification: str) -> str:
        return format(str(self), specification)


class Verdict(_Named):
    """What is known about a state or a motion. Only `FREE` is true: `if checker.check_state(q)`."""

    UNDECIDED = 0  #: closer to the margin than the tolerance; planners treat it as invalid
    FREE = 1  #: proven: every checked pair keeps more than the margin, rounding included
    COLLISION = 2  #: witnessed: two points of the exact geometry are within the margin
    VIOLATION = 3  #: witnessed: a constraint of the task does not hold

    def __bool__(self) -> bool:
        return self is Verdict.FREE


class MotionQuery(_Named):
    """How much of a motion's certificate to compute."""

    VERDICT_ONLY = 0  #: stop at any contact; `free_until` is 0 unless the motion is free
    FIRST_CONTACT = 1  #: `free_until` and the first contact, to within the tolerance


class ClearanceQuery(_Named):
    """Which clearances of a motion to compute."""

    LEAST = 0  #: of all checked pairs together
    BY_KIND = 1  #: that, and separately of pairs with the world and of the others
    WORLD = 2  #: only of pairs with the world
    SELF = 3  #: only of pairs of two links or attached bodies


class LimitKind(_Named):
    """What a limit is about."""

    POSITION = 0  #: rad or m
    VELOCITY = 1  #: rad/s or m/s
    ACCELERATION = 2  #: rad/s^2 or m/s^2
    JERK = 3  #: rad/s^3 or m/s^3


class ConstraintKind(_Named):
    """In which list of a TaskConstraint a constraint is."""

    JOINT = 0  #: `joints`
    POSITION = 1  #: `positions`
    ORIENTATION = 2  #: `orientations`
    AXIS = 3  #: `axes`


class ChangeKind(_Named):
    """What has happened to a body since the phase of a task before."""

    ATTACHED = 0  #: a link carries it now: it has the same shapes, where they were
    PLACED = 1  #: it is in the world now, likewise
    SENSED = 2  #: a body of the world that was sensed again, is new or is gone: any other shape


class EnclosingKind(_Named):
    """Of what shapes a cover of a body consists."""

    CAPSULE = 0  #: cylinders with round ends
    BOX = 1  #: of any orientation
    CONVEX = 2  #: convex hulls


class LineStop(_Named):
    """Why a path does not follow its line to the end."""

    LIMIT = 0  #: a variable would have to leave its limits, or the start is outside them
    SINGULARITY = 1  #: near a singular configuration joints had to jump, or the line leads out of reach
    JUMP = 2  #: only joints that jump get the tool farther along the line
    UNREACHABLE = 3  #: the group cannot move the tool in this direction at all
    CONTACT = 4  #: with a witness
    VIOLATION = 5  #: of the checker's constraints
    UNDECIDED = 6  #: freedom, or the constraints, could not be proven; or too many way points


class ScheduleStatus(_Named):
    """What came of planning a schedule."""

    FOUND = 0  #: and proven
    START_NOT_FREE = 1  #: of a task, at the clock's time 0
    GOAL_NOT_FREE = 2  #: of a task: none of its goals is, even after all others have come to rest
    NOT_FOUND = 3  #: in the time given
    NOT_PROVEN = 4  #: a schedule was found, and some certificate of it is not FREE
