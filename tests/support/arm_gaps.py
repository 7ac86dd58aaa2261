"""How near the arms of neighbouring legs come to each other.

An arm is a parallelogram: two rods, the knee's bar above and the platform's bar below, all `rod_diameter`
thick, their ends `rod_spacing` apart across the arm (docs/checks.md).
"""

from __future__ import annotations

import numpy as np

from core.arrays import Floats
from core.robot.leg import foot_from_strokes, vertex_directions
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs
from core.wire.executed_path import STEPS

TOGETHER = 400
"""Poses that are looked at together, so that memory stays small."""


def arm_bars(model: RobotModel, strokes: Floats) -> Floats:
    """(n, legs, 3, 4, 2, 3) ends of the bars of every arm in the robot's frame, m: rods first.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m.
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
    turned = np.einsum("lij,nlabej->nlabei", model.R_robot_from_module, ends)
    return np.asarray(turned + model.module_centres_robot[:, None, None, None])


def segment_distances(first: Floats, second: Floats) -> Floats:
    """(...) distance of segments, each (..., 2 ends, 3), m."""
    a, b = first[..., 1, :] - first[..., 0, :], second[..., 1, :] - second[..., 0, :]
    between = first[..., 0, :] - second[..., 0, :]
    aa, bb, ab = ((x * y).sum(axis=-1) for x, y in ((a, a), (b, b), (a, b)))
    to_a, to_b = (a * between).sum(axis=-1), (b * between).sum(axis=-1)
    slant = aa * bb - ab**2
    share = np.clip(
        np.where(slant > 1e-15, (ab * to_b - to_a * bb) / np.maximum(slant, 1e-15), 0.0), 0.0, 1.0
    )
    other = np.clip((ab * share + to_b) / bb, 0.0, 1.0)
    share = np.clip((ab * other - to_a) / aa, 0.0, 1.0)
    apart = between + share[..., None] * a - other[..., None] * b
    return np.asarray(np.linalg.norm(apart, axis=-1))


def arm_gaps(model: RobotModel, strokes: Floats) -> Floats:
    """(n, pairs) least room between the arms of neighbouring legs, m; below 0 they are in one another."""
    found = []
    for begin in range(0, len(strokes), TOGETHER):
        bars = arm_bars(model, strokes[begin : begin + TOGETHER])
        flat = bars.reshape(*bars.shape[:2], -1, 2, 3)
        pairs = [
            segment_distances(flat[:, one, :, None], flat[:, other, None]).min(axis=(1, 2))
            for one, other in neighbour_pairs(model.leg_count)
        ]
        found.append(np.stack(pairs, axis=-1))
    return np.concatenate(found) - model.shape.rod_diameter


def strokes_on_way(strokes: Floats) -> Floats:
    """(m, legs, 3) strokes at the first waypoint and along every move, straight in motor space, m."""
    shares = np.arange(1, STEPS + 1)[:, None, None] / STEPS
    ways = strokes[:-1, None] + shares * np.diff(strokes, axis=0)[:, None]
    return np.concatenate([strokes[:1], ways.reshape(-1, *strokes.shape[1:])])
