"""Strokes at the poses of many gaits and their motion within moves, with derivatives by the unknowns."""

from dataclasses import dataclass

import numpy as np

from core.arrays import SAME, Floats, first_highest, first_lowest
from core.robot.leg import foot_from_strokes, vertex_directions
from core.robot.model import RobotModel
from solver_jobs.atlas.layout import MM, Asked, Layout, rotations

PLACES = (0.2, 0.5, 0.8)
"""Places within each move at which rows are held; the checker looks at 41."""
LEAST_DEPTH = 1.0
"""A rod's height is taken as at least this, mm: a start out of reach keeps a slope that leads back."""


@dataclass(frozen=True, eq=False)
class Poses:
    """Poses of n gaits, mm.

    Args:
        bodies: (n, poses, 3).
        feet: (n, poses, legs, 3).
        headings: (n, poses) rad.
        strokes: (n, poses, legs, 3).
        stroke_slopes: (n, poses, legs, 3, unknowns).
    """

    bodies: Floats
    feet: Floats
    headings: Floats
    strokes: Floats
    stroke_slopes: Floats


@dataclass(frozen=True, eq=False)
class Within:
    """Body and feet at `PLACES` of every move of n gaits, as the standing feet leave them, mm.

    Args:
        headings: (n, moves, places) rad.
        body: (n, moves, places, 3).
        body_slopes: (n, moves, places, 3, unknowns).
        feet: (n, moves, places, legs, 3).
        foot_slopes: (n, moves, places, legs, 3, unknowns).
        strokes: (n, moves, places, legs, 3).
        stroke_slopes: (n, moves, places, legs, 3, unknowns).
    """

    headings: Floats
    body: Floats
    body_slopes: Floats
    feet: Floats
    foot_slopes: Floats
    strokes: Floats
    stroke_slopes: Floats


class Postures:
    """The motion of n gaits with one layout.

    Args:
        layout: their unknowns.
        asked: what is asked of each.
    """

    def __init__(self, layout: Layout, asked: Asked) -> None:
        self.layout = layout
        self.asked = asked
        self.foot_map = layout.foot_map(asked.turn)
        self._shares = np.linspace(0.0, 1.0, layout.move_count + 1)
        model = layout.model
        self._headings = asked.turn[:, None] * self._shares
        self._to_module = np.swapaxes(model.R_robot_from_module, 1, 2)
        self._centres = model.module_centres_robot * MM
        turned = np.swapaxes(rotations(self._headings), -1, -2)
        self._turn_to_module = self._to_module @ turned[:, :, None]
        self.away_map = self.foot_map - layout.body_map[None, :, None]

    def bodies(self, unknowns: Floats) -> Floats:
        """(n, poses, 3) of (n, unknowns)."""
        made = np.einsum("pcu,nu->npc", self.layout.body_map, unknowns)
        made[:, -1, :2] += self.asked.travel
        return np.asarray(made)

    def feet(self, unknowns: Floats) -> Floats:
        """(n, poses, legs, 3) of (n, unknowns)."""
        made = np.einsum("nplcu,nu->nplc", self.foot_map, unknowns)
        made[..., :2] += self.layout.landed[None, :, :, None] * self.asked.travel[:, None, None]
        return np.asarray(made)

    def poses(self, unknowns: Floats) -> Poses:
        """Poses and slopes of their strokes."""
        bodies, feet = self.bodies(unknowns), self.feet(unknowns)
        away = feet - bodies[:, :, None]
        from_centre = (self._to_module @ self._centres[:, :, None])[..., 0]
        in_module = (self._turn_to_module @ away[..., None])[..., 0] - from_centre
        strokes, slopes = stroke_slopes(self.layout.model, in_module)
        by_unknowns = (slopes @ self._turn_to_module) @ self.away_map
        return Poses(bodies, feet, self._headings, strokes, by_unknowns)

    def within(self, poses: Poses) -> Within:
        """Body and feet within moves, where motors go straight.

        As the checker has it: the body is where the farthest standing foot is nearest to its foothold, axis
        by axis. Its slope is that of the two feet that are farthest.
        """
        layout, model = self.layout, self.layout.model
        shares = np.array(PLACES)
        first, last = 1.0 - shares[:, None, None], shares[:, None, None]
        strokes = first * poses.strokes[:, :-1, None] + last * poses.strokes[:, 1:, None]
        slopes = (
            first[..., None] * poses.stroke_slopes[:, :-1, None]
            + last[..., None] * poses.stroke_slopes[:, 1:, None]
        )
        in_module = foot_from_strokes(model.leg, strokes / MM) * MM
        _, by_foot = stroke_slopes(model, in_module)
        headings = self.asked.turn[:, None, None] * (self._shares[:-1, None] + shares / layout.move_count)
        to_world = rotations(headings)[:, :, :, None] @ model.R_robot_from_module
        centres = (rotations(headings)[:, :, :, None] @ self._centres[:, :, None])[..., 0]
        offset = (to_world @ in_module[..., None])[..., 0] + centres
        offset_slopes = (to_world @ np.linalg.inv(by_foot)) @ slopes
        wanted = poses.feet[:, :-1, None] - offset
        standing = ~layout.moving[None, :, None, :, None]
        least = first_lowest(np.where(standing, wanted, np.inf), SAME * MM, axis=3)
        most = first_highest(np.where(standing, wanted, -np.inf), SAME * MM, axis=3)
        wanted_slopes = self.foot_map[:, :-1, None] - offset_slopes
        body = (_of_leg(wanted, least) + _of_leg(wanted, most)) / 2.0
        body_slopes = (_of_leg(wanted_slopes, least) + _of_leg(wanted_slopes, most)) / 2.0
        feet = body[:, :, :, None] + offset
        foot_slopes = body_slopes[:, :, :, None] + offset_slopes
        return Within(headings, body, body_slopes, feet, foot_slopes, strokes, slopes)


def _of_leg(values: Floats, legs: np.ndarray) -> Floats:
    """Of (n, moves, places, legs, 3, …) the values of one leg for each axis; legs (n, moves, places, 3)."""
    index = legs[:, :, :, None]
    while index.ndim < values.ndim:
        index = index[..., None]
    return np.asarray(np.take_along_axis(values, index, axis=3)[:, :, :, 0])


def stroke_slopes(model: RobotModel, in_module: Floats) -> tuple[Floats, Floats]:
    """Strokes of feet in their modules' frames, and their derivatives by the foot's place, mm.

    Args:
        model: the robot.
        in_module: (…, 3) mm.

    Returns:
        (…, 3) strokes, mm, and (…, 3, 3) slopes.
    """
    centres = model.leg.reach_radius * MM * vertex_directions()
    arms = in_module[..., None, :2] - centres
    below = (model.leg.link_length * MM) ** 2 - (arms**2).sum(axis=-1)
    depth = np.sqrt(np.maximum(below, LEAST_DEPTH**2))
    strokes = -(in_module[..., 2:3] + depth)
    slopes = np.concatenate([arms / depth[..., None], -np.ones((*depth.shape, 1))], axis=-1)
    return strokes, slopes
