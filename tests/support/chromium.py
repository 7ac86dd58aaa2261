"""Where Chromium is, and how the browser tests start it."""

from __future__ import annotations

import os
import shutil

from app.bench.page.edits import CHROMIUM_NAMES, CHROMIUM_WORDS

SHELL = "chromium-headless-shell"
"""Debian's Chromium without windows: half of the processor's time for each page."""
LONG_MS = 180_000
"""How long the page may take for anything: a deadline for loaded machines, which no test waits out."""

UNUSED = (
    # What Chromium keeps ready behind its address line: two pages of its own for each window, a second each.
    "WebUIOmniboxPopup",
    "WebUIOmniboxAimPopup",
    # This word replaces Playwright's own; what of it concerns a page without a network:
    "AimEnabled",
    "AvoidUnnecessaryBeforeUnloadCheckSync",
    "DestroyProfileOnBrowserClose",
    "HttpsFirstBalancedModeAutoEnable",
    "HttpsUpgrades",
    "LensOverlay",
    "MediaRouter",
    "NetworkTimeServiceQuerying",
    "OptimizationHints",
    "PaintHolding",
    "PreconnectToSearch",
    "ThirdPartyStoragePartitioning",
)
"""Features of Chromium that no test needs."""

SCENE_WORDS = [*CHROMIUM_WORDS, f"--disable-features={','.join(UNUSED)}"]
"""With a 3D scene."""
WORDS = [
    *(word for word in SCENE_WORDS if "gl" not in word.partition("=")[0] and "swift" not in word),
    "--disable-gpu",
]
"""Without one: an emulated GPU costs a quarter of a page's time."""


def chromium_path() -> str | None:
    """The browser's program, or None where there is none."""
    named = os.environ.get("FOOTFALL_CHROMIUM")
    if named:
        return named
    return next((path for name in (SHELL, *CHROMIUM_NAMES) if (path := shutil.which(name))), None)
