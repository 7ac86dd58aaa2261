"""Lines over a network: which addresses are taken, and hosts that never answer."""

import socket
import threading
from collections.abc import Iterator

import pytest

from app.bridge import network_line
from app.bridge.bridge import RobotBridge
from app.bridge.network_line import network_address
from app.bridge.states import LinkState
from core.errors import InputError, RobotError


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    """Takes connections, but nobody greets who comes."""
    with socket.create_server(("127.0.0.1", 0), backlog=0) as server:
        yield server


def device_of(listener: socket.socket) -> str:
    return f"socket://127.0.0.1:{listener.getsockname()[1]}"


@pytest.mark.parametrize(
    "rest", ["?logging=debug", "/logging", "#x", "/?logging=debug", "?logging=none", "?logging"]
)
def test_an_option_is_refused_and_nothing_is_opened(listener: socket.socket, rest: str) -> None:
    bridge = RobotBridge()
    with pytest.raises(InputError, match=r"socket://HOST:PORT") as refusal:
        bridge.connect(device_of(listener) + rest)
    assert refusal.value.where == "device"
    assert bridge.snapshot.link is LinkState.DISCONNECTED
    listener.setblocking(False)
    with pytest.raises(BlockingIOError):
        listener.accept()
    bridge.close()


@pytest.mark.parametrize(
    "device",
    [
        *(
            "socket://nowhere",
            "socket://",
            "socket://:5",
            "socket://h:0",
            "socket://h:65536",
            "socket://h:-1",
        ),
        *("socket://h:x", "socket://[::1", "socket://me@h:5", "socket://me:secret@h:5", "socket://h:5/file"),
    ],
)
def test_an_address_without_host_and_port_is_bad_input(device: str) -> None:
    with pytest.raises(InputError, match=r"socket://HOST:PORT"):
        network_address(device)


@pytest.mark.parametrize(
    ("device", "address"),
    [
        ("socket://127.0.0.1:9", ("127.0.0.1", 9)),
        ("socket://robot.lab:4000/", ("robot.lab", 4000)),
        ("socket://[::1]:5", ("::1", 5)),
    ],
)
def test_host_and_port_are_read(device: str, address: tuple[str, int]) -> None:
    assert network_address(device) == address


def test_a_host_that_drops_packets_is_given_up(
    listener: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(network_line, "CONNECT_DEADLINE", 0.3)
    full = [socket.socket() for _ in range(3)]  # no room is left for one more
    for one in full:
        one.setblocking(False)
        one.connect_ex(listener.getsockname())
    bridge = RobotBridge()
    with pytest.raises(RobotError, match="Nothing answers"):
        bridge.connect(device_of(listener))
    assert bridge.snapshot.last_error is not None
    bridge.close()
    for one in full:
        one.close()


def test_a_name_that_is_looked_up_for_long_is_given_up_and_what_opens_later_is_closed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found, closed = threading.Event(), threading.Event()

    class Late(socket.socket):
        def close(self) -> None:
            super().close()
            closed.set()

    def look_up(address: object, timeout: float) -> socket.socket:
        del address, timeout
        found.wait(60.0)
        return Late()

    monkeypatch.setattr(network_line, "CONNECT_DEADLINE", 0.1)
    monkeypatch.setattr(socket, "create_connection", look_up)
    bridge = RobotBridge()
    with pytest.raises(RobotError, match="Nothing answers"):
        bridge.connect("socket://robot.lab:4000")
    assert not closed.is_set()
    found.set()
    assert closed.wait(60.0)
    bridge.close()
