"""Refusals over HTTP: a status that fits, and a sentence that can always be shown."""

from __future__ import annotations

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from starlette.middleware import Middleware

from app.web.access import HEADERS, Access, Guard
from app.web.dependencies import install_error_handlers
from core.errors import FootfallError, InputError, NotFoundError, RobotError, StateError


@pytest.mark.parametrize(
    ("error", "status", "sentence"),
    [
        (InputError("Half \ud800 a character.", "na\udfffme"), 422, "Half \\ud800 a character."),
        (NotFoundError("There is no gait “x”."), 404, "There is no gait “x”."),
        (StateError("Not now."), 409, "Not now."),
        (RobotError("No answer."), 503, "No answer."),
    ],
)
def test_a_refusal_has_its_status_and_its_sentence(error: FootfallError, status: int, sentence: str) -> None:
    app = FastAPI()
    install_error_handlers(app)

    @app.get("/")
    async def refused() -> None:
        raise error

    answer = TestClient(app).get("/")
    assert (answer.status_code, answer.json()["error"]) == (status, sentence)
    assert (answer.json()["where"] is None) == (error.where is None)


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "words"),
    [
        ("GET", "/nowhere", b"", 404, "/nowhere"),
        ("PUT", "/kept", b"", 405, "POST"),
        ("POST", "/kept", b"[" * 100_000, 422, "body"),
        ("POST", "/kept", b'{"a": ' + b"9" * 5000 + b"}", 422, "body"),
        ("POST", "/kept", b'{"a": "\xff"}', 422, "body"),
        ("POST", "/kept", b"{", 422, "body"),
    ],
)
def test_what_no_route_answers_is_refused_with_a_sentence_too(
    method: str, path: str, body: bytes, status: int, words: str
) -> None:
    app = FastAPI()
    install_error_handlers(app)

    @app.post("/kept")
    async def kept(content: dict[str, int]) -> dict[str, int]:
        return content

    answer = TestClient(app).request(method, path, content=body, headers={"content-type": "application/json"})
    assert (answer.status_code, words in answer.json()["error"]) == (status, True)
    assert answer.json()["where"]
    assert ("POST" in answer.headers.get("allow", "")) == (status == 405)


def test_a_defect_is_answered_with_a_sentence_and_the_headers_of_every_answer() -> None:
    app = FastAPI(middleware=[Middleware(Guard, access=Access("127.0.0.1", None))])
    install_error_handlers(app)

    @app.get("/")
    async def defect() -> None:
        raise ValueError("secret insides")

    answer = TestClient(app, "http://127.0.0.1", raise_server_exceptions=False).get("/")
    assert answer.status_code == 500
    assert answer.json()["error"]
    assert "secret" not in answer.text
    assert {name.decode(): text.decode() for name, text in HEADERS.items()}.items() <= answer.headers.items()
