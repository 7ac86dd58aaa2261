"""The unknowns of one cycle in mid-walk, and how bodies and feet follow from them, for many gaits at once."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.pose_gaits.pose_problem import PoseProblem, swing_shares
from core.robot.model import RobotModel

MM = 1000.0


@dataclass(frozen=True, eq=False)
class Asked:
    """What is asked of each of n gaits, mm, s and rad.

    Args:
        heading: (n,) direction of travel at the beginning, from x.
        step: (n,) travel of the body a cycle.
        turn: (n,) turn of the body a cycle.
        height: (n,) actuator plane in the mean of all poses.
        clearance: (n,) of a swinging foot.
        margin: (n,) static stability margin.
        longest: (n,) largest move of a motor, which the stop bound leaves.
    """

    heading: Floats
    step: Floats
    turn: Floats
    height: Floats
    clearance: Floats
    margin: Floats
    longest: Floats

    @property
    def count(self) -> int:
        """How many gaits."""
        return len(self.step)

    @property
    def travel(self) -> Floats:
        """(n, 2) from the first place of the body to the last: the step along the heading half way."""
        angle = self.heading + self.turn / 2.0
        return np.asarray(self.step[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1))

    def of(self, chosen: NDArray[np.intp] | Bools) -> "Asked":
        """Some of the gaits."""
        return Asked(**{name: value[chosen] for name, value in vars(self).items()})


class Layout:
    """Unknowns of a cycle, mm: a foothold a leg, the body at every pose but the last, and feet in the air.

    The body's first place is the origin. The last pose is the first one, moved on by the step and turned.

    Args:
        problem: one gait in mid-walk whose feet are in the air at the same poses as those of all others.
    """

    def __init__(self, problem: PoseProblem) -> None:
        self.model: RobotModel = problem.model
        self.airborne: Bools = problem.airborne
        self.moving: Bools = problem.moving
        self.shares = swing_shares(self.airborne)
        self.move_count = len(self.moving)
        self.legs = self.model.leg_count
        self.homes = self.model.module_centres_robot[:, :2] * MM
        first_body = 2 * self.legs
        # Of the first pose only the height is unknown.
        self.body_places = [first_body - 2] + [first_body + 1 + 3 * k for k in range(self.move_count - 1)]
        self.height_places = np.array([place + 2 for place in self.body_places])
        place = first_body + 1 + 3 * (self.move_count - 1)
        self.air_places: dict[tuple[int, int], int] = {}
        for pose, leg in np.argwhere(self.airborne):
            self.air_places[int(pose), int(leg)] = place
            place += 3
        self.unknowns = place
        landed = np.maximum.accumulate(self.airborne, axis=0)
        self.landed: Bools = landed & ~self.airborne
        self.body_map = self._body_map()

    def _body_map(self) -> Floats:
        """(poses, 3, unknowns)."""
        made = np.zeros((self.move_count + 1, 3, self.unknowns))
        for pose, place in enumerate(self.body_places):
            for axis in range(3) if pose else (2,):
                made[pose, axis, place + axis] = 1.0
        made[-1, 2] = made[0, 2]
        return made

    def foot_map(self, turn: Floats) -> Floats:
        """(gaits, poses, legs, 3, unknowns) how feet follow from the unknowns.

        Args:
            turn: (gaits,) rad a cycle.
        """
        made = np.zeros((len(turn), self.move_count + 1, self.legs, 3, self.unknowns))
        rotation = rotations(turn)
        for leg in range(self.legs):
            own = slice(2 * leg, 2 * leg + 2)
            for pose in range(self.move_count + 1):
                if self.airborne[pose, leg]:
                    place = self.air_places[pose, leg]
                    made[:, pose, leg, :, place : place + 3] = np.eye(3)
                elif self.landed[pose, leg]:
                    made[:, pose, leg, :2, own] = rotation[:, :2, :2]
                else:
                    made[:, pose, leg, :2, own] = np.eye(2)
        return made

    def start(self, asked: Asked) -> Floats:
        """(gaits, unknowns) where the search starts: an even travel, each foot in its own moves, mm."""
        made = np.zeros((asked.count, self.unknowns))
        done = np.vstack([np.zeros(self.legs), np.cumsum(self.moving, axis=0)])
        progress = done / done[-1]
        offset = progress.mean(axis=0) - 0.5
        shares = np.linspace(0.0, 1.0, self.move_count + 1)
        for pose, place in enumerate(self.body_places):
            if pose:
                made[:, place : place + 2] = self._along(asked, shares[pose])
            made[:, place + 2] = asked.height
        for leg in range(self.legs):
            made[:, 2 * leg : 2 * leg + 2] = self._foot(asked, leg, -float(offset[leg]))
        for (pose, leg), place in self.air_places.items():
            made[:, place : place + 2] = self._foot(asked, leg, float(progress[pose, leg] - offset[leg]))
            made[:, place + 2] = asked.clearance * self.shares[pose, leg]
        return made

    def _along(self, asked: Asked, share: float) -> Floats:
        angle = asked.heading + asked.turn * share / 2.0
        return np.asarray(asked.step[:, None] * share * np.stack([np.cos(angle), np.sin(angle)], axis=-1))

    def _foot(self, asked: Asked, leg: int, share: float) -> Floats:
        turned = rotations(asked.turn * share)[:, :2, :2] @ self.homes[leg]
        return np.asarray(turned + self._along(asked, share))

    def floors(self, asked: Asked) -> Floats:
        """(gaits, poses, legs) least height of each foot at each pose, mm."""
        return asked.clearance[:, None, None] * self.shares


def rotations(angles: Floats) -> Floats:
    """(…, 3, 3) turns about z by some angles, rad."""
    cosine, sine = np.cos(angles), np.sin(angles)
    made = np.zeros((*np.shape(angles), 3, 3))
    made[..., 0, 0], made[..., 0, 1] = cosine, -sine
    made[..., 1, 0], made[..., 1, 1] = sine, cosine
    made[..., 2, 2] = 1.0
    return made
