"""Which connection is closed for a new one, and what the limits leave to the rest of the studio."""

from __future__ import annotations

import pytest

from app.server.connections import (
    MOST_KNOWN,
    MOST_OF_PEER,
    MOST_STRANGERS,
    Connection,
    Connections,
    Limits,
    Rank,
    Trouble,
    limits_for,
)

LIMITS = Limits(of_peer=3, strangers=6, known=4, sockets=2)


class Line:
    """A line that knows whether it was closed."""

    is_closed = False

    def drop(self) -> None:
        self.is_closed = True

    def time_out(self) -> bool:
        self.drop()
        return True

    def unsent_bytes(self) -> int:
        return 0


class Crowd:
    """Connections with their lines."""

    def __init__(self, limits: Limits = LIMITS) -> None:
        self.register = Connections(limits)
        self.lines: list[Line] = []

    def add(self, peer: str) -> Connection:
        line = Line()
        self.lines.append(line)
        return self.register.add(peer, line)

    @property
    def closed(self) -> list[int]:
        return [number for number, line in enumerate(self.lines) if line.is_closed]


def test_the_oldest_of_an_address_makes_room_and_others_keep_theirs() -> None:
    crowd = Crowd()
    crowd.add("a")
    for _ in range(5):
        crowd.add("b")
    assert crowd.closed == [1, 2]
    assert crowd.register.troubles == {Trouble.CROWD: 2}
    assert len(crowd.register.all()) == 4


def test_a_connection_that_is_answered_goes_last() -> None:
    crowd = Crowd()
    first = crowd.add("a")
    first.is_asking = True
    for _ in range(3):
        crowd.add("a")
    assert crowd.closed == [1]
    for one in crowd.register.all():
        one.is_asking = True
    crowd.add("a")
    assert crowd.closed == [0, 1]


def test_the_address_with_the_most_makes_room_for_all_addresses() -> None:
    crowd = Crowd()
    for peer in ("a", "b", "b", "b", "c", "d", "e"):
        crowd.add(peer)
    assert crowd.closed == [1]


def test_known_connections_take_no_place_of_strangers() -> None:
    crowd = Crowd()
    for _ in range(4):
        known = crowd.add("a")
        known.is_asking = True
        assert known.accept_request(is_socket=False)
        assert known.is_known
    for _ in range(3):
        crowd.add("a")
    assert crowd.closed == []


def test_a_known_connection_that_rests_makes_room_and_one_that_is_answered_does_not() -> None:
    crowd = Crowd()
    known = [crowd.add(str(number)) for number in range(4)]
    for one in known:
        one.is_asking = True
        one.accept_request(is_socket=False)
    assert not crowd.add("new").accept_request(is_socket=False)
    assert crowd.register.troubles[Trouble.FULL] == 1
    known[2].answered()
    known[0].answered()
    assert crowd.add("newer").accept_request(is_socket=False)
    assert crowd.closed == [2]


def test_sockets_leave_places_for_requests() -> None:
    crowd = Crowd()
    sockets = [crowd.add("a") for _ in range(3)]
    assert [one.accept_request(is_socket=True) for one in sockets] == [True, True, False]
    assert sockets[2].accept_request(is_socket=False)
    sockets[0].ended()
    sockets[0].ended()
    assert crowd.add("b").accept_request(is_socket=True)


def test_without_a_token_an_address_may_have_all_places_of_strangers() -> None:
    crowd = Crowd(Limits(of_peer=None, strangers=6, known=4, sockets=2))
    for _ in range(7):
        crowd.add("a")
    assert crowd.closed == [0]


def test_room_is_made_until_nobody_is_left() -> None:
    crowd = Crowd()
    crowd.add("a")
    assert crowd.register.close_a_stranger()
    assert not crowd.register.close_a_stranger()


@pytest.mark.parametrize("descriptors", [64, 256, 1024, 1_000_000])
def test_limits_leave_descriptors_to_the_studio(descriptors: int) -> None:
    limits = limits_for(descriptors, has_token=True)
    assert 0 < limits.strangers <= MOST_STRANGERS
    assert 0 < limits.sockets < limits.known <= MOST_KNOWN
    assert limits.strangers + limits.known <= max(descriptors // 2, descriptors - 384)
    assert limits.of_peer == MOST_OF_PEER
    assert limits_for(descriptors, has_token=False).of_peer is None


def test_a_stop_is_not_pushed_out_by_newer_requests_with_the_token() -> None:
    crowd = Crowd()
    for rank in (Rank.STOP, Rank.TOKEN, Rank.STRANGER, Rank.TOKEN, Rank.TOKEN):
        one = crowd.add("a")
        one.is_asking, one.rank = True, rank
    assert crowd.closed == [1, 2]
