"""Bars of the arms, and the distance of two of them."""

from __future__ import annotations

import numpy as np

from core.robot.arms import arm_bars, nearest_points
from core.robot.model import load_robot

MODEL = load_robot("deltawalker")


def test_rods_are_as_long_as_the_robot_s_and_parallel() -> None:
    strokes = np.random.default_rng(3).uniform(0.004, 0.012, (20, 4, 3))
    bars = arm_bars(MODEL, strokes)
    rods = bars[..., :2, 1, :] - bars[..., :2, 0, :]
    np.testing.assert_allclose(np.linalg.norm(rods, axis=-1), MODEL.leg.link_length, atol=1e-12)
    np.testing.assert_allclose(rods[..., 0, :], rods[..., 1, :], atol=1e-12)


def test_segments_are_as_far_apart_as_their_nearest_points() -> None:
    rng = np.random.default_rng(4)
    first, second = rng.uniform(-1.0, 1.0, (2, 300, 2, 3))
    shares = np.linspace(0.0, 1.0, 101)
    on_first, on_second = (
        one[:, None, 0] + shares[:, None] * (one[:, 1] - one[:, 0])[:, None] for one in (first, second)
    )
    sampled = np.linalg.norm(on_first[:, :, None] - on_second[:, None], axis=-1).min(axis=(1, 2))
    exact = nearest_points(first, second).distances
    assert (exact <= sampled + 1e-12).all()
    np.testing.assert_allclose(exact, sampled, atol=0.02)
