"""A program that did not run: the run goes on after a short time, and pauses or stops after a long one."""

from __future__ import annotations

import numpy as np
import pytest

from app.bridge.jog import JogPlan
from app.bridge.states import RobotSnapshot, RobotState, RunPlan
from app.bridge.telemetry import SILENCE_LIMIT
from app.emulator.faults import Fault
from app.emulator.profiles import ProfileName
from core.errors import StateError
from core.jog.check import check_jog
from core.jog.motor_test import MotorVerdict
from core.jog.steps import JogPart, JogStep
from core.robot.model import load_robot
from tests.support.virtual_robot import VirtualRobot, make_plan, payloads

WALKER = load_robot("deltawalker")
GAPS = (0.5, 2.0, 5.0, 20.0, 60.0)
MOMENTS = np.linspace(0.05, 21.0, 20)
TERMINAL = 4096
KEPT = {"a terminal keeps 4 kB": TERMINAL, "all is kept": 10**9, "all is lost": 0}
ENDS = (RobotState.DONE, RobotState.PAUSED, RobotState.STOPPED, RobotState.FAULT)


def walk(holds: bool = True) -> RunPlan:
    """A way of twelve moves of 2.5 to 8 mm with a pose for a pause at each third one."""
    rows = np.full((12, 12), 6.0)
    for number, row in enumerate(rows):
        row[(3 * number) % 12 : (3 * number) % 12 + 3] += (2.5, 5.0, 8.0)
    return make_plan(rows.tolist(), [holds and number % 3 == 2 for number in range(12)])


def sent_waypoints(robot: VirtualRobot) -> list[str]:
    return [payload for payload in payloads(robot) if payload.startswith("p")]


def without_a_gap() -> list[str]:
    robot = VirtualRobot()
    robot.begin(walk())
    assert robot.until_robot(*ENDS).robot is RobotState.DONE
    return sent_waypoints(robot)


WHOLE = without_a_gap()


def after_gap(seconds: float, moment: float, kept: int, plan: RunPlan) -> tuple[VirtualRobot, RobotSnapshot]:
    robot = VirtualRobot()
    robot.begin(plan)
    robot.wait(moment)
    assert robot.snapshot.robot is RobotState.MOVING
    robot.away(seconds, kept)
    return robot, robot.until_robot(*ENDS)


@pytest.mark.parametrize("seconds", GAPS)
@pytest.mark.parametrize("kept", KEPT.values(), ids=KEPT.keys())
def test_each_length_has_one_outcome_and_no_waypoint_is_left_out(seconds: float, kept: int) -> None:
    if kept == 0 and seconds < 1.0:
        kept = TERMINAL  # no line loses what was said in so short a time
    for moment in MOMENTS if kept == TERMINAL else MOMENTS[::5]:
        robot, ended = after_gap(seconds, moment, kept, walk())
        causes = [change.cause for change in robot.machine.transitions]
        assert sum("The program did not run for" in cause for cause in causes) == 1, moment
        if seconds > SILENCE_LIMIT:
            assert ended.robot is RobotState.PAUSED, (moment, ended.sentence)
            assert f"The program did not run for {seconds:.0f}." in ended.sentence
            before = len(robot.sent)
            robot.wait(10.0)
            assert len(robot.sent) == before
            robot.machine.resume("Ada", robot.now)
            ended = robot.until_robot(*ENDS)
        assert ended.robot is RobotState.DONE, (moment, ended.sentence)
        assert sent_waypoints(robot) == WHOLE


@pytest.mark.parametrize("seconds", [g for g in GAPS if g > SILENCE_LIMIT])
def test_without_a_pose_for_a_pause_the_robot_is_stopped(seconds: float) -> None:
    for moment in MOMENTS[::3]:
        robot, ended = after_gap(seconds, moment, 4096, walk(holds=False))
        assert ended.robot is RobotState.STOPPED
        assert "The program did not run for" in ended.sentence
        assert "motor" not in ended.sentence.split("Stopped")[0]
        robot.machine.clear("Ada", robot.now)
        robot.until_robot(RobotState.DISARMED)


def test_after_minutes_nothing_moves_at_all() -> None:
    robot, ended = after_gap(400.0, 3.0, 4096, walk())
    taken = len(sent_waypoints(robot))
    assert ended.robot is RobotState.STOPPED
    robot.wait(10.0)
    assert len(sent_waypoints(robot)) == taken


@pytest.mark.parametrize("profile", list(ProfileName))
@pytest.mark.parametrize("kept", KEPT.values(), ids=KEPT.keys())
def test_many_short_times_away_are_survived(profile: ProfileName, kept: int) -> None:
    robot = VirtualRobot(profile)
    robot.begin(walk())
    random = np.random.default_rng(7)
    while robot.snapshot.robot is RobotState.MOVING:
        robot.wait(random.uniform(0.05, 1.5))
        if robot.snapshot.robot is RobotState.MOVING:
            robot.away(random.uniform(1.1, 3.5), kept)
    assert robot.snapshot.robot is RobotState.DONE, robot.snapshot.sentence


def test_a_paused_run_that_slept_is_resumed_by_fresh_readings_alone() -> None:
    robot = VirtualRobot()
    robot.begin(walk())
    robot.wait(3.0)
    robot.machine.pause("Ada")
    robot.until_robot(RobotState.PAUSED)
    robot.away(100.0, 0)
    assert robot.snapshot.robot is RobotState.PAUSED
    assert "The program did not run for 100." in robot.snapshot.sentence
    with pytest.raises(StateError, match="just come back"):
        robot.machine.resume("Ada", robot.now)  # asked for while nobody could answer
    robot.wait(1.1)
    robot.machine.resume("Ada", robot.now)
    assert robot.until_robot(*ENDS).robot is RobotState.DONE


@pytest.mark.parametrize("fault", [Fault.RESET, Fault.STALL])
@pytest.mark.parametrize("kept", [0, 10**9])
def test_a_robot_that_failed_meanwhile_is_found_out(fault: Fault, kept: int) -> None:
    robot = VirtualRobot()
    robot.begin(walk())
    robot.wait(3.0)
    robot.troubles.strike(fault)
    robot.away(20.0, kept)
    ended = robot.until_robot(RobotState.FAULT, RobotState.PAUSED)
    assert ended.robot is RobotState.FAULT


def test_a_motor_that_was_jammed_meanwhile_is_named_by_fresh_readings() -> None:
    robot = VirtualRobot()
    robot.begin(walk())
    robot.until(lambda s: s.run is not None and s.run.reached == 2)
    robot.firmware.board.motors.jam(8, robot.firmware.board.now_us)
    robot.away(20.0, 0)
    ended = robot.until_robot(RobotState.FAULT, RobotState.PAUSED)
    assert ended.robot is RobotState.FAULT
    assert "motor 9" in ended.sentence


def test_a_stop_that_was_under_way_is_confirmed_afterwards() -> None:
    for moment in (0.0, 0.01, 0.5):
        robot = VirtualRobot()
        robot.begin(walk())
        robot.wait(4.0)
        robot.stop("Grace")
        robot.wait(moment)
        robot.away(20.0, 0)
        assert robot.until_robot(RobotState.STOPPED, RobotState.FAULT).robot is RobotState.STOPPED
        assert "NOT STOPPED" not in " ".join(change.cause for change in robot.machine.transitions)


@pytest.mark.parametrize("kept", KEPT.values(), ids=KEPT.keys())
@pytest.mark.parametrize("moment", [0.05, 0.3, 0.8, 1.4])
def test_a_jog_ends_after_the_move_that_is_on(kept: int, moment: float) -> None:
    robot = VirtualRobot()
    robot.arm()
    robot.until(lambda s: robot.machine.monitor.stands_still(robot.now))
    measured = np.array(robot.snapshot.strokes).reshape(4, 3)
    way = check_jog(WALKER, measured, (JogStep(JogPart.MOTOR, 0.012, 1, 2),)).way
    before = len(robot.sent)
    robot.machine.jog(JogPlan("motor 3 of foot 2", measured, way), "Ada", robot.now)
    robot.wait(moment)
    robot.away(20.0, kept)
    ended = robot.until_robot(RobotState.ARMED, RobotState.FAULT)
    assert ended.robot is RobotState.ARMED, ended.sentence
    assert len(robot.sent) - before < len(way)
    assert "ended early" in robot.machine.transitions[-1].cause


@pytest.mark.parametrize("seconds", [1.5, 3.0, 20.0])
def test_a_motor_test_is_stopped_and_blames_no_motor(seconds: float) -> None:
    for moment in np.linspace(0.1, 8.0, 12):
        robot = VirtualRobot()
        robot.arm()
        robot.machine.test_motors(WALKER, "Ada", robot.now)
        robot.wait(moment)
        robot.away(seconds, TERMINAL)
        ended = robot.until_robot(RobotState.STOPPED, RobotState.FAULT)
        assert ended.robot is RobotState.STOPPED, ended.sentence
        assert "The program did not run for" in ended.sentence
        assert ended.motor_test is not None
        assert {one.verdict for one in ended.motor_test.findings} <= {MotorVerdict.GOOD}


@pytest.mark.parametrize("kept", KEPT.values(), ids=KEPT.keys())
def test_a_clear_is_not_gone_on_with(kept: int) -> None:
    robot = VirtualRobot()
    robot.begin(walk())
    robot.wait(4.0)
    robot.stop("Grace")
    robot.until_robot(RobotState.STOPPED)
    robot.machine.clear("Ada", robot.now)
    robot.away(20.0, kept)
    ended = robot.until(lambda s: "Nothing moves until you clear" in s.sentence)
    assert ended.robot is RobotState.STOPPED
    assert "The program did not run for" in ended.sentence
    assert "s,0" not in payloads(robot)
    robot.machine.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)


@pytest.mark.parametrize("kept", KEPT.values(), ids=KEPT.keys())
def test_a_reset_ends_by_where_the_robot_stands(kept: int) -> None:
    robot = VirtualRobot()
    robot.arm()
    robot.machine.send(make_plan([[6.0] * 12]), "Ada", robot.now)
    robot.until_robot(RobotState.DONE)
    robot.machine.arm("Ada")
    robot.machine.reset("Ada", robot.now)
    robot.wait(0.3)
    robot.away(20.0, kept)
    assert robot.until_robot(RobotState.ARMED, RobotState.FAULT).robot is RobotState.ARMED
    assert max(robot.strokes_mm) < 2.0


@pytest.mark.parametrize(("seconds", "state"), [(3.0, RobotState.ARMED), (5.0, RobotState.DISARMED)])
def test_an_armed_robot_is_disarmed_after_a_long_time(seconds: float, state: RobotState) -> None:
    robot = VirtualRobot()
    robot.arm()
    robot.wait(1.0)
    robot.away(seconds, 0)
    robot.wait(3.0)
    assert robot.snapshot.robot is state
    assert ("did not run for" in robot.snapshot.sentence) is (state is RobotState.DISARMED)
