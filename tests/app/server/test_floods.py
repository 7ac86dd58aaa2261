"""Floods of connections without the token: Stop is answered, others go on, and the log stays short."""

from __future__ import annotations

import contextlib
import resource
import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from websockets.sync.client import connect

from app.bench.robot.floods import Attack, Flood, attacked, loopback_addresses
from app.server.listener import DEFERRED_SECONDS
from tests.support.bounded_server import all_of, head
from tests.support.studio_process import ANSWER_SECONDS, StudioProcess, running_studio, wait_for

TOKEN = "the-token-of-the-test"
SHOWN = {"Authorization": f"Bearer {TOKEN}"}
REQUEST = f"Authorization: Bearer {TOKEN}\r\nConnection: close\r\n"
OK = b"HTTP/1.1 200 OK"
DESCRIPTORS = 1024
"""What most systems allow a program."""

CONNECTIONS = 1150
MOST_LOG = 4000
"""Bytes that the log may grow by under one flood."""


@contextlib.contextmanager
def allowed_descriptors(soft: int) -> Iterator[None]:
    """Programs that are started meanwhile may have so many files open."""
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(soft, before[1]), before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)


@dataclass(frozen=True)
class Flooded:
    """A studio that demands a token, and its log."""

    studio: StudioProcess
    log: Path

    @property
    def address(self) -> tuple[str, int]:
        parts = urlsplit(self.studio.url)
        return parts.hostname or "", parts.port or 0

    def ask(self, words: str) -> bytes:
        """The answer to a request on a connection of its own.

        Where this process gets no turn between connecting and asking, its connection is one of those that ask
        nothing, and loses its place among them as it should. Then it comes again.
        """
        while True:
            begun = time.monotonic()
            with socket.create_connection(self.address, ANSWER_SECONDS) as line:
                with contextlib.suppress(ConnectionError):
                    line.sendall(head(words, REQUEST).encode())
                is_late = time.monotonic() - begun > DEFERRED_SECONDS / 2
                answer = all_of(line)
            if answer or not is_late:
                return answer

    def stop(self) -> bytes:
        """The status line of the answer to a Stop."""
        return self.ask("POST /api/robot/stop").partition(b"\r\n")[0]


@pytest.fixture(scope="module")
def flooded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Flooded]:
    with contextlib.ExitStack() as stack:
        with allowed_descriptors(DESCRIPTORS):
            folder = tmp_path_factory.mktemp("flooded")
            studio = stack.enter_context(running_studio(folder, "--token", TOKEN))
        assert studio.said is not None
        yield Flooded(replace(studio, url=studio.url.partition("?")[0]), studio.said)


@contextlib.contextmanager
def enough_descriptors() -> Iterator[int]:
    """How many connections this process may hold: as many as are wanted, if the system allows it."""
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    wanted = CONNECTIONS + 500 if hard == resource.RLIM_INFINITY else min(CONNECTIONS + 500, hard)
    with allowed_descriptors(wanted):
        yield min(CONNECTIONS, wanted - 300)


@pytest.mark.heavy
@pytest.mark.alone
def test_stop_is_answered_beside_more_half_requests_than_there_are_descriptors(flooded: Flooded) -> None:
    begin = flooded.log.stat().st_size
    half = b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n"
    with enough_descriptors() as count, contextlib.ExitStack() as lines:
        for _ in range(count):
            lines.enter_context(socket.create_connection(flooded.address, 60)).sendall(half)
        assert [flooded.stop() for _ in range(10)] == [OK] * 10
        assert b'"gaits"' in flooded.ask("GET /api/gaits")
    assert flooded.log.stat().st_size - begin < MOST_LOG


@pytest.mark.heavy
@pytest.mark.alone
@pytest.mark.parametrize("sources", [("127.0.0.1",), loopback_addresses(64)], ids=["one address", "many"])
@pytest.mark.parametrize("kinds", [*((kind,) for kind in Flood), tuple(Flood)], ids=lambda kinds: kinds[-1])
def test_a_flood_leaves_stop_and_the_others_alone(
    flooded: Flooded, kinds: tuple[Flood, ...], sources: tuple[str, ...]
) -> None:
    begin = flooded.log.stat().st_size
    with (
        connect(
            f"ws://127.0.0.1:{flooded.address[1]}/api/events", additional_headers=SHOWN, proxy=None
        ) as page,
        attacked(flooded.address, Attack(kinds, CONNECTIONS, sources)) as opened,
    ):
        assert opened() >= CONNECTIONS
        for _ in range(20):
            assert flooded.stop() == OK
            assert flooded.ask("GET /api/robot").startswith(OK)
            page.ping().wait(60)
    assert flooded.log.stat().st_size - begin < MOST_LOG


@pytest.mark.heavy
@pytest.mark.alone
def test_the_flood_that_is_over_leaves_nothing_open(flooded: Flooded) -> None:
    folder = Path(f"/proc/{flooded.studio.pid}/fd")
    if not folder.exists():
        pytest.skip("this system does not tell a process's descriptors")
    before = len(list(folder.iterdir()))
    with attacked(flooded.address, Attack(tuple(Flood), CONNECTIONS, loopback_addresses(64))):
        assert flooded.stop() == OK
        assert len(list(folder.iterdir())) < DESCRIPTORS
    wait_for(lambda: len(list(folder.iterdir())) <= before + 8, "the connections are closed")
