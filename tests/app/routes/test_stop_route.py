"""The stop over HTTP waits for nothing else that the server does."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import httpx
import pytest
from anyio.to_thread import current_default_thread_limiter
from fastapi import FastAPI
from fastapi.testclient import TestClient

from app.routes.robot import robot
from tests.support.own_loop import run_apart

PATIENCE = 60.0


class FakeBridge:
    """Notes which thread sends a stop, and which does what is left of it."""

    def __init__(self, *, leaves_some: bool) -> None:
        self._leaves_some = leaves_some
        self.by = self.sent_on = self.left_to = ""

    def try_stop(self, by: str) -> Callable[[], None] | None:
        self.by = by
        self.sent_on = threading.current_thread().name
        return self._rest if self._leaves_some else None

    def _rest(self) -> None:
        self.left_to = threading.current_thread().name


def app_with(bridge: FakeBridge, lane: ThreadPoolExecutor | None = None) -> FastAPI:
    app = FastAPI()
    app.include_router(robot.router)
    service = SimpleNamespace(bridge=bridge, view=dict)
    app.state.studio = SimpleNamespace(robot=service, stop_executor=lane)
    return app


async def stop_where_every_worker_is_taken(bridge: FakeBridge, lane: ThreadPoolExecutor) -> int:
    app = app_with(bridge, lane)
    limiter = current_default_thread_limiter()
    for _ in range(int(limiter.total_tokens)):
        limiter.acquire_on_behalf_of_nowait(object())
    transport = httpx.ASGITransport(app)
    async with httpx.AsyncClient(transport=transport, base_url="http://studio") as client:
        answer = await asyncio.wait_for(client.post("/api/robot/stop?by=Grace"), PATIENCE)
    return answer.status_code


@pytest.mark.parametrize("leaves_some", [False, True])
def test_a_stop_goes_out_on_the_servers_own_thread_though_every_worker_is_taken(leaves_some: bool) -> None:
    bridge = FakeBridge(leaves_some=leaves_some)
    with ThreadPoolExecutor(1, "stop") as lane:
        assert run_apart(stop_where_every_worker_is_taken(bridge, lane), "server") == 200
    assert bridge.by == "Grace"
    assert bridge.sent_on.startswith("server")
    assert bridge.left_to.startswith("stop") is leaves_some


@pytest.mark.parametrize(
    ("said", "by"), [("", robot.SOMEBODY), ("%20", robot.SOMEBODY), ("G" * 81, "G" * 80), ("a&by=b", "b")]
)
def test_a_stop_is_refused_nobody_for_their_name(said: str, by: str) -> None:
    bridge = FakeBridge(leaves_some=False)
    answer = TestClient(app_with(bridge)).post(f"/api/robot/stop?by={said}")
    assert answer.status_code == 200
    assert bridge.by == by
