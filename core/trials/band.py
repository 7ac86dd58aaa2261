"""Several trials of one gait over each other: their mean way and how far they lie apart."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, interpolated
from core.errors import InputError
from core.vision.track import FootTrack


@dataclass(frozen=True, eq=False)
class TrialBand:
    """Feet of several trials by iteration.

    Args:
        iterations: (m,) how far the walk is, in iterations; 1.5 is half way through the second.
        ways: (trials, m, feet, 2) place of each foot, less its own first, m.
    """

    iterations: Floats
    ways: Floats

    @property
    def mean(self) -> Floats:
        """(m, feet, 2) mean of the trials, m."""
        return np.asarray(self.ways.mean(axis=0))

    @property
    def low(self) -> Floats:
        """(m, feet, 2) smallest of the trials, m."""
        return np.asarray(self.ways.min(axis=0))

    @property
    def high(self) -> Floats:
        """(m, feet, 2) largest of the trials, m."""
        return np.asarray(self.ways.max(axis=0))

    @property
    def end_spread(self) -> Floats:
        """(feet,) how far the ends of the trials lie from their mean, root of the mean square, m."""
        apart = self.ways[:, -1] - self.ways[:, -1].mean(axis=0)
        return np.asarray(np.sqrt((apart**2).sum(axis=-1).mean(axis=0)))

    def along(self, direction: Floats) -> Floats:
        """(trials, m, feet) how far each foot is along a direction, m.

        Args:
            direction: (2,) of any length but 0.
        """
        return np.asarray(self.ways @ (direction / np.hypot(*direction)))


def trial_band(tracks: Sequence[FootTrack], ends: Sequence[Sequence[int]], places: int = 50) -> TrialBand:
    """Lays trials over each other, iteration by iteration, since none takes the same time.

    Args:
        tracks: of as many feet each, in one frame.
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
        numbers = np.arange(track.times.size, dtype=np.float64)
        moved.append(interpolated(frames, numbers, track.feet - track.feet[0]))
    return TrialBand(iterations, np.array(moved))
