"""How far the feet of a track went, by the definitions of the published tables."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.vision.track import FootTrack


@dataclass(frozen=True)
class Movement:
    """One foot's movement, or a mean of several.

    Three definitions of a distance are published, and all are here: thesis 5.2 says first and last values,
    its tables of chapter 5 take the largest excursions from the first frame, and those of appendix A the
    whole extents.

    Args:
        plus_x: largest excursion from the first value towards +x, m.
        minus_x: towards −x, as a positive number, m.
        dx: last minus first value, m.
        plus_y: largest excursion towards +y, m.
        minus_y: towards −y, as a positive number, m.
        dy: last minus first value, m.
        distance: hypot(plus_x, plus_y), m.
        angle: atan2(plus_y, plus_x), so never negative, rad.
        error: distance beside what was wanted, as a share of it; negative where it is short.
        net_distance: hypot(dx, dy), m.
        net_angle: atan2(dy, dx), signed, rad.
        net_error: net distance beside what was wanted, as a share of it.
        extent_distance: hypot(largest x − smallest x, largest y − smallest y), m.
    """

    plus_x: float
    minus_x: float
    dx: float
    plus_y: float
    minus_y: float
    dy: float
    distance: float
    angle: float
    error: float
    net_distance: float
    net_angle: float
    net_error: float
    extent_distance: float


def foot_movements(track: FootTrack, expected: float) -> tuple[Movement, ...]:
    """Each foot's movement over a whole track.

    Args:
        track: the frames that count, from the first to the last.
        expected: wanted distance, m.

    Raises:
        InputError: nothing was wanted, so that there is no error beside it.
    """
    if not (math.isfinite(expected) and expected > 0):
        raise InputError(f"The wanted distance is {expected} m; it must be more than 0.", "--expect")
    return tuple(_movement(track.feet[:, foot], expected) for foot in range(track.foot_count))


def _movement(path: Floats, expected: float) -> Movement:
    """Of one foot's (n, 2) path."""
    moved = path - path[0]
    (plus_x, plus_y), (minus_x, minus_y) = moved.max(axis=0), 0.0 - moved.min(axis=0)
    dx, dy = moved[-1]
    distance, net_distance = math.hypot(plus_x, plus_y), math.hypot(dx, dy)
    return Movement(
        plus_x=float(plus_x),
        minus_x=float(minus_x),
        dx=float(dx),
        plus_y=float(plus_y),
        minus_y=float(minus_y),
        dy=float(dy),
        distance=distance,
        angle=math.atan2(plus_y, plus_x),
        error=distance / expected - 1.0,
        net_distance=net_distance,
        net_angle=math.atan2(dy, dx),
        net_error=net_distance / expected - 1.0,
        extent_distance=math.hypot(*np.ptp(path, axis=0)),
    )


def mean_movement(movements: Sequence[Movement]) -> Movement:
    """The mean of each column, over feet or over trials, as the published tables have it."""
    return _folded(movements, lambda values: float(np.mean(values)))


def spread(movements: Sequence[Movement]) -> Movement:
    """The sample standard deviation of each column, of at least two movements."""
    return _folded(movements, lambda values: float(np.std(values, ddof=1)))


def _folded(movements: Sequence[Movement], fold: Callable[[list[float]], float]) -> Movement:
    names = [field.name for field in fields(Movement)]
    return Movement(**{name: fold([getattr(m, name) for m in movements]) for name in names})
