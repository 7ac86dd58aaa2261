"""A track laid over a planned or simulated motion: turned and moved so that their first frames agree."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError
from core.trials.track import FootTrack


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
    feet = frozen_floats(motion_feet, (track.foot_count, 2), "feet")
    seen = track.feet[0]
    a, b = feet - feet.mean(axis=0), seen - seen.mean(axis=0)
    sine = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
    cosine = float((a * b).sum())
    if math.hypot(sine, cosine) < 1e-12:
        raise InputError("The feet of the first frame lie in one point, so no direction is known.", "track")
    turn = math.atan2(sine, cosine)
    shift = seen.mean(axis=0) - _turning(turn) @ feet.mean(axis=0)
    gaps = np.hypot(*(feet @ _turning(turn).T + shift - seen).T)
    return Alignment(turn, shift, gaps)


def placed_motion(times: Floats, feet_world: Floats, alignment: Alignment) -> FootTrack:
    """A planned or simulated motion as a track in the frame of a recorded one.

    Args:
        times: (n,) s.
        feet_world: (n, feet, 3) m.
        alignment: how it lies there.
    """
    seen = np.zeros(feet_world.shape[:2], dtype=np.bool_)
    return FootTrack(times, alignment.placed(feet_world[..., :2]), seen)


def _turning(angle: float) -> Floats:
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, -sine], [sine, cosine]])
