"""Frames that are no whole messages cost the server next to nothing."""

from __future__ import annotations

import socket
import struct
from collections.abc import Iterator
from threading import Event

import pytest
from starlette.types import Receive, Scope, Send

from app.server.web_sockets import MOST_PARTS, BoundedSocket
from app.web.socket_limit import MOST_MESSAGE
from tests.support.page.serving import serving
from tests.support.raw_request import UPGRADE

TEXT, CONTINUED, LAST_PING = b"\x01", b"\x00", b"\x89"
TOO_BIG, NO_UTF_8 = struct.pack("!H", 1009), struct.pack("!H", 1007)
MOST_WAITING = 1_000_000
"""Bytes of answers that may wait for a client; the system keeps a part of them."""


UNDECIDED = Event()
"""A socket was asked for that is not accepted."""


class Watched(BoundedSocket):
    """Keeps the most bytes that waited to be sent to a client."""

    most_waiting = 0

    def data_received(self, data: bytes) -> None:
        """Looks at what waits after each piece."""
        super().data_received(data)
        Watched.most_waiting = max(Watched.most_waiting, self.transport.get_write_buffer_size())


async def listen(scope: Scope, receive: Receive, send: Send) -> None:
    """Accepts a socket and takes what comes; an undecided one is not accepted."""
    await receive()
    if scope["path"] == "/undecided":
        UNDECIDED.set()
    else:
        await send({"type": "websocket.accept"})
    while (await receive())["type"] != "websocket.disconnect":
        pass


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    with serving(listen, Watched) as address:
        yield int(address.split(":")[1])


def upgraded(port: int, path: str = "/") -> socket.socket:
    """A line on which a web socket was asked for."""
    line = socket.create_connection(("127.0.0.1", port), timeout=30)
    headers = "".join(f"{name}: {value}\r\n" for name, value in {"Host": "x", **UPGRADE}.items())
    line.sendall(f"GET {path} HTTP/1.1\r\n{headers}\r\n".encode())
    return line


def frame(head: bytes, content: bytes = b"") -> bytes:
    return head + bytes([0x80 + len(content)]) + b"\0\0\0\0" + content


def rest(line: socket.socket) -> bytes:
    """All that still comes, to the end of the connection."""
    gathered = b""
    try:
        while piece := line.recv(65536):
            gathered += piece
    except ConnectionResetError:
        pass
    return gathered


def test_a_message_in_too_many_parts_is_refused(port: int) -> None:
    with upgraded(port) as line:
        assert b" 101 " in line.recv(4096)
        line.sendall(frame(TEXT) + frame(CONTINUED) * (MOST_PARTS - 2))
        line.sendall(frame(LAST_PING, b"here"))
        assert line.recv(4096).endswith(b"here")
        line.sendall(frame(CONTINUED) * 5)
        assert TOO_BIG in rest(line)


def test_a_message_is_refused_by_its_length_before_it_comes(port: int) -> None:
    with upgraded(port) as line:
        assert b" 101 " in line.recv(4096)
        line.sendall(b"\x82\xff" + struct.pack("!Q", MOST_MESSAGE + 1) + b"\0\0\0\0")
        assert TOO_BIG in rest(line)


def test_pings_of_a_client_that_does_not_read_do_not_pile_up(port: int) -> None:
    pings = frame(LAST_PING, b"x" * 125) * 1000
    with upgraded(port) as line:
        assert b" 101 " in line.recv(4096)
        for _ in range(150):
            line.sendall(pings)
        line.sendall(frame(b"\x88", b"\x03\xe8"))
        assert rest(line)
    assert 0 < Watched.most_waiting < MOST_WAITING


def test_what_is_no_frame_ends_a_connection_that_is_not_accepted_yet(
    port: int, caplog: pytest.LogCaptureFixture
) -> None:
    with upgraded(port, "/undecided") as line:
        assert UNDECIDED.wait(30)
        line.sendall(b"no frame at all")
        assert rest(line) == b""
    assert caplog.records == []


def test_a_text_that_is_no_utf_8_closes_the_socket_with_a_sentence(
    port: int, caplog: pytest.LogCaptureFixture
) -> None:
    with upgraded(port) as line:
        assert b" 101 " in line.recv(4096)
        line.sendall(frame(b"\x81", b"\xff"))
        assert rest(line).endswith(NO_UTF_8 + b"Send text in UTF-8.")
    assert caplog.records == []
