"""A headless Chromium with software rendering."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, sync_playwright

from tests.chromium import CHROMIUM_WORDS, chromium_path


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    program = chromium_path()
    if program is None:
        pytest.skip("Chromium is not installed; `python -m tests` says how to get it")
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=program, args=list(CHROMIUM_WORDS))
        yield opened
        opened.close()
