"""Takes connections from the listening socket: few at a time, the newest always, none for ever."""

import asyncio
import errno
import ipaddress
import logging
import socket
import sys
from collections import deque
from collections.abc import Callable
from urllib.parse import quote

from app.server.admission import STOP
from app.server.connections import Connection, Connections, Rank, Trouble
from app.server.descriptors import Spares
from app.server.newcomers import Newcomer, is_whole, received, shows_one
from app.server.protocols import HEAD_SECONDS, BoundedHttp
from core.running_time import RunningClock

BACKLOG = 2048
"""Connections that may wait to be taken: where there is no room, the system makes a peer wait a second."""

DEFERRED_SECONDS = 1
HAS_DEFERRED = sys.platform == "linux"
"""Linux keeps a connection to itself until something has come on it, or for about so long."""

AT_ONCE = 64
"""Connections that are taken before the event loop does anything else."""

FEW = 8
"""If more wait at a time, somebody floods the studio."""

LOOK_SECONDS = 1.0
"""How often deadlines are looked at."""

REFUSAL_SECONDS = 0.005
"""Between two requests without the token."""

UNREAD_SECONDS = 20.0
"""A peer that reads nothing of its answers for so long is gone."""

REST_SECONDS = 0.05
"""No connection is taken for so long when the system has none to give."""

IPV6_NETWORK = 64
"""Bits of an IPv6 address that one peer has in common."""

STOP_LINE = " ".join(STOP).encode()
"""Beginning of the head of a Stop."""

_SHORT = frozenset({errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM})

logger = logging.getLogger(__name__)

MakeProtocol = Callable[[Connection, bytes], BoundedHttp]


def peer_of(address: str) -> str:
    """Whom an address counts for: itself, or its network with IPv6."""
    if ":" not in address:
        return address
    known = ipaddress.IPv6Address(address.partition("%")[0])
    if known.ipv4_mapped is not None:
        return str(known.ipv4_mapped)
    if known.is_loopback:
        return str(known)
    return str(ipaddress.IPv6Network((known, IPV6_NETWORK), strict=False))


class Listener:
    """Accepts connections, reads their first heads, and hands them to HTTP; looks after deadlines.

    Used on the event loop's thread alone.

    Args:
        listening: the socket, which listens.
        register: counts the connections.
        make_protocol: makes the HTTP of a connection whose first head has come.
        token: requests whose head holds it go before all others; None where none is demanded.
        on_look: called whenever the deadlines are checked.
    """

    def __init__(
        self,
        listening: socket.socket,
        register: Connections,
        make_protocol: MakeProtocol,
        token: str | None,
        on_look: Callable[[], None],
    ) -> None:
        self._listening, self._register = listening, register
        self._tokens = frozenset(() if token is None else (token.encode(), quote(token, safe="").encode()))
        self._make_protocol, self._on_look = make_protocol, on_look
        self._loop = asyncio.get_running_loop()
        self._running = RunningClock(self._loop.time, 2 * LOOK_SECONDS)
        self._spares = Spares()
        self._tasks: set[asyncio.Task[object]] = set()
        self._timers: dict[str, asyncio.TimerHandle] = {}
        self._waiting: deque[Newcomer] = deque()
        self._is_pressed = False
        self._next_refusal = 0.0

    def open(self) -> None:
        """Begins to take connections."""
        self._listening.setblocking(False)
        if HAS_DEFERRED:
            # A program may have to wait for a busy processor between its connecting and its request. It must
            # not lose its place to others meanwhile.
            self._listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_DEFER_ACCEPT, DEFERRED_SECONDS)
        self._listening.listen(BACKLOG)
        self._loop.add_reader(self._listening, self._accept)
        self._look_later()

    def close(self) -> None:
        """Takes no more connections, and closes those that have asked nothing."""
        self._loop.remove_reader(self._listening)
        for timer in self._timers.values():
            timer.cancel()
        for connection in self._register.all():
            if isinstance(connection.holder, Newcomer):
                connection.holder.drop()
        self._spares.close()

    def _heard(self, newcomer: Newcomer) -> bool:
        """Gives a newcomer whose head has come to HTTP; True where more has to come.

        Without the token it waits for its turn: to refuse a request costs far more than to accept a
        connection, and a flood of them must not keep others.
        """
        newcomer.connection.waits_for = Trouble.HEAD
        if not is_whole(newcomer.head):
            return True
        if self._goes_first(newcomer.head):
            newcomer.connection.rank = Rank.STOP if newcomer.head.startswith(STOP_LINE) else Rank.TOKEN
            self._hand_over(newcomer)
            return False
        self._waiting.append(newcomer)
        if len(self._waiting) == 1:
            self._timers["next"] = self._loop.call_at(self._next_refusal, self._take_next)
        return False

    def _goes_first(self, head: bytes) -> bool:
        """Whether a head shows the token, or none is demanded."""
        return shows_one(head, self._tokens) if self._tokens else is_whole(head)

    def _take_next(self) -> None:
        while self._waiting and not self._waiting[0].is_open:
            self._waiting.popleft()
        if self._waiting:
            self._hand_over(self._waiting[0])
            self._waiting.popleft()
            self._next_refusal = self._loop.time() + REFUSAL_SECONDS
        if self._waiting:
            self._timers["next"] = self._loop.call_at(self._next_refusal, self._take_next)

    def _hand_over(self, newcomer: Newcomer) -> None:
        connection, line = newcomer.connection, newcomer.line
        protocol = self._make_protocol(connection, newcomer.head)
        connection.holder, connection.is_asking, connection.deadline = protocol, True, None
        task: asyncio.Task[object] = self._loop.create_task(
            self._loop.connect_accepted_socket(lambda: protocol, line)
        )

        def done(task: asyncio.Task[object]) -> None:
            self._tasks.discard(task)
            if task.cancelled() or task.exception() is not None:
                line.close()
                connection.ended()

        self._tasks.add(task)
        task.add_done_callback(done)

    def _accept(self) -> None:
        was_pressed, self._is_pressed = self._is_pressed, False
        for number in range(AT_ONCE):
            try:
                line, address = self._listening.accept()
            except (BlockingIOError, InterruptedError, ConnectionAbortedError):
                return
            except OSError as error:
                self._cannot_accept(error)
                return
            self._is_pressed = number >= FEW
            self._meet(line, peer_of(address[0]), is_pressed=was_pressed or self._is_pressed)

    def _meet(self, line: socket.socket, peer: str, *, is_pressed: bool) -> None:
        line.setblocking(False)
        head = received(line)
        if head == b"":
            line.close()
            return
        is_foreign = HAS_DEFERRED if head is None else not self._goes_first(head)
        if is_pressed and is_foreign and self._register.is_crowded(peer):
            # The cheapest way: whoever waits behind this one must not wait for more.
            line.close()
            self._register.troubles[Trouble.CROWD] += 1
            return
        newcomer = Newcomer(line, head or b"", self._heard)
        newcomer.connection = self._register.add(peer, newcomer)
        newcomer.connection.deadline = self._loop.time() + HEAD_SECONDS
        newcomer.watch()

    def _cannot_accept(self, error: OSError) -> None:
        """Makes room where the system has no descriptor left; otherwise rests a moment."""
        if error.errno in _SHORT:
            self._register.troubles[Trouble.DESCRIPTORS] += 1
            if self._register.close_a_stranger() or self._spares.give_up():
                return
        else:
            logger.warning("A connection could not be accepted: %s.", error.strerror)
        self._loop.remove_reader(self._listening)
        self._timers["rest"] = self._loop.call_later(
            REST_SECONDS, self._loop.add_reader, self._listening, self._accept
        )

    def _look_later(self) -> None:
        self._timers["look"] = self._loop.call_later(LOOK_SECONDS, self._look)

    def _look(self) -> None:
        self._look_later()  # first, so that no error ends the looks
        now, away = self._loop.time(), self._running.look()
        for connection in self._register.all():
            connection.excuse(away)
            self._look_at(connection, now)
        for trouble, times in self._register.troubles.items():
            logger.warning(trouble.value, extra={"times": times})
        self._register.troubles.clear()
        self._spares.fill()
        self._on_look()

    def _look_at(self, connection: Connection, now: float) -> None:
        unsent = connection.holder.unsent_bytes()
        if unsent == 0 or unsent < connection.unsent:
            connection.stuck_since = None
        elif connection.stuck_since is None:
            connection.stuck_since = now
        connection.unsent = unsent
        if connection.stuck_since is not None and now - connection.stuck_since >= UNREAD_SECONDS:
            connection.holder.drop()
            self._register.troubles[Trouble.UNREAD] += 1
        elif connection.deadline is not None and now >= connection.deadline and connection.holder.time_out():
            connection.deadline = None
            if connection.waits_for is not None:
                self._register.troubles[connection.waits_for] += 1
