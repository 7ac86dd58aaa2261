"""The studio ends without a word in its log, whatever is not answered yet."""

from __future__ import annotations

import re
import socket
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import urlsplit

from tests.support.studio_process import running_studio

FAULT = re.compile(r"Traceback|Warning:|Exception in ASGI|Task was destroyed|resource_tracker|ASGI callable")


def test_requests_that_wait_are_cut_off_without_a_traceback(tmp_path: Path) -> None:
    head = "GET /api/health HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer wrong\r\n\r\n"
    socket_head = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    opening = head.removesuffix("\r\n") + socket_head + "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
    with ExitStack() as lines:
        with running_studio(tmp_path, "--token", "a-token-of-the-test") as studio:
            assert studio.said is not None
            log = lines.enter_context(studio.said.open())
            server = urlsplit(studio.url)
            waiting = [
                lines.enter_context(socket.create_connection((server.hostname, server.port), 60))
                for _ in range(10)
            ]
            for number, line in enumerate(waiting):
                line.sendall((opening if number % 2 else head).encode())
            assert waiting[0].recv(100).startswith(b"HTTP/1.1 403")
        assert waiting[-2].recv(100) == b""
        assert not FAULT.search(said := log.read()), said
