"""Serial devices: found again under another name, remembered, and told from the robot."""

import json
from pathlib import Path

import pytest

from app.bridge.devices import SerialDevice, found_again
from app.bridge.states import LinkState
from app.bridge.transport import serial_devices
from app.robot_ports import RobotPorts
from tests.bridge.virtual_robot import VirtualRobot

BOARD = SerialDevice("/dev/ttyACM0", "Feather M0", "F00D")
MOVED = SerialDevice("/dev/ttyACM1", "Feather M0", "F00D")
OTHER = SerialDevice("/dev/ttyACM0", "Feather M0", "BEEF")
BARE = SerialDevice("/dev/ttyUSB0", "CH340")


@pytest.mark.parametrize(
    ("lost", "present", "where"),
    [
        (BOARD, [OTHER, MOVED], MOVED),
        (BOARD, [BOARD], BOARD),
        (BOARD, [MOVED, BOARD], BOARD),
        (BOARD, [OTHER, BARE], None),
        (BOARD, [], None),
        (BARE, [BARE], None),
        (
            SerialDevice("/dev/a", "", "1"),
            [SerialDevice("/dev/b", "", "1"), SerialDevice("/dev/c", "", "1")],
            None,
        ),
    ],
)
def test_a_board_is_found_again_by_its_serial_number_alone(
    lost: SerialDevice, present: list[SerialDevice], where: SerialDevice | None
) -> None:
    assert found_again(lost, present) == where


def test_the_last_device_is_remembered_over_a_restart_and_offered_where_it_is_now(tmp_path: Path) -> None:
    present = [BOARD, BARE]
    ports = RobotPorts(tmp_path / "robot.json", lambda: tuple(present))
    assert ports.view(is_lost=True) == {"ports": [vars(BOARD), vars(BARE)], "last": None, "again": None}
    ports.connected(BOARD.device)
    present[:] = [OTHER, MOVED]
    again = RobotPorts(tmp_path / "robot.json", lambda: tuple(present))
    assert again.view(is_lost=False)["again"] is None
    view = again.view(is_lost=True)
    assert view["last"] == vars(BOARD)
    assert view["again"]["device"] == "/dev/ttyACM1"
    assert view["again"]["sentence"] == (
        "The board that was at /dev/ttyACM0 is at /dev/ttyACM1 now (serial number F00D)."
    )


def test_a_device_that_is_on_no_list_is_remembered_by_its_name(tmp_path: Path) -> None:
    ports = RobotPorts(tmp_path / "robot.json", lambda: ())
    ports.connected("socket://127.0.0.1:9")
    kept = json.loads((tmp_path / "robot.json").read_text())
    assert kept == {"device": "socket://127.0.0.1:9", "description": "", "serial_number": None}
    assert ports.view(is_lost=True)["again"] is None


@pytest.mark.parametrize("text", ["", "[]", '{"device": 3}'])
def test_a_damaged_memory_is_left_aside(tmp_path: Path, text: str) -> None:
    (tmp_path / "robot.json").write_text(text)
    assert RobotPorts(tmp_path / "robot.json", lambda: ()).view(is_lost=False)["last"] is None


def test_the_devices_of_this_computer_can_be_listed() -> None:
    assert all(one.device for one in serial_devices())


def opened(from_robot: bytes) -> VirtualRobot:
    robot = VirtualRobot()
    robot.from_robot = lambda data: from_robot if data else b""
    robot.gate.attach(robot)
    robot.session.opened("/dev/ttyACM0", robot.now)
    return robot


def test_another_device_is_told_from_a_line_on_which_nothing_comes() -> None:
    other = opened(b"$GPGGA,123519\r\n").until(lambda s: s.link is LinkState.LOST)
    assert "Something on /dev/ttyACM0 sends" in other.sentence
    assert "it is another device. Choose the robot's" in other.sentence
    nothing = opened(b"").until(lambda s: s.link is LinkState.LOST)
    assert "not a byte came. Check power and cable" in nothing.sentence


def test_nothing_is_sent_to_what_is_no_robot() -> None:
    other = opened(b"$GPGGA,123519\r\n")
    other.until(lambda s: s.link is LinkState.LOST)
    assert other.sent == []
