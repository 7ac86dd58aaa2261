"""The limited server with a small application, on a thread of the tests."""

from __future__ import annotations

import contextlib
import errno
import socket
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field

import uvicorn
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from app.server.admission import Admission
from app.server.bounded_server import BoundedServer
from app.server.connections import Limits
from app.server.protocols import CountedSocket
from app.web.access import Access, Guard
from tests.support.own_loop import run_apart

TOKEN = "the-token-of-the-test"
SHOWN = f"Authorization: Bearer {TOKEN}\r\n"
"""The header of a request that shows the token."""

LONG = 8_000_000
"""Bytes of an answer that no buffer of the system takes at once."""

PATIENCE = 30.0
"""Seconds after which a test fails that waits for an answer."""


@dataclass(frozen=True)
class Served:
    """A running server, and the connections to it."""

    port: int
    lines: list[socket.socket] = field(default_factory=list)

    def line(self, text: str = "", source: str = "127.0.0.1") -> socket.socket:
        """A connection on which some text was sent; closed when the test is done."""
        line = socket.create_connection(("127.0.0.1", self.port), PATIENCE, source_address=(source, 0))
        self.lines.append(line)
        line.sendall(text.encode())
        return line

    def ask(self, words: str, headers: str = SHOWN) -> bytes:
        """The whole answer to a request on a connection of its own."""
        with self.line(head(words, headers + "Connection: close\r\n")) as line:
            return all_of(line)


def head(words: str, headers: str = SHOWN) -> str:
    """A request's head."""
    return f"{words} HTTP/1.1\r\nHost: 127.0.0.1\r\n{headers}\r\n"


def all_of(line: socket.socket) -> bytes:
    """Everything that comes until the server closes the connection."""
    parts = []
    with contextlib.suppress(ConnectionResetError):
        while part := line.recv(65536):
            parts.append(part)
    return b"".join(parts)


def until(line: socket.socket, wanted: bytes) -> bytes:
    """What comes up to some bytes, or up to the end."""
    came = b""
    while wanted not in came and (part := line.recv(65536)):
        came += part
    return came


def is_open(line: socket.socket) -> bool:
    """Whether the server holds a connection; what has come on it is thrown away."""
    line.setblocking(False)
    try:
        while line.recv(65536):
            pass
    except BlockingIOError:
        return True
    except OSError:
        return False
    finally:
        line.settimeout(PATIENCE)
    return False


class Exhausted(socket.socket):
    """A listening socket of a process that at first has no file descriptors left for connections.

    Attributes:
        failures: how often it has none.
    """

    failures = 0

    def accept(self) -> tuple[socket.socket, tuple[str, int]]:
        """Accepts a connection when there are no failures left."""
        if self.failures:
            self.failures -= 1
            raise OSError(errno.EMFILE, "Too many open files")
        return super().accept()


@contextlib.contextmanager
def served(limits: Limits, token: str | None = TOKEN, failures: int = 0) -> Iterator[Served]:
    """A running server; ended when the test is done."""
    with Exhausted() as listening:
        listening.failures = failures
        listening.bind(("127.0.0.1", 0))
        ready = threading.Event()
        config = uvicorn.Config(
            _application(token),
            log_config=None,
            lifespan="off",
            ws=CountedSocket,
            timeout_graceful_shutdown=1,
        )
        server = BoundedServer(config, limits, token, ready.set)
        thread = threading.Thread(target=run_apart, args=[server.serve([listening])])
        thread.start()
        assert ready.wait(PATIENCE)
        server_and_lines = Served(listening.getsockname()[1])
        try:
            yield server_and_lines
        finally:
            for line in server_and_lines.lines:
                line.close()
            server.should_exit = True
            thread.join()


def _application(token: str | None) -> Starlette:
    async def short(request: Request) -> Response:
        return PlainTextResponse("short")

    async def stop(request: Request) -> Response:
        return PlainTextResponse("stopped")

    async def long(request: Request) -> Response:
        return PlainTextResponse(b"x" * LONG)

    async def count(request: Request) -> Response:
        return JSONResponse(len(await request.body()))

    async def talk(socket: WebSocket) -> None:
        await socket.accept()
        async for text in socket.iter_text():
            await socket.send_text(text)

    return Starlette(
        routes=[
            Route("/short", short),
            Route("/long", long),
            Route("/count", count, methods=["POST"]),
            Route("/api/robot/stop", stop, methods=["POST"]),
            WebSocketRoute("/talk", talk),
        ],
        middleware=[Middleware(Guard, access=Access("127.0.0.1", token)), Middleware(Admission)],
    )
