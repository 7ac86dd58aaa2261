"""One message at a time, whoever asks for the next: only a stop may overtake it."""

from collections.abc import Callable
from contextlib import suppress

import numpy as np
import pytest

from app.bridge.jog import JogPlan
from app.bridge.states import RobotState
from app.emulator.profiles import ProfileName
from core.errors import StateError
from core.robot.model import load_robot
from core.wire.messages import encode_flush, encode_stop
from tests.support.virtual_robot import VirtualRobot, make_plan

OVERTAKING = (encode_stop(), encode_flush(), encode_flush() + encode_stop())
WALKER = load_robot("deltawalker")
PLAN = make_plan([[4.0] * 12, [7.0] * 12])


def jog(robot: VirtualRobot) -> None:
    strokes = np.array(robot.machine.monitor.strokes_mm).reshape(4, 3) / 1000.0
    robot.machine.jog(JogPlan("all", strokes, [strokes + 0.002]), "Ada", robot.now)


COMMANDS: dict[str, Callable[[VirtualRobot], object]] = {
    "arm": lambda robot: robot.machine.arm("Ada"),
    "send": lambda robot: robot.machine.send(PLAN, "Ada", robot.now),
    "reset": lambda robot: robot.machine.reset("Ada", robot.now),
    "jog": jog,
    "test": lambda robot: robot.machine.test_motors(WALKER, "Ada", robot.now),
    "pause": lambda robot: robot.machine.pause("Ada"),
    "resume": lambda robot: robot.machine.resume("Ada", robot.now),
    "end early": lambda robot: robot.machine.end_early(),
    "clear": lambda robot: robot.machine.clear("Ada", robot.now),
}
BEGINNINGS = {
    "arm": RobotState.DISARMED,
    "send": RobotState.ARMED,
    "reset": RobotState.ARMED,
    "jog": RobotState.ARMED,
    "test": RobotState.ARMED,
    "resume": RobotState.PAUSED,
    "clear": RobotState.STOPPED,
}


class Wire:
    """Counts the messages that the robot has not taken yet when the next one goes out."""

    def __init__(self, robot: VirtualRobot) -> None:
        self._robot = robot
        self._sent = 0
        self._before = self._taken
        self.most = 0
        robot.to_robot = self._count

    @property
    def _taken(self) -> int:
        return sum(message.payload != "s,1" for message in self._robot.firmware.messages)

    def _count(self, data: bytes) -> bytes:
        if data not in OVERTAKING:
            self._sent += 1
            self.most = max(self.most, self._sent - self._taken + self._before)
        return data


def robot_in(state: RobotState) -> VirtualRobot:
    robot = VirtualRobot(ProfileName.SLOW)
    robot.boot()
    robot.connect()
    if state is RobotState.DISARMED:
        return robot
    robot.machine.arm("Ada")
    if state is RobotState.PAUSED:
        robot.machine.send(PLAN, "Ada", robot.now)
        robot.machine.pause("Ada")
        robot.until_robot(state)
    elif state is RobotState.STOPPED:
        robot.stop()
        robot.until_robot(state)
    robot.wait(0.4)
    return robot


@pytest.mark.parametrize("delay", [0.0, 0.01, 0.02])
@pytest.mark.parametrize("first", BEGINNINGS)
def test_whatever_is_asked_for_next_one_message_is_in_flight(first: str, delay: float) -> None:
    robot = robot_in(BEGINNINGS[first])
    wire = Wire(robot)
    COMMANDS[first](robot)
    for command in (*COMMANDS, first, *COMMANDS):
        robot.wait(delay)
        with suppress(StateError):
            COMMANDS[command](robot)
    robot.wait(2.0)
    assert wire.most <= 1


def test_a_second_clear_is_refused_and_the_first_goes_on() -> None:
    robot = robot_in(RobotState.STOPPED)
    robot.machine.clear("Ada", robot.now)
    sent, changes = len(robot.sent), len(robot.machine.transitions)
    with pytest.raises(StateError, match="still busy with the message that was sent last"):
        robot.machine.clear("Grace", robot.now)
    assert (len(robot.sent), len(robot.machine.transitions)) == (sent, changes)
    robot.until_robot(RobotState.DISARMED)
    assert [data[:3] for data in robot.sent[sent - 1 :]] == [b"<p,", b"<s,"]


@pytest.mark.parametrize("seconds", [0.0, 0.01, 0.02])
def test_a_stop_overtakes_every_message(seconds: float) -> None:
    for first, state in BEGINNINGS.items():
        robot = robot_in(state)
        COMMANDS[first](robot)
        robot.wait(seconds)
        robot.stop()
        before = len(robot.sent) - 1
        robot.until_robot(RobotState.STOPPED)
        assert set(robot.sent[before:]) == {encode_stop()}
