# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories from planners."""
from typing import Any, NamedTuple, Optional

from ._swept import Checker, Plan, ProvenTrajectory, RateLimits, TrackingTolerance, plan, proven_trajectory


class PlannedTrajectory(NamedTuple):
    """The result of `plan_trajectory`. True if there is a trajectory, and all of it is proven free."""

    plan: Plan  #: of the path, in the tube
    proven: Optional[ProvenTrajectory]  #: None if the planner has no path
    checker: Checker  #: what planned and proved it: the checker in the tube

    def __bool__(self) -> bool:
        return bool(self.proven)


def plan_trajectory(
    checker: Checker,
    start: Any,
    goal: Any,
    limits: RateLimits,
    *,
    tracking: Optional[TrackingTolerance] = None,
    simplify_seconds: Optional[float] = 0.5,
    blend_deviation: float = 0.1,
    jerk_limited: bool = False,
    **options: Any,
) -> PlannedTrajectory:
    """Plans, simplifies the path, and makes of it a trajectory that is proven as ros2_control executes it.

    `tracking`: how far the robot may be off it, at every instant; path and curve are proven with that. Other
    arguments are those of `plan` and `proven_trajectory`.
    """
    tube = checker if tracking is None else checker.with_tracking(tracking)
    found = plan(tube, start, goal, simplify_seconds=simplify_seconds, **options)
    if found.path is None:
        return PlannedTrajectory(found, None, tube)
    proven = proven_trajectory(
        tube, found.path, limits, blend_deviation=blend_deviation, jerk_limited=jerk_limited
    )
    return PlannedTrajectory(found, proven, tube)
