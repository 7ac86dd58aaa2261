"""Thousands of waypoints with random faults of every kind, in the robot's own time."""

import random
from collections.abc import Callable, Sequence

import numpy as np

from app.bench.common.measure import Row
from app.bench.robot.auditor import Auditor, Findings
from app.bridge.messages import NOT_STOPPED
from app.bridge.states import IN_RUN, LinkState, RobotState, RunPlan
from app.bridge.stop_confirmation import STOP_LIMIT
from app.emulator.faults import USUAL_MOTORS, Fault
from app.emulator.profiles import ProfileName
from app.emulator.virtual_link import VirtualLink
from core.arrays import Floats
from core.errors import StateError
from core.findings import Approval
from core.wire.messages import HIGHEST_MM, LOWEST_MM, MOTORS
from core.wire.waypoints import Waypoints

WAYPOINTS = 10_000
SHORTEST_PLAN, LONGEST_PLAN = 4, 16
LARGEST_MOVE_MM = 6.0
DURATION = 1.23
"""Unlike that of any move to the start pose, which the auditor could not tell apart otherwise, s."""

LATEST_STRIKE = 1.5
"""A fault strikes up to this long after a random waypoint was called reached, s."""

LIMIT_A_WAYPOINT, LIMIT = 20.0, 60.0
"""A run that takes longer than this hangs, s; the second for everything but waypoints."""

RESUMED_MM, CLEARED_MM = 0.2, 1.1
WATCHED = 1.0
"""A stopped robot that moves by more than the first within this time has resumed by surprise, by more than
the second if it is cleared, mm and s."""

SETTLED = 8.0
"""From power-on to an idle robot, s."""

NEEDS_POWER_CYCLE = frozenset({Fault.STALL, Fault.RESET, *USUAL_MOTORS})
"""Faults that only a power cycle ends: a dead program and wound-up controllers (docs/firmware.md, hazard 11).

A robot that is shown as NOT STOPPED needs it too: a lost decimal point lets it move for hours (hazard 12)."""

BY = "soak"


def bench_soak(waypoints: int = WAYPOINTS, seed: int = 0) -> list[Row]:
    """A row for each fault, and one for all."""
    found = soak(waypoints, seed)
    total = Findings()
    for findings in found.values():
        total.add(findings)
    return [_row(name, findings) for name, findings in (*found.items(), ("all", total))]


def soak(waypoints: int, seed: int = 0, faults: Sequence[Fault] = tuple(Fault)) -> dict[str, Findings]:
    """Runs plans with one fault each until so many approved waypoints were sent.

    Args:
        waypoints: how many.
        seed: of everything that is random.
        faults: taken in turn.

    Returns:
        What the auditor found, by the fault's name.
    """
    found = {fault.value: Findings() for fault in faults}
    number = 0
    while sum(findings.sent for findings in found.values()) < waypoints:
        fault = faults[number % len(faults)]
        SoakRound(fault, random.Random(f"{seed} {number}"), found[fault.value]).run()
        number += 1
    return found


class SoakRound:
    """One robot: a plan with a fault in it, the way out of it, and a plan without.

    Args:
        fault: what strikes.
        dice: decides all that is random.
        findings: where the auditor writes.
    """

    def __init__(self, fault: Fault, dice: random.Random, findings: Findings) -> None:
        self._fault = fault
        self._dice = dice
        self._findings = findings
        profile = dice.choice(list(ProfileName))
        start_mm = [dice.uniform(LOWEST_MM, 3.0) for _ in range(MOTORS)]
        self._bridge = VirtualLink(profile, start_mm, dice.randrange(2**31))
        self._auditor = Auditor(self._bridge, findings)

    def run(self) -> None:
        """Runs it; what goes on for ever is counted as a hang."""
        try:
            self._bridge.boot()
            self._connect()
            self._stream(self._plan(), strikes=True)
            self._recover()
            self._stream(self._plan(), strikes=False)
        except TimeoutError:
            self._findings.hangs += 1

    @property
    def _robot(self) -> RobotState:
        return self._bridge.machine.robot

    def _plan(self) -> RunPlan:
        """A random walk within the range, approved."""
        count = self._dice.randint(SHORTEST_PLAN, LONGEST_PLAN)
        moves = np.random.default_rng(self._dice.randrange(2**31)).uniform(-1.0, 1.0, (count, MOTORS))
        rows = [np.array(self._bridge.strokes_mm)]
        for move in moves * LARGEST_MOVE_MM:
            rows.append(_reflect(rows[-1] + move))
        waypoints = Waypoints(np.array(rows[1:]).reshape(-1, 4, 3) / 1000.0, np.full(count, DURATION))
        approval = Approval("soak", waypoints.content_hash, BY, "2026-01-01T00:00:00+00:00")
        return RunPlan(waypoints, approval, (True,) * count)

    def _connect(self) -> None:
        self._bridge.open()
        self._until(lambda: self._bridge.machine.link is LinkState.READY)

    def _stream(self, plan: RunPlan, *, strikes: bool) -> None:
        bridge = self._bridge
        bridge.machine.arm(BY)
        self._auditor.expect(plan)
        bridge.machine.send(plan, BY, bridge.now)
        strike_at = self._dice.randrange(plan.waypoints.count) if strikes else -1
        strike_time = float("inf")
        end = bridge.now + LIMIT + LIMIT_A_WAYPOINT * plan.waypoints.count
        while self._robot in IN_RUN:
            run = bridge.snapshot.run
            if strike_at >= 0 and run is not None and run.reached >= strike_at:
                strike_at, strike_time = -1, bridge.now + self._dice.uniform(0.0, LATEST_STRIKE)
            if bridge.now >= strike_time:
                strike_time = float("inf")
                self._strike()
            self._step(end)
        if self._robot is RobotState.FAULT:
            self._auditor.fault_named()
        run = bridge.snapshot.run
        if self._robot is RobotState.DONE or not strikes:
            self._findings.skipped += run is None or run.reached < plan.waypoints.count

    def _strike(self) -> None:
        motors = tuple(self._dice.sample(range(MOTORS), len(USUAL_MOTORS.get(self._fault, ()))))
        if self._fault is Fault.DEAD_POT:
            self._auditor.blind_motors.update(motors)
        if self._fault is Fault.UNPLUG:
            self._auditor.show(self._bridge.now)
        self._bridge.troubles.strike(self._fault, motors)

    def _recover(self) -> None:
        """What a person would do: mend it, cut the power where the program is dead, connect, clear."""
        bridge = self._bridge
        if self._robot is RobotState.FAULT:
            self._wait(STOP_LIMIT)
        bridge.troubles.mend()
        self._auditor.blind_motors.clear()
        if self._robot is RobotState.FAULT and (
            self._fault in NEEDS_POWER_CYCLE or NOT_STOPPED in bridge.machine.sentence
        ):
            bridge.firmware.power_cycle()
            self._wait(SETTLED)
        if bridge.machine.link is LinkState.LOST:
            self._connect()
        self._until(lambda: bridge.machine.link is LinkState.READY)
        if self._robot is RobotState.FAULT:
            self._clear()

    def _clear(self) -> None:
        bridge = self._bridge
        self._until(lambda: not bridge.machine.awaits_stop)
        stood = bridge.strokes_mm
        self._wait(WATCHED)
        self._findings.resumed += _farthest(stood, bridge.strokes_mm) > RESUMED_MM
        self._auditor.clearing = True
        self._until(self._cleared)
        self._until(lambda: self._robot is RobotState.DISARMED)
        self._auditor.clearing = False
        self._findings.resumed += _farthest(stood, bridge.strokes_mm) > CLEARED_MM

    def _cleared(self) -> bool:
        try:
            self._bridge.machine.clear(BY, self._bridge.now)
        except StateError:
            return False
        return True

    def _wait(self, seconds: float) -> None:
        end = self._bridge.now + seconds
        self._until(lambda: self._bridge.now >= end)

    def _until(self, condition: Callable[[], bool]) -> None:
        end = self._bridge.now + LIMIT
        while not condition():
            self._step(end)

    def _step(self, end: float) -> None:
        self._bridge.step()
        self._auditor.look()
        if self._bridge.now > end:
            raise TimeoutError(f"{self._fault}: nothing ended {self._bridge.snapshot}")


def _reflect(rows_mm: Floats) -> Floats:
    """Mirrors what leaves the range back into it."""
    inside: Floats = np.where(rows_mm > HIGHEST_MM, 2 * HIGHEST_MM - rows_mm, rows_mm)
    return np.where(inside < LOWEST_MM, 2 * LOWEST_MM - inside, inside)


def _farthest(first_mm: Sequence[float], second_mm: Sequence[float]) -> float:
    return max(abs(a - b) for a, b in zip(first_mm, second_mm, strict=True))


def _row(name: str, findings: Findings) -> Row:
    latencies = findings.latencies
    return {
        "fault": name,
        "sent": findings.sent,
        "reached": findings.reached,
        "faults": len(latencies) + findings.by_deadline,
        "by_deadline": findings.by_deadline,
        "misread": findings.spoiled,
        "skipped": findings.skipped,
        "hangs": findings.hangs,
        "unapproved": findings.unapproved + findings.out_of_range,
        "unnoticed": findings.unnoticed,
        "resumed": findings.resumed,
        "worst_s": round(max(latencies, default=0.0), 2),
    }
