"""The sequence of messages of one run: the slow way to the start pose, then the approved waypoints."""

import math
from dataclasses import dataclass

import numpy as np

from app.bridge.delivery import ARRIVAL_MM
from app.bridge.messages import displaced_sentence
from app.bridge.states import RunPhase, RunPlan, RunProgress
from app.bridge.write_gate import Clock
from core.errors import StateError
from core.wire.messages import HIGHEST_MM, LOWEST_MM, THRESHOLD_MM, encode_waypoint, strokes_to_mm
from core.wire.robot_time import START_MOVE, longest_start_move, ramp_time

FORGOTTEN = 300.0
"""A run that was left alone for longer is stopped where it is, s: nobody expects it to move any more."""


@dataclass(frozen=True)
class Move:
    """One message of a run: where it leads in mm, its phase, and whether a pause may end there."""

    message: bytes
    target_mm: tuple[float, ...]
    phase: RunPhase
    hold_ok: bool


def start_targets(
    measured_mm: tuple[float, ...], first_mm: tuple[float, ...], longest_mm: float = START_MOVE * 1000.0
) -> list[tuple[float, ...]]:
    """Cuts the way from where the motors stand to the first waypoint.

    Args:
        measured_mm: (12,) measured strokes.
        first_mm: (12,) strokes of the first waypoint.
        longest_mm: largest move of a motor in one message.

    Returns:
        Targets at most so far apart and more than the firmware's 1 mm, the last one the first waypoint;
        none when every motor is within 1 mm of it already.
    """
    here, there = np.array(measured_mm), np.array(first_mm)
    distance = float(np.abs(there - here).max())
    if distance <= THRESHOLD_MM:
        return []
    count = math.ceil(distance / longest_mm)
    between = [here + (there - here) * (i / count) for i in range(1, count)]
    limited = [np.clip(row, LOWEST_MM, HIGHEST_MM) for row in between]
    return [*(strokes_to_mm(row / 1000.0) for row in limited), first_mm]


def plan_moves(plan: RunPlan, measured_mm: tuple[float, ...]) -> list[Move]:
    """Encodes every message of a run before the first is sent.

    Raises:
        StateError: the approval is of other waypoints than these.
        InputError: a stroke cannot be sent.
    """
    if plan.approval.waypoints_hash != plan.waypoints.content_hash:
        raise StateError(
            "These waypoints are not the ones that were approved. Check and approve them, then send again.",
            "approval",
        )
    waypoints = plan.waypoints
    encoded = [
        Move(encode_waypoint(strokes, duration), strokes_to_mm(strokes), RunPhase.STREAMING, hold)
        for strokes, duration, hold in zip(
            waypoints.strokes, waypoints.durations.tolist(), plan.hold_ok, strict=True
        )
    ]
    streamed = [encoded[i] for i in plan.run_range.order(waypoints.count)]
    return [*_start_moves(measured_mm, streamed[0], longest_start_move(waypoints) * 1000.0), *streamed]


def _start_moves(measured_mm: tuple[float, ...], first: Move, longest_mm: float) -> list[Move]:
    here, moves = measured_mm, []
    for target in start_targets(measured_mm, first.target_mm, longest_mm):
        farthest = max(abs(t - h) for t, h in zip(target, here, strict=True))
        message = encode_waypoint(np.array(target) / 1000.0, ramp_time(farthest / 1000.0))
        hold = first.hold_ok and target == first.target_mm
        moves.append(Move(message, target, RunPhase.START_POSE, hold))
        here = target
    return moves


class Run:
    """The messages of a run and its progress.

    Args:
        plan: approved waypoints.
        measured_mm: where the motors stand.
        run_id: name of the run.
        by: who sends it.
        clock: by which it is timed, s.

    Raises:
        StateError, InputError: see `plan_moves`.
    """

    def __init__(
        self, plan: RunPlan, measured_mm: tuple[float, ...], run_id: str, by: str, clock: Clock
    ) -> None:
        self._moves = plan_moves(plan, measured_mm)
        self._order = plan.run_range.order(plan.waypoints.count)
        self._run_range = plan.run_range
        self._start_count = len(self._moves) - len(self._order)
        self._plan_count = plan.waypoints.count
        self._sent = 0
        self._reached = 0
        self._clock = clock
        self._began = clock()
        self._ended: float | None = None
        self.run_id = run_id
        self.by = by

    @property
    def finished(self) -> bool:
        """Whether the last waypoint was reached."""
        return self._reached == len(self._moves)

    @property
    def may_hold(self) -> bool:
        """Whether a pause may end at the pose that was reached last."""
        return self._reached > 0 and self._moves[self._reached - 1].hold_ok

    def may_pause_after(self, seconds: float) -> bool:
        """Whether a run that the program left alone for so long, s, goes on to a pose for a pause."""
        return seconds <= FORGOTTEN and any(move.hold_ok for move in self._moves[self._reached :])

    @property
    def place(self) -> str:
        """Where the run is, for a person."""
        if self._sent <= self._start_count:
            return "on the way to the start pose"
        sent = self._sent - self._start_count
        run_range = self._run_range
        again = (
            f", iteration {self._iteration(sent)} of {run_range.iterations}"
            if run_range.iterations > 1
            else ""
        )
        return f"at waypoint {self._waypoint(sent) + 1} of {self._plan_count}{again}"

    def require_in_place(self, measured_mm: tuple[float, ...]) -> None:
        """Refuses if a motor was moved since the last target was reached.

        Raises:
            StateError: with the distance, the limit and what to do.
        """
        target_mm = self._moves[max(self._reached - 1, 0)].target_mm
        farthest = max(abs(t - m) for t, m in zip(target_mm, measured_mm, strict=True))
        if farthest > ARRIVAL_MM:
            raise StateError(displaced_sentence(farthest, ARRIVAL_MM))

    def next_move(self) -> Move:
        """Returns the next message's move and counts it as sent."""
        move = self._moves[self._sent]
        self._sent += 1
        return move

    def arrive(self) -> None:
        """Counts the move in flight as reached."""
        self._reached += 1

    def end(self) -> None:
        """Stops the run's clock; only the first end counts."""
        self._ended = self._clock() if self._ended is None else self._ended

    @property
    def elapsed(self) -> float:
        """Time since the run began, until its end, s."""
        return (self._clock() if self._ended is None else self._ended) - self._began

    def progress(self) -> RunProgress:
        """What to show of the run."""
        streaming = self._sent > self._start_count
        sent = max(self._sent - self._start_count, 0)
        reached = max(self._reached - self._start_count, 0)
        return RunProgress(
            run_id=self.run_id,
            by=self.by,
            phase=RunPhase.STREAMING if streaming else RunPhase.START_POSE,
            sent=sent,
            reached=reached,
            count=len(self._order),
            elapsed=self.elapsed,
            waypoint_sent=self._waypoint(sent),
            waypoint_reached=self._waypoint(reached),
            iteration=self._iteration(sent),
            iterations=self._run_range.iterations,
        )

    def _waypoint(self, done: int) -> int:
        """The last of the first `done` waypoints that the run sends."""
        return self._order[max(done - 1, 0)]

    def _iteration(self, done: int) -> int:
        return 1 + (max(done - 1, 0) + self._run_range.first) // self._plan_count
