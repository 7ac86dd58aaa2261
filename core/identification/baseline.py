"""The linear baseline: a line of measured over wanted distances, which any model must beat."""

from collections.abc import Sequence

import numpy as np

from core.arrays import Floats

LEAST_RANGE = 1e-9
"""No line is fitted through predicted distances that differ by no more than this, m."""


def linear_baseline(said: Floats, measured: Floats) -> tuple[float, float]:
    """Slope and offset of measured = a · said + b (least squares).

    Where all are said to be equally far, a is the mean of their shares and b is 0.

    Args:
        said: (gaits,) predicted distances, m.
        measured: (gaits,) m.
    """
    if np.ptp(said) < LEAST_RANGE:
        return float((measured / said).mean()), 0.0
    columns = np.stack([said, np.ones(len(said))], axis=1)
    (slope, offset), *_ = np.linalg.lstsq(columns, measured, rcond=None)
    return float(slope), float(offset)


def baseline_left_out(wanted: Floats, measured: Floats, groups: Sequence[Sequence[int]]) -> Floats:
    """Distances that a line through the others' over wanted ones predicts of gaits that were left out.

    Args:
        wanted: (gaits,) m.
        measured: (gaits,) m.
        groups: gaits that are left out together; each gait is in one.

    Returns:
        (gaits,) m.
    """
    said = np.empty_like(wanted)
    for group in groups:
        kept = np.setdiff1d(np.arange(len(wanted)), group)
        slope, offset = linear_baseline(wanted[kept], measured[kept])
        said[group] = slope * wanted[group] + offset
    return said
