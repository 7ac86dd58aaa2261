"""Verifies the state machine against the emulated motors and the wire, not against its own reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from app.bridge.delivery import ARRIVAL_MM
from app.bridge.states import IN_RUN, LinkState, RunPlan
from app.emulator.faults import NOISE_MM
from app.emulator.virtual_link import VirtualLink
from core.wire.lines import (
    CurrentPoint,
    Echo,
    ErrorScan,
    ErrorsChecked,
    Execute,
    Line,
    LineReader,
    SetupMoving,
    Telemetry,
)
from core.wire.messages import (
    HIGHEST_MM,
    LOWEST_MM,
    encode_flush,
    encode_release,
    encode_stop,
    encode_waypoint,
    payload_of,
    strokes_to_mm,
)

READING_MM = 6 * NOISE_MM
"""How far a noisy reading may be from the truth when the robot believes it, mm."""

LONGEST_HEALTHY_SILENCE = 2.8
"""A sound robot is deaf and mute no longer than this (docs/firmware.md, Times), s."""

NAMED_WITHIN = 2.0
"""Longest time from a fault's being visible on the wire to its named state, s."""

IDLE_PASSES = 2
CROSSING = 0.2
"""A robot idles if it passes its loop twice without a word of work; what it said earlier than this after a
message may have crossed it, s."""

_WORK = (Echo, Execute, CurrentPoint, ErrorScan, ErrorsChecked)


@dataclass
class Findings:
    """What the auditor found in one run or in many.

    Attributes:
        sent: approved waypoints that were written.
        reached: those that the session called reached.
        skipped: those of them at which the motors were not.
        unapproved: messages that were neither approved nor a stop, a flush, a reset or a clear.
        out_of_range: waypoints with a number outside the range.
        spoiled: messages that the robot read otherwise than they were written.
        unnoticed: those of them after which more than stops followed.
        resumed: motors that moved between a stop's confirmation and the next wish.
        hangs: waits that nothing ended.
        by_deadline: faults that only a waypoint's deadline could tell, which counts from its sending.
        latencies: time from a fault's being visible on the wire to its named state, s.
    """

    sent: int = 0
    reached: int = 0
    skipped: int = 0
    unapproved: int = 0
    out_of_range: int = 0
    spoiled: int = 0
    unnoticed: int = 0
    resumed: int = 0
    hangs: int = 0
    by_deadline: int = 0
    latencies: list[float] = field(default_factory=list)

    def add(self, other: Findings) -> None:
        """Counts another run's findings in."""
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)

    @property
    def violations(self) -> int:
        """How many of the promises were broken."""
        late = sum(latency > NAMED_WITHIN for latency in self.latencies)
        return (
            self.skipped + self.unapproved + self.out_of_range + self.unnoticed
            + self.resumed + self.hangs + late
        )  # fmt: skip


class Auditor:
    """Looks at every message before the cable has it, at every line after it, and at the true motors.

    Args:
        bridge: the session and its robot.
        findings: where it writes.
    """

    def __init__(self, bridge: VirtualLink, findings: Findings) -> None:
        self.findings = findings
        self.blind_motors: set[int] = set()
        self.clearing = False
        self._bridge = bridge
        self._reader = LineReader()
        self._approved: list[bytes] = []
        self._targets: list[tuple[float, ...]] = []
        self._sent = self._reached = 0
        self._written: list[str] = []
        self._taken = len(bridge.firmware.messages)
        self._spoiled = False
        self._wrote_at = self._heard_at = bridge.now
        self._certain: float | None = None
        self._idle: float | None = None
        self._passes = 0
        bridge.to_robot, bridge.from_robot = self._see_message, self._see_bytes

    def expect(self, plan: RunPlan) -> None:
        """From now on these waypoints, in their order, may be sent once each."""
        waypoints = plan.waypoints
        self._targets = [strokes_to_mm(strokes) for strokes in waypoints.strokes]
        self._approved = [
            encode_waypoint(strokes, duration)
            for strokes, duration in zip(waypoints.strokes, waypoints.durations.tolist(), strict=True)
        ]
        self._sent = self._reached = 0
        self._spoiled = False
        self._certain = self._idle = None
        self._passes = 0

    def look(self) -> None:
        """Compares what the session says with what the motors did; to be called after each step."""
        bridge = self._bridge
        for message in bridge.firmware.messages[self._taken :]:
            self._spoiled |= message.payload not in self._written
            self.findings.spoiled += message.payload not in self._written
        self._taken = len(bridge.firmware.messages)
        run = bridge.snapshot.run
        while run is not None and self._reached < run.reached:
            self.findings.reached += 1
            self.findings.unnoticed += self._spoiled
            self.findings.skipped += not self._is_at(self._targets[self._reached])
            self._reached += 1

    def show(self, now: float) -> None:
        """A fault can be seen on the wire since `now`; only the first sight of it counts."""
        self._certain = now if self._certain is None else self._certain

    def fault_named(self) -> None:
        """The session has named a fault just now."""
        silence = self._heard_at + LONGEST_HEALTHY_SILENCE
        sights = [sight for sight in (self._certain, self._idle) if sight is not None]
        sights += [silence] if silence < self._bridge.now else []
        if not sights and self._bridge.now - self._wrote_at < NAMED_WITHIN:
            sights = [self._wrote_at]
        if sights:
            self.findings.latencies.append(self._bridge.now - min(sights))
        else:
            self.findings.by_deadline += 1

    def _is_at(self, target_mm: Sequence[float]) -> bool:
        limit = ARRIVAL_MM + READING_MM
        return all(
            abs(target - stroke) <= limit
            for i, (target, stroke) in enumerate(zip(target_mm, self._bridge.strokes_mm, strict=True))
            if i not in self.blind_motors
        )

    def _see_message(self, data: bytes) -> bytes:
        stop = encode_stop()
        if data in (stop, encode_flush(), encode_flush() + stop):
            self._written.append(payload_of(stop))
            return data
        self._wrote_at, self._idle, self._passes = self._bridge.now, None, 0
        self._written.append(payload_of(data))
        self.findings.out_of_range += not _in_range(data)
        if self.clearing:
            self.findings.unapproved += not (data == encode_release() or data.startswith(b"<p,1,"))
        elif self._bridge.machine.robot not in IN_RUN:
            self.findings.unapproved += 1
        elif self._sent < len(self._approved) and data == self._approved[self._sent]:
            self._sent += 1
            self.findings.sent += 1
        else:
            self.findings.unapproved += self._sent > 0 or not data.startswith(b"<p,1,")
        self.findings.unnoticed += self._spoiled and not self.clearing
        return data

    def _see_bytes(self, data: bytes) -> bytes:
        if data:
            self._heard_at = self._bridge.now
            for line in self._reader.feed(data):
                self._see_line(line)
        return data

    def _see_line(self, line: Line) -> None:
        now = self._bridge.now
        if self._bridge.machine.robot not in IN_RUN or self._bridge.machine.link is not LinkState.READY:
            return
        if isinstance(line, SetupMoving) or (isinstance(line, Echo) and line.payload != self._written[-1]):
            self.show(now)
        if isinstance(line, Telemetry) and now > self._wrote_at + CROSSING:
            self._passes += 1
            if self._passes == IDLE_PASSES:
                self._idle = now
        elif isinstance(line, _WORK):
            self._idle, self._passes = None, 0


def _in_range(message: bytes) -> bool:
    if not message.startswith(b"<p,"):
        return True
    numbers = [float(field) for field in payload_of(message).split(",")[3:]]
    return len(numbers) == 12 and all(LOWEST_MM <= n <= HIGHEST_MM for n in numbers)
