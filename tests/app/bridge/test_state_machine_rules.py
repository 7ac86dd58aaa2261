"""The session as a state machine: whatever people, cable and robot do, only what was approved is sent."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from app.bridge.messages import NOT_STOPPED
from app.bridge.states import IN_RUN, LinkState, RobotState
from app.emulator.faults import USUAL_MOTORS, Fault
from app.emulator.profiles import ProfileName
from core.errors import StateError
from core.robot.model import load_robot
from core.wire.messages import (
    HIGHEST_MM,
    LOWEST_MM,
    encode_flush,
    encode_release,
    encode_reset,
    encode_stop,
    encode_waypoint,
    payload_of,
)
from tests.support.virtual_robot import VirtualRobot, make_plan

LONGEST_WAIT = 300.0
"""Every wait ends within this: five moves to the start pose and six waypoints, all at their deadlines, s."""

WALKER = load_robot("deltawalker")
STOPS = (encode_stop(), encode_flush(), encode_flush() + encode_stop())
BY = "Ada"

_ANYWHERE = frozenset({RobotState.UNKNOWN, RobotState.FAULT, RobotState.STOPPING})
"""What a loss, a fault and a stop lead to from every state."""

ALLOWED = {
    RobotState.UNKNOWN: {RobotState.DISARMED, RobotState.STOPPED},
    RobotState.DISARMED: {RobotState.ARMED},
    RobotState.ARMED: {RobotState.MOVING, RobotState.DISARMED},
    RobotState.MOVING: {RobotState.PAUSING, RobotState.DONE, RobotState.ARMED},
    RobotState.PAUSING: {RobotState.PAUSED, RobotState.MOVING, RobotState.DONE},
    RobotState.PAUSED: {RobotState.MOVING},
    RobotState.STOPPING: {RobotState.STOPPED, RobotState.DISARMED},
    RobotState.STOPPED: {RobotState.DISARMED},
    RobotState.DONE: {RobotState.ARMED},
    RobotState.FAULT: {RobotState.DISARMED},
}
"""Which state may follow which, beside those anywhere and the same one."""


class CommandQueue(RuleBasedStateMachine):
    """People at random, a cable and a robot with faults, and a model of what may be on the wire."""

    @initialize(profile=st.sampled_from(ProfileName), start_mm=st.floats(0.5, 15.0), seed=st.integers(0, 99))
    def power_on(self, profile: ProfileName, start_mm: float, seed: int) -> None:
        self.robot = VirtualRobot(profile, [start_mm] * 12, seed)
        self.robot.to_robot = self.judge
        self.robot.boot()
        self.approved: list[bytes] = []
        self.may_reset = self.may_move = False
        self.wrong: list[str] = []
        self.robot.open()
        self.come_to_rest()

    def judge(self, data: bytes) -> bytes:
        """Looks at every message as it leaves the host; what is wrong is told by the invariant."""
        machine = self.robot.machine
        if data in STOPS or (data == encode_release() and self.may_move and machine._test is not None):
            return data
        if not self.may_move and not machine._clearing:
            self.wrong.append(f"{data!r} without Clear and Arm since the last stop")
        elif machine._clearing:
            if data != encode_release() and not self.is_where_it_stands(data):
                self.wrong.append(f"{data!r} to clear a stop")
        elif data == encode_reset():
            if not self.may_reset:
                self.wrong.append("a reset that nobody asked for")
            self.may_reset = False
        elif self.approved and data == self.approved[0]:
            self.approved.pop(0)
        elif self.is_streaming or not self.is_in_range(data):
            self.wrong.append(f"{data!r} was not approved, or is out of range")
        return data

    @property
    def is_streaming(self) -> bool:
        run = self.robot.snapshot.run
        return self.robot.machine._test is None and (run is None or run.sent > 1 or not self.approved)

    def is_in_range(self, data: bytes) -> bool:
        fields = [float(field) for field in payload_of(data).split(",")[3:]]
        return len(fields) == 12 and all(LOWEST_MM <= field <= HIGHEST_MM for field in fields)

    def is_where_it_stands(self, data: bytes) -> bool:
        measured_mm = np.clip(self.robot.machine.monitor.strokes_mm or (), LOWEST_MM, HIGHEST_MM)
        return self.is_in_range(data) and data == encode_waypoint((measured_mm / 1000.0).tolist(), 1.0)

    def wish(self, deed: Callable[[], object]) -> bool:
        """Does something; what is refused changes nothing."""
        machine, sent = self.robot.machine, len(self.robot.sent)
        before = (machine.link, machine.robot)
        try:
            deed()
        except StateError:
            assert (machine.link, machine.robot) == before
            assert len(self.robot.sent) == sent
            return False
        return True

    @rule()
    def arm(self) -> None:
        self.may_move |= self.wish(lambda: self.robot.machine.arm(BY))

    @rule()
    def disarm(self) -> None:
        if self.robot.machine.robot is RobotState.ARMED:
            self.may_move = False
        self.robot.machine.disarm(BY)

    @rule(seed=st.integers(0, 999), count=st.integers(1, 6))
    def send(self, seed: int, count: int) -> None:
        dice = np.random.default_rng(seed)
        plan = make_plan(
            dice.uniform(0.5, 19.5, (count, 12)).tolist(), (dice.integers(0, 2, count) > 0).tolist()
        )
        before, waypoints = self.approved, plan.waypoints
        self.approved = [
            encode_waypoint(strokes, duration)
            for strokes, duration in zip(waypoints.strokes, waypoints.durations.tolist(), strict=True)
        ]
        if not self.wish(lambda: self.robot.machine.send(plan, BY, self.robot.now)):
            self.approved = before

    @precondition(lambda self: self.robot.machine.robot in (RobotState.DISARMED, RobotState.DONE))
    @rule(seed=st.integers(0, 999), count=st.integers(2, 6), seconds=st.floats(0.0, 8.0))
    def run(self, seed: int, count: int, seconds: float) -> None:
        self.arm()
        self.send(seed, count)
        self.robot.wait(seconds)

    @rule()
    def pause(self) -> None:
        self.wish(lambda: self.robot.machine.pause(BY))

    @rule()
    def resume(self) -> None:
        self.wish(lambda: self.robot.machine.resume(BY, self.robot.now))

    @rule()
    def stop(self) -> None:
        self.may_move = False
        self.robot.stop(BY)

    @rule()
    def clear(self) -> None:
        self.wish(lambda: self.robot.machine.clear(BY, self.robot.now))

    @rule()
    def move_each_motor(self) -> None:
        self.wish(lambda: self.robot.machine.test_motors(WALKER, BY, self.robot.now))

    @rule()
    def end_early(self) -> None:
        self.robot.machine.end_early()

    @rule()
    def reset(self) -> None:
        self.may_reset = True
        self.may_reset &= self.wish(lambda: self.robot.machine.reset(BY, self.robot.now))

    @precondition(lambda self: self.robot.machine.link in (LinkState.DISCONNECTED, LinkState.LOST))
    @rule()
    def connect(self) -> None:
        self.robot.open()

    @precondition(lambda self: self.robot.machine.robot not in IN_RUN)
    @rule()
    def disconnect(self) -> None:
        self.may_move = False
        self.robot.gate.attach(None)
        self.robot.machine.closed()

    @precondition(lambda self: self.robot.machine.robot is not RobotState.FAULT)
    @rule(fault=st.sampled_from(Fault), motors=st.permutations(range(12)))
    def strike(self, fault: Fault, motors: list[int]) -> None:
        self.robot.troubles.strike(fault, tuple(motors[: len(USUAL_MOTORS.get(fault, ()))]))

    @rule()
    def mend_and_cut_the_power(self) -> None:
        self.robot.troubles.mend()
        self.robot.firmware.power_cycle()

    @rule(seconds=st.floats(0.0, 6.0))
    def wait(self, seconds: float) -> None:
        self.robot.wait(seconds)

    @rule()
    def come_to_rest(self) -> None:
        """Every wait of the session ends, by its success or by its deadline."""
        self.robot.until(lambda _: self.is_at_rest, LONGEST_WAIT)

    @property
    def is_at_rest(self) -> bool:
        machine = self.robot.machine
        moves = machine.robot in (RobotState.MOVING, RobotState.PAUSING) or machine._clearing
        waits = machine.awaits_stop and NOT_STOPPED not in machine.sentence
        return not moves and not waits and machine.link is not LinkState.CONNECTING

    @invariant()
    def only_what_was_approved_was_sent(self) -> None:
        assert self.wrong == []

    @invariant()
    def each_state_follows_one_that_it_may_follow(self) -> None:
        states = [RobotState.UNKNOWN, *(change.robot for change in self.robot.machine.transitions)]
        for before, after in itertools.pairwise(states):
            assert after in {before, *_ANYWHERE, *ALLOWED[before]}, (before, after)

    def teardown(self) -> None:
        if hasattr(self, "robot"):
            self.robot.until(lambda _: self.is_at_rest, LONGEST_WAIT)
            self.only_what_was_approved_was_sent()


TestSession = CommandQueue.TestCase
TestSession.settings = settings(
    max_examples=60, stateful_step_count=25, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
