"""Problems of the built-in gaits for tests of the solver."""

from __future__ import annotations

from dataclasses import replace

from core.gait.gait import heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import Group, group_ids, library
from core.problem.motion_problem import Cost, MotionProblem, Workspace
from core.robot.model import FootEnd, load_robot

GAITS = group_ids(Group.OPTIMISED)

_DELTAWALKER = load_robot("deltawalker")
BARE = replace(_DELTAWALKER, shape=replace(_DELTAWALKER.shape, foot_end=FootEnd.BARE))
"""Without shoes, which would meet in steps of more than 28.5 mm."""


def gait_problem(gait: str, step: float, workspace: Workspace, *, cost: Cost = Cost.GOAL) -> MotionProblem:
    """One iteration of a built-in gait, direction 1, with the command's defaults but for what is given."""
    chosen = library()[gait].gait
    asked = replace(
        chosen,
        step=heading_step(chosen.orientation, step),
        options=GaitOptions(workspace=workspace, cost=cost),
    )
    return motion_problem(asked, load_robot(chosen.robot))
