"""A footfall pattern drawn in characters."""

from collections.abc import Sequence

import numpy as np

from core.arrays import Bools

STANCE, SWING, CHANGE = "█", "·", "^"
WIDTH = 80
"""Samples in a line; longer patterns go on below."""
GAP = 5
"""Samples between two numbers."""


def drawn_pattern(stance: Bools, marks: Sequence[str], *, cyclic: bool) -> list[str]:
    """Lines: the samples' numbers, a row a limb, and where any limb changes.

    Args:
        stance: (legs, samples).
        marks: (legs,) what is said behind each row.
        cyclic: whether the first sample follows the last one.
    """
    changes = np.zeros(stance.shape[1], dtype=bool)
    changes[1:] = (stance[:, 1:] != stance[:, :-1]).any(axis=0)
    changes[0] = cyclic and bool((stance[:, 0] != stance[:, -1]).any())
    lines: list[str] = []
    for first in range(0, stance.shape[1], WIDTH):
        window = slice(first, first + WIDTH)
        lines.append(f"{'sample':<9}{_numbers(first, stance[:, window].shape[1])}")
        for limb, row in enumerate(stance[:, window], start=1):
            cells = "".join(STANCE if cell else SWING for cell in row)
            lines.append(f"{f'limb {limb}':<9}{cells}  {marks[limb - 1]}".rstrip())
        row = "".join(CHANGE if change else " " for change in changes[window])
        lines.append(f"{'changes':<9}{row}".rstrip())
    return lines


def _numbers(first: int, count: int) -> str:
    """The number of the first sample and of each fifth one, each beginning over its sample."""
    text = ""
    for place in range(count):
        number = first + place + 1
        if (place == 0 or number % GAP == 0) and len(text) <= place:
            text = f"{text:<{place}}{number}"
    return text
