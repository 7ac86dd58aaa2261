"""The API's page may run its own scripts and nothing else, and works under that policy."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator
from hashlib import sha256

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from fastapi_offline import FastAPIOffline
from playwright.sync_api import Browser, expect

from app.web.api_page import add_api_page
from tests.support.page.serving import serving


@pytest.fixture
def app() -> FastAPI:
    app: FastAPI = FastAPIOffline(title="Test", docs_url=None, redoc_url=None)
    add_api_page(app)

    @app.get("/answer")
    async def answer() -> int:
        return 42

    return app


def policy_of(app: FastAPI) -> dict[str, list[str]]:
    """The policy's sources by what they are for."""
    parts = TestClient(app).get("/docs").headers["content-security-policy"].split("; ")
    return {name: sources for name, *sources in (part.split() for part in parts)}


def test_scripts_are_the_studios_own_and_the_one_in_the_page(app: FastAPI) -> None:
    page = TestClient(app).get("/docs").text
    inline = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    own, *hashes = policy_of(app)["script-src"]
    assert own == "'self'"
    assert len(hashes) == len(inline) == 1
    assert sha256(inline[0].encode()).digest().hex() == decoded(hashes[0])


def decoded(source: str) -> str:
    return b64decode(source.removeprefix("'sha256-").removesuffix("'")).hex()


def test_nothing_that_is_not_named_may_be_loaded_framed_or_sent(app: FastAPI) -> None:
    policy = policy_of(app)
    assert {name: policy[name] for name in ("default-src", "frame-ancestors", "base-uri", "form-action")} == {
        "default-src": ["'none'"],
        "frame-ancestors": ["'none'"],
        "base-uri": ["'none'"],
        "form-action": ["'none'"],
    }
    assert policy["connect-src"] == ["'self'"]
    assert not {"'unsafe-inline'", "'unsafe-eval'", "*"} & {
        one for sources in policy.values() for one in sources
    }


def test_no_page_is_left_that_logs_in_elsewhere(app: FastAPI) -> None:
    assert TestClient(app).get("/docs/oauth2-redirect").status_code == 404


@pytest.fixture
def address(app: FastAPI) -> Iterator[str]:
    with serving(app) as host:
        yield f"http://{host}/docs"


@pytest.mark.heavy
def test_an_operation_is_tried_on_the_page_without_a_complaint(browser: Browser, address: str) -> None:
    page = browser.new_page()
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(address)
    page.locator(".opblock-summary-control").click()
    page.get_by_role("button", name="Try it out").click()
    page.get_by_role("button", name="Execute").click()
    expect(page.locator(".live-responses-table")).to_contain_text("42")
    page.close()
    assert said == []
