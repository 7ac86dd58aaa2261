"""A robot's line over a network: its address, and a connection that is made in time or not at all."""

import errno
import os
import socket
import threading
import time
from concurrent.futures import Future
from contextlib import suppress
from urllib.parse import urlsplit

from core.errors import InputError
from core.running_time import wait_within

SCHEME = "socket://"

CONNECT_DEADLINE = 4.0
"""A host that has not taken the connection after this long is absent; its name is looked up within it, s."""


class NetworkLine:
    """An open connection that does not block.

    Args:
        device: `socket://HOST:PORT`.

    Raises:
        InputError: the address is none of this form.
        OSError: nobody answers there in time.
    """

    def __init__(self, device: str) -> None:
        self._socket = _connected(network_address(device))
        self._socket.setblocking(False)

    def fileno(self) -> int:
        """The file descriptor, for reading, writing and waiting."""
        return self._socket.fileno()

    def close(self) -> None:
        """Ends the connection."""
        with suppress(OSError):  # the other end may have gone
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()


def network_address(device: str) -> tuple[str, int]:
    """Host and port of `socket://HOST:PORT`.

    Raises:
        InputError: there is no host or port, or something stands behind or before them.
    """
    try:
        parts = urlsplit(device)
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
        parts = urlsplit("")
    rest = parts.path.strip("/") or parts.query or parts.fragment or parts.username or parts.password
    if not host or not port or rest:
        raise InputError(
            f"{device} is not a line to a robot. Write socket://HOST:PORT with a port from 1 to "
            "65535, and nothing after it.",
            "device",
        )
    return host, port


def _connected(address: tuple[str, int]) -> socket.socket:
    """Connects on a thread of its own: a name's look-up takes no deadline, and a name may have many hosts."""
    made: Future[socket.socket] = Future()

    def connect() -> None:
        try:
            made.set_result(socket.create_connection(address, CONNECT_DEADLINE))
        except (OSError, ValueError) as error:  # a host may be no name at all
            made.set_exception(error)

    threading.Thread(target=connect, name="robot connection", daemon=True).start()
    try:
        return wait_within(made.result, CONNECT_DEADLINE, time.monotonic)
    except TimeoutError:
        made.add_done_callback(_close_late)
        raise OSError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT)) from None


def _close_late(made: Future[socket.socket]) -> None:
    if made.exception() is None:
        made.result().close()
