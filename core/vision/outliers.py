"""Outliers: detections that cannot be the foot, by the ones before and after."""

import numpy as np

from core.arrays import Bools, Floats

NEIGHBOURS_SECONDS = 0.6
"""How far before and after a frame its neighbours lie, s."""
FARTHEST = 0.012
"""A detection farther from its neighbours' median is false, m. The motors set the pace of the robot's feet,
whatever the limits of a gait: in gaits of the library feet come up to 4 mm away from that median."""


def find_outliers(times: Floats, feet: Floats) -> Bools:
    """(n, feet) detections too far from the median of their neighbours; gaps are none.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) m, nan where a foot was not seen.
    """
    step = float(np.median(np.diff(times)))
    reach = max(1, round(NEIGHBOURS_SECONDS / step))
    padded = np.pad(feet, ((reach, reach), (0, 0), (0, 0)), constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1, axis=0)
    seen = ~np.isnan(feet).any(axis=2)
    median = np.full(feet.shape, np.nan)
    median[seen] = np.nanmedian(windows[seen], axis=-1)
    away = np.linalg.norm(feet - median, axis=2)
    return np.asarray(np.nan_to_num(away, nan=0.0) > FARTHEST)
