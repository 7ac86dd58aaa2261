"""Motor speeds of one leg: the derivative of its inverse kinematics."""

from __future__ import annotations

import numpy as np

from core.robot.leg import foot_from_strokes, foot_jacobian, stroke_rates, strokes_from_foot
from core.robot.model import load_robot

LEG = load_robot("deltawalker").leg


def random_feet(count: int = 100) -> tuple[np.ndarray, np.ndarray]:
    """Feet and their velocities in the module's frame."""
    rng = np.random.default_rng(20250302)
    strokes = rng.uniform(0.0005, 0.0195, size=(count, 3))
    return foot_from_strokes(LEG, strokes), rng.normal(0.0, 0.01, size=(count, 3))


def test_stroke_rates_agree_with_finite_differences() -> None:
    feet, velocity = random_feet()
    step = 1e-5
    ahead, behind = (strokes_from_foot(LEG, feet + sign * step * velocity) for sign in (1, -1))
    np.testing.assert_allclose(stroke_rates(LEG, feet, velocity), (ahead - behind) / (2 * step), atol=1e-9)


def test_stroke_rates_undo_the_foots_jacobian() -> None:
    feet, velocity = random_feet()
    jacobian = foot_jacobian(LEG, strokes_from_foot(LEG, feet))
    moved = np.einsum("nij,nj->ni", jacobian, stroke_rates(LEG, feet, velocity))
    np.testing.assert_allclose(moved, velocity, atol=1e-12)


def test_a_foot_moved_straight_up_extends_no_motor_sideways() -> None:
    foot = foot_from_strokes(LEG, np.full(3, 0.01))
    np.testing.assert_allclose(stroke_rates(LEG, foot, np.array([0.0, 0.0, 0.01])), -0.01)


def test_no_rate_where_no_rod_is_long_enough() -> None:
    far = np.array([LEG.link_length * 2, 0.0, -0.05])
    assert np.isnan(stroke_rates(LEG, far, np.ones(3))).any()
