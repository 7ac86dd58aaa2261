"""The session on an emulated robot in virtual time: runs, stops, faults, refusals."""

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.bridge.run import start_targets
from app.bridge.states import LinkState, RobotState, RunPhase
from app.emulator.profiles import ProfileName
from core.errors import InputError, StateError
from core.wire.messages import encode_flush, encode_waypoint
from core.wire.robot_time import START_MOVE, deafness, longest_start_move
from core.wire.waypoint_path import cut_parts
from core.wire.waypoints import Waypoints
from tests.support.virtual_robot import VirtualRobot, make_plan, random_plan

SHORT = [[4.0] * 12, [6.0] * 12, [3.0, 8.0] * 6, [5.0] * 12]


def waypoints_taken(robot: VirtualRobot) -> list[tuple[float, ...]]:
    return [m.strokes_mm for m in robot.firmware.messages if m.strokes_mm is not None]


def test_connecting_says_that_the_motors_may_move_and_waits_until_the_board_is_up(
    robot: VirtualRobot,
) -> None:
    robot.gate.attach(robot)
    robot.machine.opened("virtual", robot.now)
    assert "may then move for about 8 s" in robot.snapshot.sentence
    robot.until(lambda s: s.link is LinkState.READY)
    assert robot.snapshot.robot is RobotState.DISARMED
    assert robot.now > 5.0
    assert robot.sent == [encode_flush()]


@pytest.mark.parametrize("profile", list(ProfileName))
def test_a_run_sends_exactly_the_approved_waypoints_and_reaches_each(profile: ProfileName) -> None:
    robot, plan = VirtualRobot(profile), random_plan(1, 12)
    robot.begin(plan)
    snapshot = robot.until_robot(RobotState.DONE, RobotState.FAULT)
    assert snapshot.robot is RobotState.DONE, snapshot.last_error
    expected = [encode_waypoint(s, 0.4) for s in plan.waypoints.strokes]
    assert robot.sent[-12:] == expected
    np.testing.assert_allclose(waypoints_taken(robot)[-12:], plan.waypoints.strokes_mm, atol=1e-5)
    assert len(robot.sent) - 1 == len(waypoints_taken(robot)) == len(robot.firmware.completions) - 1
    assert max(c.worst_mm for c in robot.firmware.completions[-12:]) <= 1.0
    assert snapshot.run is not None
    assert (snapshot.run.sent, snapshot.run.reached, snapshot.run.count) == (12, 12, 12)


@pytest.mark.parametrize("start_mm", [0.0, 7.3, 20.0])
def test_the_way_to_the_start_pose_is_cut_into_small_moves_that_the_firmware_makes(start_mm: float) -> None:
    robot, plan = VirtualRobot(strokes_mm=(start_mm,) * 12), make_plan([[18.2] * 12])
    robot.begin(plan)
    assert robot.snapshot.run is not None
    assert robot.snapshot.run.phase is RunPhase.START_POSE
    robot.until_robot(RobotState.DONE)
    path = np.array(waypoints_taken(robot))
    moves = np.abs(np.diff(path, axis=0)).max(axis=1)
    assert moves[:-1].max() <= START_MOVE * 1000.0 + 1e-4
    assert moves[:-1].min() > 1.0
    assert moves[-1] == 0.0


def test_the_start_pose_is_left_out_when_the_robot_stands_there(robot: VirtualRobot) -> None:
    robot.begin(make_plan([[1.2] * 12, [4.0] * 12]))
    robot.until_robot(RobotState.DONE)
    assert len(robot.sent) == 3


@given(st.floats(0.0, 12.0))
def test_a_stop_at_any_time_ends_the_run_for_good(delay: float) -> None:
    robot, plan = VirtualRobot(), random_plan(2, 8)
    robot.begin(plan)
    robot.wait(delay)
    robot.stop("Grace")
    began = robot.now
    snapshot = robot.until_robot(RobotState.STOPPED)
    longest = deafness(plan.waypoints, 0.5, start_move=0.003)
    assert robot.now - began < longest + 0.5
    assert snapshot.stop_text is not None
    assert snapshot.stop_text.endswith("s by Grace")
    strokes = robot.strokes_mm
    robot.wait(5.0)
    assert robot.strokes_mm == strokes
    assert robot.sent.count(b"<s,1>") == 1
    assert robot.sent[-1] == b"<s,1>"
    assert robot.snapshot.robot is RobotState.STOPPED


def test_a_stop_may_be_pressed_twice(robot: VirtualRobot) -> None:
    robot.begin(random_plan(3, 5))
    robot.wait(2.0)
    robot.stop("Ada")
    text = robot.snapshot.stop_text
    robot.stop("Grace")
    robot.until_robot(RobotState.STOPPED)
    robot.stop("Alan")
    assert robot.snapshot.stop_text == text
    assert robot.snapshot.robot is RobotState.STOPPED


@pytest.mark.parametrize("start_mm", [0.5, 0.0, 20.0])
def test_clear_moves_nothing_and_the_robot_runs_again_after_arming(start_mm: float) -> None:
    robot = VirtualRobot(strokes_mm=(start_mm,) * 12)
    robot.begin(make_plan([[19.5] * 12, [0.5] * 12, [19.5] * 12]))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.wait(1.0)
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    strokes = robot.strokes_mm
    robot.machine.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)
    robot.wait(3.0)
    assert robot.strokes_mm == strokes
    assert robot.snapshot.stop_text is None
    assert robot.sent[-1] == b"<s,0>"
    robot.machine.arm("Ada")
    robot.machine.send(make_plan(SHORT), "Ada", robot.now)
    assert robot.until_robot(RobotState.DONE, RobotState.FAULT).robot is RobotState.DONE


def test_a_stop_while_clearing_keeps_the_robot_stopped(robot: VirtualRobot) -> None:
    robot.begin(random_plan(4, 4))
    robot.wait(1.0)
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    robot.machine.clear("Ada", robot.now)
    robot.stop("Grace")
    robot.until_robot(RobotState.STOPPED)
    assert b"<s,0>" not in robot.sent


def test_a_stop_is_latched_even_over_a_new_connection(robot: VirtualRobot) -> None:
    robot.begin(random_plan(5, 4))
    robot.wait(2.0)
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    robot.machine.closed()
    robot.connect()
    assert robot.snapshot.robot is RobotState.STOPPED
    with pytest.raises(StateError, match="stopped"):
        robot.machine.arm("Ada")


def test_an_edited_plan_is_refused(robot: VirtualRobot) -> None:
    robot.arm()
    plan = make_plan(SHORT)
    edited = replace(plan, waypoints=random_plan(6, 4).waypoints)
    with pytest.raises(StateError, match="not the ones that were approved"):
        robot.machine.send(edited, "Ada", robot.now)
    assert robot.sent == [encode_flush()]
    assert robot.snapshot.robot is RobotState.ARMED


def test_a_plan_out_of_range_is_refused_before_anything_is_sent(robot: VirtualRobot) -> None:
    robot.arm()
    with pytest.raises(InputError, match="motor 12"):
        robot.machine.send(make_plan([*SHORT, [5.0] * 11 + [19.6]]), "Ada", robot.now)
    assert robot.sent == [encode_flush()]


def wish(robot: VirtualRobot, verb: str) -> None:
    machine = robot.machine
    wishes: dict[str, Callable[[], object]] = {
        "arm": lambda: machine.arm("Ada"),
        "send": lambda: machine.send(make_plan(SHORT), "Ada", robot.now),
        "reset": lambda: machine.reset("Ada", robot.now),
        "pause": lambda: machine.pause("Ada"),
        "resume": lambda: machine.resume("Ada", robot.now),
        "clear": lambda: machine.clear("Ada", robot.now),
    }
    wishes[verb]()


@pytest.mark.parametrize("verb", ["send", "reset", "pause", "resume", "clear"])
def test_a_robot_that_is_not_armed_refuses_with_a_sentence(robot: VirtualRobot, verb: str) -> None:
    robot.connect()
    with pytest.raises(StateError, match="disarmed"):
        wish(robot, verb)


@pytest.mark.parametrize("verb", ["arm", "reset", "clear"])
def test_a_robot_that_is_not_connected_refuses_with_a_sentence(robot: VirtualRobot, verb: str) -> None:
    with pytest.raises(StateError, match="Connect it"):
        wish(robot, verb)


UNREADABLE = b"j,99.0000,"
"""The beginning of a telemetry line that no motor can have sent."""


@pytest.mark.parametrize("verb", ["send", "reset"])
def test_what_moves_the_robot_needs_to_know_where_it_stands_now(robot: VirtualRobot, verb: str) -> None:
    robot.arm()
    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", UNREADABLE, data)
    robot.wait(1.5)
    with pytest.raises(StateError, match="not reported its strokes for more than 1"):
        wish(robot, verb)
    assert robot.snapshot.robot is RobotState.ARMED
    assert robot.sent == [encode_flush()]


def test_a_pause_does_not_end_before_it_is_known_where_the_robot_stands(robot: VirtualRobot) -> None:
    robot.begin(make_plan(SHORT))
    robot.machine.pause("Ada")
    robot.until_robot(RobotState.PAUSED)
    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", UNREADABLE, data)
    robot.wait(1.5)
    with pytest.raises(StateError, match="not reported its strokes"):
        robot.machine.resume("Ada", robot.now)
    robot.from_robot = bytes
    robot.wait(0.2)
    robot.machine.resume("Ada", robot.now)
    assert robot.snapshot.robot is RobotState.MOVING


def test_a_robot_that_was_disarmed_needs_arming_again(robot: VirtualRobot) -> None:
    robot.arm()
    robot.machine.disarm("Ada")
    with pytest.raises(StateError, match="The robot is disarmed"):
        robot.machine.send(random_plan(1, 2), "Ada", robot.now)
    robot.machine.arm("Ada")
    robot.machine.send(random_plan(1, 2), "Ada", robot.now)
    robot.machine.disarm("Ada")
    assert robot.until_robot(RobotState.DONE).run is not None


def test_a_finished_run_needs_arming_again(robot: VirtualRobot) -> None:
    robot.begin(make_plan(SHORT))
    robot.until_robot(RobotState.DONE)
    with pytest.raises(StateError, match="Arm the robot"):
        robot.machine.send(make_plan(SHORT), "Ada", robot.now)


def test_a_pause_ends_at_the_next_pose_with_all_feet_down_and_resume_goes_on(robot: VirtualRobot) -> None:
    robot.begin(make_plan(SHORT, [False, False, True, True]))
    robot.until(lambda s: s.run is not None and s.run.sent == 1)
    robot.machine.pause("Ada")
    paused = robot.until_robot(RobotState.PAUSED)
    assert paused.run is not None
    assert paused.run.reached == 3
    robot.wait(5.0)
    assert robot.snapshot.run is not None
    assert robot.snapshot.run.sent == 3
    robot.machine.resume("Ada", robot.now)
    robot.until_robot(RobotState.DONE)


def test_reset_draws_every_motor_in_and_leaves_the_robot_armed(robot: VirtualRobot) -> None:
    robot.begin(make_plan(SHORT))
    robot.until_robot(RobotState.DONE)
    robot.machine.arm("Ada")
    robot.machine.reset("Ada", robot.now)
    robot.until_robot(RobotState.ARMED)
    assert robot.strokes_mm == pytest.approx([0.5] * 12, abs=1.0)


def test_a_stuck_motor_is_a_fault_that_names_it(robot: VirtualRobot) -> None:
    robot.begin(make_plan(SHORT))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.firmware.board.motors.jam(7, robot.firmware.board.now_us)
    snapshot = robot.until_robot(RobotState.FAULT)
    assert snapshot.last_error is not None
    assert "motor 8 (foot 3, motor 2 of 3)" in snapshot.last_error
    assert robot.sent[-1] == b"<s,1>"


def test_a_stalled_robot_is_lost_within_the_limit_of_silence(robot: VirtualRobot) -> None:
    robot.begin(random_plan(7, 4))
    robot.wait(3.0)
    robot.firmware.stall("test")
    stalled = robot.now
    snapshot = robot.until(lambda s: s.link is LinkState.LOST)
    assert robot.now - stalled < 4.2
    assert snapshot.robot is RobotState.FAULT
    assert "silent" in snapshot.sentence


def test_a_restart_of_the_board_is_recognised_and_can_be_cleared(robot: VirtualRobot) -> None:
    robot.begin(random_plan(8, 4))
    robot.wait(3.0)
    robot.firmware.reset()
    robot.until(lambda s: s.last_error is not None and "restarted" in s.last_error)
    robot.until(lambda s: s.link is LinkState.READY)
    assert robot.snapshot.robot is RobotState.FAULT
    robot.wait(1.0)
    robot.machine.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)


def test_a_robot_that_holds_an_old_stop_is_found_out_and_can_be_cleared(robot: VirtualRobot) -> None:
    robot.arm()
    robot.write(b"<s,1>")
    robot.wait(0.5)
    robot.machine.send(make_plan(SHORT), "Ada", robot.now)
    snapshot = robot.until_robot(RobotState.FAULT)
    assert snapshot.last_error is not None
    assert "old stop" in snapshot.last_error
    robot.wait(1.0)
    robot.machine.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)


def test_a_message_changed_on_its_way_is_noticed_and_only_a_stop_follows(robot: VirtualRobot) -> None:
    robot.arm()
    robot.to_robot = lambda data: data.replace(b"6.0000", b"6.0010", 1)
    robot.machine.send(make_plan(SHORT), "Ada", robot.now)
    snapshot = robot.until_robot(RobotState.FAULT)
    assert snapshot.last_error is not None
    assert "was sent" in snapshot.last_error
    robot.wait(5.0)
    assert robot.sent[-1] == b"<s,1>"


@given(st.integers(0, 2**32 - 1))
def test_bytes_lost_on_the_way_never_let_a_waypoint_be_skipped(seed: int) -> None:
    robot, plan, rng = VirtualRobot(), make_plan(SHORT), np.random.default_rng(seed)
    robot.begin(plan)
    robot.from_robot = lambda data: bytes(b for b in data if rng.random() > 2e-4)
    snapshot = robot.until_robot(RobotState.DONE, RobotState.FAULT)
    taken = waypoints_taken(robot)
    assert snapshot.run is not None
    assert snapshot.run.reached <= len(robot.firmware.completions)
    sent = snapshot.run.sent
    streamed = np.reshape(taken[len(taken) - sent :], (-1, 12))
    np.testing.assert_allclose(streamed, plan.waypoints.strokes_mm[:sent], atol=1e-5)


def test_something_that_is_no_robot_is_said_to_be_none(robot: VirtualRobot) -> None:
    robot.from_robot = lambda data: b"hello\r\n" if data else b""
    robot.gate.attach(robot)
    robot.machine.opened("virtual", robot.now)
    snapshot = robot.until(lambda s: s.link is LinkState.LOST)
    assert "answered like the robot" in snapshot.sentence
    assert snapshot.unknown_lines > 10


def test_a_stop_that_gets_lost_is_sent_again(robot: VirtualRobot) -> None:
    robot.begin(random_plan(9, 4))
    robot.wait(1.0)
    robot.to_robot = lambda _: b""
    robot.stop()
    robot.wait(3.0)
    robot.to_robot = bytes
    robot.until_robot(RobotState.STOPPED)


def test_a_stop_that_nobody_confirms_is_shown_as_not_stopped(robot: VirtualRobot) -> None:
    robot.begin(random_plan(10, 4))
    robot.wait(1.0)
    robot.firmware.stall("test")
    robot.stop()
    robot.wait(7.0)
    assert robot.snapshot.robot is RobotState.STOPPING
    assert "NOT STOPPED" in robot.snapshot.sentence


@pytest.mark.parametrize("bound", [0.8, 1.0])
def test_the_way_to_the_start_pose_keeps_the_plan_s_stop_bound(bound: float) -> None:
    rows = np.array([[2.0] * 12, [12.0] * 12]) / 1000.0
    parts = cut_parts(Waypoints(rows.reshape(-1, 4, 3), np.full(2, 0.4)), bound)
    ways = np.linspace(rows[0], rows[1], int(parts[1]) + 1).reshape(-1, 4, 3)
    bounded = Waypoints(ways, np.full(len(ways), 0.4))
    longest = longest_start_move(bounded)
    assert 0.002 <= longest <= START_MOVE
    assert deafness(bounded, start_move=longest) <= bound
    targets = [(0.5,) * 12, *start_targets((0.5,) * 12, (12.0,) * 12, longest * 1000.0)]
    moves = np.abs(np.diff(np.array(targets), axis=0)).max(axis=1)
    assert moves.max() <= longest * 1000.0 + 1e-4
    assert moves.min() > 1.0
