"""A page that sits for its picture: how it is brought into the state to be shown, and how it is kept."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Locator, Page, ViewportSize, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import PROJECT, StudioProcess, wait_for

DOCS = PROJECT / "docs"
SIZE: ViewportSize = {"width": 1280, "height": 800}
COLOURS = 256
"""Of a picture's palette."""
CORNER = (SIZE["width"] / 2, 2)
"""Where a pointer rests that points at nothing."""
LOADS = 4
"""How often the page is loaded at most."""
WAIT_MS = 60_000
"""How long the page may take for anything."""
SETTLE_MS = 400
"""For transitions of the page's style."""

READY = """() => document.querySelector("#viser").contentWindow
  ?.__viserMutable?.nodeRefFromName?.["/overlay/com"]?.visible === true"""
_FAILED = "document.querySelector('#stage-message').textContent.includes('could not be loaded')"
_DRAWN = """() => new Promise((done) => {
  const scene = document.querySelector("#viser").contentWindow.__viserMutable.scene;
  const { render } = scene.__r3f.root.getState().gl.info;
  const [first, end] = [render.frame, performance.now() + 800];
  const isOver = () => render.frame > first + 1 || performance.now() > end;
  const look = () => (isOver() ? done() : requestAnimationFrame(look));
  look();
})"""
"""Waits for a new drawing of the scene, or for the time in which one would have come."""


@dataclass(frozen=True)
class Sitting:
    """An open page, and the studio behind it.

    Args:
        has_scene: whether the page draws in 3D.
    """

    page: Page
    studio: StudioProcess
    has_scene: bool

    def choose(self, name: str) -> None:
        """Shows a gait of the list, also one of a folded group, and waits for its plan."""
        find = self.page.get_by_role("searchbox", name="Find a gait")
        find.fill(name)
        exact = self.page.locator(".name", has_text=re.compile(f"^{re.escape(name)}$"))
        self.page.get_by_role("list", name="Gaits").get_by_role("button").filter(has=exact).click()
        find.fill("")
        find.blur()
        expect(self.page.get_by_label("Gait name")).to_have_value(name)
        expect(self.page.get_by_role("status", name="Verdict")).to_contain_text("Plan")

    def close_first_steps(self) -> None:
        """Closes the card First steps, which opens by itself for a new data folder."""
        close = self.page.get_by_role("button", name="Close first steps")
        if close.is_visible():
            close.dispatch_event("click")  # a dialog may lie over it

    def open_menu(self, menu: str, entry: str) -> None:
        """Chooses an entry of a menu."""
        self.page.get_by_role("button", name=menu, exact=True).click()
        self.page.get_by_role("menu").get_by_text(re.compile(f"^{re.escape(entry)}")).first.click()

    def step(self, name: str) -> None:
        """Opens a step in the inspector."""
        self.page.get_by_role("tab", name=name).click()

    def fill(self, field: Locator, value: str) -> None:
        """Types a value and confirms it."""
        field.fill(value)
        field.press("Enter")

    def to_sample(self, number: int) -> None:
        """Brings the playhead to a sample, counted from 0."""
        playhead = self.page.get_by_role("slider", name="Playhead")
        playhead.press("Home")
        for _ in range(number):
            playhead.press("ArrowRight")
        playhead.blur()

    def closer(self, turns: int) -> None:
        """Turns the wheel over the scene: closer, or with a negative number further."""
        canvas = self.page.frame_locator("#viser").locator("canvas[data-engine]")
        canvas.hover()
        for _ in range(abs(turns)):
            self.page.mouse.wheel(0, -100 if turns > 0 else 100)
        self.drawn()

    def lower_the_timeline(self, pixels: float) -> None:
        """Gives the scene more height, and the timeline less."""
        edge = self.page.get_by_role("separator", name="Height of timeline and plots").bounding_box()
        assert edge is not None
        x, y = edge["x"] + edge["width"] / 2, edge["y"] + edge["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x, y + pixels, steps=4)
        self.page.mouse.up()

    def hide_plot(self, name: str) -> None:
        """Takes a strip out of the plots."""
        plots = self.page.get_by_role("button", name="Plots", exact=True)
        plots.click()
        self.page.get_by_role("menuitemcheckbox", name=name).click()
        self.page.keyboard.press("Escape")
        plots.blur()

    def load_scene(self) -> None:
        """Waits until the scene shows the robot; loads the page anew where a busy machine was too slow."""
        for _ in range(LOADS if self.has_scene else 0):
            self.page.wait_for_function(f"() => {_FAILED} || ({READY})()")
            if not self.page.evaluate(_FAILED):
                return
            self.page.reload()
            expect(self.page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")

    def drawn(self) -> None:
        """Waits until page and scene have been drawn as they are now."""
        self.page.wait_for_timeout(SETTLE_MS)
        if self.has_scene:
            self.page.evaluate(_DRAWN)

    def keep(self, path: Path, *parts: Locator) -> None:
        """Keeps the page as a picture.

        Args:
            path: of the picture.
            parts: what is to be seen; all of the page where it is left out.
        """
        if self.has_scene:
            self.page.wait_for_function(READY)
            expect(self.page.locator("#stage-message")).to_be_hidden(timeout=WAIT_MS)
        self.close_first_steps()
        self.page.mouse.move(*CORNER)
        expect(self.page.locator("#toasts > *")).to_have_count(0)
        self.drawn()
        taken = self.page.screenshot(animations="disabled", caret="hide")
        picture: Image.Image = Image.open(io.BytesIO(taken))
        if parts:
            picture = picture.crop(_around(parts))
        write(picture, path)


def _around(parts: tuple[Locator, ...]) -> tuple[int, int, int, int]:
    boxes = [box for part in parts if (box := part.bounding_box()) is not None]
    assert len(boxes) == len(parts), "a part of the picture is not shown"
    return (
        round(min(box["x"] for box in boxes)),
        round(min(box["y"] for box in boxes)),
        round(max(box["x"] + box["width"] for box in boxes)),
        round(max(box["y"] + box["height"] for box in boxes)),
    )


def write(picture: Image.Image, path: Path) -> None:
    """Writes a picture with a palette of its own, without dithering, which would spoil flat areas."""
    reduced = picture.convert("RGB").quantize(COLOURS, kmeans=1, dither=Image.Dither.NONE)
    reduced.save(path, optimize=True)


@contextmanager
def sitting(browser: Browser, studio: StudioProcess, *, has_scene: bool = True) -> Iterator[Sitting]:
    """A page in light colours, with its first gait shown and the card First steps closed."""
    with opened_page(
        browser, studio.url, SIZE["width"], SIZE["height"], has_scene=has_scene, gait=None
    ) as page:
        expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        page.set_default_timeout(WAIT_MS)
        at = Sitting(page, studio, has_scene)
        at.load_scene()
        at.close_first_steps()
        yield at


def wait_until_robot(studio: StudioProcess, state: str) -> None:
    """Waits for a state of the robot."""
    wait_for(lambda: studio.robot()["robot"] == state, f"the robot is {state}")
