"""The drawers at the left of the page, as somebody opens them by the rail."""

from __future__ import annotations

from playwright.sync_api import Locator, Page


def open_drawer(page: Page, name: str) -> Locator:
    """Opens a drawer at its list, also where it is open at something else; gives the drawer."""
    button = page.get_by_role("navigation", name="Project").get_by_role("button", name=name)
    if button.get_attribute("aria-expanded") == "true":
        button.click()
    button.click()
    return page.get_by_role("region", name=name, exact=True)
