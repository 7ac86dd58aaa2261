"""Heights of body and feet as unknowns, for the search for what is missing.

Reach and speed are discs whose radius is a concave function of height and climb, so that tangents allow more
than they do: what the rows around the discs rule out is ruled out at every height. Balance is bilinear in
height and ground motion; there the bounds give way by as much as heights can change it.
"""

from dataclasses import replace

import numpy as np

from core.arrays import Bools, Floats
from core.problem.motion_problem import Boundary
from solver_jobs.live.linearisation import MM, Linearisation, speed_limits
from solver_jobs.live.rows import NOBODY, Rows, make_rows, vertical_term
from solver_jobs.nlp.assembly import box_of
from solver_jobs.nlp.constraint import Family, situation_of


def with_free_heights(linearisation: Linearisation) -> Linearisation:
    """The same with the heights of the body and of feet in the air as unknowns behind the others."""
    free: Bools = np.asarray((linearisation.index >= 0).any(axis=-1))
    if linearisation.problem.boundary is Boundary.PERIODIC:
        free[:, 0, 0], free[:, -1, 0] = True, False
    vertical = np.full(free.shape, -1, dtype=np.intp)
    # A knot after the other, as on the ground.
    order = free.transpose(1, 0, 2)
    vertical.transpose(1, 0, 2)[order] = linearisation.size + np.arange(int(order.sum()))
    size = linearisation.size + int(order.sum())
    if linearisation.problem.boundary is Boundary.PERIODIC:
        vertical[:, -1, 0] = vertical[:, 0, 0]
    return replace(linearisation, vertical=vertical, size=size)


def at_heights_of(linearisation: Linearisation, x: Floats) -> Linearisation:
    """The linearisation about the heights that a search with free heights has found, which are known then."""
    vertical = linearisation.vertical
    if vertical is None:
        return linearisation
    height, climb = (
        np.where(index >= 0, x[np.maximum(index, 0)], known)
        for index, known in zip(vertical, (linearisation.height, linearisation.climb), strict=True)
    )
    size = int(linearisation.index.max(initial=-1)) + 1
    return replace(linearisation, height=height, climb=climb, vertical=None, size=size)


def vertical_rows(linearisation: Linearisation) -> list[Rows]:
    """Motion and bounds of heights and climbs."""
    return [_integration(linearisation), *_bounds(linearisation)]


def _integration(linearisation: Linearisation) -> Rows:
    unknown = _unknown(linearisation)
    knot, point = np.nonzero(unknown[:, :-1].any(axis=0) | unknown[:, 1:].any(axis=0))
    one, half = np.ones(len(knot)), linearisation.intervals[knot] / 2
    terms = [
        vertical_term(linearisation, kind, knot + later, point, factor)
        for kind, later, factor in ((0, 1, one), (0, 0, -one), (1, 0, -half), (1, 1, -half))
    ]
    return make_rows(Family.DYNAMICS, "mm", terms, (0.0, 0.0), knot, None, np.full(len(knot), NOBODY))


def _bounds(linearisation: Linearisation) -> list[Rows]:
    """The exact tier's bounds of heights, and the speed limits."""
    box = box_of(situation_of(linearisation.problem))
    fastest = speed_limits(linearisation)
    heights = box.lower.position[..., 2] * MM, box.upper.position[..., 2] * MM
    unknown, body = _unknown(linearisation), np.arange(fastest.shape[1]) == 0
    parts = (
        (Family.BODY_HEIGHT, "mm", 0, body, heights),
        (Family.CLEARANCE, "mm", 0, ~body, heights),
        (Family.BODY_SPEED, "mm/s", 1, body, (-fastest, fastest)),
        (Family.FOOT_SPEED, "mm/s", 1, ~body, (-fastest, fastest)),
    )
    rows = []
    for family, unit, kind, points, (lower, upper) in parts:
        knot, point = np.nonzero(unknown[kind] & points)
        term = vertical_term(linearisation, kind, knot, point, np.ones(len(knot)))
        feet = np.stack([point - 1, np.full(len(point), NOBODY)], axis=-1)
        rows.append(make_rows(family, unit, [term], (lower[knot, point], upper[knot, point]), knot, feet))
    return rows


def _unknown(linearisation: Linearisation) -> Bools:
    """(2, n, 1 + legs) which heights and climbs are unknown."""
    if linearisation.vertical is None:
        return np.zeros((2, *linearisation.height.shape), dtype=np.bool_)
    return np.asarray(linearisation.vertical >= 0)


def heavier(linearisation: Linearisation) -> Floats:
    """(n − 1,) how many times the known vertical force the greatest one is that climbs allow."""
    return np.asarray(1 + _lift(linearisation) / linearisation.weight)


def _lift(linearisation: Linearisation) -> Floats:
    """(n − 1,) by how much another climb can change the vertical force, kg·mm/s²."""
    return _most_change(linearisation, _unknown(linearisation)[1], linearisation.climb)


def _most_change(linearisation: Linearisation, unknown: Bools, known: Floats) -> Floats:
    """(n − 1,) most that Σ m Δv / Δt can change, where speeds (n, 1 + legs) are unknown, kg·mm/s²."""
    model = linearisation.problem.model
    masses = np.array([model.masses.body] + [model.masses.foot] * model.leg_count)
    most = np.where(unknown, speed_limits(linearisation) + np.abs(known), 0.0)
    return np.asarray((most[1:] + most[:-1]) @ masses / linearisation.intervals)


def shifts_of_pressure(linearisation: Linearisation) -> Floats:
    """(n − 1,) by how much another height of the body can shift the centre of pressure, mm.

    It lies z·F_xy/F_z from the body; here are the greatest F_xy that speeds allow, and the greatest change of
    z/F_z within the body's bounds.
    """
    lowest, highest = _body_range(linearisation)
    weight, lift = linearisation.weight, _lift(linearisation)
    height = linearisation.height[:-1, 0]
    ratio = height / weight
    most = np.maximum(highest / np.maximum(weight - lift, 1e-9) - ratio, ratio - lowest / (weight + lift))
    moving = (linearisation.index[1] >= 0).any(axis=-1)
    return np.asarray(most * _most_change(linearisation, moving, np.zeros(moving.shape)))


def _body_range(linearisation: Linearisation) -> tuple[Floats, Floats]:
    """(n − 1,) lowest and highest body that its bounds and its speed allow, mm."""
    problem = linearisation.problem
    lowest, highest = (
        np.full(problem.knot_count, (plane + problem.model.com_height) * MM)
        for plane in problem.limits.plane_height
    )
    if problem.boundary is Boundary.REST:
        for pose, times in (
            (problem.start, problem.times),
            (problem.goal, problem.times[-1] - problem.times),
        ):
            way, end = problem.limits.body_speed * MM * times, pose.body_world[2] * MM
            lowest, highest = np.maximum(lowest, end - way), np.minimum(highest, end + way)
    return lowest[:-1], highest[:-1]
