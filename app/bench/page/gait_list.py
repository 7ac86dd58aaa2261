"""The list of gaits of a full data folder: how long until the server has it and a page shows it.

A page's time runs from the start of its navigation until the frame after the one in which the last saved gait
was in the list, read by the page's own clock, in a browser that has not seen the studio before and whose
window has just been opened. The first column is of the studio's first page: the server may still be reading
the files.
"""

from __future__ import annotations

import json
import urllib.request
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.bench.common.measure import Row, milliseconds, seconds_of
from app.bench.page.edits import READY_MS, SIZE, headless_browser, served_studio
from app.store.gait_files import GaitFiles
from core.library.library import library

if TYPE_CHECKING:
    from playwright.sync_api import Browser

COUNT = 500
"""Saved gaits."""

PAGES = 7
"""Pages opened after the first."""

_LISTED = """(count) => {
  if (window.benchListed) return performance.now();
  window.benchListed = document.querySelectorAll("#gaits .gait").length >= count;
  return false;
}"""
"""Asked once a frame: what was there in one frame has been laid out and painted when the next one begins."""


def bench_gait_list(count: int = COUNT, pages: int = PAGES) -> list[Row]:
    """Opens a studio with many saved gaits, page after page.

    Args:
        count: saved gaits, drawn and by hand in turn.
        pages: opened after the first.

    Raises:
        InputError: Playwright or Chromium is missing.
        StateError: the studio does not start.
    """
    with headless_browser() as browser, served_studio(partial(fill, count=count)) as address:
        first = page_seconds(browser, address, count)
        later = [page_seconds(browser, address, count) for _ in range(pages)]
        answers = [seconds_of(lambda: _list(address)) for _ in range(pages)]
        size = len(_list(address))
    return [
        {
            "saved gaits": count,
            "first page, ms": milliseconds(first),
            "later pages": pages,
            "median, ms": milliseconds(float(np.median(later))),
            "longest, ms": milliseconds(max(later)),
            "server's answer, ms": milliseconds(float(np.median(answers))),
            "kB": round(size / 1000),
        }
    ]


def fill(data: Path, count: int) -> None:
    """Saves gaits with different names and steps into a data folder."""
    files = GaitFiles(data)
    sources = [library()[name].gait for name in ("walk", "walk-manual-0", "amble", "s-gait-manual-2")]
    for number in range(count):
        source = sources[number % len(sources)]
        gait = replace(source, name=f"Trial {number + 1}", notes=json.dumps({"trial": number}))
        files.write(f"trial-{number + 1:04}", gait)


def page_seconds(browser: Browser, address: str, count: int) -> float:
    """From the start of a fresh page's navigation until so many gaits are in its list, s."""
    context = browser.new_context(viewport={"width": SIZE[0], "height": SIZE[1]})
    page = context.new_page()
    page.goto(address, wait_until="commit")
    listed = page.wait_for_function(_LISTED, arg=count, timeout=READY_MS, polling="raf")
    seconds = float(listed.json_value()) / 1000
    context.close()
    return seconds


def _list(address: str) -> bytes:
    with urllib.request.urlopen(f"{address}api/gaits", timeout=READY_MS / 1000) as answer:
        content: bytes = answer.read()
    return content
