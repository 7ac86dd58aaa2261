"""The start of a motion in the world: on the footholds where the robot stands."""

from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

import numpy as np

from core.arrays import Bools, Floats
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import raised_feet, turned_about_z

SAME_PLACE = 2e-5
"""Feet that differ by less stand at the same place, m."""
FEWEST_STAYING = 3
"""Fewer feet than these do not say where a motion begins."""


@dataclass(frozen=True, eq=False)
class Placement:
    """A turn about z, then a shift.

    Args:
        angle: rad.
        shift: (3,) m.
    """

    angle: float
    shift: Floats

    def points(self, points: Floats) -> Floats:
        """(..., 3) points, turned and shifted, m."""
        return np.asarray(turned_about_z(points, self.angle) + self.shift)

    def motion(self, motion: Trajectory) -> Trajectory:
        """A motion, turned and shifted."""

        def turned(vectors: Floats | None) -> Floats | None:
            return None if vectors is None else turned_about_z(vectors, self.angle)

        return replace(
            motion,
            body_world=self.points(motion.body_world),
            heading=motion.heading + self.angle,
            feet_world=self.points(motion.feet_world),
            body_velocity=turned(motion.body_velocity),
            feet_velocity=turned(motion.feet_velocity),
            contact_forces=turned(motion.contact_forces),
        )


@dataclass(frozen=True, eq=False)
class Placed:
    """A motion where it begins, and which feet need not step for it.

    Args:
        motion: in the world.
        stays: (legs,) true where a foot stands, or is held up, already where the motion begins.
    """

    motion: Trajectory
    stays: Bools


def placed_on(standing: Trajectory, motion: Trajectory) -> Placed:
    """Places a motion where as many feet as possible stand at the end of another.

    The turn and shift are those of least squares over the feet that stay, or over all of them where fewer
    than three could. Feet that are held up do not count for it where enough others stand, and stay only where
    they are held as high as before.

    Args:
        standing: the motion before.
        motion: the one that follows, in its own world.
    """
    own, there = motion.feet_world[0], standing.feet_world[-1]
    begins = float(standing.heading[-1] - motion.heading[0])
    raised = raised_feet(own), raised_feet(there)
    counted = np.nonzero(~(raised[0] | raised[1]))[0]
    if len(counted) < FEWEST_STAYING:
        counted = np.arange(len(own))
    chosen = counted[_largest_match(own[counted, :2], there[counted, :2])]
    placement = _fitted(own[chosen, :2], there[chosen, :2], begins)
    level = (raised[0] == raised[1]) & (~raised[0] | (np.abs(own[:, 2] - there[:, 2]) <= SAME_PLACE))
    near = _apart(placement, motion, there[:, :2]) <= SAME_PLACE
    return Placed(placement.motion(motion), np.asarray(near & level))


def _largest_match(own: Floats, there: Floats) -> Bools:
    """(legs,) most feet that can stand where others do after one turn and shift, the first feet among equals.

    All of them where fewer than three could.

    Args:
        own: (legs, 2) m.
        there: (legs, 2) m.
    """
    choices = _choices(len(own))
    share = choices / choices.sum(axis=1, keepdims=True)
    # (choices, legs, 2) about the middle of each choice's feet, and the turn that fits those best.
    p, q = (points - (share @ points)[:, None] for points in (own, there))
    across = p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]
    along = (p * q).sum(axis=-1)
    angle = np.arctan2((across * choices).sum(axis=1), (along * choices).sum(axis=1))[:, None]
    x, y = p[..., 0], p[..., 1]
    turned = np.stack([np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y], axis=-1)
    apart = np.where(choices, np.linalg.norm(turned - q, axis=-1), 0.0).max(axis=1)
    fits = np.nonzero(apart <= SAME_PLACE)[0]
    return np.asarray(choices[fits[0] if fits.size else 0])


@cache
def _choices(legs: int) -> Bools:
    """(choices, legs) true where a foot is chosen: all feet, then all but one, and so on."""
    chosen = [
        feet for count in range(legs, FEWEST_STAYING - 1, -1) for feet in combinations(range(legs), count)
    ]
    choices = np.array([[foot in feet for foot in range(legs)] for feet in chosen], dtype=np.bool_)
    choices.setflags(write=False)
    return choices


def _apart(placement: Placement, motion: Trajectory, there: Floats) -> Floats:
    begins = placement.points(motion.feet_world[0])[:, :2]
    return np.asarray(np.linalg.norm(begins - there, axis=1))


def _fitted(own: Floats, there: Floats, begins: float) -> Placement:
    """Turn and shift that bring (k, 2) points nearest to others; the turn is the one next to `begins`."""
    p, q = own - own.mean(axis=0), there - there.mean(axis=0)
    angle = float(np.arctan2((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum(), (p * q).sum()))
    # Whole turns are kept, so that headings add up.
    angle += 2 * np.pi * round((begins - angle) / (2 * np.pi))
    centre, goal = (np.append(points.mean(axis=0), 0.0) for points in (own, there))
    return Placement(angle, goal - turned_about_z(centre, angle))
