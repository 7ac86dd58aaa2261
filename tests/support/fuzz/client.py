"""One connection to the studio that sends bytes as they are and waits for an answer."""

from __future__ import annotations

import contextlib
import http.client
import socket
import time
from dataclasses import dataclass
from urllib.parse import urlsplit

from tests.support.fuzz.requests import Asked

ANSWER_SECONDS = 60.0
"""What has not answered by then never will."""

STREAMS = ("multipart/x-mixed-replace", "application/x-ndjson")
FIRST_BYTES = 4096
"""Of a stream that may never end, or shows how long work goes on."""


@dataclass(frozen=True)
class Answered:
    """What came back.

    Args:
        status: 0 where the connection ended without an answer.
        seconds: from the first byte of the request to the last of the answer, of a stream to its first.
        kind: content type.
        body: the answer.
    """

    status: int
    seconds: float
    kind: str = ""
    body: bytes = b""


class Connection:
    """A connection that is kept and opened anew where it has ended.

    Args:
        url: of the studio.
    """

    def __init__(self, url: str) -> None:
        parts = urlsplit(url)
        self._host, self._port = parts.hostname or "", parts.port or 80
        self._socket: socket.socket | None = None
        self._answers = 0

    @property
    def host(self) -> str:
        """As the header says it."""
        return f"{self._host}:{self._port}"

    def close(self) -> None:
        """Ends the connection."""
        if self._socket is not None:
            self._socket.close()
        self._socket, self._answers = None, 0

    def ask(self, asked: Asked) -> Answered:
        """Sends a request and reads its answer; once more where a kept connection had ended meanwhile."""
        was_kept = self._answers > 0
        answered = self._once(asked)
        if answered.status == 0 and was_kept and answered.seconds < 1.0:
            answered = self._once(asked)
        if asked.may_be_cut:
            self.close()
        return answered

    def _once(self, asked: Asked) -> Answered:
        begun = time.monotonic()
        try:
            return self._exchange(asked, begun)
        except (OSError, http.client.HTTPException):
            self.close()
            return Answered(0, time.monotonic() - begun)

    def _exchange(self, asked: Asked, begun: float) -> Answered:
        if self._socket is None:
            self._socket = socket.create_connection((self._host, self._port), ANSWER_SECONDS)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with contextlib.suppress(ConnectionError):  # a refusal may be there already
            self._socket.sendall(asked.wire(self.host))
            if asked.may_be_cut:
                self._socket.shutdown(socket.SHUT_WR)
        answer = http.client.HTTPResponse(self._socket, method=asked.method)
        answer.begin()
        kind = answer.getheader("content-type", "")
        is_stream = kind.startswith(STREAMS)
        body = answer.read1(FIRST_BYTES) if is_stream else answer.read()
        self._answers += 1
        if is_stream or answer.will_close:
            self.close()
        return Answered(answer.status, time.monotonic() - begun, kind, body)
