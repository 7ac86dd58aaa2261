"""Lost motion between motors and knees."""

from __future__ import annotations

import numpy as np
import pytest

from core.physics.backlash import with_backlash


def test_without_backlash_knees_are_where_motors_are() -> None:
    strokes = np.linspace(0.0, 0.01, 12).reshape(4, 3)
    assert (with_backlash(strokes, 0.0) == strokes).all()


def test_a_motor_that_turns_round_crosses_its_play_before_the_knee_moves() -> None:
    strokes = np.array([0.0, 4.0, 3.0, 2.0, 1.0, 1.5])[:, None]
    assert with_backlash(strokes, 2.0)[:, 0] == pytest.approx([0.0, 3.0, 3.0, 3.0, 2.0, 2.0])


def test_a_knee_is_never_further_from_its_motor_than_half_of_the_play() -> None:
    strokes = np.random.default_rng(3).normal(size=(200, 12))
    assert np.abs(with_backlash(strokes, 0.7) - strokes).max() <= 0.35 + 1e-12
