"""Lines as such: which are refused by name, what is said of one that takes nothing, and who comes next."""

import os
import threading
from pathlib import Path

import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.states import LinkState
from app.bridge.transport import Transport
from app.emulator.emulated_robot import start_emulator
from app.emulator.ports import PtyPort
from core.errors import InputError, RobotError

PATIENCE = 60.0


@pytest.mark.parametrize("device", ["/dev/no-robot-here", "socket://127.0.0.1:9", os.devnull])
def test_a_device_that_is_no_line_is_refused_by_name(device: str) -> None:
    bridge = RobotBridge()
    with pytest.raises(RobotError, match=device):
        bridge.connect(device)
    assert bridge.snapshot.link is LinkState.DISCONNECTED
    assert bridge.snapshot.last_error is not None
    bridge.stop("Ada")
    bridge.close()


def test_an_address_that_is_no_line_is_refused_before_anything_is_opened(tmp_path: Path) -> None:
    written = tmp_path / "written"
    for device in (f"spy:///dev/null?file={written}", "loop://", "rfc2217://127.0.0.1:9"):
        with pytest.raises(InputError, match="is not a line to a robot"):
            Transport(device, lambda _: None, lambda _: None)
    assert not written.exists()


def test_a_line_that_takes_nothing_more_is_said_to() -> None:
    port = PtyPort()
    line = Transport(port.device, lambda _: None, lambda _: None)
    with pytest.raises(RobotError, match=r"took no message for 0\.5 s"):
        line.write(b"x" * 1_000_000)
    line.close()
    port.close()


def listen_once(device: str) -> Transport:
    heard = threading.Event()

    def hear(data: bytes) -> None:
        if b"\nj," in data:
            heard.set()

    line = Transport(device, hear, lambda _: None)
    assert heard.wait(PATIENCE)
    return line


@pytest.mark.parametrize("tcp", [None, 0])
def test_a_robot_in_real_time_drops_what_nobody_reads_and_talks_to_the_next_host(tcp: int | None) -> None:
    robot = start_emulator("nominal", 50.0, tcp=tcp, booted=True)
    for _ in range(2):
        listen_once(robot.device).close()
    robot.close()


def test_a_taken_tcp_port_is_refused() -> None:
    robot = start_emulator(tcp=0)
    with pytest.raises(InputError, match="cannot be used"):
        start_emulator(tcp=int(robot.device.rpartition(":")[2]))
    robot.close()
