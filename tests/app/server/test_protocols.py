"""How long a request's body may take, on a clock of the test."""

from __future__ import annotations

import asyncio
from unittest.mock import Mock

import pytest
import uvicorn
from starlette.types import Receive, Scope, Send
from uvicorn.server import ServerState

from app.server.connections import Connections, Limits, Trouble
from app.server.protocols import BODY_RATE, BODY_SECONDS, BoundedHttp
from tests.support.own_loop import run_apart

HEAD = b"POST /count HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 1000000000\r\n\r\n"
LIMITS = Limits(of_peer=4, strangers=10, known=6, sockets=3)


async def reads_all(scope: Scope, receive: Receive, send: Send) -> None:
    while (await receive()).get("more_body"):
        pass


async def deadlines(pieces: list[tuple[float, int]], *, is_known: bool, is_paused: bool) -> list[float]:
    """The deadline after each piece of a body that came at a time, and whether it may pass at the end."""
    loop = asyncio.get_running_loop()
    connection = Connections(LIMITS).add("a", Mock())
    config = uvicorn.Config(reads_all, lifespan="off", log_config=None)
    http = BoundedHttp(config, ServerState(), {}, connection, HEAD)
    http.loop = Mock(wraps=loop)
    http.loop.time.return_value = 0.0
    transport = Mock(spec=asyncio.Transport)
    transport.get_extra_info.return_value = None
    http.connection_made(transport)
    if is_known:
        connection.accept_request(is_socket=False)
    found = [connection.deadline or 0.0]
    for when, count in pieces:
        http.loop.time.return_value = when
        http.data_received(b"x" * count)
        found.append(connection.deadline or 0.0)
        await asyncio.sleep(0)
    if is_paused:
        http.flow.pause_reading()
    assert connection.waits_for is Trouble.BODY
    assert http.time_out() is not is_paused
    assert transport.close.called is not is_paused
    http.connection_lost(None)
    await asyncio.sleep(0)
    return found


@pytest.mark.parametrize("is_paused", [False, True])
def test_a_steady_body_may_take_hours_and_a_slow_one_may_not(is_paused: bool) -> None:
    second = int(BODY_RATE)
    pieces = [(10.0, second), (15.0, 3 * second), (3600.0, 10_000 * second), (3601.0, 0 * second + 1)]
    found = run_apart(deadlines(pieces, is_known=True, is_paused=is_paused))
    assert found[:4] == [BODY_SECONDS, BODY_SECONDS + 1, BODY_SECONDS + 4, 3600.0 + BODY_SECONDS]
    assert found[4] == pytest.approx(3600.0 + BODY_SECONDS, abs=0.01)


def test_a_body_without_an_accepted_request_gets_no_more_time() -> None:
    found = run_apart(deadlines([(10.0, 100_000)], is_known=False, is_paused=False))
    assert found == [BODY_SECONDS, BODY_SECONDS]
