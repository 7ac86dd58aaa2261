"""A headless Chromium with software rendering, and properties that are tried the same way each time."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings
from playwright.sync_api import Browser, expect, sync_playwright

from app.bench.page.edits import CHROMIUM_WORDS
from app.emulator.emulated_robot import EmulatedRobot, start_emulator
from tests.support.chromium import LONG_MS, chromium_path

# A slow machine is no failure, and one commit gives one answer; `--hypothesis-profile explore` looks further.
settings.register_profile(
    "same", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("explore", deadline=None, max_examples=1000)
settings.load_profile("same")


@pytest.fixture(scope="module")
def robot(request: pytest.FixtureRequest) -> Iterator[EmulatedRobot]:
    """An emulated robot, as fast as the file's `SPEED` says: its seconds in one of ours."""
    emulated = start_emulator("nominal", request.module.SPEED)
    yield emulated
    emulated.close()


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    program = chromium_path()
    if program is None:
        pytest.skip("Chromium is not installed; `python -m tests` says how to get it")
    expect.set_options(timeout=LONG_MS)
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=program, args=list(CHROMIUM_WORDS))
        yield opened
        opened.close()
