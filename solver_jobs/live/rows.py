"""Linear rows over the unknowns of a linearisation, in the families that make up the convex problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.problem.initial_guess import Indices
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.nlp.constraint import Family

NOBODY = -1
"""In place of a foot where a row is about the body alone."""

AREA, LINE, ENDS, POINT, POINT_Y = range(5)
"""Where the centre of pressure is held: left of an edge, on the line through the two feet that stand, between
them, and in x and y at the one foot that stands."""

STEEPEST = 0.9
"""Share of a speed limit up to which a climb is where the limit is made linear."""


@dataclass(frozen=True, eq=False)
class Rows:
    """lower ≤ A x ≤ upper, with what each row is about.

    Args:
        family: which demand.
        unit: of the bounds, mm or mm/s.
        row: (nnz,) row of each entry.
        column: (nnz,) unknown of each entry.
        value: (nnz,) entries.
        lower: (m,) with what is known already taken off.
        upper: (m,) likewise.
        knot: (m,) 0-based.
        feet: (m, 2) foot, or both feet of a polygon's edge; `NOBODY` where none.
        group: (m,) rows of one number miss their bounds by one common amount when they may; `NOBODY` for
            rows that must be kept.
    """

    family: Family
    unit: str
    row: Indices
    column: Indices
    value: Floats
    lower: Floats
    upper: Floats
    knot: Indices
    feet: Indices
    group: Indices

    @property
    def count(self) -> int:
        """Number of rows."""
        return len(self.lower)

    def excess(self, x: Floats) -> Floats:
        """(m,) how far the rows lie outside their bounds."""
        values = np.zeros(self.count)
        np.add.at(values, self.row, self.value * x[self.column])
        return np.asarray(np.maximum(self.lower - values, values - self.upper))

    def split(self) -> tuple[Rows, float]:
        """The rows that hold an unknown, and by how much the others, which are known, miss their bounds."""
        holds = np.zeros(self.count, dtype=np.bool_)
        holds[self.row] = True
        miss = np.maximum(self.lower, -self.upper)[~holds].max(initial=0.0)
        if holds.all():
            return self, float(miss)
        number = np.cumsum(holds) - 1
        kept = replace(
            self,
            row=number[self.row],
            lower=self.lower[holds],
            upper=self.upper[holds],
            knot=self.knot[holds],
            feet=self.feet[holds],
            group=self.group[holds],
        )
        return kept, float(miss)


Term = tuple[Indices, Floats, Floats]
"""Index of the unknown (−1 where known), known value, coefficient; each broadcasts to (m,)."""


def make_rows(
    family: Family,
    unit: str,
    terms: Sequence[Term],
    bounds: tuple[Floats | float, Floats | float],
    knot: Indices,
    feet: Indices | None = None,
    group: Indices | None = None,
) -> Rows:
    """Sums up terms; what is known moves to the bounds."""
    m = len(knot)
    none = (np.full(m, -1), np.zeros(m), np.zeros(m))
    index, known, coefficient = (
        np.stack([np.broadcast_to(term[part], (m,)) for term in (terms or [none])]) for part in range(3)
    )
    constant = (known * coefficient * (index < 0)).sum(axis=0)
    live = (index >= 0) & (coefficient != 0.0)
    row = np.broadcast_to(np.arange(m), index.shape)[live]
    return Rows(
        family,
        unit,
        row,
        index[live],
        coefficient[live],
        np.broadcast_to(bounds[0], (m,)) - constant,
        np.broadcast_to(bounds[1], (m,)) - constant,
        knot,
        np.full((m, 2), NOBODY) if feet is None else feet,
        np.arange(m) if group is None else group,
    )


def dot_terms(
    linearisation: Linearisation, kind: int, knot: Indices, point: Indices | int, factor: Floats
) -> list[Term]:
    """The dot product of a factor (m, 2) with the position (0) or velocity (1) of a point at knots."""
    index, known = linearisation.index[kind, knot, point], linearisation.known[kind, knot, point]
    return [(index[:, axis], known[:, axis], factor[:, axis]) for axis in (0, 1)]


def vertical_term(
    linearisation: Linearisation, kind: int, knot: Indices, point: Indices | int, factor: Floats
) -> Term:
    """The height (0) or climb (1) of a point at knots, times a factor (m,)."""
    known = (linearisation.height, linearisation.climb)[kind][knot, point]
    vertical = linearisation.vertical
    return np.full(len(knot), -1) if vertical is None else vertical[kind, knot, point], known, factor


def integration(linearisation: Linearisation) -> Rows:
    """p(k+1) = p(k) + dt(k)·(v(k) + v(k+1))/2 wherever something moves."""
    index = linearisation.index
    touched = (index[:, :-1] >= 0).any(axis=(0, -1)) | (index[:, 1:] >= 0).any(axis=(0, -1))
    # A row for x and one for y.
    knot, point = (np.repeat(found, 2) for found in np.nonzero(touched))
    axis = np.tile([0, 1], len(knot) // 2)
    half = linearisation.intervals[knot] / 2
    one = np.ones(len(knot))

    def term(kind: int, at: Indices, coefficient: Floats) -> Term:
        return index[kind, at, point, axis], linearisation.known[kind, at, point, axis], coefficient

    terms = [term(0, knot + 1, one), term(0, knot, -one), term(1, knot, -half), term(1, knot + 1, -half)]
    return make_rows(Family.DYNAMICS, "mm", terms, (0.0, 0.0), knot, None, np.full(len(knot), NOBODY))


@dataclass(frozen=True)
class DiscPolygon:
    """The regular polygon that stands for a disc.

    Inner polygons have their corners at multiples of 2π/sides, so that one is a part of every other with
    twice or four times its edges; outer ones touch the disc there.

    Args:
        sides: number of edges.
        inner: within the disc, or else around it.
    """

    sides: int
    inner: bool

    @property
    def normals(self) -> Floats:
        """(sides, 2) outward unit vectors."""
        angles = 2 * np.pi * (np.arange(self.sides) + (0.5 if self.inner else 0.0)) / self.sides
        return np.stack([np.cos(angles), np.sin(angles)], axis=-1)

    @property
    def apothem(self) -> float:
        """Distance of its edges from the centre of the unit disc."""
        return float(np.cos(np.pi / self.sides)) if self.inner else 1.0


def body_speed(linearisation: Linearisation, disc: DiscPolygon) -> Rows:
    """The body's ground speed in a polygon of what its climb leaves of the limit."""
    knots = np.arange(linearisation.problem.knot_count)
    moving = (linearisation.index[1, :, 0] >= 0).any(axis=-1)
    return _speed(
        linearisation, knots[moving], 0, linearisation.problem.limits.body_speed, Family.BODY_SPEED, disc
    )


def foot_speed(linearisation: Linearisation, disc: DiscPolygon) -> Rows:
    """The same for feet in the air."""
    knot, foot = np.nonzero((linearisation.index[1, :, 1:] >= 0).any(axis=-1))
    return _speed(
        linearisation, knot, foot + 1, linearisation.problem.limits.foot_speed, Family.FOOT_SPEED, disc
    )


def _speed(
    linearisation: Linearisation,
    knot: Indices,
    point: Indices | int,
    limit: float,
    family: Family,
    disc: DiscPolygon,
) -> Rows:
    normal = np.tile(disc.normals, (len(knot), 1))
    group = np.repeat(np.arange(len(knot)), disc.sides)
    point = np.broadcast_to(point, knot.shape)
    feet = np.stack([point[group] - 1, np.full(len(group), NOBODY)], axis=-1)
    terms = dot_terms(linearisation, 1, knot[group], point[group], normal)
    climb, most = linearisation.climb[knot, point], limit * MM
    if linearisation.vertical is None:
        left = most**2 - climb**2
        radius = np.sign(left) * np.sqrt(np.abs(left)) * disc.apothem
    else:
        # The plane that touches the ball of all speeds where the climb is this one.
        climb = np.clip(climb, -STEEPEST * most, STEEPEST * most)
        level = np.sqrt(most**2 - climb**2)
        slope = disc.apothem * climb / level
        terms.append(vertical_term(linearisation, 1, knot[group], point[group], slope[group]))
        radius = disc.apothem * most**2 / level
    return make_rows(family, "mm/s", terms, (-np.inf, radius[group]), knot[group], feet, group)


def balance(linearisation: Linearisation, give: Floats) -> Rows:
    """Centre of pressure inside every edge of the support polygon by the margin (docs/sources.md).

    Args:
        linearisation: the known part.
        give: (n − 1,) by how much less is enough, mm.
    """
    model, margin = linearisation.problem.model, linearisation.problem.limits.margin * MM
    knot, start, end, alone = _edges(linearisation)
    corners = linearisation.known[0, knot, 1:]
    rows = np.arange(len(knot))
    a, b = corners[rows, start], corners[rows, end]
    along = (b - a) / np.maximum(np.linalg.norm(b - a, axis=-1, keepdims=True), 1e-9)
    inward = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    # Where two feet carry the robot, both edges coincide and one equality stands for them; its ends are rows
    # along the line.
    inward = np.where((alone == ENDS)[:, None], along, inward)
    inward[alone == POINT] = [1.0, 0.0]
    inward[alone == POINT_Y] = [0.0, 1.0]
    exact = np.isin(alone, (LINE, POINT, POINT_Y))
    least = (inward * a).sum(axis=-1) + np.where(exact, 0.0, margin)
    most = np.where(exact, least + give[knot], np.inf)
    least = least - give[knot]
    pull = linearisation.height[knot, 0] / (linearisation.weight[knot] * linearisation.intervals[knot])
    terms = dot_terms(linearisation, 0, knot, 0, inward)
    masses = [model.masses.body] + [model.masses.foot] * model.leg_count
    for point, mass in enumerate(masses):
        factor = inward * (mass * pull)[:, None]
        terms += dot_terms(linearisation, 1, knot, point, factor) + dot_terms(
            linearisation, 1, knot + 1, point, -factor
        )
    group = np.unique(knot, return_inverse=True)[1]
    return make_rows(
        Family.BODY_TORQUE, "mm", terms, (least, most), knot, np.stack([start, end], axis=-1), group
    )


def _edges(linearisation: Linearisation) -> tuple[Indices, Indices, Indices, Indices]:
    """Knots and feet of every edge of every support polygon, counter-clockwise.

    The last array says what each row is: AREA, LINE, ENDS, POINT or POINT_Y.
    """
    contact = linearisation.contact[:-1]
    corners = linearisation.known[0, :-1, 1:]
    legs = contact.shape[1]
    start, end = (index[~np.eye(legs, dtype=np.bool_)] for index in np.indices((legs, legs)))
    a, edge = corners[:, start], corners[:, end] - corners[:, start]
    offset = corners[:, None] - a[:, :, None]
    side = edge[..., None, 0] * offset[..., 1] - edge[..., None, 1] * offset[..., 0]
    standing = contact[:, start] & contact[:, end]
    hull = standing & ((side >= -1e-6) | ~contact[:, None, :]).all(axis=-1)
    pair = contact.sum(axis=1) == 2
    knot, number = np.nonzero(hull & ~pair[:, None])
    line_knot, line = np.nonzero(standing & (start < end) & pair[:, None])
    end_knot, ends = np.nonzero(standing & pair[:, None])
    lone_knot = np.nonzero(contact.sum(axis=1) == 1)[0]
    lone = contact[lone_knot].argmax(axis=1)
    found = (
        (AREA, knot, start[number], end[number]),
        (LINE, line_knot, start[line], end[line]),
        (ENDS, end_knot, start[ends], end[ends]),
        (POINT, lone_knot, lone, lone),
        (POINT_Y, lone_knot, lone, lone),
    )
    kinds = np.concatenate([np.full(len(knots), kind, dtype=np.intp) for kind, knots, _, _ in found])
    knots, starts, ends_ = (np.concatenate([one[part] for one in found]) for part in (1, 2, 3))
    return knots, starts, ends_, kinds


def friction(linearisation: Linearisation, disc: DiscPolygon, heavier: Floats) -> list[Rows]:
    """Sideways force within the cone of the vertical one, ‖Σ m a_xy‖ ≤ μ Σ m (g + a_z), where it is asked.

    Args:
        linearisation: the known part.
        disc: what stands for discs.
        heavier: (n − 1,) how many times the known vertical force counts.
    """
    limit = linearisation.problem.limits.friction
    if limit is None:
        return []
    model = linearisation.problem.model
    count = linearisation.problem.knot_count - 1
    group = np.repeat(np.arange(count), disc.sides)
    normal = np.tile(disc.normals, (count, 1))
    terms: list[Term] = []
    for point, mass in enumerate([model.masses.body] + [model.masses.foot] * model.leg_count):
        factor = (
            normal
            * (mass / (linearisation.intervals * linearisation.weight))[group, None]
            * linearisation.height[group, :1]
        )
        terms += dot_terms(linearisation, 1, group + 1, point, factor) + dot_terms(
            linearisation, 1, group, point, -factor
        )
    # As a distance of the centre of pressure from the body's ground point, mm, like balance.
    most = limit * disc.apothem * (linearisation.height[:-1, 0] * heavier)[group]
    return [make_rows(Family.FRICTION, "mm", terms, (-np.inf, most), group, None, group)]
