"""The path from a gait in the list to measured strokes and Stop, by touch on a tablet."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.touch import long_press, touch_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy
SPEED = 5.0
"""Seconds of the emulated robot in a second."""
HELD_MS = 1300


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with touch_page(browser, studio.url) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def tap(page: Page, name: str) -> None:
    button = page.get_by_role("button", name=name, exact=True)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    button.tap()


def choose_a_gait(page: Page) -> None:
    page.get_by_role("navigation", name="Project").get_by_role("button", name="Gaits").tap()
    gaits = page.get_by_role("list", name="Gaits")
    gaits.locator("[data-gait=walk]").tap()
    expect(gaits).to_be_hidden()
    expect(page.get_by_label("Gait name")).to_have_value("Walk 10 mm")


def edit_and_take_it_back(page: Page) -> None:
    grid = page.get_by_role("grid", name="Footfall timeline")
    grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True).tap()
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: swing", exact=True)).to_be_visible()
    page.get_by_role("button", name=re.compile("^Undo")).tap()
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True)).to_be_visible()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("margin")


def test_the_path_by_touch(page: Page, studio: StudioProcess) -> None:
    choose_a_gait(page)
    edit_and_take_it_back(page)
    tap(page, "Simulate")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    tap(page, "Check")
    tap(page, "Approve")
    page.get_by_role("textbox", name="Your name").fill("Ada")
    tap(page, "Continue")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    tap(page, "Connect")
    status = page.get_by_role("status", name="Robot")
    expect(status).to_contain_text("disarmed")
    tap(page, "Arm")
    expect(status).to_contain_text("armed")
    send = page.get_by_role("button", name="Send to robot", exact=True)
    expect(send).not_to_have_attribute("aria-disabled", "true")
    long_press(page, send, HELD_MS)
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 0, "the robot walks")
    expect(page.get_by_role("status", name="Explanation")).to_be_hidden()
    long_press(page, page.get_by_role("button", name="Stop", exact=True))
    wait_for(lambda: studio.robot()["robot"] == "stopped", "a long press stops as well")
    tap(page, "Clear")
    expect(status).to_contain_text("disarmed")
