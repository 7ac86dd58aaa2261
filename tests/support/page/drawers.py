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


def gait_act(page: Page, name: str) -> None:
    """Chooses an entry of the menu over the list of gaits that acts on the shown gait."""
    page.get_by_role("button", name="Gait", exact=True).click()
    page.get_by_role("menuitem", name=name, exact=True).click()
