"""A page of the studio that must not throw, and has nothing to say on the console."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from urllib.parse import urljoin

from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, expect

from tests.support.chromium import LONG_MS, SCENE_WORDS, chromium_path
from tests.support.spent_seconds import spending

_SCENE: dict[Browser, Browser] = {}
"""Beside each browser one that draws 3D scenes; it ends with its Playwright."""
_PROFILES: dict[Browser, BrowserContext] = {}
_BUSY: set[Browser] = set()
"""Browsers of which a page is open."""
REMEMBER = (
    "try { localStorage.getItem('footfall.gait') ?? localStorage.setItem('footfall.gait', '%s') } catch {}"
)
"""As if a gait was used last, where none is remembered."""
NOT_OURS = ("Failed to load resource", "WebSocket connection to", "THREE.", "[.WebGL")
"""How messages of the browser about the network begin, and those of the 3D client."""
NO_FRAME = "Object.defineProperty(HTMLIFrameElement.prototype, 'src', { set() {}, get: () => '' })"
"""Lighter than an answer in the place of the server's, which has every request pass through Playwright."""


@contextmanager
def opened_page(
    browser: Browser,
    url: str,
    width: int,
    height: int,
    *,
    has_scene: bool = False,
    gait: str | None = "walk",
) -> Iterator[Page]:
    """Opens an address in a window of a size, and ends with an error where the page threw one.

    It has a 3D scene, which is seconds of drawing in software, only where a test looks at it.
    The page shows a gait, as if that was used last; without one the first of the list, as for a new user.
    """
    drawing = scene_browser(browser) if has_scene else browser
    with window(drawing, url) as page:
        if gait is not None:
            page.add_init_script(REMEMBER % gait)
        page.set_viewport_size({"width": width, "height": height})
        page.set_default_timeout(LONG_MS)
        if not has_scene:
            leave_scene_out(page)
        problems: list[str] = []
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda message: problems.extend(said_by_us(message)))
        with spending("opening pages"):
            page.goto(url)
        try:
            yield page
        except BaseException:
            print("The page said:", page.locator("#toasts").all_inner_texts())  # noqa: T201
            raise
    assert problems == [], problems


def said_by_us(message: ConsoleMessage) -> list[str]:
    """An error or warning on the console; not of a refused request, nor of the 3D client."""
    is_ours = "/viser/" not in message.location["url"] and not message.text.startswith(NOT_OURS)
    return [message.text] if is_ours and message.type in ("error", "warning") else []


@contextmanager
def window(browser: Browser, url: str) -> Iterator[Page]:
    """A page without anything stored for the address.

    Pages that follow one another share a profile, and with it the files that the browser has kept.
    A page beside another one gets a profile of its own, as another person has.
    """
    if browser in _BUSY:
        page = browser.new_page()
        yield page
        page.close()
        return
    context = _PROFILES.get(browser)
    if context is None:
        context = _PROFILES[browser] = browser.new_context()
    _BUSY.add(browser)
    try:
        page = context.new_page()
        page.goto(f"{urljoin(url, '/')}static/icon.svg")
        page.evaluate("localStorage.clear(), sessionStorage.clear()")
        yield page
        for opened in context.pages:
            opened.close()
    finally:
        _BUSY.discard(browser)


def scene_browser(browser: Browser) -> Browser:
    """A browser for 3D scenes beside the one for everything else."""
    if browser not in _SCENE:
        _SCENE[browser] = browser.browser_type.launch(executable_path=chromium_path(), args=SCENE_WORDS)
    return _SCENE[browser]


def leave_scene_out(where: Page | BrowserContext) -> None:
    """An empty frame instead of the 3D scene, in a page or in all of a window's."""
    where.add_init_script(NO_FRAME)


def look(page: Page, name: str) -> None:
    """Keeps a screenshot where somebody asked for them."""
    folder = os.environ.get("FOOTFALL_SCREENSHOTS")
    if folder:
        page.screenshot(path=f"{folder}/{name}.png")


def choose(page: Page, name: str) -> None:
    """Shows a gait of the list, and waits until the live tier has answered for it."""
    alone = re.compile(f"^{re.escape(name)}(?!,)")  # and not one of its other foot orders
    page.get_by_role("list", name="Gaits").get_by_role("button", name=alone).click()
    expect(page.get_by_label("Gait name")).to_have_value(name)
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
