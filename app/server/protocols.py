"""HTTP and web sockets as uvicorn speaks them, with deadlines, and counted among the open connections."""

import asyncio
import json
from typing import Any

import h11
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.server import ServerState

from app.server.connections import Connection, Trouble
from app.server.untaken import untaken_bytes
from app.server.web_sockets import BoundedSocket

CONNECTION = "connection"
"""Key of the connection in the state of a request's scope."""

HEAD_SECONDS = 8.0
"""A request's head must be complete within this."""

BODY_SECONDS = 20.0
"""A body may stand still for so long; without an accepted request it must be complete within this."""

BODY_RATE = 500.0
"""Bytes of a body that give it a second more, up to the above."""

_SENTENCE = {
    "error": f"The request came too slowly: its head has {HEAD_SECONDS:.0f} s, and its body must bring "
    f"{BODY_RATE:.0f} bytes a second. Send it again on a better line.",
    "where": "request",
}
_WORDS = json.dumps(_SENTENCE).encode()
TIMEOUT_ANSWER = (
    b"HTTP/1.1 408 Request Timeout\r\nconnection: close\r\ncontent-type: application/json\r\n"
    b"content-length: %d\r\n\r\n%s" % (len(_WORDS), _WORDS)
)


class BoundedHttp(H11Protocol):
    """uvicorn's HTTP on a connection whose first request's head has come already.

    Args:
        config: the server's.
        server_state: the server's.
        app_state: what each request's scope carries.
        connection: as it is counted.
        first: the bytes that have come.
    """

    def __init__(
        self,
        config: uvicorn.Config,
        server_state: ServerState,
        app_state: dict[str, Any],
        connection: Connection,
        first: bytes,
    ) -> None:
        super().__init__(config, server_state, {**app_state, CONNECTION: connection})
        self._connection, self._first = connection, first
        self._is_dropped = self._is_upgraded = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begins with the bytes that have come."""
        super().connection_made(transport)
        if self._is_dropped:
            transport.abort()
        else:
            self.data_received(self._first)

    def data_received(self, data: bytes) -> None:
        """Takes bytes, and sets the deadline for the next ones."""
        refused = self.cycle if self._is_refused() else None
        super().data_received(data)
        if refused is not None and self.cycle is not refused:
            self.transport.close()
        if not self._is_upgraded:
            self._connection.is_asking = self._is_asking()
            self._set_deadline(len(data))
            self._close_if_refused()

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Hands the line over to a web socket."""
        self._is_upgraded = self._connection.is_asking = True
        self._connection.deadline = None
        super().handle_websocket_upgrade(event)

    def send_400_response(self, msg: str) -> None:
        """Answers what is no HTTP; where an answer has begun already, the line is closed."""
        if self._is_asking():
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            super().send_400_response(msg)
        else:
            self.transport.close()

    def on_response_complete(self) -> None:
        """Goes on with the next request, or waits for it."""
        self._close_if_refused()
        super().on_response_complete()
        if self._is_upgraded:
            return
        if not self._is_asking():
            self._connection.answered()
        self._set_deadline(0)

    def connection_lost(self, exc: Exception | None) -> None:
        """Forgets the connection."""
        super().connection_lost(exc)
        self._connection.ended()

    def drop(self) -> None:
        """Closes the line at once; nobody waits for the rest of an answer."""
        self._is_dropped = True
        if self.cycle is not None:
            self.cycle.disconnected = True
        if self.transport is not None:
            self.transport.abort()

    def time_out(self) -> bool:
        """Closes the line, saying why if no answer has begun; not while the studio itself reads nothing."""
        if self.flow.read_paused:
            self._connection.deadline = self.loop.time() + BODY_SECONDS
            return False
        if not (self._is_asking() and self.cycle.response_started):
            self.transport.write(TIMEOUT_ANSWER)
        self.transport.close()
        return True

    def unsent_bytes(self) -> int:
        """Bytes of answers that wait for the peer to read."""
        return untaken_bytes(self.transport) if self.transport is not None else 0

    def _is_asking(self) -> bool:
        return self.cycle is not None and not self.cycle.response_complete

    def _is_refused(self) -> bool:
        return self.cycle is not None and self.cycle.response_complete and not self._connection.is_known

    def _close_if_refused(self) -> None:
        """Closes after a refusal, so that nobody asks on and on.

        A body that still comes is read to its end: a peer that is cut off would not see the answer.
        """
        if self._is_refused() and self.conn.their_state is not h11.SEND_BODY:
            self.transport.close()

    def _set_deadline(self, received: int) -> None:
        connection, now = self._connection, self.loop.time()
        if self.conn.their_state is h11.SEND_BODY:
            latest = now + BODY_SECONDS
            if connection.waits_for is not Trouble.BODY or connection.deadline is None:
                connection.deadline = latest
            elif connection.is_known:
                connection.deadline = min(connection.deadline + received / BODY_RATE, latest)
            connection.waits_for = Trouble.BODY
        elif self.conn.their_state is h11.IDLE:
            begun = Trouble.HEAD if self.conn.trailing_data[0] else None
            if connection.deadline is None or connection.waits_for is not begun:
                connection.deadline = now + HEAD_SECONDS
            connection.waits_for = begun
        else:
            connection.deadline = None


class CountedSocket(BoundedSocket):
    """A web socket, counted among the open connections."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Takes the line over."""
        super().connection_made(transport)
        self._counted().holder = self

    def connection_lost(self, exc: Exception | None) -> None:
        """Forgets the connection."""
        super().connection_lost(exc)
        self._counted().ended()

    def drop(self) -> None:
        """Closes the line at once."""
        self.transport.abort()

    def time_out(self) -> bool:
        """Closes the line."""
        self.drop()
        return True

    def unsent_bytes(self) -> int:
        """Bytes of messages that wait for the peer to read."""
        return untaken_bytes(self.transport)

    def _counted(self) -> Connection:
        connection: Connection = self.app_state[CONNECTION]
        return connection
