"""Silence: a restarted board is named soon; a ramp, or a program that was kept from running, is none."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunPlan
from app.bridge.telemetry import IDLE_SILENCE, SILENCE_LIMIT, TelemetryMonitor
from app.bridge.transport import Transport
from app.emulator.faults import Fault
from app.emulator.profiles import ProfileName
from core.wire.lines import ErrorScan, Execute, Telemetry
from core.wire.robot_time import OVERRUN, ramp_time
from tests.support.studio_process import wait_for
from tests.support.virtual_robot import VirtualRobot, make_plan

PROMISED = 2.0
PATIENCE = 60.0


def is_named(snapshot: RobotSnapshot) -> bool:
    return snapshot.link is LinkState.LOST or snapshot.robot is RobotState.FAULT


def until_named(robot: VirtualRobot, fault: Fault) -> float:
    """Time from a fault to its being named, s."""
    struck = robot.now
    robot.troubles.strike(fault)
    robot.until(is_named, 20.0)
    return robot.now - struck


def to_and_fro(step_mm: float) -> RunPlan:
    return make_plan([[3.0] * 12, [3.0 + step_mm] * 12] * 10)


@pytest.mark.parametrize("profile", list(ProfileName))
@pytest.mark.parametrize("fault", [Fault.RESET, Fault.STALL])
@pytest.mark.parametrize("is_armed", [False, True])
def test_a_robot_that_stands_still_and_restarts_or_hangs_is_named_within_two_seconds(
    profile: ProfileName, fault: Fault, is_armed: bool
) -> None:
    robot = VirtualRobot(profile)
    (robot.arm if is_armed else robot.connect)()
    robot.wait(1.003)
    assert until_named(robot, fault) <= PROMISED
    assert "restarted" in robot.snapshot.sentence


@pytest.mark.parametrize("moment", np.linspace(0.0, 4.0, 9))
def test_a_restart_in_a_run_of_short_moves_is_named_within_two_seconds(moment: float) -> None:
    robot = VirtualRobot()
    robot.begin(to_and_fro(3.7))
    robot.wait(moment)
    assert until_named(robot, Fault.RESET) <= PROMISED
    assert robot.snapshot.robot is RobotState.FAULT


@pytest.mark.parametrize("moment", [2.3, 3.1, 4.2])
def test_a_restart_in_a_long_ramp_is_named_soon_after_the_ramp_should_be_over(moment: float) -> None:
    robot = VirtualRobot()
    robot.begin(to_and_fro(15.0))
    robot.wait(moment)
    assert until_named(robot, Fault.RESET) <= ramp_time(0.016) + OVERRUN + 0.5


@pytest.mark.parametrize("profile", list(ProfileName))
def test_the_longest_sound_ramp_is_no_silence(profile: ProfileName) -> None:
    robot = VirtualRobot(profile)
    robot.begin(make_plan([[0.5] * 12, [19.5] * 12, [0.5] * 12]))
    robot.troubles.strike(Fault.DELAY)
    ended = robot.until_robot(RobotState.DONE, RobotState.FAULT)
    assert ended.robot is RobotState.DONE, ended.last_error


def test_a_board_that_comes_back_is_said_to_have_restarted(robot: VirtualRobot) -> None:
    robot.arm()
    until_named(robot, Fault.RESET)
    snapshot = robot.until(lambda s: s.link is LinkState.READY, 30.0)
    assert snapshot.robot is RobotState.FAULT
    assert snapshot.last_error is not None
    assert "restarted by itself" in snapshot.last_error


def test_the_silence_that_is_allowed_follows_the_move_that_may_be_on() -> None:
    monitor = TelemetryMonitor(0.0)
    assert IDLE_SILENCE < monitor.longest_silence < SILENCE_LIMIT
    idle = Telemetry((5.0,) * 12)
    for _ in range(2):
        monitor.see(idle, 0.1)
    assert monitor.longest_silence == IDLE_SILENCE
    monitor.expect(3.0)
    assert monitor.longest_silence == IDLE_SILENCE
    monitor.see(Execute(1), 0.2)
    monitor.see(ErrorScan((-15.0, *(0.0,) * 11)), 0.3)
    assert monitor.longest_silence > ramp_time(0.015)
    monitor.see(ErrorScan((float("nan"), *(0.0,) * 11)), 0.3)
    assert monitor.longest_silence == SILENCE_LIMIT
    for _ in range(2):
        monitor.see(idle, 0.4)
    assert monitor.longest_silence == IDLE_SILENCE


class TalkingLine(Transport):
    """A robot that idles, and is mute while `hushed` is set; time passes as it talks."""

    hushed = threading.Event()
    now = 0.0

    def __init__(self, device: str, on_data: Callable[[bytes], None], on_lost: Callable[[str], None]) -> None:
        del on_lost
        self.device = device
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._talk, args=(on_data,))
        self._thread.start()

    def _talk(self, on_data: Callable[[bytes], None]) -> None:
        reading = b"j," + b"5.0040," * 12 + b"\r\n"
        while not self._ended.wait(0.002):
            if not self.hushed.is_set():
                on_data(b"new data tf 0\r\n" + reading)
                TalkingLine.now += 0.01

    def write(self, data: bytes) -> None:
        del data

    def wait_read(self) -> None:
        pass

    def close(self) -> None:
        self._ended.set()
        self._thread.join()


@pytest.fixture
def bridge() -> Iterator[RobotBridge]:
    TalkingLine.hushed.clear()
    bridge = RobotBridge(clock=lambda: TalkingLine.now, tick=0.005, opener=TalkingLine)
    bridge.connect("talking")
    wait_for(lambda: bridge.snapshot.link is LinkState.READY, "the robot answers")
    yield bridge
    bridge.close()


@pytest.mark.parametrize("place", ["_inbox.take", "_feed"])
def test_a_program_that_was_kept_from_running_does_not_call_that_the_robots_silence(
    bridge: RobotBridge, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    owner, name = (bridge._inbox, "take") if place == "_inbox.take" else (bridge, place)
    run, tick, looked = getattr(owner, name), bridge._machine.tick, threading.Event()

    def run_late(*arguments: object) -> object:
        if not TalkingLine.hushed.is_set():
            TalkingLine.hushed.set()
            TalkingLine.now += 2 * SILENCE_LIMIT
        return run(*arguments)

    def look(now: float) -> None:
        tick(now)
        if TalkingLine.hushed.is_set():
            looked.set()

    monkeypatch.setattr(bridge._machine, "tick", look)
    monkeypatch.setattr(owner, name, run_late)
    assert looked.wait(PATIENCE)
    assert bridge.snapshot.link is LinkState.READY


def test_a_robot_that_is_silent_while_the_program_runs_is_lost(bridge: RobotBridge) -> None:
    TalkingLine.hushed.set()

    def is_lost() -> bool:
        TalkingLine.now += 0.05
        return bridge.snapshot.link is LinkState.LOST

    wait_for(is_lost, "the robot is lost")
    assert "silent" in bridge.snapshot.sentence
