"""What the segment table's tests do on the page: gaits of their own, cells, the note, the clipboard."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

WALK = "walk-manual-0"


@contextmanager
def opened_segments(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """One page for a whole file, which may use the clipboard: each test has a gait of its own."""
    with opened_page(browser, studio.url, 1280, 800) as opened:
        opened.context.grant_permissions(["clipboard-read", "clipboard-write"])
        yield opened


def copy_of(studio: StudioProcess, gait: str, name: str, **changes: Any) -> str:
    """A saved gait of its own for a test, then edited in some fields; gives its id."""
    answer = studio.ask("POST", "/api/gaits", {**studio.document(gait), "name": name})
    assert answer.status == 201
    gait_id: str = answer.content["id"]
    if changes:
        edited = {**studio.document(gait_id), **changes}
        assert studio.ask("PUT", f"/api/gaits/{gait_id}?label=Prepare", edited).status == 200
    return gait_id


def choose(page: Page, name: str) -> None:
    """Shows a gait with its segments."""
    page.get_by_role("list", name="Gaits").get_by_role(
        "button", name=re.compile(f"^{re.escape(name)}")
    ).click()
    expect(page.get_by_label("Gait name")).to_have_value(name)
    page.get_by_role("tab", name="Segments").click()


def table(studio: StudioProcess, gait: str) -> dict[str, Any]:
    """A gait's segment table."""
    content: dict[str, Any] = studio.document(gait)["segment_table"]
    return content


def grid(page: Page) -> Locator:
    """The table on the page."""
    return page.get_by_role("grid", name="Segment table")


def cell(page: Page, segment: int | str, foot: int) -> Locator:
    """The cell of a segment, counted from 1, or of "Link segment 1"."""
    name = f"Segment {segment}" if isinstance(segment, int) else segment
    return grid(page).get_by_role("row", name=name, exact=True).get_by_role("gridcell").nth(foot - 1)


def note(page: Page) -> Locator:
    """What does not fit yet."""
    return page.get_by_role("status", name="Segment table note")


def undo_label(page: Page) -> Locator:
    """What Undo would take back."""
    return page.locator("#undo-label")


def selected_samples(page: Page) -> list[str]:
    """Which of the timeline's cells are selected."""
    cells = page.get_by_role("grid", name="Footfall timeline").locator('[aria-selected="true"]').all()
    return [re.sub(":.*", "", one.get_attribute("aria-label") or "") for one in cells]


def put_on_clipboard(page: Page, text: str) -> None:
    """As a spreadsheet does."""
    page.evaluate("text => navigator.clipboard.writeText(text)", text)
