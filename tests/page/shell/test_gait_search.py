"""A long list of gaits: found by words, and one line of it follows an edit."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from app.bench.page.gait_list import fill
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, running_studio

pytestmark = pytest.mark.heavy

COUNT = 40


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    data: Path = tmp_path_factory.mktemp("many")
    fill(data, COUNT)
    with running_studio(data) as running:
        yield running


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def test_gaits_are_found_by_words_and_escape_shows_all(page: Page) -> None:
    gaits = page.get_by_role("list", name="Gaits").locator("button.gait")
    expect(gaits.nth(COUNT)).to_be_attached()
    all_of_them = gaits.count()
    search = page.get_by_role("searchbox", name="Find a gait")
    search.fill("trial FBS 4")
    expect(gaits).to_have_count(3)  # 4, 24 and 40
    search.fill("trot")
    expect(gaits.first).to_have_accessible_name(re.compile("Trot"))
    search.fill("nothing like it")
    expect(gaits).to_have_count(0)
    expect(page.get_by_text("No gait matches “nothing like it”")).to_be_visible()
    search.press("Escape")
    expect(gaits).to_have_count(all_of_them)
    expect(search).to_have_value("")


def test_the_list_stands_before_the_studio_has_greeted(browser: Browser, studio: StudioProcess) -> None:
    page = browser.new_page()
    page.route_web_socket("**/api/events**", lambda socket: None)
    page.goto(studio.url)
    gaits = page.get_by_role("list", name="Gaits")
    expect(gaits.get_by_role("button", name="Trial 40")).to_be_visible()
    gaits.get_by_role("button", name="Trial 40").click()
    expect(page.get_by_label("Gait name")).to_have_value("Trial 40")
    page.close()


def test_a_list_that_does_not_come_with_the_page_comes_with_the_greeting(page: Page) -> None:
    page.route("**/api/gaits", lambda route: route.abort())
    page.reload()
    gaits = page.get_by_role("list", name="Gaits")
    expect(gaits.get_by_role("button", name="Trial 40")).to_be_visible()


def test_a_line_of_the_list_follows_an_edit_elsewhere(page: Page, studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/trial-0007").content
    studio.ask("PUT", "/api/gaits/trial-0007?label=Name", {**document, "name": "Seventh heaven"})
    line = page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Seventh heaven"))
    expect(line).to_have_attribute("title", re.compile("unsaved changes"))
