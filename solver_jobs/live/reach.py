"""The reach of each foot: polygons around its module, at a known height."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.problem.initial_guess import Indices
from core.problem.motion_problem import CYLINDER, Workspace
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.live.rows import NOBODY, DiscPolygon, Rows, Term, dot_terms, make_rows, vertical_term
from solver_jobs.nlp.constraint import Family

DEEPEST = 0.98
"""Share of the links' length up to which a depth is where reach is made linear; it falls steeply beyond."""

HOLE_SLACK = 1e-4
"""A foot at most this far above where holes begin has none to keep out of, mm. The search with free heights
presses feet to exactly that height, where rounding would decide whether a hole of no width takes 14 mm of
their room. A stroke is below its limit by no more than this, a tenth of the checker's tolerance."""

BOUND_DECIMALS = 6
"""Decimals to which bounds of reach are compared, mm."""

TOP_STEP = 0.01
"""Heights that are tried for the top of reach, mm."""


@dataclass(frozen=True, eq=False)
class Reach:
    """Half planes of reach in the world's axes: direction_j · (foot − body) ≤ bound.

    Args:
        directions: (sides, 2).
        bound: (n, legs, sides) mm.
        slope: (n, legs) how much it grows with each mm that the foot is higher, or the body lower; 0 where
            heights are known.
        height_miss: (n, legs) how far the known height itself is out of reach, mm; 0 where it is not.
    """

    directions: Floats
    bound: Floats
    slope: Floats
    height_miss: Floats


def reach_of(linearisation: Linearisation, disc: DiscPolygon) -> Reach:
    """Polygons for every foot and knot.

    Args:
        linearisation: what is known.
        disc: what stands for discs.
    """
    model = linearisation.problem.model
    normal = disc.normals
    below = linearisation.height[:, 1:] - (linearisation.height[:, :1] - model.com_height * MM)
    heading = linearisation.problem.heading
    if linearisation.problem.limits.workspace is Workspace.CYLINDER:
        own = np.full((*below.shape, disc.sides), CYLINDER.radius * MM * disc.apothem)
        above = below + CYLINDER.depth * MM
        slope = np.zeros_like(below)
        miss = np.maximum(np.maximum(-CYLINDER.below * MM - above, above - CYLINDER.above * MM), 0.0)
    else:
        own, slope, miss = _stroke_bounds(linearisation, below, disc)
    cosine, sine = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y = (model.module_centres_robot[:, axis] * MM for axis in (0, 1))
    centres = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    return Reach(normal, own + centres @ normal.T, slope, miss)


def _stroke_bounds(
    linearisation: Linearisation, below: Floats, disc: DiscPolygon
) -> tuple[Floats, Floats, Floats]:
    """Discs d_i ≤ l² − (z + upper)² round three vertices; and outside d_i ≥ l² − (z + lower)².

    Returns:
        Their bounds, how these grow with z, and by how much z itself is out of reach.
    """
    model = linearisation.problem.model
    link = model.leg.link_length * MM
    deep = below + model.stroke.upper * MM
    far = link**2 - deep**2
    near = link**2 - (below + model.stroke.lower * MM - HOLE_SLACK) ** 2
    radius, hole = np.sqrt(np.maximum(far, 0.0)), np.sqrt(np.maximum(near, 0.0))
    slope = np.zeros_like(radius)
    if linearisation.vertical is not None:
        # The tangent of the root, which lies above it everywhere.
        at = np.clip(deep, -DEEPEST * link, DEEPEST * link)
        level = np.sqrt(link**2 - at**2)
        radius, slope = level - at / level * (deep - at), -at / level * disc.apothem
    # The direction of each world normal seen from each module, turned with the body.
    turn = linearisation.problem.heading[:, None] + model.azimuths - np.pi / 2
    normal = disc.normals
    angle = np.arctan2(normal[:, 1], normal[:, 0]) - turn[..., None]
    seen = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    vertices = vertex_directions() * model.leg.reach_radius * MM
    bound = (seen @ vertices.T + radius[..., None, None] * disc.apothem).min(axis=-1)
    if disc.inner and linearisation.vertical is None and (hole > 0).any():
        bound = np.minimum(bound, _hole_bound(seen, hole, model.leg.reach_radius * MM, disc))
    miss = np.where(far < 0, np.abs(below) - link - model.stroke.upper * MM, 0.0).clip(0.0)
    return bound, slope, miss


def _hole_bound(seen: Floats, hole: Floats, reach_radius: float, disc: DiscPolygon) -> Floats:
    """Keeps clear of the holes round the vertices by the polygon within the disc that touches them."""
    room = reach_radius - hole
    apothem = np.where(room > 0, room * disc.apothem, room)
    return np.where(hole[..., None] > 0, np.broadcast_to(apothem[..., None], seen.shape[:-1]), np.inf)


def standing_reach(linearisation: Linearisation, reach: Reach) -> Rows:
    """The body where every standing foot reaches its foothold: one row a direction and knot."""
    knots = np.arange(linearisation.problem.knot_count)
    held = np.where(
        linearisation.contact[knots, :, None],
        reach.bound[knots] - linearisation.known[0, knots, 1:] @ reach.directions.T,
        np.inf,
    )
    # Of feet that reach equally far the first is named.
    foot = held.round(BOUND_DECIMALS).argmin(axis=1)
    most = np.take_along_axis(held, foot[:, None], axis=1)[:, 0]
    sides = len(reach.directions)
    group = np.repeat(np.arange(len(knots)), sides)
    knot = knots[group]
    feet = np.stack([foot.reshape(-1), np.full(len(knot), NOBODY)], axis=-1)
    normal = np.tile(reach.directions, (len(knots), 1))
    terms = dot_terms(linearisation, 0, knot, 0, -normal)
    # Feet stand at one height, so that all bounds of a knot grow alike.
    raised, lowered = _height_terms(linearisation, reach, knot, feet[:, 0])
    most = most.reshape(-1) + lowered
    return make_rows(Family.WORKSPACE, "mm", terms + raised, (-np.inf, most), knot, feet, group)


def _height_terms(
    linearisation: Linearisation, reach: Reach, knot: Indices, foot: Indices
) -> tuple[list[Term], Floats]:
    """What the heights of foot and body add to rows of reach, and to their bounds; nothing if known."""
    if linearisation.vertical is None:
        return [], np.zeros(len(knot))
    slope = reach.slope[knot, foot]
    terms = [
        vertical_term(linearisation, 0, knot, foot + 1, -slope),
        vertical_term(linearisation, 0, knot, 0, slope),
    ]
    return terms, slope * (linearisation.height[knot, 0] - linearisation.height[knot, foot + 1])


def height_reach(linearisation: Linearisation, reach: Reach, disc: DiscPolygon) -> list[Rows]:
    """The known heights, where they are out of reach by themselves; or the bounds of unknown ones."""
    if linearisation.vertical is not None:
        is_cylinder = linearisation.problem.limits.workspace is Workspace.CYLINDER
        return [_within_cylinder(linearisation) if is_cylinder else _under_top(linearisation, disc)]
    knot, foot = np.nonzero(reach.height_miss > 0)
    if not len(knot):
        return []
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    return [make_rows(Family.WORKSPACE, "mm", [], (-np.inf, -reach.height_miss[knot, foot]), knot, feet)]


def _within_cylinder(linearisation: Linearisation) -> Rows:
    """Every foot between the floor and the lid of its cylinder."""
    knot, foot = (index.reshape(-1) for index in np.indices(linearisation.contact.shape))
    middle = -CYLINDER.depth * MM
    return _module_height(
        linearisation, knot, foot, middle - CYLINDER.below * MM, middle + CYLINDER.above * MM
    )


def _under_top(linearisation: Linearisation, disc: DiscPolygon) -> Rows:
    """Every foot in the air under the highest point of its workspace, or where that has no holes."""
    model = linearisation.problem.model
    knot, foot = np.nonzero(~linearisation.contact)
    highest = -(model.leg.link_length + model.stroke.lower) * MM if disc.inner else top_of_reach(model)
    return _module_height(linearisation, knot, foot, -np.inf, highest)


def _module_height(
    linearisation: Linearisation, knot: Indices, foot: Indices, lowest: float, highest: float
) -> Rows:
    """Z of feet in their modules between bounds, mm."""
    ones = np.ones(len(knot))
    terms = [
        vertical_term(linearisation, 0, knot, foot + 1, ones),
        vertical_term(linearisation, 0, knot, 0, -ones),
    ]
    plane = linearisation.problem.model.com_height * MM
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    return make_rows(Family.WORKSPACE, "mm", terms, (lowest - plane, highest - plane), knot, feet)


def top_of_reach(model: RobotModel) -> float:
    """A height that no foot is above in its module, less than 0.01 mm over the highest point of reach, mm.

    With ρ the distance from the module's axis and r the vertices' own, squared distances d from the three
    vertices spread by 3rρ at least, and the smallest is ρ² + r² − rρ at most, or r². All must lie from
    l² − (z + lower)² to l² − (z + upper)².
    """
    link, r = model.leg.link_length * MM, model.leg.reach_radius * MM
    lower, upper = model.stroke.lower * MM, model.stroke.upper * MM
    z = np.arange(-link - upper, -upper, TOP_STEP)
    least, most = link**2 - (z + lower) ** 2, link**2 - (z + upper) ** 2
    farthest = (most - np.maximum(least, 0.0)) / (3 * r)
    reached = (most >= 0) & (np.maximum(r**2, farthest**2 + r**2 - r * farthest) >= least)
    return float(z[reached].max()) + TOP_STEP


def swinging_reach(linearisation: Linearisation, reach: Reach) -> Rows:
    """Every foot in the air within reach of the body: one row a direction, foot and knot."""
    knot, foot = np.nonzero((linearisation.index[0, :, 1:] >= 0).any(axis=-1))
    return _relative(linearisation, reach, knot, foot)


def _relative(linearisation: Linearisation, reach: Reach, knot: Indices, foot: Indices) -> Rows:
    sides = len(reach.directions)
    group = np.repeat(np.arange(len(knot)), sides)
    most = reach.bound[knot, foot].reshape(-1)
    knot, foot = knot[group], foot[group]
    normal = np.tile(reach.directions, (len(group) // sides, 1))
    terms = dot_terms(linearisation, 0, knot, foot + 1, normal) + dot_terms(
        linearisation, 0, knot, 0, -normal
    )
    raised, lowered = _height_terms(linearisation, reach, knot, foot)
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    return make_rows(Family.WORKSPACE, "mm", terms + raised, (-np.inf, most + lowered), knot, feet, group)
