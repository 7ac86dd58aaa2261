"""The displacement of a walk, from a recording or from a motion, so that both can be compared."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.trials.alignment import repeated_motion
from core.trials.movement import Movement, foot_movements, mean_movement
from core.vision.track import FootTrack


@dataclass(frozen=True)
class Displacement:
    """The displacement of a whole walk, a mean over its feet.

    Args:
        distance: by the published definition, hypot of the largest excursions along and across the wanted
            direction, m.
        angle: from first to last frame, from the wanted direction, counter-clockwise, rad.
    """

    distance: float
    angle: float


@dataclass(frozen=True)
class MeasuredWalk:
    """What the real robot did with one gait, over one or several trials.

    Args:
        name: of the gait with its step.
        kind: of gait; walks of one kind are left out together in one of the tests.
        wanted: distance that was wanted, m.
        displacement: mean over the trials.
        trials: how many.
        spread: (distance in m, angle in rad) sample standard deviation of the trials; None of a single one.
    """

    name: str
    kind: str
    wanted: float
    displacement: Displacement
    trials: int
    spread: tuple[float, float] | None = None


def track_displacement(track: FootTrack, heading: float, wanted: float) -> Displacement:
    """Travel of a recorded track.

    Args:
        track: from the first frame to the last.
        heading: of the wanted direction in the track's frame, rad.
        wanted: distance that was wanted, m.
    """
    turned = FootTrack(track.times, turned_by(track.feet, -heading), track.filled)
    return movement_displacement(mean_movement(foot_movements(turned, wanted)))


def motion_displacement(
    times: Floats, feet: Floats, laps: int, heading: float, wanted: float
) -> Displacement:
    """Travel of a motion that is walked several times, each lap from where the one before has ended.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) x, y of one lap, m.
        laps: how often.
        heading: of the wanted direction in the motion's frame, rad.
        wanted: distance that was wanted of all laps, m.
    """
    every_time, every_place = repeated_motion(times, feet, laps)
    seen = np.zeros(every_place.shape[:2], dtype=np.bool_)
    return track_displacement(FootTrack(every_time, every_place, seen), heading, wanted)


def movement_displacement(movement: Movement) -> Displacement:
    """Travel of a movement whose frame has the wanted direction on +x."""
    return Displacement(movement.distance, movement.net_angle)


def walk_of_trials(
    name: str, kind: str, wanted: float, displacements: Sequence[Displacement]
) -> MeasuredWalk:
    """The trials of one gait together.

    Raises:
        InputError: there is none.
    """
    if not displacements:
        raise InputError(f"{name} has no trial; leave it out.", "trials")
    both = np.array([[displacement.distance, displacement.angle] for displacement in displacements])
    mean = both.mean(axis=0)
    spread = both.std(axis=0, ddof=1) if len(both) > 1 else None
    apart = None if spread is None else (float(spread[0]), float(spread[1]))
    return MeasuredWalk(name, kind, wanted, Displacement(float(mean[0]), float(mean[1])), len(both), apart)


def pooled_spread(walks: Sequence[MeasuredWalk]) -> tuple[float, float] | None:
    """Spread of a single trial over all walks that have several: the root of the mean variance.

    Returns:
        (m, rad), or None where every walk has one trial.
    """
    rows = [(walk.trials - 1, *walk.spread) for walk in walks if walk.spread is not None]
    if not rows:
        return None
    freedoms = sum(row[0] for row in rows)
    distance, angle = (
        math.sqrt(sum(row[0] * row[column] ** 2 for row in rows) / freedoms) for column in (1, 2)
    )
    return distance, angle


def turned_by(points: Floats, angle: float) -> Floats:
    """Points (..., 2) turned about the origin by an angle, rad."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(points @ np.array([[cosine, sine], [-sine, cosine]]))
