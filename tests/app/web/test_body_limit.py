"""Bodies of requests over the limit are refused with a sentence, whether they tell their size or not."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterator
from typing import Annotated, Any

import pytest
from fastapi import Body, FastAPI, Request
from fastapi.testclient import TestClient
from starlette.middleware import Middleware
from starlette.types import Message, Receive, Scope, Send

from app.web import body_limit
from app.web.body_limit import BodyLimit
from app.web.dependencies import install_error_handlers
from core.text.json_size import MOST_VALUES
from tests.support.own_loop import run_apart

LIMIT = 1000


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> TestClient:
    monkeypatch.setattr(body_limit, "MOST_BODY", LIMIT)
    app = FastAPI(middleware=[Middleware(BodyLimit)])
    install_error_handlers(app)

    @app.post("/json")
    async def read_json(text: Annotated[Any, Body()]) -> int:
        return len(text)

    @app.post("/stream")
    @app.post("/api/videos")
    async def read_stream(request: Request) -> int:
        return sum([len(chunk) async for chunk in request.stream()])

    return TestClient(app)


def parts(count: int) -> Iterator[bytes]:
    yield b'"'
    for _ in range(count - 2):
        yield b"x"
    yield b'"'


@pytest.mark.parametrize("path", ["/json", "/stream"])
def test_a_body_over_the_limit_is_refused(client: TestClient, path: str) -> None:
    for content in (b"".join(parts(LIMIT + 1)), parts(LIMIT + 1)):
        answer = client.post(path, content=content, headers={"content-type": "application/json"})
        assert (answer.status_code, answer.json()["where"]) == (413, "body")
        assert "Send less at a time." in answer.json()["error"]


@pytest.mark.parametrize("path", ["/json", "/stream"])
def test_a_body_of_the_limit_is_read(client: TestClient, path: str) -> None:
    for content in (b"".join(parts(LIMIT)), parts(LIMIT)):
        answer = client.post(path, content=content, headers={"content-type": "application/json"})
        assert answer.json() == (LIMIT - 2 if path == "/json" else LIMIT)


def test_a_video_has_a_limit_of_its_own(client: TestClient) -> None:
    assert client.post("/api/videos", content=parts(10 * LIMIT)).json() == 10 * LIMIT


@pytest.mark.parametrize("kind", ["application/json", "application/gait+JSON; charset=utf-8"])
def test_json_of_too_many_values_is_refused_before_it_is_read(client: TestClient, kind: str) -> None:
    many = b"[" + b"0," * MOST_VALUES + b"0]"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(body_limit, "MOST_BODY", 2 * len(many))
        answer = client.post("/json", content=many, headers={"content-type": kind})
        assert client.post("/stream", content=many).json() == len(many)
    assert answer.status_code == 413
    assert answer.json() == {
        "error": "The JSON of the request has more than 500,000 values. Send less at a time.",
        "where": "body",
    }


def test_large_bodies_are_worked_at_one_at_a_time_with_a_rest_between(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(body_limit, "LARGE_BYTES", 10)
    monkeypatch.setattr(body_limit, "REST_SECONDS", 0.05)
    begun: list[str] = []
    ended: dict[str, float] = {}

    async def work(scope: Scope, receive: Receive, send: Send) -> None:
        await receive()
        if scope["path"] == "/small":
            assert len(begun) > len(ended)
            await send({"type": "http.response.start", "status": 204, "headers": []})
            return
        assert len(begun) == len(ended)
        begun.append(scope["path"])
        assert all(time.monotonic() - end >= 0.05 for end in ended.values())
        await asyncio.sleep(0.01)
        ended[scope["path"]] = time.monotonic()
        if scope["path"] == "/fails":
            raise ValueError
        await send({"type": "http.response.start", "status": 204, "headers": []})

    async def ask(limit: BodyLimit, path: str, size: int) -> None:
        async def body() -> Message:
            return {"type": "http.request", "body": b"x" * size}

        async def sent(message: Message) -> None:
            assert message["status"] == 204

        await limit({"type": "http", "method": "POST", "path": path, "headers": []}, body, sent)

    async def crowd() -> list[BaseException | None]:
        limit = BodyLimit(work)
        large = [asyncio.ensure_future(ask(limit, path, 11)) for path in ("/fails", "/b", "/c")]
        while not begun:
            await asyncio.sleep(0)
        await ask(limit, "/small", 10)
        return await asyncio.gather(*large, return_exceptions=True)

    ends = run_apart(crowd())
    assert [type(end) for end in ends] == [ValueError, type(None), type(None)]
    assert begun == ["/fails", "/b", "/c"]
