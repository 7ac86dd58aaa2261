"""Runs the tests, the browser tests included: `python -m tests [--all] [PYTEST ARGUMENTS]`.

Without `--all` it is every test but those marked `heavy`, two files at a time; properties are tried with few
examples, the same each time. `--all` runs what that leaves out: the heavy tests (soaks, kill storms, the
benchmarks' own, cameras, 3D scenes, most of the page), and every property with many examples, other ones each
time; one file at a time. `pytest FILE` runs all that a
file has.

Where Chromium is absent it is installed on Debian and Ubuntu by their package manager, as root; elsewhere it
says what to install.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.support.chromium import SHELL, chromium_path

PROJECT = Path(__file__).resolve().parents[1]

LANES = ("-n", "2", "--dist", "loadfile", "--no-loadscope-reorder")
"""Two files at a time, in the order of `conftest.py`; the tests of one file share its studio and its page."""
USUAL = ("-m", "not heavy")
REST = ("-m", "heavy or property", "--hypothesis-profile", "explore")


def main(words: list[str]) -> int:
    """Provides Chromium, then hands over to pytest."""
    if words[:1] in (["--help"], ["-h"]):
        sys.stdout.write(__doc__ or "")
        return 0
    if "FOOTFALL_CHROMIUM" not in os.environ and shutil.which(SHELL) is None:
        install_chromium()
    if chromium_path() is None:
        sys.stderr.write(
            "The browser tests need Chromium or Chrome. On Debian and Ubuntu install the package “chromium” "
            "(apt-get install chromium, as root); elsewhere install Chrome, or name the program in "
            "FOOTFALL_CHROMIUM. Then run this again.\n"
        )
        return 2
    # The heavy ones load the machine, or keep to the clock as a camera does: one file at a time.
    chosen, lanes = (REST, ()) if "--all" in words else (USUAL, LANES)
    more = [word for word in words if word != "--all"]
    return subprocess.call(
        [sys.executable, "-m", "pytest", *lanes, *chosen, *more], cwd=PROJECT, env=environment()
    )


def environment() -> dict[str, str]:
    """This one, but modules stay compiled: else each of a hundred processes compiles the program anew."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def install_chromium() -> None:
    """Installs Debian's or Ubuntu's Chromium if this process may: without windows, else the whole one."""
    apt = shutil.which("apt-get")
    if apt is None or os.geteuid() != 0:
        return
    sys.stderr.write("Installing Chromium by apt-get …\n")
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}

    def run(*words: str) -> bool:
        done = subprocess.call([apt, "-q", *words], env=quiet, stdout=sys.stderr, stdin=subprocess.DEVNULL)
        return done == 0

    install = ("install", "-y", "--no-install-recommends")
    if chromium_path() is None:
        run("update")
    if not run(*install, SHELL) and chromium_path() is None:
        run(*install, "chromium")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
