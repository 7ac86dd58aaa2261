"""The two sides of a transition: gaits that fit together, and a cursor in each."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools
from core.errors import InputError
from core.gait.gait import Gait
from core.robot.model import load_robot


@dataclass(frozen=True, eq=False)
class PatternSide:
    """One side of a transition: a gait and the cursor in it.

    Args:
        gait: a document with a timeline.
        at: the cursor's sample, 0-based.
        name: `from` or `to`, for messages.
    """

    gait: Gait
    at: int
    name: str

    def __post_init__(self) -> None:
        count = self.gait.timeline.sample_count
        if self.gait.sequence:
            raise InputError(
                f"“{self.gait.name}” is a sequence; choose the gait of one of its parts.", self.name
            )
        if self.gait.poses is not None:
            raise InputError(
                f"“{self.gait.name}” is made for the robot's clock; choose a gait whose timeline is drawn.",
                self.name,
            )
        if not 0 <= self.at < count:
            raise InputError(
                f"The cursor is at sample {self.at + 1} of “{self.gait.name}”; it must be 1 to {count}.",
                self.name,
            )

    @property
    def state(self) -> Bools:
        """(legs,) which feet stand at the cursor."""
        return np.asarray(self.gait.timeline.stance[:, self.at])


def still_limbs(gait: Gait) -> Bools:
    """(legs,) limbs that do one thing all along."""
    stance = gait.timeline.stance
    return np.asarray((stance == stance[:, :1]).all(axis=1))


def locked_limbs(first: Gait, second: Gait) -> Bools:
    """(legs,) limbs that are up in both gaits all along, or stand in both: a transition leaves them so."""
    same = first.timeline.stance[:, 0] == second.timeline.stance[:, 0]
    return np.asarray(still_limbs(first) & still_limbs(second) & same)


def require_alike(first: Gait, second: Gait) -> None:
    """Two gaits that a transition can join: one robot, one way, one sample time.

    Raises:
        InputError: naming what differs and what to do.
    """
    names = f"“{first.name}” and “{second.name}”"
    if first.robot != second.robot:
        robots = [load_robot(gait.robot).title for gait in (first, second)]
        raise InputError(
            f"{names} are for different robots, {robots[0]} and {robots[1]}. Choose two gaits of one robot.",
            "to",
        )
    if first.orientation is not second.orientation:
        raise InputError(
            f"{names} differ in orientation, {first.orientation} and {second.orientation}. Choose two gaits "
            "of one orientation; a turn in place leads from one to the other.",
            "to",
        )
    if first.direction != second.direction:
        raise InputError(
            f"{names} go in directions {first.direction} and {second.direction}. Give both one direction.",
            "to",
        )
    times = [gait.timeline.sample_time for gait in (first, second)]
    if times[0] != times[1]:
        raise InputError(
            f"{names} have a sample every {times[0]:g} s and every {times[1]:g} s. Set both to one sample "
            "time.",
            "to",
        )
