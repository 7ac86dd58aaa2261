"""A pace in words."""

from __future__ import annotations

import math

import pytest

from core.pose_gaits.pace import motion_words, pace_words


def test_a_pace_is_a_speed_and_on_the_spot_a_turn() -> None:
    assert pace_words(0.00299, on_the_spot=False) == "2.99 mm/s"
    assert pace_words(math.radians(-5.9), on_the_spot=True) == "5.90°/s"


@pytest.mark.parametrize(
    ("speed", "turn_rate", "words"),
    [
        (0.002, 0.1, "2.00 mm/s"),
        (0.0, math.radians(4.0), "4.00°/s"),
        (1e-6, -0.1, "5.73°/s"),
        (0.0, 0.0, "0.00 mm/s"),
    ],
)
def test_a_curve_has_a_speed_and_a_turn_on_the_spot_a_rate(
    speed: float, turn_rate: float, words: str
) -> None:
    assert motion_words(speed, turn_rate) == words
