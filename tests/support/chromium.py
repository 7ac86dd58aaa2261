"""Where Chromium is, and how the browser tests start it."""

from __future__ import annotations

import os
import shutil

from app.bench.page.edits import CHROMIUM_NAMES

LONG_MS = 60_000
"""How long the page may take for anything: a deadline for loaded machines, which no test waits out."""


def chromium_path() -> str | None:
    """The browser's program, or None where there is none."""
    named = os.environ.get("FOOTFALL_CHROMIUM")
    if named:
        return named
    return next((path for name in CHROMIUM_NAMES if (path := shutil.which(name))), None)
