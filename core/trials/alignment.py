"""A track laid over a planned or simulated motion: turned and moved so that their first frames agree."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, frozen_floats, interpolated
from core.errors import InputError
from core.vision.track import FootTrack


@dataclass(frozen=True, eq=False)
class Alignment:
    """How a motion's frame lies in the track's.

    Args:
        turn: of the motion about z, rad; −45° in the published Walk and Amble trials.
        shift: (2,) of the turned motion, m.
        gaps: (feet,) what is left between the two at the first frame, m.
    """

    turn: float
    shift: Floats
    gaps: Floats

    def placed(self, feet: Floats) -> Floats:
        """Positions of the motion in the track's frame.

        Args:
            feet: (..., 2) x, y in the motion's frame, m.
        """
        return np.asarray(feet @ _turning(self.turn).T + self.shift)

    def taken_back(self, feet: Floats) -> Floats:
        """Positions of the track in the motion's frame; inverse of `placed`.

        Args:
            feet: (..., 2) x, y in the track's frame, m.
        """
        return np.asarray((feet - self.shift) @ _turning(self.turn))


def align(track: FootTrack, motion_feet: Floats) -> Alignment:
    """The turn and shift with which the motion's first feet come nearest to the track's (least squares).

    With a_i the motion's and b_i the track's feet less their means, the turn is
    atan2(Σ a_i × b_i, Σ a_i · b_i).

    Args:
        track: its first frame counts.
        motion_feet: (feet, 2) the motion's feet at its beginning, x, y, m.

    Raises:
        InputError: the two have not the same number of feet, or the feet lie in one point.
    """
    return align_feet(track.feet[0], motion_feet)


def align_feet(places: Floats, motion_feet: Floats) -> Alignment:
    """The same for feet at places (see `align`).

    Args:
        places: (feet, 2) where they are, m.
        motion_feet: (feet, 2) where the motion has them, m.

    Raises:
        InputError: the two have not the same number of feet, or the feet lie in one point.
    """
    feet = frozen_floats(motion_feet, (len(places), 2), "feet")
    turn, shift = _rigid_move(feet, places)
    gaps = np.hypot(*(feet @ _turning(turn).T + shift - places).T)
    return Alignment(turn, shift, gaps)


def repeated_motion(times: Floats, feet: Floats, laps: int) -> tuple[Floats, Floats]:
    """A motion done several times, each beginning where the one before has taken the robot.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) m.
        laps: how often.

    Returns:
        (laps (n − 1) + 1,) s and (laps (n − 1) + 1, feet, 2) m.
    """
    turn, shift = _rigid_move(feet[0], feet[-1])
    every_time, every_place = [times], [feet]
    for _ in range(laps - 1):
        every_time.append(every_time[-1][-1] + times[1:] - times[0])
        before = feet[1:] if len(every_place) == 1 else every_place[-1]
        every_place.append(before @ _turning(turn).T + shift)
    return np.concatenate(every_time), np.concatenate(every_place)


def _rigid_move(start: Floats, end: Floats) -> tuple[float, Floats]:
    """Turn and shift that bring (feet, 2) points nearest to others."""
    a, b = start - start.mean(axis=0), end - end.mean(axis=0)
    sine = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
    cosine = float((a * b).sum())
    if math.hypot(sine, cosine) < 1e-12:
        raise InputError("The feet of the first frame lie in one point, so no direction is known.", "track")
    turn = math.atan2(sine, cosine)
    return turn, np.asarray(end.mean(axis=0) - _turning(turn) @ start.mean(axis=0))


def placed_motion(times: Floats, feet_world: Floats, alignment: Alignment) -> FootTrack:
    """A planned or simulated motion as a track in the frame of a recorded one.

    Args:
        times: (n,) s.
        feet_world: (n, feet, 3) m.
        alignment: how it lies there.
    """
    seen = np.zeros(feet_world.shape[:2], dtype=np.bool_)
    return FootTrack(times, alignment.placed(feet_world[..., :2]), seen)


def track_of_motion(track: FootTrack, alignment: Alignment) -> FootTrack:
    """A recorded track in the frame of the motion that it is laid over."""
    return FootTrack(track.times, alignment.taken_back(track.feet), track.filled)


def foot_gaps(track: FootTrack, ends: Sequence[int], motion: FootTrack) -> Floats:
    """(feet,) mean distance of each foot from where a motion has it at the same share of the walk, m.

    The robot walks by its own clock: its k-th of n iterations, between their ends, stands beside the k-th
    n-th of the motion's time. Frames in which a foot was not seen don't count, unless it was seen in none.

    Args:
        track: recorded.
        ends: last frame of each of its iterations.
        motion: planned or simulated, placed in the track's frame.

    Raises:
        InputError: the two have not the same number of feet.
    """
    if motion.foot_count != track.foot_count:
        raise InputError(f"The motion has {motion.foot_count} feet, the track {track.foot_count}.", "motion")
    shares = np.interp(np.arange(track.times.size), [0, *ends], np.linspace(0.0, 1.0, len(ends) + 1))
    wanted = motion.times[0] + shares * (motion.times[-1] - motion.times[0])
    gaps = np.linalg.norm(interpolated(wanted, motion.times, motion.feet) - track.feet, axis=-1)
    counted = np.where(track.filled.all(axis=0), True, ~track.filled)
    return np.asarray((gaps * counted).sum(axis=0) / counted.sum(axis=0))


def _turning(angle: float) -> Floats:
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, -sine], [sine, cosine]])
