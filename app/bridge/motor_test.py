"""The motor test: one motor after the other makes a small move out and back, one ramp at a time.

The firmware goes on until every motor has arrived, so a motor that turns the wrong way would run to the end
of its travel. Therefore the robot is kept stopped all through the test. Each target is stored in the stopped
robot; a release lets it go, and the next stop is on the line before the ramp is over, so that it acts right
after that ramp.
"""

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from app.bridge.delivery import RESTART, STORE, Stage
from app.bridge.states import MotorTestProgress, MotorTestState
from core.arrays import Floats
from core.errors import RobotError
from core.jog.motor_test import (
    BACK_RAMPS,
    TEST_MOVE,
    MotorFinding,
    MotorMove,
    MotorVerdict,
    choose_move,
    judge_first_ramp,
    judge_move,
)
from core.robot.model import RobotModel
from core.wire.lines import CurrentPoint, EndOfTrajectories, Line, Telemetry
from core.wire.messages import (
    HIGHEST_MM,
    LOWEST_MM,
    MOTORS,
    encode_release,
    encode_stop,
    encode_waypoint,
    name_motor,
)
from core.wire.robot_time import ramp_time

STRAYED_MM = 1.2
"""A motor that is farther from its place although it was not moved is tested next, mm; sound ones keep within
the firmware's threshold."""

MOST_LINES = 20
"""A robot that was let go begins its work within so many lines."""

SETTLED_READINGS = 8
"""Number of readings after a stop; their mean is the position of each motor."""

SETTLED_MM = 0.3
"""Readings of a motor that stands differ by less, noise included, mm."""

MOST_READINGS = 80
"""Readings after which a motor that does not come to rest ends the test."""


@dataclass(frozen=True)
class Order:
    """The next message of the test.

    Args:
        message: to be sent.
        target_mm: (motors,) strokes that the robot may go to while it is delivered; None to stand still.
        stages: what must be seen.
    """

    message: bytes
    target_mm: tuple[float, ...] | None
    stages: tuple[Stage, ...]


class MotorTest:
    """The messages of a motor test and what it found, without threads, clocks or ports.

    Args:
        model: the robot.
        by: who tests.
    """

    def __init__(self, model: RobotModel, by: str) -> None:
        self._model = model
        self._by = by
        self._state = MotorTestState.RUNNING
        self._findings: list[MotorFinding] = []
        self._motor: int | None = 0
        self._cancelled = False
        self._home_mm: Floats = np.zeros(MOTORS)
        self._left = list(range(MOTORS))
        self._postponed: set[int] = set()
        self._script = self._run()
        self._begun = False

    @property
    def finished(self) -> bool:
        """Whether the robot was let go after the last motor."""
        return self._state is not MotorTestState.RUNNING

    @property
    def end_words(self) -> str:
        """The sentence at its end."""
        return "Motor test ended early." if self._cancelled else "Motor test done."

    @property
    def place(self) -> str:
        """Where it is, for a person."""
        return "at the end of the motor test" if self._motor is None else f"in the test of {self._named}"

    @property
    def _named(self) -> str:
        return name_motor(self._motor or 0)

    def end_early(self) -> None:
        """Ends the test after the motor that is being tested."""
        self._cancelled = True

    def end(self) -> None:
        """The robot was stopped or lost: the test is over where it is."""
        self._motor, self._state = None, MotorTestState.STOPPED
        self._script.close()

    def progress(self) -> MotorTestProgress:
        """The state of the test, for display."""
        return MotorTestProgress(self._by, self._state, self._motor, tuple(self._findings))

    def advance(self, line: Line | None) -> Order | None:
        """Takes the next line, or None after a message was delivered.

        Returns:
            The next message; None to wait for another line, or if the test is finished.

        Raises:
            RobotError: the robot does not do what a stopped or released robot does.
        """
        try:
            if self._begun:
                return self._script.send(line)
            self._begun = True
            return next(self._script)
        except StopIteration:
            self._motor = None
            self._state = MotorTestState.CANCELLED if self._cancelled else MotorTestState.DONE
            return None

    def _run(self) -> Generator[Order | None, Line | None]:
        here_mm = yield from self._halt(None)
        self._home_mm = np.array(here_mm)
        while self._left and not self._cancelled:
            self._motor = self._left.pop(0)
            here_mm = yield from self._test(self._motor, here_mm)
            self._let_stray(here_mm)
        self._motor = None
        hold = _within_range(here_mm)
        yield _store(hold)
        yield Order(encode_release(), hold, RESTART)

    def _test(self, motor: int, here_mm: Floats) -> Generator[Order | None, Line | None, Floats]:
        """Moves one motor, and returns where all of them stand then, mm."""
        move = choose_move(self._model, here_mm / 1000.0, motor, self._home_mm[motor] / 1000.0)
        if isinstance(move, MotorFinding):
            if motor in self._postponed:
                self._findings.append(move)
            else:
                # Its neighbours may stand better once they were tested.
                self._postponed.add(motor)
                self._left.append(motor)
            return here_mm
        out_mm = yield from self._go(motor, move.target, here_mm)
        finding = judge_first_ramp(move, out_mm / 1000.0)
        if finding is not None:
            self._findings.append(finding)
            if finding.verdict is MotorVerdict.NO_ANSWER:
                return (yield from self._unwind(move, out_mm))
            return out_mm
        back_mm = out_mm
        for _ in range(BACK_RAMPS):
            if not move.is_at(move.home, back_mm / 1000.0):
                back_mm = yield from self._go(motor, move.home, back_mm)
        self._findings.append(judge_move(move, out_mm / 1000.0, back_mm / 1000.0))
        return back_mm

    def _unwind(self, move: MotorMove, here_mm: Floats) -> Generator[Order | None, Line | None, Floats]:
        """Drives a motor that did not answer the other way for one ramp, where that is allowed.

        This brings back a rod whose potentiometer is dead, and clears the sum of the controller.
        """
        back = move.opposite(self._model)
        return here_mm if back is None else (yield from self._go(move.motor, back, here_mm))

    def _go(self, motor: int, place: float, here_mm: Floats) -> Generator[Order | None, Line | None, Floats]:
        """Lets one motor go to a stroke in m for one ramp, and returns where all stand then, mm.

        The others are to keep their places. The controller of a motor that turns the wrong way gets an error
        of the other sign, and controllers of exchanged motors get each other's.
        """
        self._let_stray(here_mm)
        target_mm = np.array(self._home_mm)
        for finding in self._findings:
            one, other = finding.motor, finding.other
            if finding.verdict is MotorVerdict.WRONG_WAY:
                target_mm[one] = 2 * here_mm[one] - self._home_mm[one]
            elif finding.verdict is MotorVerdict.NO_ANSWER:
                target_mm[one] = here_mm[one]
            elif other is not None:
                target_mm[one] = here_mm[one] + self._home_mm[other] - here_mm[other]
                target_mm[other] = here_mm[other] + self._home_mm[one] - here_mm[one]
        target_mm[motor] = place * 1000.0
        target = _within_range(target_mm)
        yield _store(target)
        yield Order(encode_release(), target, (Stage.ECHO,))
        for _ in range(MOST_LINES):
            line = yield None
            if isinstance(line, CurrentPoint | EndOfTrajectories):
                return (yield from self._halt(target))
        raise RobotError("The robot was let go but does not work on its target.")

    def _let_stray(self, here_mm: Floats) -> None:
        """Lets motors be where they went although nobody moved them, and has those tested next."""
        away = np.abs(here_mm - self._home_mm)
        strayed = [motor for motor in self._left if away[motor] > STRAYED_MM]
        self._home_mm[strayed] = here_mm[strayed]
        self._left.sort(key=lambda motor: motor not in strayed)

    def _halt(self, target: tuple[float, ...] | None) -> Generator[Order | None, Line | None, Floats]:
        """Stops the robot after the ramp that is on, and returns where its motors stand, mm."""
        yield Order(encode_stop(), target, (Stage.ECHO,))
        readings: list[tuple[float, ...]] = []
        for _ in range(MOST_READINGS):
            line = yield None
            while not isinstance(line, Telemetry):
                line = yield None
            readings = [*readings[-SETTLED_READINGS + 1 :], line.strokes_mm]
            if len(readings) == SETTLED_READINGS and float(np.ptp(readings, axis=0).max()) <= SETTLED_MM:
                return np.asarray(np.mean(readings, axis=0))
        spread = np.ptp(readings, axis=0)
        raise RobotError(
            f"The reading of {name_motor(int(spread.argmax()))} changes by {spread.max():.2f} mm although "
            f"the robot is stopped (limit {SETTLED_MM} mm). Look at its potentiometer and its cable."
        )


def _store(target: tuple[float, ...]) -> Order:
    """Gives a stopped robot its next target."""
    message = encode_waypoint([stroke / 1000.0 for stroke in target], ramp_time(TEST_MOVE))
    return Order(message, target, STORE)


def _within_range(strokes_mm: Floats) -> tuple[float, ...]:
    """Strokes that may be sent, mm: a motor beyond the range by less than the threshold is not moved."""
    return tuple(float(stroke) for stroke in np.round(np.clip(strokes_mm, LOWEST_MM, HIGHEST_MM), 4))
