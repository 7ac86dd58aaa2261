"""The page as users feel it: from an edit under the finger to new plots and a new pose, in headless Chromium.

Times are the page's own (`performance.measure`): from the moment it takes an edit until the frame with what
the edit leads to has been painted. A step that is overtaken by the next one has no time of its own. Drawing
in software, as on a machine without a GPU, shares the processor's cores with everything else.

Beside them stand the page's tasks of over 50 ms and the time between frames while the finger is down. The
last row moves a block back and forth on the largest timeline, a move a frame.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.bench.common.measure import Row
from app.bench.page.long_timeline import NAME, dragging, forget, long_gait, tasks_and_frames, watch
from app.common.own_command import own_command
from core.errors import InputError, StateError

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

DRAGS = 8
"""Drags of each kind."""

STEPS = 9
"""Moves of a drag."""

STEP_MS = 150
BLOCK_STEPS, FRAME_MS, COLUMN_STEPS = 60, 16, 2
"""Moves of the block, ms between them, moves a sample."""

ARRIVE_MS = 400
"""Between the pointer's arrival and the press, as with a person."""
REST_MS = 900
READY_MS = 60_000
END_SECONDS = 20.0
SIZE = (1280, 800)

CHROMIUM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
CHROMIUM_WORDS = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)
"""Drawing in software, the same on every machine."""

PLOTS, SCENE = "edit to plots", "edit to 3D"
"""Names of the page's measures."""

_READY = """() => Boolean(
  document.querySelector("#viser").contentWindow?.__viserMutable?.nodeRefFromName?.["/overlay/com"])"""
_MEASURES = "(name) => performance.getEntriesByName(name).map((entry) => entry.duration)"


def bench_page(drags: int = DRAGS) -> list[Row]:
    """Drags timeline cells, the goal and a number, and reads the page's own times.

    Args:
        drags: of each kind.

    Raises:
        InputError: Playwright or Chromium is missing.
        StateError: the studio does not start.
    """
    with headless_browser() as browser, served_studio() as address:
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.goto(address)
        wait_until_ready(page)
        # The gait that opens first is one for the robot's clock: every edit adapts its last poses.
        numbers = {"goal": _drag_goal, "number": _drag_number}
        rows = _rows(page, {f"{name}, for the robot": drag for name, drag in numbers.items()}, drags)
        open_drawn_walk(page, address)
        rows += _rows(page, {"timeline": _drag_timeline, **numbers}, drags)
        _open_long_timeline(page, address)
        return [*rows, _row(page, NAME, _drag_block, drags)]


def wait_until_ready(page: Page) -> None:
    """Waits until a page shows its 3D preview, and begins to watch its tasks and frames."""
    page.wait_for_function(_READY, timeout=READY_MS)
    watch(page)


def open_drawn_walk(page: Page, address: str) -> None:
    """Opens the drawn walk of the library."""
    page.goto(f"{address}?gait=walk")
    wait_until_ready(page)
    page.wait_for_timeout(5 * REST_MS)


def bench_drags(page: Page, drags: int) -> list[Row]:
    """Drags timeline cells, the goal and a number of a drawn gait that is shown.

    Args:
        page: shows it.
        drags: of each kind.
    """
    ways = {"timeline": _drag_timeline, "goal": _drag_goal, "number": _drag_number}
    return [_row(page, name, drag, drags) for name, drag in ways.items()]


def _rows(page: Page, ways: dict[str, Callable[[Page], None]], drags: int) -> list[Row]:
    for drag in ways.values():
        drag(page)
    return [_row(page, name, drag, drags) for name, drag in ways.items()]


def _row(page: Page, name: str, drag: Callable[[Page], None], drags: int) -> Row:
    page.evaluate("() => performance.clearMeasures()")
    forget(page)
    for _ in range(drags):
        drag(page)
    row: Row = {"drag": name, "drags": drags}
    for key, measure in (("plots", PLOTS), ("3d", SCENE)):
        times = np.array(page.evaluate(_MEASURES, measure))
        row[f"{key}_times"] = len(times)
        for label, share in (("median", 50), ("p95", 95)):
            row[f"{key}_{label}_ms"] = round(float(np.percentile(times, share))) if len(times) else None
    return row | tasks_and_frames(page)


def _open_long_timeline(page: Page, address: str) -> None:
    request = urllib.request.Request(
        f"{address}api/gaits",
        data=json.dumps(long_gait()).encode(),
        method="POST",
        headers={"content-type": "application/json"},
    )
    with urllib.request.urlopen(request, timeout=READY_MS / 1000):
        page.get_by_role("list", name="Gaits").get_by_role("button", name=NAME).click()
    page.locator('.timeline-row[data-foot="12"]').wait_for(timeout=READY_MS)
    page.wait_for_timeout(5 * REST_MS)
    _drag_block(page)


def _drag_block(page: Page) -> None:
    """Moves a swing there and back, a move a frame."""
    swing = page.locator('.timeline-row[data-foot="6"] .cell[data-state="swing"]')
    x, y = _middle(swing.nth(swing.count() // 2))
    width = _middle(swing.nth(1))[0] - _middle(swing.nth(0))[0]
    way = [*range(BLOCK_STEPS // 2), *range(BLOCK_STEPS // 2, -1, -1)]
    _drag(page, [(x, y), *((x + width * step / COLUMN_STEPS, y) for step in way)], FRAME_MS)


def _drag_timeline(page: Page) -> None:
    cells = page.locator('.timeline-row[data-foot="3"] .cell')
    _drag(page, [_middle(cells.nth(10 + step // 3)) for step in range(STEPS)])


def _drag_goal(page: Page) -> None:
    x, y = _middle(page.get_by_label("Goal", exact=True))
    _drag(page, [(x + 2 * step, y - step / 2) for step in range(STEPS + 1)])


def _drag_number(page: Page) -> None:
    x, y = _middle(page.locator("#optimise .field .drag", has_text="Clearance"))
    _drag(page, [(x + 4 * step, y) for step in range(STEPS + 1)])


def _drag(page: Page, places: list[tuple[float, float]], step_ms: float = STEP_MS) -> None:
    """Moves through the places and takes it all back; the gait stays as it was."""
    page.mouse.move(*places[0])
    page.wait_for_timeout(ARRIVE_MS)
    page.mouse.down()
    dragging(page, True)
    for place in places[1:]:
        page.wait_for_timeout(step_ms)
        page.mouse.move(*place)
    page.wait_for_timeout(step_ms)
    dragging(page, False)
    page.keyboard.press("Escape")
    page.mouse.up()
    page.mouse.move(SIZE[0] / 2, 1.0)
    page.wait_for_timeout(REST_MS)


def _middle(place: Locator) -> tuple[float, float]:
    box = place.bounding_box()
    if box is None:
        raise StateError("The page does not show what the benchmark drags.", "page")
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@contextmanager
def headless_browser() -> Iterator[Browser]:
    """Headless Chromium.

    Raises:
        InputError: it or Playwright is missing.
    """
    try:
        from playwright.sync_api import Error, sync_playwright
    except ImportError as error:
        raise InputError(
            "The page's benchmark needs Playwright, which is not installed; install the project's dev extra.",
            "page",
        ) from error
    program = os.environ.get("FOOTFALL_CHROMIUM") or next(
        filter(None, map(shutil.which, CHROMIUM_NAMES)), None
    )
    with sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=program, args=list(CHROMIUM_WORDS))
        except Error as error:
            raise InputError(
                f"Chromium does not start ({program or 'none was found'}); install it, or name its program "
                "in FOOTFALL_CHROMIUM.",
                "page",
            ) from error
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def served_studio(fill: Callable[[Path], None] = lambda data: None) -> Iterator[str]:
    """Address of a studio with its own data folder on a free port.

    Args:
        fill: puts something into the folder first.

    Raises:
        StateError: it does not start.
    """
    with tempfile.TemporaryDirectory() as data:
        fill(Path(data))
        words = own_command("serve", "--port", "0", "--data", data, "--no-browser")
        process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
        try:
            line = process.stdout.readline() if process.stdout is not None else ""
            found = re.search(r"http://\S+", line)
            if found is None:
                raise StateError(f"The studio does not start; it said {line!r}.", "page")
            yield found.group()
        finally:
            process.terminate()
            try:
                process.wait(END_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
