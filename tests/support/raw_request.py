"""Requests whose head is written by hand, to send what no client library sends."""

from __future__ import annotations

import socket
from collections.abc import Mapping

UPGRADE = {
    "Connection": "Upgrade",
    "Upgrade": "websocket",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
}
"""What makes a GET a request for a web socket."""


def status_of(port: int, path: str, headers: Mapping[str, str], method: str = "GET") -> int:
    """The status of the answer of a server on loopback.

    Args:
        port: where it listens.
        path: of the request.
        headers: all of them; `Host` is 127.0.0.1 with the port unless it is among them.
        method: of the request.
    """
    whole = {"Host": f"127.0.0.1:{port}", **headers}
    head = "".join(f"{name}: {value}\r\n" for name, value in whole.items())
    with socket.create_connection(("127.0.0.1", port), timeout=30) as line:
        line.sendall(f"{method} {path} HTTP/1.1\r\n{head}\r\n".encode("latin-1"))
        answer = line.recv(4096)
    return int(answer.split(b" ", 2)[1]) if answer else 0
