"""Each wrong token in a minute waits longer, and nothing else does."""

from __future__ import annotations

import asyncio
from typing import Any

import httpx2
import pytest
from fastapi import FastAPI
from starlette.middleware import Middleware

from app.web.access import Access, Guard
from app.web.wrong_tokens import WrongTokens
from tests.support.own_loop import run_apart

TOKEN = "a-token-of-enough-letters"


def test_the_wait_doubles_up_to_four_seconds_and_is_forgotten_after_a_minute() -> None:
    now = 0.0
    wrong = WrongTokens(lambda: now)
    assert [wrong.seconds() for _ in range(7)] == [0.25, 0.5, 1.0, 2.0, 4.0, 4.0, 4.0]
    assert {wrong.seconds() for _ in range(10_000)} == {4.0}
    now = 61.0
    assert wrong.seconds() == 0.25


class Held(WrongTokens):
    """Lets wrong tokens wait until told."""

    def __init__(self) -> None:
        super().__init__()
        self.waiting = 0
        self.released = asyncio.Event()

    async def wait(self) -> None:
        """Waits for the event."""
        self.waiting += 1
        await self.released.wait()


async def asked(client: httpx2.AsyncClient, path: str, **options: Any) -> int:
    return (await client.post(path, **options)).status_code


@pytest.mark.parametrize(
    "wrong",
    [
        {"headers": {"authorization": "Bearer wrong"}},
        {"headers": {"cookie": "footfall_token_8400=wrong"}},
        {"params": {"token": "wrong"}},
    ],
)
def test_right_tokens_stop_and_requests_without_a_token_pass_those_that_wait(wrong: dict[str, Any]) -> None:
    async def play() -> None:
        held = Held()
        app = FastAPI(middleware=[Middleware(Guard, access=Access("h.example", TOKEN), wrong_tokens=held)])

        @app.post("/api/robot/stop")
        async def stop() -> str:
            return "stopping"

        transport = httpx2.ASGITransport(app)
        async with httpx2.AsyncClient(transport=transport, base_url="http://h.example:8400") as client:
            late = [asyncio.ensure_future(asked(client, "/api/robot/stop", **wrong)) for _ in range(20)]
            while held.waiting < len(late):
                await asyncio.sleep(0)
            right = {"headers": {"authorization": f"Bearer {TOKEN}"}}
            assert await asked(client, "/api/robot/stop", **right) == 200
            assert await asked(client, "/api/robot/stop") == 403
            assert not any(one.done() for one in late)
            assert held.waiting == len(late)
            held.released.set()
            assert await asyncio.gather(*late) == [403] * len(late)

    run_apart(play())
