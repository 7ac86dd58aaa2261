"""Serial devices: found again under another name, remembered, and told from the robot."""

import json
import threading
import time
from contextlib import closing
from pathlib import Path

import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.devices import SerialDevice, found_again
from app.bridge.states import LinkState, RobotSnapshot
from app.bridge.transport import serial_devices
from app.emulator.faults import Fault, FaultRequest
from app.emulator.ports import PtyPort, TcpPort
from app.robot.ports import RobotPorts
from tests.support.patience import patient_robot
from tests.support.virtual_robot import VirtualRobot

PATIENCE = 60.0
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


class FastClock:
    """Lets so many seconds pass in a real one."""

    def __init__(self, speed: float) -> None:
        self._speed = speed

    def __call__(self) -> float:
        return time.monotonic() * self._speed


def opened(from_robot: bytes) -> VirtualRobot:
    robot = VirtualRobot()
    robot.from_robot = lambda data: from_robot if data else b""
    robot.gate.attach(robot)
    robot.machine.opened("/dev/ttyACM0", robot.now)
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


def until_link(bridge: RobotBridge, link: LinkState) -> RobotSnapshot:
    reached = threading.Event()
    unsubscribe = bridge.subscribe(lambda shown: reached.set() if shown.link is link else None)
    assert reached.wait(PATIENCE), bridge.snapshot
    unsubscribe()
    return bridge.snapshot


def test_a_board_that_comes_back_under_another_name_is_found_and_answers(tmp_path: Path) -> None:
    first, second = tmp_path / "ttyACM0", tmp_path / "ttyACM1"
    present: list[SerialDevice] = []
    ports = RobotPorts(tmp_path / "robot.json", lambda: tuple(present))
    with closing(RobotBridge()) as bridge:
        for name in (first, second):
            with patient_robot(20.0, booted=True) as robot:
                name.symlink_to(robot.device)
                present[:] = [SerialDevice(str(name), "Feather M0", "F00D")]
                device = str(name) if name is first else ports.view(is_lost=True)["again"]["device"]
                bridge.connect(device)
                ports.connected(device)
                assert until_link(bridge, LinkState.READY).device == str(name)
                robot.inject(FaultRequest(Fault.UNPLUG))
                until_link(bridge, LinkState.LOST)
                name.unlink()


@pytest.mark.parametrize("port", [PtyPort, TcpPort])
def test_a_device_that_is_no_robot_is_recognised_on_every_kind_of_line(port: type[PtyPort | TcpPort]) -> None:
    other, asked = port(), []
    bridge = RobotBridge(clock=FastClock(20.0))
    bridge.connect(other.device)
    lost = threading.Event()
    bridge.subscribe(lambda shown: lost.set() if shown.link is LinkState.LOST else None)
    deadline = time.monotonic() + PATIENCE
    while not lost.wait(0.01) and time.monotonic() < deadline:
        asked.append(other.read())
        other.write(b"$GPGGA,123519\r\n")
    assert f"Something on {other.device} sends" in bridge.snapshot.sentence
    assert b"".join(asked) == b""
    bridge.close()
    other.close()
