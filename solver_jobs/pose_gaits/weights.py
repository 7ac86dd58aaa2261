"""The cost of a pose gait's program, and the limits that may be loosened in it."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats

SLACKS = ("margin", "clearance", "shoe distance", "stop bound")
"""Limits that an explanation may loosen."""


@dataclass(frozen=True)
class Weights:
    """What the cost consists of.

    Args:
        time: of the robot's time, a second.
        pace: of the robot's time for each 30 mm of travel, on the spot at `pose_program.LEVER`; in place
            of `time` where step or turn is free.
        slip: of squared deviations of standing feet, mm².
        sway: of squared differences from an even travel of the body, mm².
        reach: taken off for each mm of the step, on the spot at `pose_program.LEVER`.
        slack: of each mm by which a limit is loosened.
    """

    time: float = 0.0
    pace: float = 0.0
    slip: float = 0.0
    sway: float = 0.0
    reach: float = 0.0
    slack: float = 0.0

    @property
    def values(self) -> Floats:
        """(6,) as the program's parameters."""
        return np.array([self.time, self.pace, self.slip, self.sway, self.reach, self.slack])
