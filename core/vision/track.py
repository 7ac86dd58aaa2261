"""Foot positions over time as a camera under the platform saw them, with their gaps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.arrays import FARTHEST, Bools, Floats, frozen_bools, frozen_floats, stretches
from core.errors import InputError


@dataclass(frozen=True, eq=False)
class FootTrack:
    """Where each foot was at each frame, in the plane of the platform.

    Gaps are filled by straight lines between the frames beside them, and at an end by the nearest frame; what
    was filled stays marked.

    Args:
        times: (n,) s, increasing.
        feet: (n, feet, 2) x, y, m.
        filled: (n, feet) true where the foot was not seen.
    """

    times: Floats
    feet: Floats
    filled: Bools

    def __post_init__(self) -> None:
        times = frozen_floats(self.times, (None,), "times")
        if times.size < 2 or (np.diff(times) <= 0).any():
            raise InputError("A track needs at least two frames with increasing times.", "times")
        feet = frozen_floats(self.feet, (times.size, None, 2), "feet", FARTHEST)
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "feet", feet)
        object.__setattr__(self, "filled", frozen_bools(self.filled, feet.shape[:2], "filled"))

    @property
    def foot_count(self) -> int:
        """Number of feet."""
        return int(self.feet.shape[1])

    @property
    def seconds(self) -> float:
        """From the first frame to the last, s."""
        return float(self.times[-1] - self.times[0])

    @property
    def frame_rate(self) -> float:
        """Frames a second, the mean by its times."""
        return (self.times.size - 1) / self.seconds

    @property
    def gaps(self) -> tuple[tuple[int, int, int], ...]:
        """Each gap as foot, first frame and last frame, 0-based and included."""
        return tuple(
            (foot, first, last)
            for foot in range(self.foot_count)
            for first, last in stretches(self.filled[:, foot])
        )

    def between(self, first: int, last: int) -> FootTrack:
        """The frames from `first` to `last`, both included, with times as they are."""
        part = slice(first, last + 1)
        return FootTrack(self.times[part], self.feet[part], self.filled[part])


def filled_track(times: Floats, feet: Floats, name: str = "track") -> FootTrack:
    """A track out of positions with gaps.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) m; nan where a foot was not seen.
        name: of the file, for messages.

    Raises:
        InputError: a foot was never seen.
    """
    missing = np.asarray(np.isnan(feet).any(axis=2))
    whole = np.array(feet, dtype=np.float64)
    for foot in range(feet.shape[1]):
        seen = ~missing[:, foot]
        if not seen.any():
            raise InputError(
                f"{name}: foot {foot + 1} is seen in no frame; check its colour range or columns.", name
            )
        for axis in range(2):
            whole[:, foot, axis] = np.interp(times, times[seen], feet[seen, foot, axis])
    return FootTrack(times, whole, missing)
