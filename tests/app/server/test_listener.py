"""Connections over real sockets: how many stay open, how long, and who is answered meanwhile."""

from __future__ import annotations

import socket

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import ClientConnection, connect

from app.server import listener, protocols
from app.server.bounded_server import BoundedServer
from app.server.connections import Limits, Trouble
from app.server.listener import peer_of
from tests.support.bounded_server import LONG, SHOWN, TOKEN, Served, all_of, head, is_open, served, until
from tests.support.raw_request import UPGRADE
from tests.support.studio_process import wait_for

OF_PEER, STRANGERS, KNOWN, SOCKETS = 4, 10, 6, 3
LIMITS = Limits(OF_PEER, STRANGERS, KNOWN, SOCKETS)
HALF = "GET /short HTTP/1.1\r\nHost: 127.0.0.1\r\n"
WRONG = "Authorization: Bearer wrong\r\n"
HALF_HANDSHAKE = HALF + "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
BODY = "Connection: close\r\nContent-Length: 6000\r\n"
OPENING = SHOWN + "".join(f"{name}: {value}\r\n" for name, value in UPGRADE.items())


@pytest.fixture
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    """Deadlines of a fraction of a second."""
    monkeypatch.setattr(listener, "HEAD_SECONDS", 0.3)
    monkeypatch.setattr(protocols, "HEAD_SECONDS", 0.3)
    monkeypatch.setattr(protocols, "BODY_SECONDS", 0.5)
    monkeypatch.setattr(listener, "UNREAD_SECONDS", 0.3)
    monkeypatch.setattr(listener, "LOOK_SECONDS", 0.05)


def count_open(lines: list[socket.socket]) -> int:
    return sum(is_open(line) for line in lines)


def talk_to(server: Served) -> ClientConnection:
    return connect(f"ws://127.0.0.1:{server.port}/talk?token={TOKEN}", proxy=None)


@pytest.mark.parametrize("opening", [HALF, HALF_HANDSHAKE, "G"])
def test_half_requests_of_one_address_make_room_for_the_newest_and_for_the_token(opening: str) -> None:
    with served(LIMITS) as server:
        lines = [server.line(opening) for _ in range(40)]
        assert server.ask("GET /short").endswith(b"short")
        wait_for(lambda: count_open(lines) <= OF_PEER, "the oldest are closed")
        assert b" 403 " in server.ask("GET /short", headers="")


def test_all_addresses_together_have_a_limit_and_one_with_few_keeps_its_place() -> None:
    with served(LIMITS) as server:
        honest = server.line(HALF, "127.0.0.9")
        lines = [server.line(HALF, f"127.0.0.{number % 5 + 2}") for number in range(50)]
        assert server.ask("POST /api/robot/stop").endswith(b"stopped")
        wait_for(lambda: count_open(lines) < STRANGERS, "the oldest are closed")
        honest.sendall(f"{SHOWN}Connection: close\r\n\r\n".encode())
        assert all_of(honest).endswith(b"short")


def test_a_head_that_does_not_end_is_answered_with_a_sentence_and_closed(soon: None) -> None:
    with served(LIMITS) as server:
        silent, half = server.line(), server.line(HALF)
        answer = all_of(half)
        assert answer.startswith(b"HTTP/1.1 408 ")
        assert b'"error"' in answer
        assert all_of(silent) == b""


@pytest.mark.parametrize("before", ["", head("GET /short")])
def test_a_head_that_drips_gets_no_more_time(soon: None, before: str) -> None:
    with served(LIMITS) as server:
        line = server.line(before + HALF + "X-Long: ")
        came = b""
        while b" 408 " not in came:
            line.settimeout(0.05)
            try:
                came += line.recv(65536)
                line.sendall(b"x")
            except TimeoutError:
                continue
            except OSError:
                break
        assert came.count(b"short") == bool(before)


@pytest.mark.parametrize(("shown", "status"), [(SHOWN, b" 408 "), (WRONG, b" 403 ")])
def test_half_a_body_is_closed(soon: None, shown: str, status: bytes) -> None:
    with served(LIMITS) as server:
        assert status in all_of(server.line(head("POST /count", shown + BODY) + "half"))


def test_an_answer_that_is_not_read_is_cut_off(soon: None) -> None:
    with served(LIMITS) as server:
        line = server.line(head("GET /long", SHOWN + "Connection: close\r\n"))

        def is_cut() -> bool:
            try:
                line.sendall(b"\r\n")
            except OSError:
                return True
            return False

        wait_for(is_cut, "the server has given up")
        assert len(all_of(line)) < LONG


def test_a_refused_peer_must_connect_anew() -> None:
    with served(LIMITS) as server:
        answers = all_of(server.line(head("GET /short", WRONG) * 3))
        assert answers.count(b"HTTP/1.1 403 ") == 1


def test_a_refused_peer_that_still_sent_its_body_must_connect_anew_too() -> None:
    refused = head("POST /count", WRONG + "Content-Length: 2\r\n")
    with served(LIMITS) as server:
        line = server.line(refused)
        assert b" 403 " in until(line, b"}")
        line.sendall(f"ab{refused}ab".encode())
        assert all_of(line) == b""


@pytest.mark.parametrize(
    "opening",
    [
        head("POST /talk", OPENING),
        head("GET /talk", OPENING + "Content-Length: 2\r\n") + "ab",
        head("GET /talk", OPENING + "Transfer-Encoding: chunked\r\n") + "0\r\n\r\n",
        head("GET /talk?x=" + "x" * 9000, OPENING),
        head("GET /talk", OPENING + "".join(f"X-{number}: 1\r\n" for number in range(300))),
    ],
    ids=["method", "body", "chunks", "long", "many"],
)
def test_an_opening_that_no_web_socket_takes_is_refused(opening: str) -> None:
    with served(LIMITS) as server:
        assert all_of(server.line(opening)).startswith(b"HTTP/1.1 400 ")


@pytest.mark.parametrize("is_answered", [True, False])
def test_garbage_beside_an_answer_leaves_no_traceback(
    caplog: pytest.LogCaptureFixture, is_answered: bool
) -> None:
    with served(LIMITS) as server:
        line = server.line(
            head("GET /short", SHOWN + "Transfer-Encoding: chunked\r\n") + "zz\r\n" * (not is_answered)
        )
        if is_answered:
            until(line, b"short")
            line.sendall(b"zz\r\n")
        all_of(line)
        assert server.ask("GET /short").endswith(b"short")
    assert [record for record in caplog.records if record.levelname == "ERROR"] == []


def test_a_socket_that_opens_behind_another_request_keeps_its_place() -> None:
    with served(LIMITS) as server:
        line = server.line(head("GET /short") + head("GET /talk", OPENING))
        until(line, b" 101 ")
        for _ in range(3 * KNOWN):
            assert b"short" in until(server.line(head("GET /short")), b"short")
        assert is_open(line)


@pytest.mark.heavy
def test_deadlines_go_on_after_an_error_while_they_were_looked_at(
    soon: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(server: BoundedServer) -> None:
        raise OSError("the log cannot be written")

    monkeypatch.setattr(BoundedServer, "_flush_log", fails)
    with served(LIMITS) as server:
        assert all_of(server.line()) == b""
        assert all_of(server.line()) == b""


def test_stop_finds_its_way_when_every_place_is_taken() -> None:
    with served(LIMITS) as server:
        talking = [talk_to(server) for _ in range(SOCKETS)]
        with pytest.raises(InvalidStatus):
            talk_to(server)
        bodies = [server.line(head("POST /count", SHOWN + BODY)) for _ in range(KNOWN - SOCKETS)]
        wait_for(lambda: b" 503 " in server.ask("GET /short"), "all places are taken")
        assert server.ask("POST /api/robot/stop").endswith(b"stopped")
        for one in talking:
            one.send("still here")
            assert one.recv() == "still here"
        talking[0].close()
        wait_for(lambda: server.ask("GET /short").endswith(b"short"), "a place is free again")
        for one in talking[1:]:
            one.close()
        assert count_open(bodies) == len(bodies)


def test_connections_that_rest_make_room_for_others() -> None:
    with served(LIMITS) as server:
        for _ in range(3 * KNOWN):
            assert b"short" in until(server.line(head("GET /short")), b"short")
        wait_for(lambda: count_open(server.lines) <= KNOWN, "the first are closed")


def test_without_a_token_one_address_may_have_all_places_of_strangers() -> None:
    with served(Limits(None, STRANGERS, KNOWN, SOCKETS), token=None) as server:
        lines = [server.line(HALF) for _ in range(OF_PEER + 1)]
        assert server.ask("POST /api/robot/stop", headers="").endswith(b"stopped")
        assert count_open(lines) == len(lines)
        lines += [server.line(HALF) for _ in range(40)]
        assert server.ask("POST /api/robot/stop", headers="").endswith(b"stopped")
        wait_for(lambda: count_open(lines) <= STRANGERS, "the oldest are closed")


def test_a_flood_leaves_few_lines_in_the_log(caplog: pytest.LogCaptureFixture, soon: None) -> None:
    with served(LIMITS) as server:
        lines = [server.line(HALF) for _ in range(60)]
        wait_for(lambda: count_open(lines) == 0, "all are closed")
    kinds = [record.getMessage().partition(" (and")[0] for record in caplog.records]
    assert {Trouble.CROWD, Trouble.HEAD} <= set(kinds)


def test_without_descriptors_the_newest_connection_still_gets_in(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(listener, "REST_SECONDS", 0.001)
    with served(LIMITS, failures=50) as server:
        assert server.ask("POST /api/robot/stop").endswith(b"stopped")
        wait_for(lambda: Trouble.DESCRIPTORS in caplog.text, "the log tells of it")


@pytest.mark.parametrize(
    ("address", "peer"),
    [
        ("10.0.0.7", "10.0.0.7"),
        ("::1", "::1"),
        ("::ffff:10.0.0.7", "10.0.0.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::/64"),
        ("fe80::1%eth0", "fe80::/64"),
    ],
)
def test_an_ipv6_network_counts_as_one_peer(address: str, peer: str) -> None:
    assert peer_of(address) == peer
