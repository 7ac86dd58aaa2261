"""Bodies of requests over the limit are refused with a sentence, whether they tell their size or not."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

import pytest
from fastapi import Body, FastAPI, Request
from fastapi.testclient import TestClient
from starlette.middleware import Middleware

from app.web import body_limit
from app.web.body_limit import BodyLimit
from app.web.dependencies import install_error_handlers

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
