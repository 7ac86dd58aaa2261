"""How fast a gait goes, and how fast it turns where it only turns."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        yield opened


def test_the_list_shows_a_rate_for_gaits_that_only_turn(page: Page) -> None:
    gaits = page.get_by_role("list", name="Gaits")
    turn = gaits.get_by_role("button", name="Fast turn on the spot")
    expect(turn.locator(".tag")).to_have_text("4.5°/s")
    expect(turn).to_have_attribute("title", re.compile(r"43\.8 s on the robot · 4\.5°/s"))
    expect(gaits.get_by_role("button", name="Fast C-Gait").locator(".tag")).to_have_text("2.27")


def test_the_verdict_of_a_turn_has_its_rate(page: Page) -> None:
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Fast turn on the spot").click()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("43.8 s  4.5°/s")
