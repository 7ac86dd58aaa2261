"""One message on its way: delivered when its echo agrees, not by counting lines (docs/firmware.md)."""

from enum import Enum, auto

from app.bridge.messages import cited, misread_sentence
from app.bridge.pass_check import PassCheck
from app.bridge.stop_confirmation import STOP_PAYLOAD
from core.wire.lines import (
    CurrentPoint,
    Echo,
    EndOfTrajectories,
    ErrorScan,
    ErrorsChecked,
    Execute,
    Line,
    NewData,
    PointCount,
    Telemetry,
    TrajectoryPoint,
    numbers_equal,
)
from core.wire.messages import QUANTUM_MM, THRESHOLD_MM, name_motor, payload_of
from core.wire.robot_time import ramp_time

COAST_MM = 0.1
"""A motor within the threshold coasts on at 3 mm/s for at most two readings before it is released."""

ARRIVAL_MM = THRESHOLD_MM + QUANTUM_MM + COAST_MM
"""Distance of a measured stroke from its target within which a waypoint counts as reached, mm."""

ECHO_DEADLINE = 1.9
"""An idle robot takes a message within one pass of its loop, 32 ms with slow input and output; a fault has to
be named within 2 s, s."""

RAMP_FACTOR, PATIENCE = 2.0, 5.0
"""Slack for scans and further small ramps: the slowest of 2400 random moves of the emulator, all profiles,
needed 1.8 s more than twice its ramp."""

START_PATIENCE = 15.0
"""On the way to the start pose; a controller that is wound up by the board's own first move from 20 mm
needs up to 11 s for its first small step (firmware.md, hazard 11)."""


IDLE_PASSES = 3
"""A robot at work says so in every pass of its loop; after so many without a word of it the move is over."""

REST_PASSES = 10
"""After so many passes without work nothing more is to come of a move, even where lines are missing."""

_WORK = (Execute, CurrentPoint, ErrorScan, ErrorsChecked)

HELD_STOP = "it still holds an old stop"
"""Part of the sentence where a stop from before this connection keeps the robot from moving."""


class Stage(Enum):
    """The event that a delivery waits for next."""

    ECHO = auto()
    POINT = auto()
    END = auto()
    MEASURE = auto()


MOVE = (Stage.ECHO, Stage.POINT, Stage.END, Stage.MEASURE)
"""A waypoint that is to be reached."""

STORE = (Stage.ECHO, Stage.POINT)
"""A waypoint given to a stopped robot, which keeps it for later."""

RESTART = (Stage.ECHO, Stage.END, Stage.MEASURE)
"""A reset, or the end of a stop."""


def arrival_deadline(distance_mm: float, patience: float = PATIENCE) -> float:
    """Time in s within which a move of `distance_mm` must have arrived."""
    return RAMP_FACTOR * ramp_time(distance_mm / 1000.0) + patience


class Delivery:
    """Follows a message through its stages.

    Args:
        message: what was sent.
        target_mm: strokes that it leads to.
        measured_mm: strokes in the robot's last telemetry line.
        stages: what must be seen, in order.
        sent_at: time of sending, s.
        deadline: time within which everything must have been seen, s (see `arrival_deadline`).
        early_end: an end line before the echo counts too (a robot that was not stopped after all).

    Attributes:
        failure: why the message must be given up, or None.
    """

    def __init__(
        self,
        message: bytes,
        target_mm: tuple[float, ...],
        measured_mm: tuple[float, ...],
        stages: tuple[Stage, ...],
        sent_at: float,
        deadline: float,
        *,
        early_end: bool = False,
    ) -> None:
        self.payload = payload_of(message)
        self.target_mm = target_mm
        self.failure: str | None = None
        self._left = list(stages)
        self._sent_at = sent_at
        self._deadline = sent_at + deadline
        self._early_end = early_end
        self._executing = False
        self._idle = 0
        self._misses_lines = False
        self._pass_check = PassCheck(target_mm, measured_mm)
        self._point_read = False

    @property
    def arrived(self) -> bool:
        """Whether everything was seen."""
        return not self._left and self.failure is None

    def miss_lines(self) -> None:
        """Lines from the robot may be missing; a robot at rest is believed by its strokes."""
        self._misses_lines = True

    def see(self, line: Line) -> None:
        """Takes the next line from the robot."""
        if not self._left or self.failure is not None:
            return
        self._follow(line)
        if not self._misses_lines:
            is_taken = self._left[0] is not Stage.ECHO
            self.failure = self._pass_check.see(line, is_taken=is_taken)
            if self.failure is None and is_taken and isinstance(line, Echo):
                self.failure = f"The robot took {cited(line.payload)}, which was not sent."
            if self.failure is not None:
                return
        if self._misses_lines and self._idle >= REST_PASSES:
            self._judge_at_rest(line)
            return
        match self._left[0]:
            case Stage.ECHO:
                self._await_echo(line)
            case Stage.POINT:
                self._await_point(line)
            case Stage.END:
                self._await_end(line)
            case Stage.MEASURE:
                self._await_measurement(line)

    def _follow(self, line: Line) -> None:
        if isinstance(line, _WORK):
            self._executing, self._idle = True, 0
        elif isinstance(line, Telemetry):
            self._idle += 1

    def check(self, now: float, measured_mm: tuple[float, ...]) -> None:
        """Fails the delivery if its time is over."""
        if not self._left or self.failure is not None:
            return
        awaits_echo = self._left[0] is Stage.ECHO and not self._misses_lines
        if awaits_echo and now > self._sent_at + ECHO_DEADLINE:
            self.failure = f"The robot did not take a message within {ECHO_DEADLINE} s."
        elif now > self._deadline:
            seconds = self._deadline - self._sent_at
            if self._is_reached(measured_mm):
                self.failure = (
                    f"All motors are in place, but the robot did not report that within {seconds:.1f} s."
                )
            else:
                self.failure = f"Not reached within {seconds:.1f} s: {self.describe_distance(measured_mm)}."

    def describe_distance(self, measured_mm: tuple[float, ...]) -> str:
        """Names the motor that is farthest from its target, and how far."""
        distances = [abs(t - m) for t, m in zip(self.target_mm, measured_mm, strict=True)]
        worst = distances.index(max(distances))
        return (
            f"{name_motor(worst)} stands at {measured_mm[worst]:.2f} mm, {distances[worst]:.2f} mm from its "
            f"{self.target_mm[worst]:.2f} mm (limit {ARRIVAL_MM:.2f} mm)"
        )

    def _await_echo(self, line: Line) -> None:
        if isinstance(line, EndOfTrajectories) and self._early_end:
            self._left = [stage for stage in self._left if stage is not Stage.END]
        if not isinstance(line, Echo) or (line.payload == STOP_PAYLOAD != self.payload):
            return
        if line.payload == self.payload:
            self._left.pop(0)
        else:
            self.failure = misread_sentence(self.payload, line.payload)

    def _await_point(self, line: Line) -> None:
        match line:
            case TrajectoryPoint():
                self._point_read = line.index == 0 and numbers_equal(self.target_mm, line.strokes_mm)
                if not self._point_read:
                    self.failure = "The robot read other strokes than were sent."
            case PointCount() if line.count != 1:
                self.failure = f"The robot read {line.count} waypoints, but one was sent."
            case PointCount() if self._point_read:
                self._left.pop(0)
            case NewData() | PointCount() | EndOfTrajectories() | Execute() if not self._misses_lines:
                missing = "how many waypoints it read" if self._point_read else "the strokes that it was sent"
                self.failure = f"The robot did not confirm {missing}."

    def _await_end(self, line: Line) -> None:
        if isinstance(line, EndOfTrajectories):
            self._left.pop(0)
        elif self._misses_lines:
            return
        elif isinstance(line, NewData) and not self._executing:
            self.failure = f"The robot took the message but does not move: {HELD_STOP}."
        elif self._executing and self._idle >= IDLE_PASSES:
            self.failure = "The robot stopped working on the move but did not report that it arrived."

    def _await_measurement(self, line: Line) -> None:
        if not isinstance(line, Telemetry):
            return
        if self._is_reached(line.strokes_mm):
            self._left.pop(0)
        else:
            says = "is at rest" if self._misses_lines else "says that it arrived"
            self.failure = f"The robot {says}, but {self.describe_distance(line.strokes_mm)}."

    def _judge_at_rest(self, line: Line) -> None:
        if Stage.MEASURE in self._left:
            self._left = [Stage.MEASURE]
            self._await_measurement(line)
        else:
            self.failure = "The robot’s answer to a message was lost."

    def _is_reached(self, measured_mm: tuple[float, ...]) -> bool:
        return all(abs(t - m) <= ARRIVAL_MM for t, m in zip(self.target_mm, measured_mm, strict=True))
