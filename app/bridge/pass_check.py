"""Compares what the robot says in each pass of its loop with itself and with its telemetry.

A pass that works on a target reports the errors of all motors (E = measured − wanted) and whether all of them
are within the threshold. Then it either moves by one ramp or reports that it arrived, and ends with the
measured strokes. The errors of a pass are measured after the strokes of the pass before it, and before those
of its own.

A line of a pass that arrives may be spoilt on its way. Where one is unreadable and every other line is in
its place, the strokes at the end of the pass decide, which the delivery compares with the target.
"""

import math
from collections.abc import Iterable
from itertools import repeat

from app.bridge.messages import cited
from core.wire.lines import (
    HIGHEST_READING_MM,
    CurrentPoint,
    EndOfTrajectories,
    ErrorScan,
    ErrorsChecked,
    Execute,
    Line,
    NewData,
    OutOfTravel,
    PointReached,
    Telemetry,
    UnknownLine,
    is_miscounted,
    is_out_of_travel,
)
from core.wire.messages import MOTORS, THRESHOLD_MM, name_motor
from core.wire.robot_time import LONGEST_SCAN, OVERRUN, RAMP_SPEED, ramp_time

ROUNDING_MM = 0.0001
"""The robot compares before it rounds to the fourth decimal, mm."""

AGREE_MM = THRESHOLD_MM
"""Error and telemetry of a motor that is not driven between them agree within this, mm. They differ by noise,
and by coasting until the release (docs/firmware.md)."""

SPEED_MM = RAMP_SPEED * 1000.0
"""No motor is faster, mm/s."""

PASS_TIME = 0.05
"""From the strokes of one pass to the first error of the next, at most, s."""

_ARRIVAL: tuple[type[Line], ...] = (CurrentPoint, ErrorScan, ErrorsChecked, PointReached)
"""What a pass says before the end of all trajectories, in this order."""

REMEDY = "Look at the robot's cable and at the program on its board before you clear."


class PassCheck:
    """Follows the passes of one delivery.

    Args:
        target_mm: (motors,) strokes to which the message leads.
        measured_mm: (motors,) strokes in the robot's last telemetry line.
    """

    def __init__(self, target_mm: tuple[float, ...], measured_mm: tuple[float, ...]) -> None:
        self._target_mm = target_mm
        self._strokes_mm = measured_mm
        self._is_driven = False
        self._is_measured = True
        self._begin_pass()
        self._is_measured = True

    def _begin_pass(self) -> None:
        self._is_known, self._is_measured = self._is_measured, False
        self._works = False
        self._errors_mm: tuple[float, ...] | None = None
        self._said: list[Line] = []
        self._is_within: bool | None = None
        self._ended = False

    def see(self, line: Line, *, is_taken: bool) -> str | None:
        """Takes the next line.

        Args:
            line: from the robot.
            is_taken: whether the robot has echoed the message, so that it works on this target.

        Returns:
            The contradiction in a sentence, or None.
        """
        match line:
            case NewData():
                self._begin_pass()
            case Execute() if self._works:  # the line that begins this pass was lost
                self._begin_pass()
            case OutOfTravel():
                return _with_remedy(_stray_sentence(line.strokes_mm))
            case Telemetry():
                self._is_measured, self._said = True, []
                return _with_remedy(self._compare_strokes(line.strokes_mm))
        self._works |= isinstance(line, (Execute, *_ARRIVAL))
        return _with_remedy(self._read(line)) if is_taken else None

    def _read(self, line: Line) -> str | None:
        if isinstance(line, CurrentPoint):
            self._said = []
        if isinstance(line, (*_ARRIVAL, UnknownLine)):
            self._said.append(line)
        match line:
            case Execute() if line.count != 1:
                return f"The robot works on {line.count} waypoints, but one was sent."
            case CurrentPoint() if (line.index, line.count) != (0, 1):
                return (
                    f"The robot works on waypoint {line.index} of {line.count}, but the only one that was "
                    "sent is waypoint 0 of 1."
                )
            case ErrorScan():
                return self._compare_errors(line.errors_mm)
            case ErrorsChecked():
                self._is_within = line.reached
                return self._check_threshold(line.reached)
            case PointReached():
                return self._check_success("that it reached the waypoint")
            case EndOfTrajectories():
                self._ended = True
                return self._check_success("the end of all trajectories")
        return None

    def _check_success(self, what: str) -> str | None:
        """Looks for the lines that lead to a line of success."""
        if self._is_within is False:
            return f"The robot reports {what}, but in the same pass that a motor is not within the threshold."
        if not self._has_said(_ARRIVAL):
            unreadable = f" It said {cited(self._unreadable)} in this pass." if self._unreadable else ""
            return f"The robot reports {what}, but not the check of its errors that leads to it.{unreadable}"
        if self._is_within:
            return None
        self._is_within = True
        return None if self._errors_mm is None else self._check_threshold(reached=True)

    def _has_said(self, wanted: tuple[type[Line], ...]) -> bool:
        """Whether these lines came in this pass, one of them unreadable at most.

        An unreadable line stands for two where the end of the first was lost, but its CR was not.
        """
        said = [type(line) for line in self._said]
        if [kind for kind in said if kind in wanted[1:]] == list(wanted[1:]):
            return True
        if said.count(UnknownLine) != 1 or is_miscounted(self._unreadable):
            return False
        place, spoilt = said.index(UnknownLine), len(wanted) - len(said) + 1
        said[place : place + 1] = wanted[place : place + spoilt]
        return said == list(wanted) and spoilt <= sum(map(bool, self._unreadable.split("\r")))

    @property
    def _unreadable(self) -> str:
        """The first line of this pass that is of no kind."""
        return next((line.text for line in self._said if isinstance(line, UnknownLine)), "")

    def _compare_errors(self, errors_mm: tuple[float, ...]) -> str | None:
        odd = next((i for i, error in enumerate(errors_mm) if not math.isfinite(error)), None)
        if odd is not None:
            return (
                f"The robot reports no number for the error of {name_motor(odd)}; by its telemetry "
                f"the error is {self._error_mm(odd):+.2f} mm."
            )
        self._errors_mm = errors_mm
        driven = [
            PASS_TIME + LONGEST_SCAN * (i + 1) / MOTORS if self._is_driven else 0.0 for i in range(MOTORS)
        ]
        motor, limit = self._farthest(errors_mm, driven)
        if motor is None:
            return None
        return (
            f"The robot reports an error of {errors_mm[motor]:+.2f} mm for {name_motor(motor)}, but by its "
            f"telemetry just before it is {self._error_mm(motor):+.2f} mm (they agree within {limit:.2f} mm)."
        )

    def _check_threshold(self, reached: bool) -> str | None:
        errors_mm = self._errors_mm
        if errors_mm is None:
            is_told = not reached or self._has_said(_ARRIVAL[:3])
            return None if is_told else self._unread_errors()
        motor = max(range(MOTORS), key=lambda i: abs(errors_mm[i]))
        error = abs(errors_mm[motor])
        if reached and error > THRESHOLD_MM + ROUNDING_MM:
            return (
                "The robot reports that it arrived, and in the same pass an error of "
                f"{errors_mm[motor]:+.2f} mm for {name_motor(motor)} (limit {THRESHOLD_MM:.2f} mm); by its "
                f"telemetry just before it is {self._error_mm(motor):+.2f} mm."
            )
        if not reached and error < THRESHOLD_MM - ROUNDING_MM:
            return (
                f"The robot reports that a motor is not within {THRESHOLD_MM:.2f} mm of its target, but its "
                f"largest error is {errors_mm[motor]:+.2f} mm, that of {name_motor(motor)}."
            )
        return None

    def _unread_errors(self) -> str:
        said = f"but said {cited(self._unreadable)}" if self._unreadable else "but no line of errors came"
        return f"The robot reports that every motor is in place, {said} where its errors belong."

    def _compare_strokes(self, strokes_mm: tuple[float, ...]) -> str | None:
        """Compares the strokes at the end of a pass with its errors, or with the strokes before."""
        errors_mm, arrives = self._errors_mm, bool(self._is_within)
        unended = arrives and not self._ended
        before_mm = self._strokes_mm
        if errors_mm is not None:
            before_mm = tuple(t + e for t, e in zip(self._target_mm, errors_mm, strict=True))
        self._strokes_mm = strokes_mm
        if unended:
            return "The robot says that every motor is in place, but did not report that it arrived."
        if self._works and errors_mm is None:  # its errors were of another target, or were lost
            self._is_driven = True
            return None
        self._is_known |= errors_mm is not None
        driven = self._driven_time(errors_mm or ())
        self._is_driven = errors_mm is not None and not arrives
        errors = tuple(b - t for b, t in zip(before_mm, self._target_mm, strict=True))
        motor, limit = self._farthest(errors, repeat(driven, MOTORS))
        if motor is None:
            return None
        said = "last telemetry" if errors_mm is None else "error in the same pass"
        return (
            f"By the robot's telemetry {name_motor(motor)} stands at {strokes_mm[motor]:.2f} mm, but by its "
            f"{said} at {before_mm[motor]:.2f} mm (they agree within {limit:.2f} mm)."
        )

    def _driven_time(self, errors_mm: tuple[float, ...]) -> float:
        """How long motors may have been driven since the errors, or since the strokes before, s."""
        if not errors_mm:
            return PASS_TIME if self._is_driven else 0.0
        if self._is_within:
            return 0.0
        return LONGEST_SCAN + ramp_time(max(map(abs, errors_mm)) / 1000.0) + OVERRUN

    def _error_mm(self, motor: int) -> float:
        """A motor's error by its telemetry, mm."""
        return self._strokes_mm[motor] - self._target_mm[motor]

    def _farthest(self, errors_mm: tuple[float, ...], driven: Iterable[float]) -> tuple[int | None, float]:
        """The motor whose error differs most from its telemetry's, if by more than it may, and that limit.

        Args:
            errors_mm: of all motors.
            driven: how long each may have been driven between the two, s.
        """
        limits = [AGREE_MM + SPEED_MM * seconds for seconds in driven]
        beyond = [abs(error - self._error_mm(i)) - limits[i] for i, error in enumerate(errors_mm)]
        motor = max(range(MOTORS), key=beyond.__getitem__)
        return (motor if beyond[motor] > 0.0 and self._is_known else None), limits[motor]


def _stray_sentence(strokes_mm: tuple[float, ...]) -> str:
    motor = next(i for i, stroke in enumerate(strokes_mm) if is_out_of_travel(stroke))
    return (
        f"By the robot's telemetry {name_motor(motor)} stands at {strokes_mm[motor]:.2f} mm, but motors "
        f"go from 0 to {HIGHEST_READING_MM} mm."
    )


def _with_remedy(sentence: str | None) -> str | None:
    return None if sentence is None else f"{sentence} {REMEDY}"
