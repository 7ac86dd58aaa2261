"""Stops that must be heard: after faults, over lost bytes and endless ramps, and until they are cleared."""

import re
from collections.abc import Callable

import pytest

from app.bridge.messages import NOT_SENT, NOT_STOPPED, clearing_sentence
from app.bridge.states import LinkState, RobotState
from app.emulator.faults import Fault
from core.errors import StateError
from core.wire.messages import encode_flush
from tests.support.virtual_robot import VirtualRobot, make_plan, payloads, random_plan

FLUSH, STOP = encode_flush(), b"<s,1>"
LONG = [[10.0] * 12, [3.0] * 12, [12.0] * 12]


def losing(count: int, what: bytes = STOP) -> Callable[[bytes], bytes]:
    """A cable that loses the first `count` messages of a kind."""
    left = [count]

    def pass_on(data: bytes) -> bytes:
        lost = data == what and left[0] > 0
        left[0] -= lost
        return b"" if lost else data

    return pass_on


def jammed_on_the_way(robot: VirtualRobot) -> None:
    robot.begin(make_plan(LONG))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.firmware.board.motors.jam(4, robot.firmware.board.now_us)


# A fault's own stop


def test_a_faults_stop_is_repeated_until_it_is_confirmed(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.to_robot = losing(2)
    snapshot = robot.until_robot(RobotState.FAULT)
    assert "Stop was sent" in snapshot.sentence
    with pytest.raises(StateError, match="not confirmed the stop yet"):
        robot.machine.clear("Ada", robot.now)
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 8.0)
    assert snapshot.robot is RobotState.FAULT
    assert "motor 5" in snapshot.sentence
    assert payloads(robot)[-1] == "s,1"
    robot.machine.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)


def test_a_faults_stop_that_is_never_heard_is_said_and_may_be_cleared(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.to_robot = losing(1000)
    robot.until_robot(RobotState.FAULT)
    snapshot = robot.until(lambda s: "NOT STOPPED" in s.sentence, 7.0)
    assert snapshot.robot is RobotState.FAULT
    assert "motor 5" in snapshot.sentence
    assert "power switch" in snapshot.sentence
    robot.until(lambda _: robot.machine.monitor.stands_still(robot.now))
    robot.machine.clear("Ada", robot.now)
    assert robot.snapshot.sentence.startswith("The robot has not confirmed the stop. Clearing")


def test_a_stop_after_a_loss_is_repeated_when_the_line_is_back(robot: VirtualRobot) -> None:
    robot.begin(random_plan(12, 20))
    robot.wait(2.0)
    robot.to_robot = robot.from_robot = lambda _: b""
    robot.until(lambda s: s.link is LinkState.LOST)
    assert robot.snapshot.robot is RobotState.FAULT
    taken = len(robot.firmware.messages)
    robot.to_robot = robot.from_robot = bytes
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 5.0)
    assert snapshot.robot is RobotState.FAULT
    assert set(payloads(robot)[taken:]) == {"s,1"}


def test_a_stop_that_a_broken_line_took_away_is_sent_on_the_next_line(robot: VirtualRobot) -> None:
    robot.begin(random_plan(13, 20))
    robot.wait(2.0)
    robot.machine.hung_up("virtual has hung up. Check the cable, then connect again.", robot.now)
    assert "connect again" in robot.snapshot.sentence
    robot.wait(7.0)
    assert "NOT STOPPED" in robot.snapshot.sentence
    assert STOP not in robot.sent
    robot.connect()
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 5.0)
    assert snapshot.robot is RobotState.FAULT
    assert "virtual has hung up" in snapshot.sentence
    assert "connect again" not in snapshot.sentence  # it has been
    assert robot.firmware.messages[-1].payload == "s,1"


def test_a_stop_that_was_not_confirmed_is_not_called_stopped_after_reconnecting(robot: VirtualRobot) -> None:
    robot.begin(random_plan(14, 20))
    robot.wait(2.0)
    robot.to_robot = losing(1000)
    robot.stop()
    robot.machine.closed()
    robot.to_robot = losing(1000, FLUSH + STOP)
    robot.connect()
    assert robot.snapshot.robot is RobotState.STOPPING
    robot.until_robot(RobotState.STOPPED)
    assert robot.firmware.messages[-1].payload == "s,1"


def test_a_stop_that_the_line_did_not_take_is_not_called_sent(robot: VirtualRobot) -> None:
    robot.begin(random_plan(15, 20))
    robot.wait(2.0)
    robot.troubles.strike(Fault.UNPLUG)
    robot.stop("Grace")
    assert robot.snapshot.robot is RobotState.STOPPING
    assert robot.snapshot.sentence == f"virtual has hung up. {NOT_SENT}"
    robot.connect()
    assert robot.until_robot(RobotState.STOPPED).stop_text == "stopped by Grace"


def test_a_persons_stop_after_a_fault_leaves_the_faults_sentence(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.until_robot(RobotState.FAULT)
    robot.stop("Grace")
    assert "motor 5" in robot.snapshot.sentence
    stopped = robot.until_robot(RobotState.STOPPED)
    assert "motor 5" in stopped.sentence
    assert stopped.stop_text == "stopped by Grace"


# Lost stops


def test_a_lost_stop_is_repeated_while_the_robot_ramps_again_and_again(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.wait(2.0)
    passes = [0]

    def shake(found: re.Match[bytes]) -> bytes:
        passes[0] += 1
        return b"j," + (b"7.0000," if passes[0] % 2 else b"7.6000,")

    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", shake, data)
    robot.to_robot = losing(1)
    lost = robot.now
    robot.stop()
    robot.until(lambda _: payloads(robot)[-1] == "s,1", 6.0)
    assert robot.now - lost < 5.0
    assert robot.sent.count(STOP) == 2


def test_an_overdue_stop_is_repeated_although_the_robot_is_silent(robot: VirtualRobot) -> None:
    robot.begin(random_plan(10, 4))
    robot.wait(1.0)
    robot.firmware.stall("test")
    robot.stop()
    robot.wait(5.5)
    assert robot.sent.count(STOP) == 1
    robot.wait(6.0)
    assert robot.sent.count(STOP) >= 3


# Clearing


@pytest.mark.parametrize("last", [b"<p,1,1.00,", b"<s,0>"])
def test_a_stop_stands_that_comes_while_one_which_was_not_confirmed_is_cleared(
    robot: VirtualRobot, last: bytes
) -> None:
    robot.begin(random_plan(3, 4))
    robot.wait(3.0)
    robot.to_robot = losing(1000)
    robot.stop()
    robot.until(lambda s: NOT_STOPPED in s.sentence)
    robot.until(lambda _: robot.machine.monitor.stands_still(robot.now))
    robot.to_robot = bytes
    robot.machine.clear("Ada", robot.now)
    robot.until(lambda _: robot.sent[-1].startswith(last))
    robot.stop("Grace")
    assert robot.snapshot.sentence.startswith("Stop was sent")
    robot.until(lambda s: s.robot is not RobotState.STOPPING)
    assert robot.snapshot.robot is RobotState.STOPPED
    assert robot.snapshot.stop_text == "stopped by Grace"
    assert payloads(robot)[-1] == "s,1"


def test_clearing_says_which_motor_it_moves(robot: VirtualRobot) -> None:
    robot.connect()
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", b"j,20.5000,", data)
    robot.wait(1.0)
    robot.machine.clear("Ada", robot.now)
    sentence = robot.snapshot.sentence
    assert "motor 1 (foot 1, motor 1 of 3) moves 1.00 mm to 19.50 mm" in sentence
    assert "no motor moves" not in sentence


@pytest.mark.parametrize(
    ("stroke_mm", "words"), [(20.3, "no motor moves"), (20.45, "moves 0.95 mm"), (-0.45, "moves 0.95 mm")]
)
def test_a_motor_within_the_robots_threshold_is_not_moved(stroke_mm: float, words: str) -> None:
    target = min(max(stroke_mm, 0.5), 19.5)
    assert words in clearing_sentence((stroke_mm,), (target,), confirmed=True)
