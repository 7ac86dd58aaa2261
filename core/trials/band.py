"""Several trials of one gait over each other: their mean way and how far they lie apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.trials.track import FootTrack


@dataclass(frozen=True, eq=False)
class TrialBand:
    """Feet of several trials by iteration.

    Args:
        iterations: (m,) how far the walk is, in iterations; 1.5 is half way through the second.
        mean: (m, feet, 2) mean place of each foot, less its own first, m.
        low: (m, feet, 2) smallest of the trials, m.
        high: (m, feet, 2) largest of the trials, m.
    """

    iterations: Floats
    mean: Floats
    low: Floats
    high: Floats


def trial_band(tracks: Sequence[FootTrack], ends: Sequence[Sequence[int]], places: int = 50) -> TrialBand:
    """Lays trials over each other, iteration by iteration, since none takes the same time.

    Args:
        tracks: of as many feet each.
        ends: last frame of each iteration of each track, as many for all.
        places: samples an iteration.

    Raises:
        InputError: the trials have not the same feet or iterations.
    """
    if not tracks or len({track.foot_count for track in tracks}) > 1 or len({len(e) for e in ends}) > 1:
        raise InputError("Trials laid over each other need as many feet and iterations each.", "trials")
    count = len(ends[0])
    iterations = np.linspace(0.0, count, count * places + 1)
    moved = []
    for track, last in zip(tracks, ends, strict=True):
        frames = np.interp(iterations, np.arange(count + 1), [0, *last])
        ways = track.feet - track.feet[0]
        rows = [
            [np.interp(frames, np.arange(len(ways)), ways[:, foot, axis]) for axis in range(2)]
            for foot in range(track.foot_count)
        ]
        moved.append(np.moveaxis(np.array(rows), -1, 0))
    together = np.array(moved)
    return TrialBand(iterations, together.mean(axis=0), together.min(axis=0), together.max(axis=0))
