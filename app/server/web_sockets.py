"""Web sockets whose clients cannot fill the server's memory with frames that are no messages."""

from typing import TYPE_CHECKING

from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import CloseCode, Frame

if TYPE_CHECKING:
    from uvicorn._types import ASGISendEvent

MOST_PARTS = 256
"""Parts that one message may come in; each costs memory, an empty one too."""

MOST_WAITING = 65_536
"""Bytes that wait for a client; while more do, its pings go without an answer."""

NO_OPENING = b"HTTP/1.1 400 Bad Request\r\nconnection: close\r\ncontent-length: 0\r\n\r\n"


class BoundedSocket(WebSocketsSansIOProtocol):
    """uvicorn's web socket, which keeps every part of a message and answers every ping, read or not."""

    _parts = 0
    _is_failed = False

    def data_received(self, data: bytes) -> None:
        """Takes bytes; refuses an opening that cannot be read, which the library leaves without an answer."""
        super().data_received(data)
        if self.conn.handshake_exc is not None and not self.handshake_initiated:
            self.transport.write(NO_OPENING)
            self.transport.close()

    def handle_cont(self, event: Frame) -> None:
        """Takes a further part of a message."""
        self._parts = 0 if event.fin else self._parts + 1
        if self._parts < MOST_PARTS:
            super().handle_cont(event)
        elif not self.transport.is_closing():
            self.conn.fail(CloseCode.MESSAGE_TOO_BIG, f"At most {MOST_PARTS} parts.")
            self.handle_parser_exception()

    def send_receive_event_to_app(self) -> None:
        """Passes a whole message on; a text that is no UTF-8 ends the connection."""
        if self.curr_msg_data_type == "text" and not _is_text(b"".join(self.frames)):
            self.frames = []
            self.conn.fail(CloseCode.INVALID_DATA, "Send text in UTF-8.")
            self.handle_parser_exception()
        else:
            super().send_receive_event_to_app()

    def handle_ping(self) -> None:
        """Answers a ping, as long as the client reads what it is sent."""
        if self.transport.get_write_buffer_size() < MOST_WAITING:
            super().handle_ping()
        else:
            self.conn.data_to_send()

    def handle_parser_exception(self) -> None:
        """Ends a connection that sends what is no frame; before it is accepted there is nothing to close."""
        self._is_failed = True
        if self.conn.close_sent is None:
            self.transport.abort()
        else:
            super().handle_parser_exception()

    async def send(self, message: "ASGISendEvent") -> None:
        """Sends a message.

        Raises:
            ClientDisconnected: the connection was ended because of what the client sent.
        """
        if self._is_failed:
            raise ClientDisconnected
        await super().send(message)


def _is_text(data: bytes) -> bool:
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return True
