"""Where an emulated robot is plugged in: a pseudo-terminal or a TCP port.

Neither ever blocks: what the host does not fetch is lost, as on the robot (firmware.md, hazard 23).
"""

import os
import socket
import tty
from typing import Protocol

from core.errors import InputError

CHUNK_BYTES = 65536


class Port(Protocol):
    """The robot's end of a cable."""

    @property
    def device(self) -> str:
        """Name under which a host opens the other end."""

    def write(self, data: bytes) -> int:
        """Sends what fits, drops the rest, and returns how many bytes fitted."""

    def read(self) -> bytes:
        """Returns what has arrived, perhaps nothing."""

    def close(self) -> None:
        """Pulls the plug; the host sees its line hang up."""


class PtyPort:
    """A pseudo-terminal in raw mode."""

    def __init__(self) -> None:
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self._device = os.ttyname(self._slave)

    @property
    def device(self) -> str:
        """Path of the host's end."""
        return self._device

    def fileno(self) -> int:
        """For waiting until the host has written."""
        return self._master

    def write(self, data: bytes) -> int:
        """Sends what fits, drops the rest, and returns how many bytes fitted."""
        try:
            return os.write(self._master, data)
        except OSError:
            return 0

    def read(self) -> bytes:
        """Returns what has arrived, perhaps nothing."""
        try:
            return os.read(self._master, CHUNK_BYTES)
        except OSError:
            return b""

    def close(self) -> None:
        """Hangs up."""
        if self._master >= 0:
            os.close(self._slave)
            os.close(self._master)
            self._master = self._slave = -1


class TcpPort:
    """A TCP port on the loopback interface for one host at a time.

    Args:
        port: number; 0 takes a free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, port: int = 0) -> None:
        try:
            self._listener = socket.create_server(("127.0.0.1", port))
        except OSError as error:
            raise InputError(
                f"TCP port {port} cannot be used: {error.strerror}. Name another one."
            ) from error
        self._listener.setblocking(False)
        self._number = int(self._listener.getsockname()[1])
        self._host: socket.socket | None = None

    @property
    def device(self) -> str:
        """Address of the robot, `socket://127.0.0.1:PORT`."""
        return f"socket://127.0.0.1:{self._number}"

    def write(self, data: bytes) -> int:
        """Sends what fits, drops the rest, and returns how many bytes fitted."""
        if self._host is None:
            return 0
        try:
            return self._host.send(data)
        except BlockingIOError:
            return 0
        except OSError:
            self._drop_host()
            return 0

    def read(self) -> bytes:
        """Returns what has arrived, perhaps nothing; takes the next host if there is none."""
        if self._host is None and not self._accept():
            return b""
        try:
            data = self._host.recv(CHUNK_BYTES) if self._host else b""
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._drop_host()
        return data

    def close(self) -> None:
        """Hangs up and takes no more hosts."""
        self._drop_host()
        self._listener.close()

    def _accept(self) -> bool:
        try:
            self._host, _ = self._listener.accept()
        except OSError:
            return False
        self._host.setblocking(False)
        self._host.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return True

    def _drop_host(self) -> None:
        if self._host is not None:
            self._host.close()
            self._host = None
