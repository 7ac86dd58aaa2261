"""Axe finds nothing on a tablet on end, where the inspector is a sheet and drawers lie over the preview."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.axe import require_no_finding
from tests.support.page.touch import touch_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with touch_page(browser, studio.url) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def test_sheet_steps_and_views(page: Page) -> None:
    for step in ("Simulate", "Check & approve", "Run", "Design"):
        page.get_by_role("tab", name=step).tap()
        require_no_finding(page, step)
    for view in ("Segments", "Pattern search", "Cells"):
        page.get_by_role("tab", name=view).tap()
        require_no_finding(page, view)


def test_drawers_over_the_preview_and_the_help(page: Page) -> None:
    for name in ("Papers", "Gaits", "Jobs", "Runs", "Trials"):
        page.get_by_role("navigation", name="Project").get_by_role("button", name=name).tap()
        require_no_finding(page, name)
    page.get_by_role("button", name="Close trials").tap()
    page.get_by_role("button", name="Keyboard").tap()
    expect(page.get_by_role("dialog", name="Keyboard")).to_be_visible()
    require_no_finding(page, "keys")
    page.get_by_role("button", name="Close", exact=True).tap()
