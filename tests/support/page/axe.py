"""What axe-core finds on a page: every rule, of any impact."""

from __future__ import annotations

from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

from tests.support.soak import is_soak

OWN = {"exclude": [["#viser"]]}
"""The scene's frame is Viser's own page."""
NODES = 3
COLOURS = {"runOnly": {"type": "rule", "values": ["color-contrast"]}}
"""Options for the one rule that can break in other colours."""


def findings(
    page: Page, context: dict[str, list[list[str]]] = OWN, options: dict[str, Any] | None = None
) -> list[str]:
    """A line for each broken rule: its impact and name, its help, and the first elements.

    Args:
        page: as it is.
        context: axe's, for a part of the page.
        options: axe's.
    """
    chosen = {"resultTypes": ["violations"], **(options or {})}
    answer = Axe().run(page, context=context, options=chosen).response
    return [
        f"{rule['impact']}, {rule['id']}: {rule['help']} at "
        f"{[node['target'] for node in rule['nodes'][:NODES]]}"
        for rule in answer["violations"]
    ]


def require_no_finding(page: Page, state: str) -> None:
    """Fails where axe finds something in light, or in a soak in dark.

    Args:
        page: as it is.
        state: what it shows, for the message.
    """
    found = findings(page)
    assert found == [], f"{state}, light: {found}"
    if not is_soak():
        return
    page.emulate_media(color_scheme="dark")
    found = findings(page, options=COLOURS)
    assert found == [], f"{state}, dark: {found}"
    page.emulate_media(color_scheme="light")
