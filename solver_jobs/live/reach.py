"""The reach of each foot: polygons around its module, at a known height."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.problem.initial_guess import Indices
from core.problem.motion_problem import CYLINDER, Workspace
from core.robot.leg import vertex_directions
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.live.rows import NOBODY, DiscPolygon, Rows, dot_terms, make_rows
from solver_jobs.nlp.constraint import Family


@dataclass(frozen=True, eq=False)
class Reach:
    """Half planes of reach in the world's axes: direction_j · (foot − body) ≤ bound.

    Args:
        directions: (sides, 2).
        bound: (n, legs, sides) mm.
        height_miss: (n, legs) how far the known height itself is out of reach, mm; 0 where it is not.
    """

    directions: Floats
    bound: Floats
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
        miss = np.maximum(np.maximum(-CYLINDER.below * MM - above, above - CYLINDER.above * MM), 0.0)
    else:
        own, miss = _stroke_bounds(linearisation, below, disc)
    cosine, sine = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y = (model.module_centres_robot[:, axis] * MM for axis in (0, 1))
    centres = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    return Reach(normal, own + centres @ normal.T, miss)


def _stroke_bounds(linearisation: Linearisation, below: Floats, disc: DiscPolygon) -> tuple[Floats, Floats]:
    """Discs d_i ≤ l² − (z + upper)² round three vertices; and outside d_i ≥ l² − (z + lower)²."""
    model = linearisation.problem.model
    link = model.leg.link_length * MM
    far = link**2 - (below + model.stroke.upper * MM) ** 2
    near = link**2 - (below + model.stroke.lower * MM) ** 2
    radius, hole = np.sqrt(np.maximum(far, 0.0)), np.sqrt(np.maximum(near, 0.0))
    # The direction of each world normal seen from each module, turned with the body.
    turn = linearisation.problem.heading[:, None] + model.azimuths - np.pi / 2
    normal = disc.normals
    angle = np.arctan2(normal[:, 1], normal[:, 0]) - turn[..., None]
    seen = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    vertices = vertex_directions() * model.leg.reach_radius * MM
    bound = (seen @ vertices.T + radius[..., None, None] * disc.apothem).min(axis=-1)
    if disc.inner and (hole > 0).any():
        bound = np.minimum(bound, _hole_bound(seen, hole, model.leg.reach_radius * MM, disc))
    return bound, np.where(far < 0, np.abs(below) - link - model.stroke.upper * MM, 0.0).clip(0.0)


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
    foot = held.argmin(axis=1)
    most = np.take_along_axis(held, foot[:, None], axis=1)[:, 0]
    sides = len(reach.directions)
    group = np.repeat(np.arange(len(knots)), sides)
    knot = knots[group]
    feet = np.stack([foot.reshape(-1), np.full(len(knot), NOBODY)], axis=-1)
    normal = np.tile(reach.directions, (len(knots), 1))
    terms = dot_terms(linearisation, 0, knot, 0, -normal)
    return make_rows(Family.WORKSPACE, "mm", terms, (-np.inf, most.reshape(-1)), knot, feet, group)


def height_reach(linearisation: Linearisation, reach: Reach) -> list[Rows]:
    """The known heights, where they are out of reach by themselves."""
    knot, foot = np.nonzero(reach.height_miss > 0)
    if not len(knot):
        return []
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    return [make_rows(Family.WORKSPACE, "mm", [], (-np.inf, -reach.height_miss[knot, foot]), knot, feet)]


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
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    return make_rows(Family.WORKSPACE, "mm", terms, (-np.inf, most), knot, feet, group)
