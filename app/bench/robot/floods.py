"""Floods of connections without the token, from a process of their own, to see what is left for others."""

import contextlib
import multiprocessing
import selectors
import socket
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from multiprocessing.connection import Connection

from app.bench.robot.crowd import NOBODY, Crowd

CHUNK_BYTES = 4096
DRIP_SECONDS = 1.0
"""Between two bytes of a head that drips."""

RETRY_SECONDS = 0.02
"""Sockets that could not be opened are opened after this."""

TURN_SECONDS = 0.01

HANDSHAKE = (
    "GET /api/events HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
)
REQUEST = "GET /api/health HTTP/1.1\r\nHost: {host}\r\n"


class Flood(StrEnum):
    """What each connection of a flood does."""

    SILENT = "connections that say nothing"
    HALF_HEADS = "half request heads"
    DRIPPED_HEADS = "heads, a byte a second"
    HALF_BODIES = "half bodies"
    KEPT_ALIVE = "idle after a request"
    HALF_HANDSHAKES = "half web socket handshakes"
    SOCKETS = "web sockets without the token"
    UNREAD = "answers never read"
    WRONG_TOKENS = "wrong tokens"


OPENINGS = {
    Flood.SILENT: "",
    Flood.HALF_HEADS: REQUEST,
    Flood.DRIPPED_HEADS: REQUEST + "X-Long: ",
    Flood.HALF_BODIES: "POST /api/videos HTTP/1.1\r\nHost: {host}\r\nContent-Length: 100000\r\n\r\nhalf",
    Flood.KEPT_ALIVE: REQUEST + "\r\n",
    Flood.HALF_HANDSHAKES: HANDSHAKE,
    Flood.SOCKETS: HANDSHAKE + "\r\n",
    Flood.UNREAD: (REQUEST + "\r\n") * 8,
    Flood.WRONG_TOKENS: REQUEST + "Authorization: Bearer wrong\r\n\r\n",
}
DRIPPING = frozenset({Flood.DRIPPED_HEADS, Flood.HALF_BODIES})


@dataclass(frozen=True)
class Attack:
    """A flood.

    Args:
        kinds: what its connections do, in turn.
        connections: how many are held open; one that the studio closes is opened again at once.
        sources: addresses that they come from, in turn.
        crowd: visitors with the token beside them.
    """

    kinds: tuple[Flood, ...]
    connections: int
    sources: tuple[str, ...] = ("127.0.0.1",)
    crowd: Crowd = NOBODY


def loopback_addresses(count: int) -> tuple[str, ...]:
    """So many addresses of this computer, from 127.0.0.2 on; Linux has them all."""
    return tuple(f"127.0.{number // 250}.{number % 250 + 2}" for number in range(count))


@contextlib.contextmanager
def attacked(address: tuple[str, int], attack: Attack) -> Iterator[Callable[[], int]]:
    """Floods a server meanwhile.

    Args:
        address: the server's.
        attack: the flood.

    Yields:
        A function that says how many connections were opened so far.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_attack, args=(theirs, address, attack), daemon=True)
    process.start()
    ours.recv()

    def opened() -> int:
        ours.send(None)
        count: int = ours.recv()
        return count

    try:
        yield opened
    finally:
        process.terminate()
        process.join()


def _attack(pipe: Connection, address: tuple[str, int], attack: Attack) -> None:
    attacker = _Attacker(address, attack)
    while not attacker.is_full:
        attacker.turn()
    pipe.send(None)
    while True:
        attacker.turn()
        if pipe.poll():
            pipe.recv()
            pipe.send(attacker.opened)


class _Attacker:
    """Holds the connections of an attack.

    Attributes:
        opened: connections so far.
        is_full: whether as many as wanted were opened once.
    """

    def __init__(self, address: tuple[str, int], attack: Attack) -> None:
        self._address, self._attack = address, attack
        self._selector = selectors.DefaultSelector()
        self._lines: dict[socket.socket, Flood] = {}
        self._next_drip = time.monotonic() + DRIP_SECONDS
        self.opened = 0

    @property
    def is_full(self) -> bool:
        return self.opened >= self._attack.connections

    def turn(self) -> None:
        """Opens what is missing, reads what came, and drips."""
        while len(self._lines) < self._attack.connections:
            if not self._open():
                time.sleep(RETRY_SECONDS)
                break
        for key, _ in self._selector.select(TURN_SECONDS):
            line = key.fileobj
            if isinstance(line, socket.socket):
                self._read(line, self._lines[line])
        if time.monotonic() >= self._next_drip:
            self._next_drip = time.monotonic() + DRIP_SECONDS
            self._drip()

    def _open(self) -> bool:
        number, attack = self.opened, self._attack
        kind, source = attack.kinds[number % len(attack.kinds)], attack.sources[number % len(attack.sources)]
        line = socket.socket()
        if kind is Flood.UNREAD:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, CHUNK_BYTES)
        try:
            line.settimeout(RETRY_SECONDS)
            line.bind((source, 0))
            line.connect(self._address)
            line.setblocking(False)
            line.send(OPENINGS[kind].format(host="127.0.0.1").encode())
        except OSError:
            line.close()
            return False
        self.opened += 1
        self._lines[line] = kind
        self._selector.register(line, selectors.EVENT_READ)
        return True

    def _read(self, line: socket.socket, kind: Flood) -> None:
        """Reads an answer, or closes a line that the studio closed."""
        if kind is Flood.UNREAD:
            self._selector.unregister(line)
            return
        try:
            answer = line.recv(CHUNK_BYTES)
            if answer and kind is Flood.WRONG_TOKENS:
                line.send(OPENINGS[kind].format(host="127.0.0.1").encode())
        except BlockingIOError:
            return
        except OSError:
            answer = b""
        if not answer:
            self._close(line)

    def _drip(self) -> None:
        for line, kind in list(self._lines.items()):
            if kind in DRIPPING or kind is Flood.UNREAD:
                try:
                    line.send(b"x" if kind in DRIPPING else OPENINGS[kind].format(host="127.0.0.1").encode())
                except BlockingIOError:
                    continue
                except OSError:
                    self._close(line)

    def _close(self, line: socket.socket) -> None:
        del self._lines[line]
        with contextlib.suppress(KeyError):
            self._selector.unregister(line)
        line.close()
