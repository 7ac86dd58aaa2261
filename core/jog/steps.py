"""Small steps by hand: one motor, one foot or the body moved along an axis, and the strokes that follow.

Axes are the robot's own: x forwards, y to the left, z up. A motor's stroke grows downwards.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.robot.leg import foot_from_strokes, strokes_from_foot
from core.robot.model import RobotModel
from core.wire.robot_time import START_MOVE

LONGEST_STEP = 0.02
"""Longest single step, the travel of a motor, m."""

MOST_STEPS = 100
"""Steps that a target may be made of."""

SCAN_STEP = 0.0005
"""Distance of the places that are tried first for the range of a step, m."""

HALVINGS = 20
"""After these the end of a range is known to less than a nanometre."""

INSIDE = 1e-9
"""Rounding by which a stroke may pass its limit, m."""


class JogPart(StrEnum):
    """What is moved."""

    MOTOR = "motor"
    FOOT = "foot"
    BODY = "body"
    """Every foot stays where it stands."""


class Axis(StrEnum):
    """Along which of the robot's axes."""

    X = "x"
    Y = "y"
    Z = "z"


@dataclass(frozen=True)
class JogStep:
    """One step by hand.

    Args:
        part: what is moved.
        by: how far, m; of a motor the change of its stroke.
        foot: of the foot or the motor, 0-based.
        motor: within the foot, 0-based.
        axis: of a foot or the body.
    """

    part: JogPart
    by: float
    foot: int | None = None
    motor: int | None = None
    axis: Axis | None = None

    def require_fit(self, model: RobotModel) -> None:
        """Refuses a step that says too little or too much, or of what the robot does not have.

        Raises:
            InputError: with the field and what would do.
        """
        has_foot = self.part is not JogPart.BODY
        _require_number("foot", self.foot, model.leg_count if has_foot else 0, self.part)
        _require_number("motor", self.motor, 3 if self.part is JogPart.MOTOR else 0, self.part)
        if (self.axis is None) != (self.part is JogPart.MOTOR):
            need = "has no axis; leave it out" if self.part is JogPart.MOTOR else "needs an axis: x, y or z"
            raise InputError(f"A step of a {self.part} {need}.", "axis")
        if not (math.isfinite(self.by) and abs(self.by) <= LONGEST_STEP):
            raise InputError(
                f"A step of {self.by * 1000:g} mm cannot be made; one has at most "
                f"{LONGEST_STEP * 1000:.0f} mm either way.",
                "by",
            )


def jog_strokes(model: RobotModel, strokes: Floats, steps: Sequence[JogStep]) -> Floats:
    """The strokes after some steps, one after the other, limits left aside.

    Motors that share an actuator move together where one of them is stepped; where a foot or the body is,
    the strokes are those that are wanted (see `core.robot.coupled_strokes.real_strokes`).

    Args:
        model: the robot.
        strokes: (legs, 3) before them, m.
        steps: that fit the robot.

    Returns:
        (legs, 3) m; nan where no rod is long enough.
    """
    for step in steps:
        strokes = _stepped(model, strokes, step, np.array([step.by]))[0]
    return strokes


def jog_way(
    model: RobotModel, strokes: Floats, steps: Sequence[JogStep], longest: float = START_MOVE
) -> tuple[Floats, ...]:
    """Cuts the steps into moves, so that no motor goes far in one and a stop is soon heard.

    All steps are made together, a share of each in every move, so that feet which stand keep their places
    all along the way.

    Args:
        model: the robot.
        strokes: (legs, 3) before them, m.
        steps: that fit the robot and lead to strokes that it can make.
        longest: largest move of a motor, m.

    Returns:
        (legs, 3) m after each move, the last one where the steps lead.
    """
    whole = float(np.abs(jog_strokes(model, strokes, steps) - strokes).max())
    count = max(math.ceil(whole / longest - INSIDE), 1)
    while True:
        shares = [(i + 1) / count for i in range(count)]
        way = [
            jog_strokes(model, strokes, [replace(step, by=step.by * share) for step in steps])
            for share in shares
        ]
        moves = np.abs(np.diff([strokes, *way], axis=0)).max(axis=(1, 2))
        if float(moves.max()) <= longest + INSIDE:
            return tuple(way)
        count += 1


def jog_range(model: RobotModel, strokes: Floats, step: JogStep) -> tuple[float, float]:
    """How far a step may go either way until a motor is at the end of its range, m.

    Args:
        model: the robot.
        strokes: (legs, 3) before it, within the limits, m.
        step: whose length is left aside.

    Returns:
        Least and greatest length, at most the longest step.
    """
    return -_reach(model, strokes, step, -1.0), _reach(model, strokes, step, 1.0)


def within_range(model: RobotModel, strokes: Floats) -> bool:
    """Whether a robot can make these strokes: all of them known, and none beyond its limits."""
    # nan compares false.
    inside = (strokes >= model.stroke.lower - INSIDE) & (strokes <= model.stroke.upper + INSIDE)
    return bool(inside.all())


def _reach(model: RobotModel, strokes: Floats, step: JogStep, sign: float) -> float:
    def fits(lengths: Floats) -> list[bool]:
        return [within_range(model, row) for row in _stepped(model, strokes, step, sign * lengths)]

    tried = np.arange(0.0, LONGEST_STEP + SCAN_STEP / 2, SCAN_STEP)
    good = fits(tried)
    if all(good):
        return LONGEST_STEP
    if not good[0]:
        return 0.0
    beyond = good.index(False)
    low, high = float(tried[beyond - 1]), float(tried[beyond])
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(np.array([middle]))[0] else (low, middle)
    return low


def _stepped(model: RobotModel, strokes: Floats, step: JogStep, lengths: Floats) -> Floats:
    """(n, legs, 3) strokes after a step of each of (n,) lengths, m."""
    after = np.repeat(strokes[None], len(lengths), axis=0)
    if step.part is JogPart.MOTOR:
        return after + lengths[:, None, None] * _moved_together(model, step)
    away = np.zeros((len(lengths), 3))
    away[:, list(Axis).index(step.axis or Axis.X)] = lengths
    # Where the body goes one way, its feet go the other in its own frame.
    feet, ways = (
        (slice(None), -away) if step.part is JogPart.BODY else (slice(_foot(step), _foot(step) + 1), away)
    )
    turned = np.einsum("lji,nj->nli", model.R_robot_from_module[feet], ways)
    places = foot_from_strokes(model.leg, strokes[feet]) + turned
    after[:, feet] = strokes_from_foot(model.leg, places)
    return after


def _moved_together(model: RobotModel, step: JogStep) -> Floats:
    """(legs, 3) 1 for each motor of the step's actuator, else 0."""
    actuator = model.coupling[3 * _foot(step) + (step.motor or 0)]
    return np.asarray((model.coupling @ actuator).reshape(model.leg_count, 3))


def _foot(step: JogStep) -> int:
    return step.foot or 0


def _require_number(name: str, value: int | None, count: int, part: JogPart) -> None:
    if count == 0 and value is not None:
        raise InputError(f"A step of the {part} names no {name}; leave it out.", name)
    if count and not (value is not None and 0 <= value < count):
        given = "none" if value is None else str(value + 1)
        raise InputError(f"A step of a {part} needs a {name} from 1 to {count}; it names {given}.", name)
