"""The Robot panel as somebody opens it."""

from __future__ import annotations

import re

from playwright.sync_api import Page


def name(page: Page, person: str) -> None:
    """Says who one is, and opens the Robot panel."""
    page.get_by_role("button", name=re.compile("Operator")).click()
    page.get_by_role("textbox", name="Your name").fill(person)
    page.keyboard.press("Enter")
    page.get_by_role("tab", name="Run").click()
