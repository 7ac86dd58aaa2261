"""A moving picture of the page: frames by steps of its state, a drawn pointer, a caption under each frame."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont
from playwright.sync_api import Locator

from tests.pictures.sitting import SIZE, Sitting

FRAME_MS = 125
"""How long a frame is shown."""
WIDTH, HEIGHT, BAND = 960, 600, 44
"""Of the page in the film, and of the caption under it, px."""
SCALE = WIDTH / SIZE["width"]
CAPTION_SIZE = 22
QUALITY = 72
ACCENT, PAPER, INK = "#4b48c8", "#ffffff", "#161b22"
ARROW = ((0, 0), (0, 17), (4, 13.4), (6.8, 19.6), (9.6, 18.3), (6.9, 12.4), (12.4, 12.4))
"""A pointer that points at its first corner, px."""
SMOOTH = 4
"""By how much more pixels the pointer is drawn than it has in the end."""
RING, ROOM = 13, 16
"""Radius of the ring round a pressed pointer, and the room for it, px."""
GLIDE = (0.35, 0.75, 1.0)
"""Parts of a way at which a moving pointer is seen."""


@dataclass
class Film:
    """Frames of a page.

    The drawn pointer may stand elsewhere than the real one, which scrubs the playhead meanwhile.
    """

    at: Sitting
    caption: str = ""
    frames: list[Image.Image] = field(default_factory=list)
    times_ms: list[int] = field(default_factory=list)
    place: tuple[float, float] = (SIZE["width"] / 2, SIZE["height"] / 3)
    """Where the pointer is drawn, px of the page."""
    is_pressed: bool = False

    def frame(self) -> None:
        """Takes a frame of the page as it is."""
        picture = Image.open(io.BytesIO(self.at.page.screenshot(caret="hide"))).convert("RGB")
        arrow = pointer(self.is_pressed)
        picture.paste(arrow, (round(self.place[0]) - ROOM, round(self.place[1]) - ROOM), arrow)
        canvas = Image.new("RGB", (WIDTH, HEIGHT + BAND), INK)
        canvas.paste(picture.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS))
        draw = ImageDraw.Draw(canvas)
        middle = (WIDTH / 2, HEIGHT + BAND / 2)
        draw.text(middle, self.caption, PAPER, ImageFont.load_default(CAPTION_SIZE), anchor="mm")
        self.frames.append(canvas)
        self.times_ms.append(FRAME_MS)

    def hold(self, seconds: float) -> None:
        """Shows the last frame for longer."""
        self.times_ms[-1] += round(1000 * seconds)

    def say(self, caption: str) -> None:
        """Changes the caption of the frames to come."""
        self.caption = caption

    def glide(self, target: Locator | tuple[float, float]) -> None:
        """Moves the pointer to a place, seen on its way."""
        x, y = target if isinstance(target, tuple) else middle_of(target)
        from_x, from_y = self.place
        for part in GLIDE:
            self.place = (from_x + part * (x - from_x), from_y + part * (y - from_y))
            self.at.page.mouse.move(*self.place)
            self.frame()

    def click(self, target: Locator) -> None:
        """Glides to something and clicks it."""
        self.glide(target)
        with self.pressed():
            self.frame()

    @contextmanager
    def pressed(self) -> Iterator[None]:
        """The button of the mouse is down meanwhile."""
        self.at.page.mouse.down()
        self.is_pressed = True
        yield
        self.is_pressed = False
        self.at.page.mouse.up()

    def drag(self, end: tuple[float, float], steps: int) -> None:
        """Drags from where the pointer is; every step is seen with what it leads to."""
        x, y = self.place
        with self.pressed():
            for step in range(1, steps + 1):
                self.place = (x + (end[0] - x) * step / steps, y + (end[1] - y) * step / steps)
                self.at.page.mouse.move(*self.place)
                self.at.drawn()
                self.frame()

    def play(self, first: tuple[float, float], last: tuple[float, float], count: int) -> None:
        """Brings the playhead from one place of the ruler to another; the drawn pointer stays."""
        mouse = self.at.page.mouse
        mouse.move(*first)
        mouse.down()
        for step in range(count):
            part = step / (count - 1)
            mouse.move(*(a + part * (b - a) for a, b in zip(first, last, strict=True)))
            self.at.drawn()
            self.frame()
        mouse.up()
        mouse.move(*self.place)

    def write(self, path: Path) -> None:
        """Writes the film as an animated WebP that begins again at its end."""
        self.frames[0].save(
            path,
            save_all=True,
            append_images=self.frames[1:],
            duration=self.times_ms,
            loop=0,
            quality=QUALITY,
            method=4,
        )


def middle_of(target: Locator) -> tuple[float, float]:
    """Where something is on the page."""
    target.scroll_into_view_if_needed()
    box = target.bounding_box()
    assert box is not None, f"{target} is not shown"
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@cache
def pointer(is_pressed: bool) -> Image.Image:
    """The pointer; with a ring where the button of the mouse is down."""
    size = 2 * ROOM + 8
    large = Image.new("RGBA", (size * SMOOTH, size * SMOOTH))
    draw = ImageDraw.Draw(large)
    if is_pressed:
        edges = [(ROOM - RING) * SMOOTH] * 2 + [(ROOM + RING) * SMOOTH] * 2
        draw.ellipse(edges, fill=f"{ACCENT}40", outline=ACCENT, width=2 * SMOOTH)
    corners = [((x + ROOM) * SMOOTH, (y + ROOM) * SMOOTH) for x, y in ARROW]
    draw.polygon(corners, fill=INK)
    draw.line([*corners, corners[0], corners[1]], fill=PAPER, width=round(1.4 * SMOOTH), joint="curve")
    return large.resize((size, size), Image.Resampling.LANCZOS)
