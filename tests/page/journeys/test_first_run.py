"""The path that the page shows, from the first load to measured strokes: every click is counted."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import look, opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy
SPEED = 5.0
"""Seconds of the emulated robot in a second."""
MOST_CLICKS = 7
HELD_MS = 1300
COUNT = """() => {
  window.clicks = 0;
  addEventListener("click", ({ isTrusted }) => { window.clicks += isTrusted ? 1 : 0; }, true);
}"""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1440, 900, gait=None) as opened:
        opened.evaluate(COUNT)
        yield opened


def press(page: Page, name: str) -> None:
    """Clicks the button as soon as it is offered."""
    button = page.get_by_role("button", name=name, exact=True)
    expect(button).to_be_visible()
    expect(button).not_to_have_attribute("aria-disabled", "true")
    button.click()


def hold(page: Page, name: str) -> None:
    """Holds the button until it acts."""
    button = page.get_by_role("button", name=name)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    box = button.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.wait_for_timeout(HELD_MS)
    page.mouse.up()


def test_seven_clicks_and_a_name_lead_to_measured_strokes(page: Page, studio: StudioProcess) -> None:
    press(page, "Simulate")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    press(page, "Check")
    press(page, "Approve")
    page.get_by_role("textbox", name="Your name").fill("Ada")
    press(page, "Continue")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    press(page, "Connect")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("disarmed")
    press(page, "Arm")
    hold(page, "Send to robot")
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 2, "the robot walks", 60)
    look(page, "first run")
    strokes = page.locator(".strokes .bar span")
    expect(strokes).to_have_text([re.compile(r"^\d+\.\d$")] * 12)
    expect(page.locator(".time-left")).to_contain_text(re.compile(r"\d+\.\d s left"))
    expect(page.get_by_role("button", name="Pause robot")).to_be_visible()
    for name in ("Connect", "Arm", "Send to robot"):
        expect(page.get_by_role("button", name=name, exact=True)).to_be_hidden()
    clicks: int = page.evaluate("window.clicks")
    assert clicks <= MOST_CLICKS
    page.get_by_role("button", name="Stop", exact=True).click()
    expect(page.get_by_role("button", name="Clear", exact=True)).to_be_visible()
