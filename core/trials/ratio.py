"""A line through measured distances over wanted ones, which any model of the robot must beat."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.arrays import Floats


def ratio_left_out(wanted: Floats, measured: Floats, groups: Sequence[Sequence[int]]) -> Floats:
    """Distances that measured = a · wanted + b foretells of gaits that were left out (least squares).

    Where all others were wanted equally far, a is the mean of their shares and b is 0.

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
        if np.ptp(wanted[kept]) < 1e-9:
            said[group] = (measured[kept] / wanted[kept]).mean() * wanted[group]
            continue
        columns = np.stack([wanted[kept], np.ones(len(kept))], axis=1)
        (slope, offset), *_ = np.linalg.lstsq(columns, measured[kept], rcond=None)
        said[group] = slope * wanted[group] + offset
    return said
