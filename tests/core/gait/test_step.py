"""The bounds of a gait's step: absurd numbers are refused, 0 is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.step import MAX_STEP, MAX_TURN, without_rounding
from core.library.library import library

WALK = library()["walk"].gait


@pytest.mark.parametrize(
    ("step", "words"),
    [
        ((1e-300, 0.0, 0.0), "must be 0 or at least 1e-09 m"),
        ((0.01, 0.0, 1e-300), "must be 0 or at least 1e-09 rad"),
        ((0.01, 0.0, -1e-12), "must be 0 or at least 1e-09 rad"),
        ((10.0, 0.0, 0.0), "at most 200 mm an iteration"),
        ((1e308, 1e308, 0.0), "at most 200 mm an iteration"),
        ((0.0, 0.0, 1e6), "at most 6.28 rad an iteration"),
        ((0.0, 0.0, -1e308), "at most 6.28 rad an iteration"),
        ((0.01, 0.0, np.nan), "must be finite"),
    ],
)
def test_a_step_that_no_robot_makes_is_refused(step: tuple[float, float, float], words: str) -> None:
    with pytest.raises(InputError, match=words):
        replace(WALK, step=step)


@pytest.mark.parametrize("step", [(0.0, -0.0, 0.0), (MAX_STEP, 0.0, MAX_TURN), (0.01, 1e-18, 0.0)])
def test_none_and_the_bounds_are_steps(step: tuple[float, float, float]) -> None:
    assert replace(WALK, step=step).step == step


def test_a_measured_step_is_without_rounding() -> None:
    assert without_rounding((1e-17, -1e-18, 1e-16)) == (0.0, 0.0, 0.0)
    assert without_rounding((0.01, 1e-18, -0.2)) == (0.01, 1e-18, -0.2)
