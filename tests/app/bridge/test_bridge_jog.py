"""Steps by hand on an emulated robot in virtual time: what is sent, believed, stopped and refused."""

from __future__ import annotations

import numpy as np
import pytest

from app.bridge.jog import JogPlan
from app.bridge.states import LinkState, RobotState
from app.bridge.write_gate import MessageKind, WriteGate
from app.emulator.profiles import ProfileName
from app.robot.views import jog_stop_seconds
from core.errors import InputError, StateError
from core.jog.check import check_jog
from core.jog.steps import JogPart, JogStep
from core.robot.model import load_robot
from core.wire.messages import encode_release, encode_reset, encode_stop, encode_waypoint
from tests.support.virtual_robot import VirtualRobot, make_plan

WALKER = load_robot("deltawalker")
RAISE = JogStep(JogPart.MOTOR, 0.007, 1, 2)
"""Motor 3 of foot 2 by 7 mm, in three moves."""


def jog_plan(robot: VirtualRobot, *steps: JogStep) -> JogPlan:
    """The steps from where the robot stands."""
    strokes = robot.snapshot.strokes
    assert strokes is not None
    measured = np.array(strokes).reshape(4, 3)
    return JogPlan(
        "motor 3 of foot 2 by +7.0 mm", measured, check_jog(WALKER, measured, steps or (RAISE,)).way
    )


def armed(profile: ProfileName = ProfileName.PUBLISHED) -> VirtualRobot:
    robot = VirtualRobot(profile)
    robot.arm()
    robot.until(lambda s: robot.machine.monitor.stands_still(robot.now))
    return robot


@pytest.mark.parametrize("profile", list(ProfileName))
def test_a_jog_moves_one_motor_in_small_moves_and_leaves_the_robot_armed(profile: ProfileName) -> None:
    robot = armed(profile)
    before, sent = robot.strokes_mm, len(robot.sent)
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    moving = robot.snapshot
    assert (moving.robot, moving.run) == (RobotState.MOVING, None)
    assert moving.jog is not None
    assert (moving.jog.reached, moving.jog.count, moving.jog.by) == (0, 3, "Ada")
    assert moving.sentence == "Jog: motor 3 of foot 2 by +7.0 mm."
    done = robot.until_robot(RobotState.ARMED, RobotState.FAULT)
    assert (done.robot, done.jog) == (RobotState.ARMED, None), done.last_error
    assert len(robot.sent) - sent == 3
    gone = np.array(robot.strokes_mm) - before
    assert gone[5] == pytest.approx(7.0, abs=1.0)
    assert np.abs(np.delete(gone, 5)).max() < 0.5
    assert robot.machine.transitions[-2].cause == "Jog by Ada: motor 3 of foot 2 by +7.0 mm."


def test_a_jog_may_follow_a_jog_and_then_a_run() -> None:
    robot = armed()
    for _ in range(2):
        robot.until(lambda s: robot.machine.monitor.stands_still(robot.now))
        robot.machine.jog(jog_plan(robot), "Ada", robot.now)
        assert robot.until_robot(RobotState.ARMED, RobotState.FAULT).robot is RobotState.ARMED
    robot.machine.send(make_plan([[4.0] * 12]), "Ada", robot.now)
    assert robot.until_robot(RobotState.DONE, RobotState.FAULT).robot is RobotState.DONE


@pytest.mark.parametrize("wait", [0.0, 0.4, 1.5])
def test_a_stop_in_the_middle_of_a_jog_holds_and_nothing_resumes(wait: float) -> None:
    robot = armed()
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    robot.wait(wait)
    robot.stop("Grace")
    sent = robot.sent
    stopped = robot.until_robot(RobotState.STOPPED)
    assert (stopped.jog, stopped.stop_text) == (None, "stopped by Grace")
    robot.machine.clear("Grace", robot.now)
    robot.until_robot(RobotState.DISARMED)
    robot.machine.arm("Grace")
    stands = robot.strokes_mm
    robot.wait(5.0)
    assert robot.strokes_mm == pytest.approx(stands, abs=0.02)
    assert [m for m in robot.sent[len(sent) :] if not m.startswith((b"<p", b"<s,0", b"<s,1"))] == []
    assert len(robot.sent) - len(sent) <= 3


@pytest.mark.parametrize("profile", [ProfileName.SLOW, ProfileName.PUBLISHED])
def test_motors_stand_within_the_stop_time_that_is_stated_of_a_jog(profile: ProfileName) -> None:
    for number in range(15):
        robot = armed(profile)
        robot.machine.jog(jog_plan(robot), "Ada", robot.now)
        robot.wait(number * 0.137)
        shown = robot.snapshot
        assert shown.jog is not None
        stated = jog_stop_seconds(shown.jog.largest_move, shown)
        assert stated < 1.2
        robot.stop("Grace")
        robot.wait(stated)
        stands = robot.strokes_mm
        robot.wait(1.0)
        assert robot.strokes_mm == pytest.approx(stands, abs=0.02)


def test_a_jog_that_is_not_reached_ends_as_a_fault_that_names_it() -> None:
    robot = armed()
    board = robot.firmware.board
    board.motors.jam(5, board.now_us)
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    fault = robot.until_robot(RobotState.FAULT)
    assert fault.jog is None
    assert "motor 6 (foot 2, motor 3 of 3)" in str(fault.last_error)
    assert "In move 1 of 3 of a jog of motor 3 of foot 2" in str(fault.last_error)


def test_a_jog_that_is_ended_early_sends_no_further_move_and_leaves_the_robot_armed() -> None:
    robot = armed()
    before, sent = robot.strokes_mm, len(robot.sent)
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    robot.wait(0.3)
    robot.machine.end_early()
    ended = robot.until_robot(RobotState.ARMED, RobotState.FAULT)
    assert (ended.robot, ended.jog) == (RobotState.ARMED, None), ended.last_error
    assert len(robot.sent) - sent == 1
    assert robot.strokes_mm[5] - before[5] == pytest.approx(7.0 / 3, abs=1.0)
    robot.machine.end_early()
    assert robot.snapshot.robot is RobotState.ARMED


def test_a_jog_whose_cable_comes_out_ends_as_a_fault() -> None:
    robot = armed()
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    robot.wait(0.5)
    robot.machine.hung_up("virtual has hung up.", robot.now)
    lost = robot.snapshot
    assert (lost.link, lost.robot, lost.jog) == (LinkState.LOST, RobotState.FAULT, None)


def test_only_an_armed_robot_that_stands_still_is_jogged() -> None:
    robot = VirtualRobot()
    robot.connect()
    plan = jog_plan(robot)
    with pytest.raises(StateError, match="Arm the robot"):
        robot.machine.jog(plan, "Ada", robot.now)
    robot.machine.arm("Ada")
    robot.machine.send(make_plan([[4.0] * 12]), "Ada", robot.now)
    with pytest.raises(StateError, match="The robot is moving"):
        robot.machine.jog(plan, "Ada", robot.now)
    robot.stop()
    with pytest.raises(StateError, match="The robot is stopping"):
        robot.machine.jog(plan, "Ada", robot.now)


def test_a_robot_that_is_pushed_by_hand_is_not_jogged_before_it_stands() -> None:
    robot = armed()
    board = robot.firmware.board
    board.motors.command(0, 40, board.now_us)
    robot.wait(0.5)
    with pytest.raises(StateError, match="does not stand still"):
        robot.machine.jog(jog_plan(robot), "Ada", robot.now)


def test_a_jog_that_was_worked_out_elsewhere_is_refused() -> None:
    robot = armed()
    plan = jog_plan(robot)
    elsewhere = JogPlan(plan.text, plan.start + 0.0006, plan.way)
    with pytest.raises(StateError, match=r"0\.60 mm from where it stood when this jog was planned"):
        robot.machine.jog(elsewhere, "Ada", robot.now)
    assert robot.snapshot.robot is RobotState.ARMED


@pytest.mark.parametrize("outside_mm", [0.4, 19.6, float("nan")])
def test_a_jog_out_of_range_sends_nothing_at_all(outside_mm: float) -> None:
    robot = armed()
    plan, sent = jog_plan(robot), len(robot.sent)
    last = np.array(plan.way[-1])
    last[0, 0] = outside_mm / 1000.0
    with pytest.raises(InputError):
        robot.machine.jog(JogPlan(plan.text, plan.start, (*plan.way, last)), "Ada", robot.now)
    assert len(robot.sent) == sent
    assert robot.snapshot.robot is RobotState.ARMED


def test_a_jog_without_a_move_is_refused() -> None:
    robot = armed()
    with pytest.raises(InputError, match="moves nothing"):
        robot.machine.jog(JogPlan("nothing", jog_plan(robot).start, ()), "Ada", robot.now)


def test_a_jog_is_not_paused() -> None:
    robot = armed()
    robot.machine.jog(jog_plan(robot), "Ada", robot.now)
    with pytest.raises(StateError, match="A jog cannot be paused"):
        robot.machine.pause("Ada")


WAYPOINT = encode_waypoint(np.full((4, 3), 0.005), 1.0)
BY_KIND = {
    MessageKind.WAYPOINT: {WAYPOINT},
    MessageKind.JOG: {WAYPOINT},
    MessageKind.TEST: {WAYPOINT, encode_stop(), encode_release()},
    MessageKind.RESET: {encode_reset()},
    MessageKind.CLEAR: {WAYPOINT, encode_release()},
}


@pytest.mark.parametrize("kind", list(MessageKind))
@pytest.mark.parametrize("message", [WAYPOINT, encode_reset(), encode_release(), encode_stop(), b"<p,2,1"])
def test_the_gate_lets_a_message_out_as_what_it_is_and_as_nothing_else(
    kind: MessageKind, message: bytes
) -> None:
    gate = WriteGate(lambda way, data, when: None, lambda: 0.0)
    if message in BY_KIND[kind]:
        assert not gate.write(message, gate.permit(), kind)
    else:
        with pytest.raises(InputError, match="is not"):
            gate.write(message, gate.permit(), kind)
