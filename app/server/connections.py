"""The open connections: how many there may be, and which one is closed for a new one."""

from collections import Counter
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import Protocol

MOST_OF_PEER = 32
"""Connections from one address on which the token was not shown."""

MOST_STRANGERS = 256
"""Connections from all addresses on which no request was accepted yet; one that brings a Stop begins here."""

MOST_KNOWN = 384
"""Connections on which a request was accepted."""

SOCKET_SHARE = 2 / 3
"""Part of them that may be web sockets; the others are for requests."""

MOST_RESERVED = 384
"""File descriptors for the rest of the studio: files, cameras, workers, the connections to the 3D scenes."""


class Trouble(StrEnum):
    """Why connections were closed or requests refused, for the log."""

    CROWD = "Too many connections without an accepted request: the oldest was closed."
    HEAD = "The head of a request was not complete in time: the connection was closed."
    BODY = "The body of a request came too slowly: the connection was closed."
    UNREAD = "An answer was not read: the connection was closed."
    FULL = "Too many connections are open: a request was refused."
    DESCRIPTORS = "The system allows the studio no more open files: a connection had to wait or was closed."


class Rank(IntEnum):
    """Which connections make room for which others, the lowest first."""

    STRANGER = 0
    TOKEN = 1
    """The first head holds the token, where one is demanded."""
    STOP = 2
    """It stops the robot, and holds the token too."""


@dataclass(frozen=True)
class Limits:
    """How many connections may be open.

    Args:
        of_peer: strangers from one address; None where no token is demanded.
        strangers: connections on which no request was accepted yet.
        known: connections on which one was.
        sockets: how many of those may be web sockets.
    """

    of_peer: int | None
    strangers: int
    known: int
    sockets: int


def limits_for(descriptors: int, *, has_token: bool) -> Limits:
    """Limits that leave the studio file descriptors of its own.

    Args:
        descriptors: how many the system allows the process.
        has_token: whether a token is demanded.
    """
    room = descriptors - min(MOST_RESERVED, descriptors // 2)
    strangers = min(MOST_STRANGERS, room * 2 // 5)
    known = min(MOST_KNOWN, room - strangers)
    return Limits(MOST_OF_PEER if has_token else None, strangers, known, int(known * SOCKET_SHARE))


class Holder(Protocol):
    """What holds the line of a connection at present."""

    def drop(self) -> None:
        """Closes the line at once."""

    def time_out(self) -> bool:
        """Closes the line, with a sentence if no answer has begun; False where we ourselves keep the peer."""

    def unsent_bytes(self) -> int:
        """Bytes of answers that wait for the peer to read."""


class Connection:
    """One connection, from its acceptance to its end.

    Attributes:
        peer: where it comes from.
        holder: what holds its line.
        is_known: whether a request was accepted on it.
        is_socket: whether it became a web socket.
        is_asking: whether a request is being answered on it.
        rank: by its first head.
        deadline: when it is closed, on the event loop's clock, s; None where it may take its time.
        waits_for: the trouble at the deadline; None where the peer has not begun a request.
        unsent: bytes that waited for the peer when last looked at.
        stuck_since: when the peer was first seen not to read, s, or None.
    """

    def __init__(self, register: "Connections", peer: str, holder: Holder) -> None:
        self._register = register
        self.peer, self.holder = peer, holder
        self.is_known = self.is_socket = self.is_asking = False
        self.rank = Rank.STRANGER
        self.deadline: float | None = None
        self.waits_for: Trouble | None = None
        self.unsent = 0
        self.stuck_since: float | None = None

    def excuse(self, seconds: float) -> None:
        """Time in which the studio itself did not run is not the peer's, s."""
        if self.deadline is not None:
            self.deadline += seconds
        if self.stuck_since is not None:
            self.stuck_since += seconds

    def accept_request(self, *, is_socket: bool) -> bool:
        """Counts the connection among the known ones; False where they are too many."""
        return self._register.accept_request(self, is_socket=is_socket)

    def answered(self) -> None:
        """The request is answered; from now on the connection may be closed for another one."""
        self.is_asking = False
        self._register.rest(self)

    def ended(self) -> None:
        """The line is closed; doing it twice does no harm."""
        self._register.remove(self)


_Crowd = dict[Connection, None]
"""The strangers from one address, the oldest first."""


class Connections:
    """All open connections; used on the event loop's thread alone.

    Strangers, on whose connection no request was accepted yet, and known ones are counted apart: neither can
    take the other's places. The newest stranger always finds a place: the oldest makes room.

    Args:
        limits: how many there may be.

    Attributes:
        troubles: how often each came about; who reports them clears this.
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._crowds: dict[str, _Crowd] = {}
        self._stranger_count = 0
        self._known: dict[Connection, None] = {}
        self._socket_count = 0
        self.troubles: Counter[Trouble] = Counter()

    def all(self) -> list[Connection]:
        """Every open connection."""
        return [*(one for crowd in self._crowds.values() for one in crowd), *self._known]

    def add(self, peer: str, holder: Holder) -> Connection:
        """Takes a new connection, and closes an old one where there are too many."""
        if self._limits.of_peer is not None and len(self._crowds.get(peer, ())) >= self._limits.of_peer:
            self._close_one(self._crowds[peer])
        elif self._stranger_count >= self._limits.strangers:
            self.close_a_stranger()
        connection = Connection(self, peer, holder)
        self._crowds.setdefault(peer, {})[connection] = None
        self._stranger_count += 1
        return connection

    def is_crowded(self, peer: str) -> bool:
        """Whether one more stranger would only push another one from this address out."""
        crowd = len(self._crowds.get(peer, ()))
        is_full = self._limits.of_peer is not None and crowd >= self._limits.of_peer
        return is_full or (crowd > 0 and self._stranger_count >= self._limits.strangers)

    def close_a_stranger(self) -> bool:
        """Closes one of the address that has the most; False where there is none."""
        if not self._crowds:
            return False
        self._close_one(max(self._crowds.values(), key=len))
        return True

    def accept_request(self, connection: Connection, *, is_socket: bool) -> bool:
        """Counts a connection among the known ones; False, and a trouble, where they are too many."""
        if is_socket and self._socket_count >= self._limits.sockets:
            self.troubles[Trouble.FULL] += 1
            return False
        if not connection.is_known:
            if len(self._known) >= self._limits.known and not self._close_resting():
                self.troubles[Trouble.FULL] += 1
                return False
            self.remove(connection)
            connection.is_known = True
            self._known[connection] = None
        if is_socket:
            connection.is_socket = True
            self._socket_count += 1
        return True

    def rest(self, connection: Connection) -> None:
        """Puts a known connection last among those that make room for others."""
        if connection in self._known:
            self._known[connection] = self._known.pop(connection)

    def remove(self, connection: Connection) -> None:
        """Forgets a connection."""
        if connection in self._known:
            del self._known[connection]
            self._socket_count -= connection.is_socket
            return
        crowd = self._crowds.get(connection.peer, {})
        if connection in crowd:
            del crowd[connection]
            self._stranger_count -= 1
            if not crowd:
                del self._crowds[connection.peer]

    def _close_one(self, crowd: _Crowd) -> None:
        """Closes the oldest that waits for its peer, else the oldest of the lowest rank."""
        self._close(min(crowd, key=lambda one: (one.is_asking, one.rank)))
        self.troubles[Trouble.CROWD] += 1

    def _close_resting(self) -> bool:
        resting = next((one for one in self._known if not one.is_asking), None)
        if resting is not None:
            self._close(resting)
        return resting is not None

    def _close(self, connection: Connection) -> None:
        self.remove(connection)
        connection.holder.drop()
