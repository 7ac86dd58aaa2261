"""The live tier's quadratic program: linearisation, rows and cost.

`quadratic_program` stacks the rows of `_rows`; `solve.py` adds motor limits and room between shoes,
`elastic.py` slack.
"""

import numpy as np

from core.arrays import Floats
from core.problem.motion_problem import GENTLE_FOOT_SHARE, Cost, MotionProblem
from solver_jobs.live.free_heights import heavier, shifts_of_pressure, vertical_rows
from solver_jobs.live.linearisation import MM, Linearisation, linearise
from solver_jobs.live.qp import QuadraticProgram, stacked
from solver_jobs.live.reach import height_reach, reach_of, standing_reach, swinging_reach
from solver_jobs.live.rows import DiscPolygon, Rows, balance, body_speed, foot_speed, friction, integration
from solver_jobs.live.shoes import standing_shoes

TOLERANCE_MM = 1e-9
"""Rows without unknowns may exceed their bounds by this much."""

HEIGHT_SHARE = 100.0
"""Weight of unknown heights beside the rest of the cost: they change only where that keeps a limit, because
rows are linear about them."""


def quadratic_program(linearisation: Linearisation, rows: list[Rows]) -> QuadraticProgram | None:
    """The motion nearest to the goal within the rows; None where rows without unknowns are already broken."""
    split = [one.split() for one in rows]
    if max(miss for _, miss in split) > TOLERANCE_MM:
        return None
    curvature, gradient = cost_terms(linearisation)
    row, column, value, lower, upper = stacked([kept for kept, _ in split])
    least = np.full(linearisation.size, -np.inf)
    return QuadraticProgram(curvature, gradient, row, column, value, lower, upper, least)


def natural_linearisation(problem: MotionProblem) -> Linearisation:
    """The body straight from start to goal, or higher between them where feet need room to rise.

    A leg fully drawn in holds its foot at most `link_length + lower stroke` under the plane, and the cylinder
    ends there too; a foot that rises by the clearance, or is held up, needs that much more.
    """
    model = problem.model
    held = max(float(pose.feet_world[:, 2].max()) for pose in (problem.start, problem.goal))
    room = model.leg.link_length + model.stroke.lower + max(problem.limits.clearance, held)
    ends = [pose.body_world[2] - model.com_height for pose in (problem.start, problem.goal)]
    level = room if min(ends) < room - TOLERANCE_MM / MM and problem.timeline.swings() else None
    return linearise(problem, None if level is None else min(level, problem.limits.plane_height[1]))


def inner_rows(linearisation: Linearisation, sides: int) -> list[Rows]:
    """Every demand with polygons inside the discs: what keeps them is a motion."""
    return _rows(linearisation, DiscPolygon(sides, inner=True))


def outer_rows(linearisation: Linearisation, sides: int) -> list[Rows]:
    """Every demand with polygons around the discs: where these cannot be kept, no motion exists."""
    return _rows(linearisation, DiscPolygon(sides, inner=False))


def _rows(linearisation: Linearisation, disc: DiscPolygon) -> list[Rows]:
    reach = reach_of(linearisation, disc)
    give, more = np.zeros(len(linearisation.intervals)), np.ones(len(linearisation.intervals))
    vertical = linearisation.vertical is not None
    if vertical and not disc.inner:
        give, more = shifts_of_pressure(linearisation), heavier(linearisation)
    return [
        integration(linearisation),
        *(vertical_rows(linearisation) if vertical else []),
        balance(linearisation, give),
        body_speed(linearisation, disc),
        foot_speed(linearisation, disc),
        standing_reach(linearisation, reach),
        swinging_reach(linearisation, reach),
        *height_reach(linearisation, reach, disc),
        *friction(linearisation, disc, more),
        *standing_shoes(linearisation),
    ]


def cost_terms(linearisation: Linearisation) -> tuple[Floats, Floats]:
    """Curvature and gradient of the cost in the unknowns; forces are none of them, so effort has no part.

    Heights and climbs, where they are unknown, stay near those where they were made linear.
    """
    is_gentle = linearisation.problem.cost is Cost.GENTLE
    curvature, gradient = _gentle(linearisation) if is_gentle else _goal(linearisation)
    if linearisation.vertical is not None:
        for index, wanted in zip(
            linearisation.vertical, (linearisation.height, linearisation.climb), strict=True
        ):
            np.add.at(curvature, index[index >= 0], HEIGHT_SHARE)
            np.add.at(gradient, index[index >= 0], -HEIGHT_SHARE * wanted[index >= 0])
    return curvature, gradient


def _gentle(linearisation: Linearisation) -> tuple[Floats, Floats]:
    """Of ½ Σ (‖v_b‖² + s Σ ‖v_f‖²), with the share s of the feet."""
    velocity = linearisation.index[1]
    shares = np.broadcast_to(
        np.where(np.arange(velocity.shape[1]) == 0, 1.0, GENTLE_FOOT_SHARE)[:, None], velocity.shape
    )
    curvature = np.zeros(linearisation.size)
    np.add.at(curvature, velocity[velocity >= 0], shares[velocity >= 0])
    return curvature, np.zeros(linearisation.size)


def _goal(linearisation: Linearisation) -> tuple[Floats, Floats]:
    """Curvature and gradient of (3.4), ½ Σ ‖x − x_g‖², in the unknowns."""
    problem = linearisation.problem
    goal = np.concatenate([problem.goal.body_world[None], problem.goal.feet_world])[:, :2] * MM
    curvature, gradient = np.zeros(linearisation.size), np.zeros(linearisation.size)
    for index, wanted in zip(linearisation.index, (goal, np.zeros_like(goal)), strict=True):
        free = index >= 0
        np.add.at(curvature, index[free], 1.0)
        np.add.at(gradient, index[free], -np.broadcast_to(wanted, index.shape)[free])
    return curvature, gradient
