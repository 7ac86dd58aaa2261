"""A finger on the page."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser, Locator, Page

from tests.support.chromium import LONG_MS
from tests.support.page.opened import REMEMBER, leave_scene_out

WIDTH, HEIGHT = 820, 1180
"""A tablet on end."""
LONG_PRESS_MS = 900


@contextmanager
def touch_page(browser: Browser, url: str) -> Iterator[Page]:
    """The page on a tablet without a mouse."""
    context = browser.new_context(viewport={"width": WIDTH, "height": HEIGHT}, has_touch=True, is_mobile=True)
    context.add_init_script(REMEMBER % "walk")
    leave_scene_out(context)
    page = context.new_page()
    page.set_default_timeout(LONG_MS)
    page.goto(url)
    yield page
    context.close()


def long_press(page: Page, target: Locator, hold_ms: int = LONG_PRESS_MS) -> None:
    """Puts a finger on the middle of a control, keeps it there and takes it away."""
    target.scroll_into_view_if_needed()
    box = target.bounding_box()
    assert box is not None
    point = {"x": box["x"] + box["width"] / 2, "y": box["y"] + box["height"] / 2}
    session = page.context.new_cdp_session(page)
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [point]})
    page.wait_for_timeout(hold_ms)
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()
