"""Who asks the system for less motion gets no transition, no animation and no playback by itself."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True
pytestmark = pytest.mark.heavy

MOVING = """() => {
  document.querySelector(".hold").dataset.holding = "";
  const moves = ({ animationName, transitionDuration }) =>
    animationName !== "none" || transitionDuration.split(", ").some((one) => one !== "0s");
  const found = [...document.querySelectorAll("body, body *")].filter((element) =>
    [null, "::before", "::after"].some((part) => moves(getComputedStyle(element, part))));
  const names = found.map((element) => element.outerHTML.slice(0, 120));
  return [...names, ...document.getAnimations().map(String)];
}"""


def moving(page: Page) -> list[str]:
    """Elements that CSS would move, and what moves, while Send is held."""
    found: list[str] = page.evaluate(MOVING)
    return found


def test_nothing_moves_by_itself(browser: Browser, studio: StudioProcess) -> None:
    with opened_page(browser, studio.url, 1280, 800) as page:
        page.emulate_media(reduced_motion="no-preference")
        expect(page.locator(".hold")).to_be_attached()
        page.get_by_role("tab", name="Run").click()
        assert moving(page) != [], "what moves would be found"
        page.emulate_media(reduced_motion="reduce")
        page.reload()
        expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        expect(page.locator(".hold")).to_be_attached()
        for name in ("Run", "Pattern search", "Cells", "Design"):
            page.get_by_role("tab", name=name).click()
            assert moving(page) == [], name
        expect(page.locator("#clock b")).to_have_text("0.0")
        expect(page.get_by_role("button", name="Play", exact=True)).to_be_visible()
        page.get_by_role("button", name="Play", exact=True).click()
        expect(page.locator("#clock b")).not_to_have_text("0.0")
        page.get_by_role("button", name="Pause", exact=True).click()
        expect(page.locator("#clock b")).to_have_text(re.compile(r"^\d+\.\d$"))
        page.emulate_media(reduced_motion="no-preference")
