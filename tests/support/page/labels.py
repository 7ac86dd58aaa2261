"""Measures on a page whether a text is cut, or lies on another one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from playwright.sync_api import Page

MEASURE = Path(__file__).with_suffix(".js").read_text()

Scheme = Literal["light", "dark"]


def label_problems(page: Page) -> list[str]:
    """A line for each text that is cut or lies on another one; a gait's name may end in an ellipsis."""
    problems: list[str] = page.evaluate(MEASURE)
    return problems


def require_whole_labels(
    page: Page, state: str, folder: Path, schemes: Sequence[Scheme] = ("light", "dark")
) -> None:
    """Fails with a picture where a text is cut or lies on another one.

    Args:
        page: as it is.
        state: what it shows, for the message and the picture's name.
        folder: where the picture is kept.
        schemes: colours in which the page is looked at.
    """
    for scheme in schemes:
        page.emulate_media(color_scheme=scheme)
        problems = label_problems(page)
        if problems:
            picture = folder / f"{state.replace(' ', '-')}-{scheme}.png"
            page.screenshot(path=picture)
            raise AssertionError(f"{state}, {scheme}: {problems}; see {picture}")
    page.emulate_media(color_scheme="light")
