"""Connections whose first head has not come yet: each costs a socket and its bytes, nothing more."""

import asyncio
import contextlib
import re
import socket
from collections.abc import Callable
from itertools import islice

from app.server.connections import Connection
from app.server.protocols import TIMEOUT_ANSWER

MOST_HEAD = 16_384
"""Bytes of a head; the parser refuses more."""

_HEAD_END = re.compile(rb"\n\r?\n")
_FIRST_LETTER = 0x21
"""No request begins with a byte below this; a TLS handshake does."""

_SHOWN = re.compile(rb"(?:[?&]token=|[Bb]earer |footfall_token_\d+=)([^\s&;]+)")
MOST_SHOWN = 16
"""Tokens of a head that are looked at: a browser sends the cookies of all studios of a computer."""


def received(line: socket.socket) -> bytes | None:
    """What has come on a line; None where nothing has, no bytes where it is closed."""
    try:
        return line.recv(MOST_HEAD)
    except (BlockingIOError, InterruptedError):
        return None
    except OSError:
        return b""


def is_whole(head: bytes) -> bool:
    """Whether the parser can do something with a head: take it, or refuse it."""
    if not head:
        return False
    return _HEAD_END.search(head) is not None or len(head) >= MOST_HEAD or head[0] < _FIRST_LETTER


def shows_one(head: bytes, tokens: frozenset[bytes]) -> bool:
    """Whether a head shows one of some tokens; among very many, as of somebody who guesses, it does not."""
    shown = (found[1] for found in islice(_SHOWN.finditer(head), MOST_SHOWN))
    return not tokens.isdisjoint(shown)


class Newcomer:
    """A connection whose first head has not come yet.

    Args:
        line: the socket.
        head: the bytes that have come.
        on_bytes: told that bytes have come; returns whether to wait for more.

    Attributes:
        connection: as it is counted.
        is_open: whether nobody closed it.
    """

    connection: Connection

    def __init__(self, line: socket.socket, head: bytes, on_bytes: "Callable[[Newcomer], bool]") -> None:
        self.line, self.head, self._on_bytes = line, head, on_bytes
        self.is_open = True

    def watch(self) -> None:
        """Goes on with the bytes that have come, and waits for more where they are not enough."""
        if not self.head or self._on_bytes(self):
            asyncio.get_running_loop().add_reader(self.line, self._read)

    def _read(self) -> None:
        data = received(self.line)
        if data is None:
            return
        if not data:
            self.drop()
            return
        self.head += data
        if not self._on_bytes(self):
            asyncio.get_running_loop().remove_reader(self.line)

    def drop(self) -> None:
        """Closes the line at once."""
        self.is_open = False
        asyncio.get_running_loop().remove_reader(self.line)
        self.line.close()
        self.connection.ended()

    def time_out(self) -> bool:
        """Closes the line, with a sentence if something has come."""
        if self.head:
            with contextlib.suppress(OSError):
                self.line.send(TIMEOUT_ANSWER)
        self.drop()
        return True

    def unsent_bytes(self) -> int:
        """Nothing was answered yet."""
        return 0
