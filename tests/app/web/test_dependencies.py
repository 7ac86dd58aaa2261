"""Refusals over HTTP: a status that fits, and a sentence that can always be shown."""

from __future__ import annotations

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

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
