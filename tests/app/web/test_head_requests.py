"""HEAD is answered as GET without the body, by pages, files, streams and refusals alike."""

from __future__ import annotations

import http.client
from collections.abc import AsyncIterator, Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from fastapi import FastAPI, Response
from fastapi.responses import FileResponse, StreamingResponse
from fastapi.testclient import TestClient
from starlette.middleware import Middleware

from app.web.dependencies import install_error_handlers
from app.web.head_requests import HeadRequests
from core.errors import StateError
from tests.support.studio_process import StudioProcess, running_studio, text_of

TOKEN = "a-token-of-enough-letters"
SHOWN = {"authorization": f"Bearer {TOKEN}"}
PATHS = [
    "/",
    "/docs",
    "/openapi.json",
    "/static/editor.js",
    "/static/page.css",
    "/static-offline-docs/swagger-ui.css",
    "/viser/",
    "/api/health",
    "/api/gaits/walk",
    "/api/gaits/walk/export/json",
    "/api/gaits/walk/export/none",
    "/api/videos/none/file",
    "/api/robot/stop",
    "/docs/",
    "/static/none",
    "/none",
]
"""Pages, files, views, and what is refused or led elsewhere."""

Answer = tuple[int, dict[str, str], bytes]


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    app = FastAPI(middleware=[Middleware(HeadRequests)])
    install_error_handlers(app)
    kept = tmp_path / "kept.txt"
    kept.write_text("a file")

    @app.get("/page")
    async def page() -> Response:
        return Response("page", headers={"x-own": "1"})

    @app.get("/file")
    async def file() -> FileResponse:
        return FileResponse(kept)

    @app.get("/refused")
    async def refused() -> None:
        raise StateError("This does not go.", "here")

    @app.get("/endless")
    async def endless() -> StreamingResponse:
        async def parts() -> AsyncIterator[bytes]:
            while True:
                yield b"part"

        return StreamingResponse(parts(), media_type="text/plain")

    @app.post("/send")
    async def send() -> None:
        raise AssertionError("HEAD is no POST")

    return TestClient(app)


@pytest.mark.parametrize("path", ["/page", "/file", "/refused", "/send", "/none"])
def test_head_has_the_status_and_the_headers_of_get(client: TestClient, path: str) -> None:
    got, asked = client.get(path), client.head(path)
    assert (asked.status_code, asked.headers) == (got.status_code, got.headers)
    assert int(asked.headers["content-length"]) == len(got.content) > 0
    assert asked.content == b""


def test_a_stream_without_end_is_not_begun(client: TestClient) -> None:
    asked = client.head("/endless")
    assert (asked.status_code, asked.content) == (200, b"")
    assert asked.headers["content-type"].startswith("text/plain")


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data"), "--token", TOKEN) as running:
        yield running


def answer_to(studio: StudioProcess, method: str, path: str, headers: dict[str, str]) -> Answer:
    place = urlsplit(studio.url)
    connection = http.client.HTTPConnection(place.hostname or "", place.port, timeout=60)
    try:
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        own = {name.lower(): value for name, value in answer.getheaders() if name.lower() != "date"}
        return answer.status, own, answer.read()
    finally:
        connection.close()


HEADERS = {
    "let in": SHOWN,
    "packed": SHOWN | {"accept-encoding": "gzip"},
    "without the token": {},
    "foreign host": SHOWN | {"host": "evil.example"},
    "foreign page": SHOWN | {"origin": "http://evil.example"},
}


@pytest.mark.parametrize("who", HEADERS)
def test_the_studio_answers_head_as_get(studio: StudioProcess, who: str) -> None:
    for path in PATHS:
        status, headers, body = answer_to(studio, "GET", path, HEADERS[who])
        assert answer_to(studio, "HEAD", path, HEADERS[who]) == (status, headers, b""), path
        assert "content-security-policy" in headers
        assert int(headers["content-length"]) == len(body)
    assert "Traceback" not in text_of(studio.said)


@pytest.mark.parametrize("path", ["/", "/static/editor.js"])
def test_an_address_with_the_token_leads_to_the_one_without_it(studio: StudioProcess, path: str) -> None:
    address = f"{path}?token={TOKEN}"
    status, headers, _ = answer_to(studio, "GET", address, {})
    assert answer_to(studio, "HEAD", address, {}) == (status, headers, b"")
    assert (status, headers["location"]) == (303, path)


def test_a_page_that_did_not_change_has_no_body_either(studio: StudioProcess) -> None:
    headers = SHOWN | {"if-none-match": answer_to(studio, "HEAD", "/viser/", SHOWN)[1]["etag"]}
    status, own, body = answer_to(studio, "GET", "/viser/", headers)
    assert answer_to(studio, "HEAD", "/viser/", headers) == (status, own, body) == (304, own, b"")
