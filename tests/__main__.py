"""Runs all tests, the browser tests included: `python -m tests [PYTEST ARGUMENTS]`.

Where Chromium is absent it is installed on Debian and Ubuntu by their package manager, as root; elsewhere it
says what to install.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.support.chromium import chromium_path

PROJECT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Provides Chromium, then hands over to pytest."""
    if chromium_path() is None:
        install_chromium()
    if chromium_path() is None:
        sys.stderr.write(
            "The browser tests need Chromium or Chrome. On Debian and Ubuntu install the package “chromium” "
            "(apt-get install chromium, as root); elsewhere install Chrome, or name the program in "
            "FOOTFALL_CHROMIUM. Then run this again.\n"
        )
        return 2
    return subprocess.call([sys.executable, "-m", "pytest", *sys.argv[1:]], cwd=PROJECT)


def install_chromium() -> None:
    """Installs Debian's or Ubuntu's Chromium where this process may."""
    apt = shutil.which("apt-get")
    if apt is None or os.geteuid() != 0:
        return
    sys.stderr.write("Installing Chromium by apt-get …\n")
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for words in (["update"], ["install", "-y", "--no-install-recommends", "chromium"]):
        subprocess.call([apt, "-q", *words], env=environment, stdout=sys.stderr, stdin=subprocess.DEVNULL)


if __name__ == "__main__":
    sys.exit(main())
