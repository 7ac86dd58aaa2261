"""What a pointer's hover explains is explained by a long press, on a tablet without a mouse."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.drawers import open_drawer
from tests.support.page.touch import long_press, touch_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with touch_page(browser, studio.url) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def explanation(page: Page) -> Locator:
    return page.get_by_role("status", name="Explanation")


def test_a_long_press_explains_and_does_nothing_else(page: Page) -> None:
    cells = page.get_by_role("grid", name="Footfall timeline")
    cell = cells.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True)
    for target, words in (
        (page.get_by_role("tab", name="Simulate"), "Simulate: not yet"),
        (page.get_by_role("button", name="Redo"), "Nothing to redo."),
        (
            page.get_by_role("status", name="Verdict").get_by_role("button", name=re.compile("^Plan")),
            "Stability margin: how far",
        ),
        (page.locator(".plot-label .name").first, ""),
        (page.get_by_role("button", name="Loop"), "Loop the selected samples"),
        (cell, "Click to change this cell to swing"),
        (page.get_by_text("Step", exact=True).first, ""),
    ):
        long_press(page, target)
        expect(explanation(page)).to_have_text(re.compile(re.escape(words) or "."))
    expect(page.get_by_role("tab", name="Design", selected=True)).to_be_visible()
    expect(cell).to_be_visible()
    expect(page.get_by_role("button", name="Loop")).to_have_attribute("aria-pressed", "false")


def test_it_goes_with_the_next_touch_which_acts_as_usual(page: Page) -> None:
    long_press(page, page.get_by_role("button", name="Loop"))
    expect(explanation(page)).to_be_visible()
    page.get_by_role("tab", name="Simulate").tap()
    expect(explanation(page)).to_be_hidden()
    expect(page.get_by_role("tab", name="Simulate", selected=True)).to_be_visible()
    page.get_by_role("tab", name="Design").tap()


def test_it_stays_inside_the_window(page: Page) -> None:
    gaits = open_drawer(page, "Gaits")
    long_press(page, gaits.get_by_role("list", name="Gaits").get_by_role("button").nth(1))
    box = explanation(page).bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["y"] >= 0
    assert box["x"] + box["width"] <= 820
    page.get_by_role("button", name="Close gaits").tap()


def test_a_touch_of_a_plot_shows_its_values_until_the_next_touch_elsewhere(page: Page) -> None:
    card = page.locator(".plot-card")
    page.get_by_role("img", name=re.compile("^Stability margin")).tap()
    expect(card).to_be_visible()
    expect(card).to_contain_text("Margin")
    page.get_by_role("tab", name="Design").tap()
    expect(card).to_be_hidden()
