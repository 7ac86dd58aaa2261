"""What makes a gait one for the robot's clock: limits of its own, and the poses that a solver has found."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from core.arrays import FARTHEST, Floats, frozen_floats
from core.errors import InputError
from core.robot.arms import ARM_GAP

MOST_SWAY = math.radians(40.0)
"""Farthest that the heading may be allowed to leave an even turn, rad."""
POSE_LIMITS = {
    "slip": (0.00005, 0.005),
    "shoe_distance": (0.0, 0.06),
    "arm_distance": (0.0, 0.01),
}
"""Least and most of the limits that only such a gait has, m."""
MOST_POSES = 2000
MOST_PINNED = 0.03
"""Farthest that a pinned pose may be from where an even travel has the body, along either axis, m."""
_HASH = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True, eq=False)
class FoundPoses:
    """Poses as a solver has found them; the strokes follow by inverse kinematics.

    Args:
        answers: SHA-256 of what was asked (`core.pose_gaits.gait_poses.asked_of`).
        step: travel of the body a cycle, m; 0 for a turn on the spot.
        bodies: (poses, 3) point of the body axis in the actuator plane, m; z above standing feet's platforms.
        feet: (poses, legs, 3) platform centres, m.
        headings: (poses,) turn of the body, rad; None where it is 0 throughout.
    """

    answers: str
    step: float
    bodies: Floats
    feet: Floats
    headings: Floats | None = None

    def __post_init__(self) -> None:
        if not _HASH.fullmatch(self.answers):
            raise InputError(
                "poses.found.answers is no SHA-256: 64 digits 0 to 9, a to f. Solve the gait again.",
                "poses.found.answers",
            )
        if not (math.isfinite(self.step) and 0.0 <= self.step <= 0.2):
            raise InputError(
                f"poses.found.step is {self.step:g} m; it must lie between 0 and 0.2 m.",
                "poses.found.step",
            )
        bodies = frozen_floats(self.bodies, (None, 3), "poses.found.bodies", FARTHEST)
        if not 2 <= len(bodies) <= MOST_POSES:
            raise InputError(
                f"poses.found has {len(bodies)} poses; it needs 2 to {MOST_POSES}.", "poses.found.bodies"
            )
        object.__setattr__(self, "bodies", bodies)
        feet = frozen_floats(self.feet, (len(bodies), None, 3), "poses.found.feet", FARTHEST)
        object.__setattr__(self, "feet", feet)
        if self.headings is not None:
            headings = frozen_floats(self.headings, (len(bodies),), "poses.found.headings", FARTHEST)
            object.__setattr__(self, "headings", headings)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, FoundPoses):
            return NotImplemented
        return (self.answers, self.step) == (other.answers, other.step) and all(
            a.shape == b.shape and bool((a == b).all())
            for a, b in (
                (self.bodies, other.bodies),
                (self.feet, other.feet),
                (self.turns, other.turns),
            )
        )

    __hash__ = None  # type: ignore[assignment]

    @property
    def turns(self) -> Floats:
        """(poses,) turn of the body, rad."""
        return np.zeros(len(self.bodies)) if self.headings is None else self.headings


@dataclass(frozen=True)
class PinnedPose:
    """A pose whose body position a person has fixed.

    The position is an offset from where the body would be if it moved evenly, the same way at every pose, so
    that it stays meaningful when the step changes.

    Args:
        pose: counted from 1.
        along: the direction of travel, m.
        sideways: to the left of it, m.
    """

    pose: int
    along: float
    sideways: float

    def __post_init__(self) -> None:
        for name in ("along", "sideways"):
            value = getattr(self, name)
            if not abs(value) <= MOST_PINNED:
                raise InputError(
                    f"poses.pinned puts the body of pose {self.pose} {value * 1000:g} mm {name}; it must lie "
                    f"between {-MOST_PINNED * 1000:g} and {MOST_PINNED * 1000:g} mm.",
                    "poses.pinned",
                )


@dataclass(frozen=True)
class Poses:
    """What a gait for the robot's clock asks beside the document's own fields, and what was found.

    Margin, clearance and stop bound stand in the document's options, foot order, direction, step and number
    of cycles in the document itself.

    Args:
        free_step: the step, or on the spot the turn, is that of the fastest gait; the document's own
            follows from the poses.
        sway: how far the heading may leave an even turn, rad.
        overlap: whether a foot is lifted in the move that lowers the one before it, where the others balance.
        slip: how far a standing foot may be off its foothold within a move, in x and y; half of it in z, m.
        shoe_distance: least distance between the middles of two feet, m.
        arm_distance: least room between the arms of neighbouring legs, m; 0 where they may touch.
        found: the poses; None where none were found yet.
        pinned: where the body is to be at some of them, by their numbers.
    """

    free_step: bool = True
    slip: float = 0.0005
    shoe_distance: float = 0.028
    arm_distance: float = ARM_GAP
    sway: float = 0.0
    overlap: bool = False
    found: FoundPoses | None = None
    pinned: tuple[PinnedPose, ...] = ()

    def __post_init__(self) -> None:
        numbers = [pin.pose for pin in self.pinned]
        if len(set(numbers)) < len(numbers):
            raise InputError("poses.pinned names a pose twice. Name each pose once.", "poses.pinned")
        object.__setattr__(self, "pinned", tuple(sorted(self.pinned, key=lambda pin: pin.pose)))
        if not 0.0 <= self.sway <= MOST_SWAY:
            raise InputError(
                f"poses.sway is {math.degrees(self.sway):g}°; it must lie between 0 and "
                f"{math.degrees(MOST_SWAY):g}°.",
                "poses.sway",
            )
        for name, (least, most) in POSE_LIMITS.items():
            value = getattr(self, name)
            if not least <= value <= most:
                raise InputError(
                    f"poses.{name} is {value * 1000:g} mm; it must lie between {least * 1000:g} and "
                    f"{most * 1000:g} mm.",
                    f"poses.{name}",
                )
