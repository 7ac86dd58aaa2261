"""What a robot was told and what it measured during a run, read from the bytes that went both ways.

Nothing here believes a log: commands are the messages that went out, arrivals are what the robot said.
"""

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.wire.lines import EndOfTrajectories, Line, LineReader, Telemetry, TrajectoryPoint, numbers_equal
from core.wire.messages import MOTORS, encode_stop
from core.wire.waypoints import Waypoints

SAME_MM = 1e-6
"""Strokes that differ by less were one number on the wire, mm."""

_MESSAGE = re.compile(rb"<p,1,\d+\.\d+((?:,\d+\.\d+){12})>")

START = -1
"""Index of a command that leads to the start pose and to no waypoint."""


@dataclass(frozen=True)
class RunBytes:
    """Bytes as they passed.

    Args:
        time: s on the run's clock.
        to_robot: which way they went.
        data: the bytes.
    """

    time: float
    to_robot: bool
    data: bytes


@dataclass(frozen=True)
class SentWaypoint:
    """A waypoint that was sent.

    Args:
        sent: when its message went out, s on the run's clock.
        target_mm: (12,) strokes that it asks for.
        index: of the waypoint, 0-based; `START` on the way to the start pose.
        lap: how often the waypoints were gone through before, 0-based.
        arrived: when the robot first told its strokes after it had confirmed these and the end of the move,
            s; nan where it never did.
        measured_mm: (12,) those strokes; empty where it never did.
    """

    sent: float
    target_mm: tuple[float, ...]
    index: int = START
    lap: int = 0
    arrived: float = math.nan
    measured_mm: tuple[float, ...] = ()

    @property
    def leads_on(self) -> bool:
        """Whether it leads to a waypoint."""
        return self.index != START

    @property
    def is_reached(self) -> bool:
        """Whether it led to a waypoint and the robot arrived there."""
        return self.leads_on and bool(self.measured_mm)


@dataclass(frozen=True, eq=False)
class RunSeries:
    """A run in numbers.

    Args:
        times: (n,) of each telemetry, s on the run's clock.
        measured_mm: (n, 12) measured strokes.
        aims: (n,) index into `commands` of the one that was sent last; −1 before the first.
        commands: in the order of sending.
    """

    times: Floats
    measured_mm: Floats
    aims: NDArray[np.int64]
    commands: tuple[SentWaypoint, ...]

    @property
    def streamed(self) -> tuple[SentWaypoint, ...]:
        """Commands that lead to waypoints."""
        return tuple(command for command in self.commands if command.leads_on)


def read_run(pieces: Iterable[RunBytes], waypoints: Waypoints, first: int = 0) -> RunSeries:
    """Reads a run from its bytes.

    Args:
        pieces: in the order of their times.
        waypoints: what was approved.
        first: waypoint with which the run began, 0-based.
    """
    telemetry: list[tuple[float, tuple[float, ...], int]] = []
    commands: list[SentWaypoint] = []
    for time, event in _events(pieces):
        if isinstance(event, SentWaypoint):
            commands.append(event)
        elif isinstance(event, Telemetry):
            telemetry.append((time, event.strokes_mm, len(commands) - 1))
        if commands:
            commands[-1] = _follow(commands[-1], event, time)
    return RunSeries(
        np.array([time for time, _, _ in telemetry]),
        np.array([strokes for _, strokes, _ in telemetry]).reshape(-1, MOTORS),
        np.array([aim for _, _, aim in telemetry], dtype=np.int64),
        tuple(_numbered([_resolved(command) for command in commands], waypoints.strokes_mm, first)),
    )


def _events(pieces: Iterable[RunBytes]) -> Iterator[tuple[float, Line | SentWaypoint]]:
    """Lines and commands; what follows a stop, which is for clearing it, is no command of the run."""
    reader, outgoing, is_stopped = LineReader(drop_first=True), b"", False
    for piece in pieces:
        if not piece.to_robot:
            yield from ((piece.time, line) for line in reader.feed(piece.data))
            continue
        if is_stopped:
            continue
        is_stopped = encode_stop() in piece.data
        outgoing += piece.data
        end = 0
        for match in _MESSAGE.finditer(outgoing):
            end = match.end()
            numbers = tuple(float(field) for field in match[1].split(b",")[1:])
            yield piece.time, _Awaited(piece.time, numbers)
        outgoing = outgoing[max(end, len(outgoing) - 200) :]


@dataclass(frozen=True)
class _Awaited(SentWaypoint):
    """A command whose confirmation is still awaited: its point, then its end, then its strokes."""

    confirmed: bool = False
    ended: bool = False


def _follow(command: SentWaypoint, event: Line | SentWaypoint, time: float) -> SentWaypoint:
    if not isinstance(command, _Awaited) or command.measured_mm:
        return command
    if isinstance(event, TrajectoryPoint) and numbers_equal(command.target_mm, event.strokes_mm):
        return replace(command, confirmed=True)
    if isinstance(event, EndOfTrajectories) and command.confirmed:
        return replace(command, ended=True)
    if isinstance(event, Telemetry) and command.ended:
        return replace(command, arrived=time, measured_mm=event.strokes_mm)
    return command


def _resolved(command: SentWaypoint) -> SentWaypoint:
    return SentWaypoint(
        command.sent, command.target_mm, arrived=command.arrived, measured_mm=command.measured_mm
    )


def _numbered(commands: list[SentWaypoint], rows_mm: Floats, first: int) -> Iterator[SentWaypoint]:
    """Says of each command which waypoint it is.

    A run goes through the waypoints in their order, round and round; what was sent before that is the way to
    the start pose.
    """
    targets_mm = np.array([command.target_mm for command in commands]).reshape(-1, rows_mm.shape[1])
    start = _start_count(targets_mm, rows_mm, first)
    for number, command in enumerate(commands):
        place = first + number - start
        if number < start:
            yield command
        else:
            yield replace(command, index=place % len(rows_mm), lap=place // len(rows_mm))


def _start_count(targets_mm: Floats, rows_mm: Floats, first: int) -> int:
    """How many commands lead to the start pose: after them all others are the waypoints in their order."""
    count = len(targets_mm)
    for start in range(count):
        order = (first + np.arange(count - start)) % len(rows_mm)
        if np.abs(targets_mm[start:] - rows_mm[order]).max() < SAME_MM:
            return start
    return count
