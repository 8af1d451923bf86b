# SPDX-License-Identifier: BSD-3-Clause
"""Pages that show robots and what is proven about their motions."""
import html
import os
from typing import Any, Optional, Sequence, Union

from ._swept import Checker, Curve, Page, Plan, ProvenTrajectory, RateLimits, TaskPage, TaskPhase, Trajectory
from .errors import UsageError

_HEIGHT = 640  # pixels, of the frame in a notebook


def show(
    checker: Checker,
    *things: Any,
    limits: Optional[RateLimits] = None,
    file: Optional[Union[str, "os.PathLike[str]"]] = None,
    title: str = "swept",
) -> Page:
    """A page of states (n,), or of paths (m, n) and plans, or of trajectories and curves.

    Jupyter shows it. `file`: also writes it there, a .html file that any browser opens from disk. `limits`: what
    the page plots beside trajectories.
    """
    page = Page(checker, title=title)
    for number, thing in enumerate(things, 1):
        if isinstance(thing, ProvenTrajectory):
            thing = thing.trajectory
        if isinstance(thing, Plan):
            if thing.path is None:
                raise UsageError(f"a plan without a path cannot be shown: {thing.status}")
            page.add_path(thing.planner, thing.path)
        elif isinstance(thing, (Trajectory, Curve)):
            page.add_trajectory(f"trajectory {number}", thing, limits)
        elif getattr(thing, "ndim", 1) == 2 or (isinstance(thing, (list, tuple)) and hasattr(thing[0], "__len__")):
            page.add_path(f"path {number}", thing)
        else:
            page.add_state(f"state {number}", thing)
    if file is not None:
        page.write(file)
    return page


def show_task(
    phases: Sequence[TaskPhase],
    *,
    limits: Optional[RateLimits] = None,
    file: Optional[Union[str, "os.PathLike[str]"]] = None,
    title: str = "swept",
) -> TaskPage:
    """A page that plays a task, a list of TaskPhase, on one clock.

    Jupyter shows it. `limits`, of phases that all move one group, and `file`: as `show`. Whether the phases join it
    does not say: `verify_task` does, of a file of `write_task`.
    """
    if not phases:
        raise UsageError("a task without a phase cannot be shown")
    page = TaskPage(phases[0].checker.robot, title=title)
    for phase in phases:
        page.add_phase(phase, limits)
    if file is not None:
        page.write(file)
    return page


def _repr_html_(page: Union[Page, TaskPage]) -> str:
    """A frame of its own, which keeps the page's scripts and styles from those of the notebook."""
    return (
        f'<iframe srcdoc="{html.escape(page.html)}" width="100%" height="{_HEIGHT}" '
        'style="border: 0" sandbox="allow-scripts"></iframe>'
    )


setattr(Page, "_repr_html_", _repr_html_)
setattr(TaskPage, "_repr_html_", _repr_html_)
