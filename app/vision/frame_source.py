"""A source of frames: a video file, or the recording of a camera."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from core.arrays import Floats

PICTURES, TABLE = "pictures.mjpeg", "pictures.table"
"""Files of a recording: JPEG pictures one after the other, and where each is and when."""


EVEN = 1.1e-3
"""A film whose times lie this near to even ones has an even rate, s: many containers hold milliseconds."""


@dataclass(frozen=True)
class Facts:
    """Facts of a video.

    Args:
        rate: frames a second, by the times of its pictures.
        count: how many pictures; a few of them may not decode.
        size: width and height, px.
        remark: what is missing of it, in a sentence; "" where nothing is.
    """

    rate: float
    count: int
    size: tuple[int, int]
    remark: str = ""

    @property
    def seconds(self) -> float:
        """How long it lasts."""
        return self.count / self.rate


class FrameSource(Protocol):
    """Pictures with their times; for one thread.

    Attributes:
        facts: what is known of it.
        times: (n,) of each picture after the first, s, increasing.
    """

    facts: Facts
    times: Floats

    def close(self) -> None:
        """Closes the file."""

    def picture(self, number: int) -> Any:
        """One picture, (height, width, 3) blue, green, red."""

    def pictures(self) -> Iterator[tuple[float, Any]]:
        """Every picture with its time, s."""


def rate_of(times: Floats, nominal: float) -> float | None:
    """Frames a second of a film: the nominal rate where its times follow that, else their mean.

    Args:
        times: (n,) of its pictures, s, as the file has them.
        nominal: rate that the file tells, 1/s; may be no rate at all.

    Returns:
        The rate; None where neither tells one.
    """
    is_rate = math.isfinite(nominal) and nominal > 0
    if is_rate and np.abs(times - times[0] - np.arange(times.size) / nominal).max() <= EVEN:
        return nominal
    if times.size > 1 and times[-1] > times[0]:
        return float((times.size - 1) / (times[-1] - times[0]))
    return nominal if is_rate else None


def increasing_times(times: Floats, rate: float) -> Floats:
    """Times after the first; one that does not follow comes a usual interval after the one before.

    Args:
        times: (n,) s, as the file has them.
        rate: frames a second.
    """
    after = times - times[0]
    for number in range(1, after.size):
        if after[number] <= after[number - 1]:
            after[number] = after[number - 1] + 1.0 / rate
    return np.asarray(after)
