"""Remedies as users wait for them: from an edit to the first one, from pointing at one to its preview.

Times are the page's own (see `edits`), in headless Chromium, from the moment the page takes the edit, or the
pointer reaches the row, until the frame with it has been painted. An edit that still walks has no times.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.bench.common.measure import Row
from app.bench.page.edits import headless_browser, served_studio

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

COUNT = 30
GAITS = ("Walk 10 mm", "Amble 10 mm", "S-Gait 10 mm", "C-Gait 10 mm", "Hexapod tripod", "Hexapod ripple")
"""Whose steps, margins and swings are changed."""

FIRST, PREVIEW = "edit to remedy", "pointing to preview"
"""Names of the page's measures."""

SIZE = (1440, 900)
REST_MS = 1500
READY_MS = 60_000

_MEASURES = "(name) => performance.getEntriesByName(name).map((entry) => entry.duration)"


def bench_advice(count: int = COUNT, seed: int = 3) -> list[Row]:
    """Edits of gaits until they cannot walk, each taken back again.

    Args:
        count: edits.
        seed: the same seed makes the same edits.

    Raises:
        InputError: Playwright or Chromium is missing.
        StateError: the studio does not start.
    """
    random = np.random.default_rng(seed)
    with headless_browser() as browser, served_studio() as address:
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.goto(address)
        page.get_by_role("list", name="Gaits").get_by_text("For this robot").wait_for(timeout=READY_MS)
        page.wait_for_timeout(2 * REST_MS)
        for number in range(count):
            _choose(page, GAITS[number % len(GAITS)])
            _spoil(page, number // len(GAITS), random)
            _look(page)
            page.get_by_role("button", name="Undo").click()
            page.wait_for_timeout(REST_MS)
        return [_row(page, FIRST), _row(page, PREVIEW)]


def _choose(page: Page, name: str) -> None:
    page.get_by_role("searchbox", name="Find a gait").or_(page.get_by_placeholder("Find a gait")).first.fill(
        name
    )
    page.get_by_role("list", name="Gaits").get_by_role("button", name=name).first.click()
    page.wait_for_timeout(2 * REST_MS)


def _spoil(page: Page, kind: int, random: np.random.Generator) -> None:
    """Asks for too long a step, too large a margin, or paints a swing beside another."""
    if kind % 3 == 0:
        _type(page, "Step", random.uniform(40.0, 58.0))
    elif kind % 3 == 1:
        _type(page, "Stability margin", random.uniform(26.0, 30.0))
    else:
        cells = page.locator('.timeline-row[data-foot="1"] .cell')
        _drag(page, cells.nth(5), cells.nth(5 + int(random.integers(6, 9))))
        cells = page.locator('.timeline-row[data-foot="3"] .cell')
        _drag(page, cells.nth(4), cells.nth(12))


def _type(page: Page, name: str, value: float) -> None:
    field = page.get_by_role("spinbutton", name=name, exact=True)
    field.fill(f"{value:.1f}")
    field.press("Enter")


def _drag(page: Page, start: Locator, end: Locator) -> None:
    start.hover()
    page.mouse.down()
    end.hover()
    page.mouse.up()


def _look(page: Page) -> None:
    """Waits for the first remedy, points at it once the search is over, and away again."""
    row = page.get_by_role("group", name="What would help").get_by_role("listitem").first
    page.wait_for_timeout(2 * REST_MS)
    if not row.is_visible():
        return
    row.hover()
    page.wait_for_timeout(REST_MS)
    page.mouse.move(SIZE[0] / 2, SIZE[1] / 3)
    page.wait_for_timeout(REST_MS / 3)


def _row(page: Page, name: str) -> Row:
    times = np.array(page.evaluate(_MEASURES, name))
    shares = {"median_ms": 50, "p95_ms": 95, "longest_ms": 100}
    return {
        "from": name,
        "times": len(times),
        **{key: round(float(np.percentile(times, share))) for key, share in shares.items() if len(times)},
    }
