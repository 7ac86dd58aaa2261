"""The motor test's small moves, and the verdict on each motor by the measured strokes."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core.arrays import Floats
from core.jog.check import JogCheck, check_jog
from core.jog.steps import JogPart, JogStep
from core.robot.model import RobotModel
from core.wire.messages import name_motor
from core.wire.robot_time import ARRIVAL_THRESHOLD

TEST_MOVE = 0.004
"""Move of the tested motor, m: four times the firmware's threshold."""

BACK_RAMPS = 4
"""Ramps that a motor gets for the way back; for the way out it gets one."""

MOVED = 0.0003
"""A stroke that changed by less has not moved, m."""

MOVED_INSTEAD = 0.0012
"""Another motor that moved by this much where the tested one did not moved in its place, m. In a ramp the
emulated motors stray by 1.0 mm at most."""

TRAVEL = 0.020
"""Travel of a motor between its end stops, m (docs/firmware.md)."""

SHORT = 0.0026
"""A motor that is farther from its target after the ramp out stays short of it, m. Emulated motors are 0.9 to
2.5 mm from it and motors with 35 % of the speed 2.7 to 3.4 mm, in all timings of the board and whatever the
controllers gathered before (docs/firmware.md, hazard 11)."""

TOO_FAR = 0.0015
"""A motor that is farther beyond its target goes too far, m."""


class MotorVerdict(StrEnum):
    """What the test found of a motor."""

    GOOD = "good"
    NO_ANSWER = "no answer"
    WRONG_WAY = "wrong way"
    SHORT = "stays short"
    TOO_FAR = "goes too far"
    OTHER_MOTOR = "another motor moved"
    NOT_TESTED = "not tested"


@dataclass(frozen=True)
class MotorFinding:
    """The verdict on one motor.

    Args:
        motor: 0-based.
        verdict: good, or what is wrong.
        sentence: what was seen.
        remedy: what to do; empty for a good motor.
        moved: how far it went towards its target, m; None where it was not tested.
        off: how far it stayed from the target, m; only of a motor that stays short or goes too far.
        other: 0-based motor that moved in its place.
    """

    motor: int
    verdict: MotorVerdict
    sentence: str
    remedy: str = ""
    moved: float | None = None
    off: float | None = None
    other: int | None = None


@dataclass(frozen=True, eq=False)
class MotorMove:
    """The move of a motor out of its place and back.

    Args:
        motor: 0-based.
        by: signed change of its stroke, m.
        start: (motors,) measured strokes before it, m.
        home: stroke to which the motor goes back, m.
    """

    motor: int
    by: float
    start: Floats
    home: float

    @property
    def target(self) -> float:
        """Stroke at the end of the way out, m."""
        return float(self.start[self.motor]) + self.by

    def opposite(self, model: RobotModel) -> float | None:
        """Stroke as far the other way, m; None where the check of a jog refuses it."""
        check = _checked(model, self.start, self.motor, -self.by)
        return None if check.errors else float(self.start[self.motor]) - self.by

    def made(self, strokes: Floats) -> float:
        """How far the motor has gone towards its target, m; below 0 where it went the wrong way."""
        return float(np.sign(self.by) * (strokes - self.start)[self.motor])

    def is_at(self, place: float, strokes: Floats) -> bool:
        """Whether the motor is within the firmware's threshold of a stroke, m."""
        return bool(abs(strokes[self.motor] - place) <= ARRIVAL_THRESHOLD)


def choose_move(model: RobotModel, strokes: Floats, motor: int, home: float) -> MotorMove | MotorFinding:
    """The way on which a motor can be tested: in range and in balance by the check of a jog.

    Of two ways the one with fewer warnings is taken, then the one towards the middle of the range.

    Args:
        model: the robot.
        strokes: (motors,) measured, m.
        motor: 0-based.
        home: stroke to which the motor is to go back, m.

    Returns:
        The move, or that the motor cannot be tested where the robot stands.
    """
    limits = model.stroke
    inwards = TEST_MOVE if strokes[motor] < (limits.lower + limits.upper) / 2 else -TEST_MOVE
    checks = [(by, _checked(model, strokes, motor, by)) for by in (inwards, -inwards)]
    allowed = [
        (len(check.findings), order, by) for order, (by, check) in enumerate(checks) if not check.errors
    ]
    if allowed:
        return MotorMove(motor, min(allowed)[2], strokes, home)
    reason = checks[0][1].errors[0].sentence
    return MotorFinding(
        motor,
        MotorVerdict.NOT_TESTED,
        f"No move of {TEST_MOVE * 1000:.0f} mm is allowed here: {reason}",
        "Let the robot stand on all feet, with Reset or Jog, and test again.",
    )


def _checked(model: RobotModel, strokes: Floats, motor: int, by: float) -> JogCheck:
    return check_jog(model, strokes.reshape(-1, 3), [JogStep(JogPart.MOTOR, by, motor // 3, motor % 3)])


def judge_first_ramp(move: MotorMove, strokes: Floats) -> MotorFinding | None:
    """The verdict that the first ramp allows: None where the motor goes the right way.

    Args:
        move: what was asked.
        strokes: (motors,) measured after one ramp, m.
    """
    made = move.made(strokes)
    changes = np.abs(strokes - move.start)
    changes[move.motor] = 0.0
    other = int(changes.argmax())
    if changes[other] >= MOVED_INSTEAD > made:
        return MotorFinding(
            move.motor,
            MotorVerdict.OTHER_MOTOR,
            f"In its place {name_motor(other)} moved by {_mm(changes[other])} mm.",
            f"The cables of motors {move.motor + 1} and {other + 1}, or of their potentiometers, may be "
            "exchanged. Swap them back.",
            moved=made,
            other=other,
        )
    if made <= -MOVED:
        return MotorFinding(
            move.motor,
            MotorVerdict.WRONG_WAY,
            f"It moved {_mm(-made)} mm away from its target.",
            "Exchange the two wires of the motor, or the outer wires of its potentiometer.",
            moved=made,
        )
    if made < MOVED:
        stands = move.start[move.motor]
        at_end = min(stands, TRAVEL - stands) < 2 * MOVED
        return MotorFinding(
            move.motor,
            MotorVerdict.NO_ANSWER,
            f"Its stroke changed by {_mm(abs(made))} of {_mm(abs(move.by))} mm.",
            "Did its rod move? Then the potentiometer or its cable is broken. If not: a jam, a loose motor "
            "cable or a dead driver."
            + (" Or it turned the wrong way, against the end of its travel." if at_end else ""),
            moved=made,
        )
    return None


def judge_move(move: MotorMove, out: Floats, back: Floats) -> MotorFinding:
    """The verdict on a motor that went the right way out and was to come back.

    Args:
        move: what was asked.
        out: (motors,) measured after the ramp out, m.
        back: (motors,) measured after the way back, m.
    """
    asked, made, returned = abs(move.by), move.made(out), move.made(out) - move.made(back)
    if asked - made > SHORT:
        return MotorFinding(
            move.motor,
            MotorVerdict.SHORT,
            f"It went {_mm(made)} of {_mm(asked)} mm in one ramp and stayed {_mm(asked - made)} mm short; a "
            f"sound motor is at most {_mm(SHORT)} mm short.",
            _STIFF,
            moved=made,
            off=asked - made,
        )
    if made - asked > TOO_FAR:
        return MotorFinding(
            move.motor,
            MotorVerdict.TOO_FAR,
            f"It went {_mm(made)} mm where {_mm(asked)} mm were asked for.",
            "Look at the potentiometer and its cable: its readings may jump.",
            moved=made,
            off=made - asked,
        )
    if returned < MOVED and made > ARRIVAL_THRESHOLD + MOVED:
        return MotorFinding(
            move.motor,
            MotorVerdict.SHORT,
            f"It went {_mm(made)} mm out but did not come back.",
            _STIFF,
            moved=made,
            off=move.made(back),
        )
    sentence = f"{_mm(made)} mm out, {_mm(returned)} mm back."
    return MotorFinding(move.motor, MotorVerdict.GOOD, sentence, moved=made)


_STIFF = "Look for friction, a loose coupling, a weak motor or a low supply voltage."


def _mm(metres: float) -> str:
    return f"{metres * 1000:.1f}"
