"""How fast a gait is, in words: its speed, or on the spot its turn."""

import math

LEAST_SPEED = 5e-6
"""A body that is slower only turns, m/s; it would read as 0.00 mm/s."""

PACE_DECIMALS = 7
"""Decimals to which paces (m/s, rad/s) are ranked. Several starts and mirrored foot orders lead to one pace,
equal to 1e-10."""


def pace_rank(pace: float) -> float:
    """Sort key that puts the fastest gait first and keeps the order of gaits that are equally fast."""
    return -round(pace, PACE_DECIMALS)


def pace_words(pace: float, on_the_spot: bool) -> str:
    """The pace of a gait in words: 2.99 mm/s, or 5.90°/s.

    Args:
        pace: its speed, m/s, or on the spot its turn, rad/s, to whichever side.
        on_the_spot: whether the body turns where it is.
    """
    return f"{abs(math.degrees(pace)):.2f}°/s" if on_the_spot else f"{pace * 1000:.2f} mm/s"


def motion_words(speed: float, turn_rate: float) -> str:
    """The same of a gait whose speed and turn are known: of its speed where it has one, else of its turn.

    Args:
        speed: m/s.
        turn_rate: rad/s.
    """
    on_the_spot = abs(speed) < LEAST_SPEED and turn_rate != 0.0
    return pace_words(turn_rate if on_the_spot else speed, on_the_spot)
