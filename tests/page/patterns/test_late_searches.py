"""News of a search that comes late: it is never taken for the answer of a later search."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, Route, WebSocketRoute, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True
pytestmark = pytest.mark.heavy

LONGER_THAN_A_REST_MS = 800
"""After a shorter rest the page asks for more patterns."""


class SlowSearches:
    """Searches of the studio; a test decides when the page hears that one runs, and when it gets the answer.

    Args:
        page: before it is opened.
        studio: that searches.
    """

    def __init__(self, page: Page, studio: StudioProcess) -> None:
        self._page = page
        self._studio = studio
        self._asked: list[tuple[Route, dict[str, Any]]] = []
        self._socket: WebSocketRoute | None = None
        page.route_web_socket("**/api/events*", self._connect)
        page.route("**/api/patterns", self._ask)

    @property
    def count(self) -> int:
        """How many searches the page has asked for."""
        self._page.evaluate("null")
        return len(self._asked)

    def runs(self, number: int) -> None:
        """Says that a search has begun; waits until the page asks for it."""
        wait_for(lambda: self.count > number, f"the page asks for search {number}")
        route, content = self._asked[number]
        route.fulfill(status=202, json={"id": content["id"], "state": "running", "progress": None})

    def ends(self, number: int) -> None:
        """Tells the answer of a search; waits until the page asks for it."""
        wait_for(lambda: self.count > number, f"the page asks for search {number}")
        assert self._socket is not None
        self._socket.send(json.dumps({"type": "pattern", **self._asked[number][1]}))

    def _ask(self, route: Route) -> None:
        content = route.fetch().json()
        while content["state"] == "running":
            content = self._studio.ask("GET", f"/api/patterns/{content['id']}").content
        self._asked.append((route, content))

    def _connect(self, socket: WebSocketRoute) -> None:
        server = self._socket = socket
        studio = socket.connect_to_server()

        def take(message: str | bytes) -> None:
            if json.loads(message)["type"] != "pattern":
                server.send(message)

        studio.on_message(take)


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as opened:
        yield opened


def test_late_news_of_the_search_before_ends_no_later_one(page: Page, studio: StudioProcess) -> None:
    searches = SlowSearches(page, studio)
    page.goto(studio.url)
    expect(page.get_by_label("Gait name")).not_to_have_value("")
    page.get_by_role("tab", name="Pattern search").click()
    status = page.get_by_role("status", name="Pattern found")
    walk = page.get_by_role("button", name="Walk it")
    patterns = page.get_by_role("listbox", name="Best patterns").get_by_role("option")
    searches.runs(0)
    expect(status).to_contain_text("Searching")
    searches.ends(0)
    expect(status).to_contain_text("Optimal")
    searches.runs(1)  # asks for more patterns

    page.get_by_role("slider", name="Gait B: boundary sample").press("ArrowRight")
    wait_for(lambda: searches.count > 2, "the page asks anew")
    searches.ends(1)
    searches.runs(2)
    expect(status).to_contain_text("Searching")
    page.wait_for_timeout(LONGER_THAN_A_REST_MS)
    assert searches.count == 3, "more patterns are not asked for before the best one is known"
    expect(walk).to_have_attribute("aria-disabled", "true")
    searches.ends(2)
    expect(status).to_contain_text("Optimal")
    expect(walk).not_to_have_attribute("aria-disabled", "true")
    expect(patterns).to_have_count(1)
    searches.runs(3)
    searches.ends(3)
    expect(patterns).to_have_count(5)
    expect(walk).not_to_have_attribute("aria-disabled", "true")


def test_news_that_overtakes_the_answer_to_the_question_counts(page: Page, studio: StudioProcess) -> None:
    searches = SlowSearches(page, studio)
    page.goto(studio.url)
    expect(page.get_by_label("Gait name")).not_to_have_value("")
    page.get_by_role("tab", name="Pattern search").click()
    searches.ends(0)
    searches.runs(0)
    expect(page.get_by_role("status", name="Pattern found")).to_contain_text("Optimal")
    expect(page.get_by_role("button", name="Walk it")).not_to_have_attribute("aria-disabled", "true")
    searches.runs(1)
