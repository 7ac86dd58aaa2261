"""The arms of a leg as bars, and the room between those of neighbouring legs.

An arm is a parallelogram of four bars, `rod_diameter` thick: two rods whose ends are `rod_spacing` apart
across the arm, the knee's bar above and the platform's bar below.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.robot.leg import foot_from_strokes, vertex_directions
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs

ARM_GAP = 0.0005
"""Room between the arms of two legs below which the check warns, and that the fastest walks keep, m."""
TOGETHER = 400
"""Poses that are looked at together, so that memory stays small."""
Indices = NDArray[np.intp]
PARALLEL = 1e-15
"""Squared area between two segments, m⁴, below which they count as parallel."""


def arm_bars(model: RobotModel, strokes: Floats) -> Floats:
    """The middle lines of every bar, in the robot's frame.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m.

    Returns:
        (n, legs, 3, 4, 2, 3) both ends of two rods, knee's bar and platform's bar of each arm, m.
    """
    directions = vertex_directions()
    outwards = np.column_stack([directions, np.zeros(3)])
    across = np.column_stack([-directions[:, 1], directions[:, 0], np.zeros(3)]) * model.shape.rod_spacing / 2
    knees = np.broadcast_to(model.leg.base_radius * outwards, (*strokes.shape, 3)).copy()
    knees[..., 2] = -strokes
    vertices = foot_from_strokes(model.leg, strokes)[..., None, :] + model.leg.platform_radius * outwards
    left, right, low_left, low_right = knees - across, knees + across, vertices - across, vertices + across
    bars = [(left, low_left), (right, low_right), (left, right), (low_left, low_right)]
    ends = np.stack([np.stack(bar, axis=-2) for bar in bars], axis=-3)
    points = ends.reshape(*ends.shape[:2], -1, 3)
    turned = points @ np.swapaxes(model.R_robot_from_module, 1, 2) + model.module_centres_robot[:, None]
    return np.asarray(turned.reshape(ends.shape))


@dataclass(frozen=True, eq=False)
class NearestPoints:
    """Where two segments p + s·a and q + t·b, with s and t in 0 to 1, are nearest to each other.

    Args:
        first: (..., 3) on the first one, m.
        second: (..., 3) on the second one, m.
    """

    first: Floats
    second: Floats

    @property
    def distances(self) -> Floats:
        """(...) m."""
        return np.asarray(np.linalg.norm(self.first - self.second, axis=-1))


def nearest_points(first: Floats, second: Floats) -> NearestPoints:
    """Where two segments are nearest to each other.

    The lines' nearest points are taken, and each share is clipped with the other one's best answer.

    Args:
        first: (..., 2, 3) both ends, m.
        second: likewise.
    """
    a, b = first[..., 1, :] - first[..., 0, :], second[..., 1, :] - second[..., 0, :]
    between = first[..., 0, :] - second[..., 0, :]
    aa, bb, ab = ((x * y).sum(axis=-1) for x, y in ((a, a), (b, b), (a, b)))
    to_a, to_b = (a * between).sum(axis=-1), (b * between).sum(axis=-1)
    slant = aa * bb - ab**2
    # Parallel segments have many nearest points; any share of the first will do.
    share = (ab * to_b - to_a * bb) / np.where(slant > PARALLEL, slant, np.inf)
    share = np.clip(share, 0.0, 1.0)
    other = np.clip((ab * share + to_b) / bb, 0.0, 1.0)
    share = np.clip((ab * other - to_a) / aa, 0.0, 1.0)
    return NearestPoints(
        np.asarray(first[..., 0, :] + share[..., None] * a),
        np.asarray(second[..., 0, :] + other[..., None] * b),
    )


def arm_gaps(model: RobotModel, strokes: Floats) -> Floats:
    """Least room between the arms of neighbouring legs.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m.

    Returns:
        (n, pairs) m, in the order of `neighbour_pairs`; below 0 arms are in one another, nan where a leg has
        no pose.
    """
    pairs = neighbour_pairs(model.leg_count)
    found = [np.zeros((0, len(pairs)))]
    for begin in range(0, len(strokes), TOGETHER):
        bars = arm_bars(model, strokes[begin : begin + TOGETHER])
        flat = bars.reshape(*bars.shape[:2], -1, 2, 3)
        distances = [
            nearest_points(flat[:, one, :, None], flat[:, other, None]).distances.min(axis=(1, 2))
            for one, other in pairs
        ]
        found.append(np.stack(distances, axis=-1))
    return np.concatenate(found) - model.shape.rod_diameter


def least_arm_gaps(model: RobotModel, strokes: Floats) -> Floats:
    """Least room between the arms of neighbouring legs over some samples, as `arm_gaps` has it, but sooner.

    Bars are at least as far apart as their shadows on the line through the modules' centres. So only bars
    whose shadows are nearer than the nearest bars that are known need to be looked at.

    Args:
        model: the robot.
        strokes: (groups, n, legs, 3) m.

    Returns:
        (groups, pairs) m, in the order of `neighbour_pairs`; inf where a leg has no pose at any sample.
    """
    groups, samples = strokes.shape[:2]
    pairs = neighbour_pairs(model.leg_count)
    bars = arm_bars(model, strokes.reshape(-1, *strokes.shape[2:]))
    bars = bars.reshape(groups, samples, model.leg_count, -1, 2, 3)
    least = np.full((groups, len(pairs)), np.inf)
    for place, (one, other) in enumerate(pairs):
        first, second = bars[:, :, one], bars[:, :, other]
        towards = model.module_centres_robot[one] - model.module_centres_robot[other]
        towards = towards / np.linalg.norm(towards)
        near = (first @ towards).min(axis=-1)[..., :, None] - (second @ towards).max(axis=-1)[..., None, :]
        near = np.where(np.isnan(near), np.inf, near).reshape(groups, -1)
        best = np.full(groups, np.inf)
        known = np.nonzero(np.isfinite(near).any(axis=1))[0]
        best[known] = _bar_distances(first, second, known, near[known].argmin(axis=1))
        group, index = np.nonzero(near < best[:, None])
        np.minimum.at(best, group, _bar_distances(first, second, group, index))
        least[:, place] = best
    return least - model.shape.rod_diameter


def _bar_distances(first: Floats, second: Floats, group: Indices, index: Indices) -> Floats:
    """(k,) distances of chosen bars of two legs, m.

    Args:
        first: (groups, n, bars, 2, 3) of one leg, m.
        second: likewise of the other.
        group: (k,) which group.
        index: (k,) which sample, bar of the first leg and bar of the second, as one number.
    """
    sample, pair = np.divmod(index, first.shape[2] * second.shape[2])
    bar, against = np.divmod(pair, second.shape[2])
    return nearest_points(first[group, sample, bar], second[group, sample, against]).distances
