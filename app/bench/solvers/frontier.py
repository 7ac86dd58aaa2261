"""How far every built-in gait gets, and what limits it."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from app.bench.common.measure import Row, seconds_of
from core.gait.gait import Gait
from core.library.library import Group, group_ids, library
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot
from solver_jobs import Frontier, FrontierSearch

GAITS = group_ids(Group.OPTIMISED)
MARGINS = (0.0, 0.003)


def bench_frontier(
    gaits: Sequence[str] = GAITS,
    workspaces: Sequence[Workspace] = tuple(Workspace),
    margins: Sequence[float] = MARGINS,
) -> list[Row]:
    """The largest step or turn of each gait, phases as drawn and free."""
    return [_row(*combination) for combination in product(gaits, workspaces, margins, (False, True))]


def _row(name: str, workspace: Workspace, margin: float, free: bool) -> Row:
    gait = library()[name].gait
    gait = replace(gait, options=replace(gait.options, workspace=workspace, margin=margin))
    found: list[Frontier] = []
    seconds = seconds_of(lambda: found.append(_search(gait, free).run()))
    frontier = found[0]
    return {
        "gait": name,
        "workspace": workspace.value,
        "margin_mm": round(margin * 1000, 1),
        "phases": "free" if free else "5 knots",
        "largest": _reach(frontier, frontier.reach),
        "live_tier": _reach(frontier, frontier.live_reach),
        "confirmed": "yes" if frontier.confirmed else "no",
        "phase_knots": frontier.gait.options.phase_knots,
        "plane_mm": round(frontier.gait.options.plane_height * 1000, 1),
        "limited_by": ", ".join(frontier.limited_by).replace("_", " "),
        "seconds": round(seconds, 1),
    }


def _search(gait: Gait, free: bool) -> FrontierSearch:
    returns = gait.options.turning is HeadingProfile.RETURN
    return FrontierSearch(gait, load_robot(gait.robot), free_phases=free, free_return=returns)


def _reach(frontier: Frontier, reach: float) -> str:
    return f"{np.degrees(reach):.1f}°" if frontier.turns else f"{reach * 1000:.1f} mm"
