"""The motor test on an emulated robot in virtual time, with each fault of motors and without."""

from __future__ import annotations

import numpy as np
import pytest

from app.bridge.states import LinkState, MotorTestState, RobotSnapshot, RobotState
from app.emulator.faults import Fault, FaultRequest
from app.emulator.profiles import ProfileName
from app.robot.views import jog_stop_seconds
from core.errors import StateError
from core.jog.motor_test import TEST_MOVE, MotorFinding, MotorVerdict
from core.robot.model import load_robot
from core.wire.messages import MOTORS, encode_reset
from tests.support.virtual_robot import REST_MM, VirtualRobot, make_plan, payloads

WALKER = load_robot("deltawalker")
PROFILES = list(ProfileName)
STANDING_MM = (8.0,) * MOTORS
UNEVEN_MM = (14.0, 13.0, 15.0) * 4


def begun(
    fault: str = "", profile: ProfileName = ProfileName.PUBLISHED, strokes_mm: tuple[float, ...] = REST_MM
) -> VirtualRobot:
    """A robot at some strokes, with a fault, under test."""
    robot = VirtualRobot(profile)
    robot.arm()
    if strokes_mm != REST_MM:
        robot.machine.send(make_plan([strokes_mm]), "Ada", robot.now)
        robot.until_robot(RobotState.DONE)
        robot.machine.arm("Ada")
    if fault:
        request = FaultRequest.parse(fault)
        robot.troubles.strike(request.fault, request.motors)
    robot.machine.test_motors(WALKER, "Ada", robot.now)
    return robot


def ended(robot: VirtualRobot) -> dict[int, MotorFinding]:
    """Runs a test to its end: the findings by the motor's number."""
    end = robot.until(lambda s: s.robot is not RobotState.MOVING)
    assert (end.robot, end.last_error) == (RobotState.ARMED, None)
    assert end.motor_test is not None
    assert (end.motor_test.state, end.motor_test.motor) == (MotorTestState.DONE, None)
    return {one.motor + 1: one for one in end.motor_test.findings}


def bad(findings: dict[int, MotorFinding]) -> dict[int, MotorVerdict]:
    assert sorted(findings) == list(range(1, MOTORS + 1))
    return {motor: one.verdict for motor, one in findings.items() if one.verdict is not MotorVerdict.GOOD}


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("fault", ["", "noise"])
@pytest.mark.parametrize("strokes_mm", [REST_MM, STANDING_MM, UNEVEN_MM])
def test_sound_motors_are_good_and_go_back(
    profile: ProfileName, fault: str, strokes_mm: tuple[float, ...]
) -> None:
    robot = begun(fault, profile, strokes_mm)
    before, began = robot.strokes_mm, robot.now
    findings = ended(robot)
    assert bad(findings) == {}
    assert robot.strokes_mm == pytest.approx(before, abs=1.2)
    assert robot.now - began < 100.0
    assert all(one.remedy == "" and 0.0014 < (one.moved or 0.0) < 0.004 for one in findings.values())


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("strokes_mm", [STANDING_MM, UNEVEN_MM])
@pytest.mark.parametrize(
    ("fault", "verdicts"),
    [
        ("stuck-motor:5", {5: MotorVerdict.NO_ANSWER}),
        ("dead-pot:2", {2: MotorVerdict.NO_ANSWER}),
        ("reversed-motor:7", {7: MotorVerdict.WRONG_WAY}),
        ("weak-motor:8", {8: MotorVerdict.SHORT}),
        ("weak-motor:1", {1: MotorVerdict.SHORT}),
        ("swapped-motors:4,5", {4: MotorVerdict.OTHER_MOTOR, 5: MotorVerdict.OTHER_MOTOR}),
        ("swapped-motors:3,10", {3: MotorVerdict.OTHER_MOTOR, 10: MotorVerdict.OTHER_MOTOR}),
    ],
)
def test_each_fault_of_a_motor_is_named_and_no_other_motor_is_blamed(
    fault: str, verdicts: dict[int, MotorVerdict], profile: ProfileName, strokes_mm: tuple[float, ...]
) -> None:
    robot = begun(fault, profile, strokes_mm)
    before = np.array(robot.strokes_mm)
    findings = ended(robot)
    # A robot that a fault has put out of balance may not be moved everywhere.
    blamed = {motor: one for motor, one in bad(findings).items() if one is not MotorVerdict.NOT_TESTED}
    assert blamed == verdicts
    assert len(bad(findings)) - len(blamed) <= 4
    assert all(findings[motor].remedy for motor in verdicts)
    assert all(findings[motor].off for motor, one in verdicts.items() if one is MotorVerdict.SHORT)
    if "swapped" in fault:
        first, second = verdicts
        assert (findings[first].other, findings[second].other) == (second - 1, first - 1)
        assert f"motor {second} (foot" in findings[first].sentence
    # A motor that runs away would be at the end of its travel. One without a reading goes where nobody sees.
    assert "dead" in fault or float(np.abs(np.array(robot.strokes_mm) - before).max()) < 7.5


def test_a_reversed_motor_gets_one_ramp_and_no_more() -> None:
    robot = begun("reversed-motor:7", ProfileName.SLOW, STANDING_MM)
    robot.until(lambda s: s.motor_test is not None and len(s.motor_test.findings) == 7)
    assert abs(robot.strokes_mm[6] - 8.0) < 5.0


def test_after_the_test_the_robot_is_not_stopped_and_a_run_reaches_its_end() -> None:
    robot = begun("weak-motor:8")
    ended(robot)
    stands = robot.strokes_mm
    robot.wait(3.0)
    assert robot.strokes_mm == pytest.approx(stands, abs=0.02)
    robot.machine.send(make_plan([[4.0] * MOTORS]), "Ada", robot.now)
    assert robot.until_robot(RobotState.DONE, RobotState.FAULT).robot is RobotState.DONE


@pytest.mark.parametrize("wait", [0.0, 0.3, 0.9, 1.7, 4.2, 9.0])
def test_stop_ends_the_test_holds_and_keeps_what_was_found(wait: float) -> None:
    robot = begun()
    robot.wait(wait)
    before = robot.snapshot
    robot.stop("Grace")
    sent = len(robot.sent)
    robot.wait(jog_stop_seconds(TEST_MOVE, before))
    stands = robot.strokes_mm
    stopped = robot.until_robot(RobotState.STOPPED)
    assert before.motor_test is not None
    assert stopped.motor_test is not None
    assert stopped.motor_test.state is MotorTestState.STOPPED
    assert stopped.motor_test.findings == before.motor_test.findings
    robot.wait(5.0)
    assert robot.strokes_mm == pytest.approx(stands, abs=0.02)
    assert all(message == b"<s,1>" for message in robot.sent[sent:])
    robot.machine.clear("Grace", robot.now)
    robot.until_robot(RobotState.DISARMED)
    robot.wait(2.0)
    assert robot.strokes_mm == pytest.approx(stands, abs=0.02)


def test_cancel_lets_the_motor_go_back_and_leaves_the_robot_armed() -> None:
    robot = begun()
    robot.until(lambda s: s.motor_test is not None and s.motor_test.motor == 2)
    robot.machine.end_early()
    end = robot.until_robot(RobotState.ARMED, RobotState.FAULT)
    assert (end.robot, end.last_error) == (RobotState.ARMED, None)
    assert end.motor_test is not None
    assert end.motor_test.state is MotorTestState.CANCELLED
    assert [one.motor for one in end.motor_test.findings] == [0, 1, 2]


def test_a_motor_that_may_not_move_is_not_tested_and_the_sentence_says_why() -> None:
    """With foot 2 deeper than the others, the robot stands on three feet, and each foot is one too few."""
    robot = begun("", ProfileName.NOMINAL, (8.0,) * 3 + (3.0,) * 3 + (8.0,) * 6)
    findings = ended(robot)
    untested = [one for one in findings.values() if one.verdict is MotorVerdict.NOT_TESTED]
    assert untested
    assert all("No move of 4 mm is allowed here: " in one.sentence for one in untested)
    assert all(one.moved is None and "Reset or Jog" in one.remedy for one in untested)


def test_a_motor_whose_readings_jump_ends_the_test_as_a_fault_that_names_it() -> None:
    robot = begun()
    board = robot.firmware.board
    real = board.motors.reading_mm
    board.motors.reading_mm = (  # type: ignore[method-assign]
        lambda index, now_us: real(index, now_us) + (now_us // 10_000 % 2 if index == 3 else 0)
    )
    fault = robot.until_robot(RobotState.FAULT)
    assert "reading of motor 4" in str(fault.last_error)
    assert fault.motor_test is not None
    assert fault.motor_test.state is MotorTestState.STOPPED


@pytest.mark.parametrize("fault", [Fault.UNPLUG, Fault.RESET, Fault.STALL])
def test_a_fault_of_the_cable_or_the_board_ends_the_test_and_is_named(fault: Fault) -> None:
    robot = begun()
    robot.wait(2.0)
    robot.troubles.strike(fault)

    def told(shown: RobotSnapshot) -> bool:
        return shown.robot is RobotState.FAULT or shown.link is LinkState.LOST

    end = robot.until(told, 10.0)
    assert end.motor_test is not None
    assert end.motor_test.state is MotorTestState.STOPPED
    assert end.last_error


def test_only_an_armed_robot_is_tested_and_nothing_else_moves_it_meanwhile() -> None:
    robot = VirtualRobot()
    robot.connect()
    sent = len(robot.sent)
    with pytest.raises(StateError, match="Arm the robot, then test its motors"):
        robot.machine.test_motors(WALKER, "Ada", robot.now)
    assert len(robot.sent) == sent
    robot.machine.arm("Ada")
    robot.machine.test_motors(WALKER, "Ada", robot.now)
    with pytest.raises(StateError, match="The robot is moving"):
        robot.machine.send(make_plan([[4.0] * MOTORS]), "Ada", robot.now)
    with pytest.raises(StateError, match="The robot is moving"):
        robot.machine.reset("Ada", robot.now)
    with pytest.raises(StateError, match="A motor test cannot be paused"):
        robot.machine.pause("Ada")
    ended(robot)
    assert encode_reset().decode()[1:-1] not in payloads(robot)


def test_a_new_test_begins_without_the_findings_of_the_last_one() -> None:
    robot = VirtualRobot()
    robot.connect()
    robot.machine.arm("Ada")
    robot.machine.test_motors(WALKER, "Ada", robot.now)
    assert len(ended(robot)) == MOTORS
    robot.machine.test_motors(WALKER, "Bo", robot.now)
    now = robot.snapshot.motor_test
    assert now is not None
    assert (now.by, now.findings) == ("Bo", ())
