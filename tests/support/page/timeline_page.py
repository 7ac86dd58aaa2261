"""What the timeline's tests do on the page: small gaits of their own, cells, drags, the menu."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

FOUR = (
    "111100001111111111111111",
    "111111110000111111111111",
    "111111111111000011111111",
    "111111111111111100001111",
)
"""Four feet that swing one after the other, 24 samples."""


@dataclass(frozen=True)
class TimelinePage:
    """An open page and the studio behind it."""

    page: Page
    studio: StudioProcess

    def open(self, name: str, feet: Sequence[str] = FOUR, **changes: Any) -> str:
        """Makes a gait of these rows and shows it; gives its id back."""
        content = {
            "format": "footfall-gait",
            "version": 1,
            "name": name,
            "orientation": "FB",
            "order": [1, 2, 3, 4],
            "step": [0.005, 0.005, 0.0],
            "timeline": {"sample_time": 0.4, "feet": list(feet)},
            **changes,
        }
        made = self.studio.ask("POST", "/api/gaits", content)
        assert made.status == 201, made.content
        gait: str = made.content["id"]
        # The list of a page that was just opened may still scroll, between the two halves of a click.
        self.page.get_by_role("list", name="Gaits").locator(f'[data-gait="{gait}"]').dispatch_event("click")
        expect(self.page.get_by_label("Gait name")).to_have_value(name)
        expect(self.grid).to_have_attribute("aria-colcount", str(len(feet[0])))
        return gait

    @property
    def grid(self) -> Locator:
        """The timeline."""
        return self.page.get_by_role("grid", name="Footfall timeline")

    def cell(self, foot: int, sample: int) -> Locator:
        """A cell, counted from 1."""
        return self.page.locator(f'.timeline-row[data-foot="{foot}"] .cell').nth(sample - 1)

    def middle(self, foot: int, sample: int) -> tuple[float, float]:
        """Where a cell is on the screen."""
        box = self.cell(foot, sample).bounding_box()
        assert box is not None
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, start: tuple[int, int], end: tuple[int, int], *held: str, drop: bool = True) -> None:
        """Drags from a cell to another one with keys held."""
        for key in held:
            self.page.keyboard.down(key)
        self.page.mouse.move(*self.middle(*start))
        self.page.mouse.down()
        self.page.mouse.move(*self.middle(*end), steps=4)
        if drop:
            self.page.mouse.up()
        for key in reversed(held):
            self.page.keyboard.up(key)

    def press(self, *keys: str) -> None:
        """Keys one after the other, on what has the focus."""
        for key in keys:
            self.page.keyboard.press(key)

    def selected(self) -> list[tuple[int, int]]:
        """The selected cells, counted from 1."""
        found: list[list[int]] = self.page.evaluate(
            """() => [...document.querySelectorAll('#timeline [aria-selected="true"]')].map((cell) =>
              [cell.closest("[role=row]").dataset.foot, cell.getAttribute("aria-colindex")].map(Number))"""
        )
        return [(foot, sample) for foot, sample in found]

    def select(self, start: tuple[int, int], end: tuple[int, int]) -> None:
        """Selects a rectangle by Ctrl and a drag."""
        self.drag(start, end, "Control")
        wait_for(lambda: self.selected() == rectangle(start, end), f"{start} to {end} are selected")

    def shown(self) -> tuple[str, ...]:
        """Rows of 1 and 0 as the page shows them."""
        rows: list[str] = self.page.evaluate(
            """() => [...document.querySelectorAll("#timeline [role=row]")].map((row) =>
              [...row.querySelectorAll(".cell")]
                .map(({ dataset }) => (dataset.state === "swing" ? "0" : "1")).join(""))"""
        )
        return tuple(rows)

    def document(self, gait: str) -> dict[str, Any]:
        """The document as the studio has it."""
        content: dict[str, Any] = self.studio.ask("GET", f"/api/gaits/{gait}").content
        return content

    def feet(self, gait: str) -> tuple[str, ...]:
        """Rows of 1 and 0 as the studio has them."""
        return tuple(self.document(gait)["timeline"]["feet"])

    def becomes(self, gait: str, *feet: str) -> None:
        """Waits until studio and page have these rows."""
        wait_for(lambda: self.feet(gait) == feet, f"the studio has {feet}")
        wait_for(lambda: self.shown() == feet, f"the page shows {feet}")

    def undo(self) -> Locator:
        """The button, whose hover help names the last edit."""
        return self.page.get_by_role("button", name=re.compile("^Undo"))

    def last_edit(self, label: str) -> None:
        """Waits until the last edit has this name."""
        expect(self.undo()).to_have_attribute("title", re.compile(f"Undo: {re.escape(label)} "))

    def said(self, sentence: str) -> None:
        """Waits until the page has said so."""
        expect(self.page.locator("#toasts")).to_contain_text(sentence)

    def item(self, name: str) -> Locator:
        """Opens the menu; a line of it."""
        self.page.get_by_role("button", name="Edit", exact=True).click()
        menu = self.page.get_by_role("menu", name="Edit the timeline")
        return menu.get_by_role("menuitem", name=re.compile(f"^{re.escape(name)}"))

    def tool(self, name: str) -> None:
        """Chooses what a plain drag does."""
        group = self.page.get_by_role("group", name="What a drag does")
        group.get_by_role("button", name=name).click()


def rectangle(start: tuple[int, int], end: tuple[int, int]) -> list[tuple[int, int]]:
    """Cells between two, row by row."""
    feet, samples = (sorted(pair) for pair in zip(start, end, strict=True))
    return [(f, s) for f in range(feet[0], feet[1] + 1) for s in range(samples[0], samples[1] + 1)]


def painted(feet: Sequence[str], foot: int, first: int, last: int, value: str) -> tuple[str, ...]:
    """The rows with samples of one foot set, counted from 1."""
    row = feet[foot - 1]
    changed = row[: first - 1] + value * (last - first + 1) + row[last:]
    return (*feet[: foot - 1], changed, *feet[foot:])


@contextmanager
def opened_timeline(browser: Browser, studio: StudioProcess) -> Iterator[TimelinePage]:
    """A page with its timeline drawn."""
    with opened_page(browser, studio.url, 1280, 800) as page:
        page.get_by_role("grid", name="Footfall timeline").get_by_role("row").first.wait_for()
        # The gait that the page opens by itself must not come after the one that a test opens.
        expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        yield TimelinePage(page, studio)
