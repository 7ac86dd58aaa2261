"""A page without its studio, or left before a part had loaded: nothing can be pressed in vain."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from playwright.sync_api import Browser, Page, Route, WebSocketRoute, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy
SHARES_STUDIO = True


@dataclass
class Line:
    """The page's event connection, which can be cut and mended."""

    is_cut: bool = False
    opened: list[WebSocketRoute] = field(default_factory=list)

    def accept(self, line: WebSocketRoute) -> None:
        """Passes a new connection on, or closes it."""
        if self.is_cut:
            line.close()
            return
        line.connect_to_server()
        self.opened.append(line)

    def cut(self) -> None:
        """Closes what is open, and all that is opened from now on."""
        self.is_cut = True
        for line in self.opened:
            line.close()


@pytest.fixture
def line() -> Line:
    return Line()


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, line: Line) -> Iterator[Page]:
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as opened:
        opened.route_web_socket("**/api/events*", line.accept)
        opened.goto(studio.url)
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
        yield opened


def test_without_the_studio_all_but_stop_and_looking_is_off_and_comes_back(page: Page, line: Line) -> None:
    locked = ("#drawers", ".rail", "#sections", ".inspector-foot", "#timeline", "#tools", ".gait-pill")
    line.cut()
    banner = page.get_by_role("alert").filter(has_text="No connection to the studio")
    expect(banner).to_be_visible()
    for part in locked:
        expect(page.locator(part)).to_have_attribute("inert", "")
    expect(page.get_by_role("button", name="Stop", exact=True)).to_be_enabled()
    before = page.locator("#timeline").inner_html()
    for key in ("Control+a", "Delete", "k", "Control+z"):
        page.keyboard.press(key)
    assert page.locator("#timeline").inner_html() == before
    page.keyboard.press("ArrowRight")
    expect(page.get_by_role("status", name="Time")).not_to_contain_text("0.0 /")
    # A small window has no stage: the sentence stands there all the same.
    page.set_viewport_size({"width": 640, "height": 360})
    expect(banner).to_be_in_viewport()
    page.set_viewport_size({"width": 1280, "height": 800})
    # A dialog that closes meanwhile frees nothing.
    page.keyboard.press("?")
    page.keyboard.press("Escape")
    expect(page.locator("#drawers")).to_have_attribute("inert", "")
    line.is_cut = False
    expect(banner).to_be_hidden()
    for part in locked:
        expect(page.locator(part)).not_to_have_attribute("inert", "")


def test_a_pattern_search_that_was_left_before_it_had_loaded_stays_closed(page: Page) -> None:
    waiting: list[Route] = []
    page.route(re.compile("pattern_view"), lambda route: waiting.append(route))
    page.get_by_role("tab", name="Pattern search").click()
    page.get_by_role("tab", name="Cells").click()
    expect(page.get_by_role("tab", name="Cells")).to_have_attribute("aria-selected", "true")
    wait_for(lambda: page.evaluate("1") == 1 and len(waiting) == 1, "the search is being loaded")
    waiting[0].continue_()
    panel = page.locator("#patterns")
    expect(panel).to_have_count(1)
    expect(panel).to_be_hidden()
    page.get_by_role("tab", name="Pattern search").click()
    expect(panel).to_be_visible()
    for covered in ("#inspector > .inspector-head", "#sections", ".inspector-foot"):
        expect(page.locator(covered)).to_have_attribute("inert", "")
    page.get_by_role("tab", name="Cells").click()
    expect(page.locator("#sections")).not_to_have_attribute("inert", "")


def test_the_inspector_folds_after_its_edge_was_dragged(page: Page) -> None:
    edge = page.get_by_role("separator", name="Width of the inspector")
    edge.press("ArrowLeft")
    inspector = page.locator("#inspector")
    expect(inspector).to_have_css("width", "376px")
    page.locator("#clock").click()
    page.keyboard.press("]")
    expect(inspector).to_be_hidden()
    stage = page.locator(".stage").bounding_box()
    assert stage is not None
    assert stage["x"] + stage["width"] == 1280
    page.keyboard.press("]")
    expect(inspector).to_have_css("width", "376px")


def test_the_focus_goes_to_the_step_that_opens(page: Page) -> None:
    page.get_by_role("button", name="Simulate", exact=True).press("Enter")
    tab = page.get_by_role("tab", name="Simulate")
    expect(tab).to_have_attribute("aria-selected", "true")
    expect(tab).to_be_focused()
