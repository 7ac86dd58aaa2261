"""Makes the pictures of README and docs anew: `python -m tests.pictures [NAME ...]`, without a name all.

A name is that of a file in docs, such as `studio.png`. The still pictures share a studio with a new data
folder and an emulated robot; the moving one has its own. Look at every picture before it is committed.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

from tests.pictures.album import STILLS
from tests.pictures.main_path import FILM, SPEED, main_path
from tests.pictures.sitting import DOCS, sitting
from tests.support.chromium import LONG_MS, WORDS, chromium_path
from tests.support.patience import patient_robot
from tests.support.process_defaults import restore_defaults
from tests.support.studio_process import StudioProcess, running_studio

NAMES = (*STILLS, FILM)
STILL_SPEED = 8.0
"""Seconds of the emulated robot in a second, for still pictures."""


def main(names: list[str]) -> int:
    """Makes the named pictures, or all."""
    unknown = sorted(set(names) - set(NAMES))
    if unknown:
        sys.stderr.write(f"No picture has the name {unknown[0]}. There are: {', '.join(NAMES)}\n")
        return 2
    restore_defaults()
    expect.set_options(timeout=LONG_MS)
    chosen = [name for name in NAMES if name in names or not names]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium_path(), args=WORDS)
        with new_studio(STILL_SPEED) as studio:
            for name in chosen:
                if name in STILLS:
                    with sitting(browser, studio, has_scene=STILLS[name].has_scene) as at:
                        STILLS[name].take(at, DOCS / name)
                    report(name)
        if FILM in chosen:
            with new_studio(SPEED) as studio, sitting(browser, studio) as at:
                main_path(at, DOCS / FILM)
            report(FILM)
    return 0


def report(name: str) -> None:
    """Says that a picture is made, and its size."""
    sys.stdout.write(f"{name}: {(DOCS / name).stat().st_size / 1000:.0f} kB\n")
    sys.stdout.flush()


@contextmanager
def new_studio(speed: float) -> Iterator[StudioProcess]:
    """A studio with an empty data folder.

    Args:
        speed: seconds of its emulated robot in a second.
    """
    with (
        tempfile.TemporaryDirectory() as data,
        patient_robot(speed) as robot,
        running_studio(Path(data), "--robot", robot.device) as studio,
    ):
        yield studio


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
