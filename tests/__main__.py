"""Runs the tests, the browser tests included: `python -m tests [--all | --soak] [PYTEST ARGUMENTS]`.

Without a size it is every test that is neither `heavy` nor `soak`, two files at a time; properties are tried
with few examples, the same each time. `--all` runs what that leaves out: the heavy tests (cameras, 3D scenes,
most of the page, the benchmarks' own, a tenth of each soak), and every property with many examples, the same
each time. `--soak` runs the soaks at full length (fuzz, storms of kills, floods, the oldest versions), and
every property with other examples each time; it takes long, and a quiet machine. docs/tests.md says when to
run which.

Where Chromium is absent it is installed on Debian and Ubuntu by their package manager, as root; elsewhere it
says what to install.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

from tests.support.chromium import SHELL, chromium_path
from tests.support.process_defaults import COLOURS, default_environment
from tests.support.soak import VARIABLE as SOAK

PROJECT = Path(__file__).resolve().parents[1]

LANES = ("-n", "2", "--dist", "loadfile", "--no-loadscope-reorder")
"""Two files at a time, in the order of `conftest.py`; the tests of one file share its studio and its page."""

NOTHING_CHOSEN = 5
"""Status of pytest where no test is of a run's marks."""


@dataclass(frozen=True)
class Size:
    """One of the three sizes of checks.

    Args:
        runs: the runs of pytest that it has, as arguments, one after the other.
        environment: what is set besides.
    """

    runs: tuple[tuple[str, ...], ...]
    environment: Mapping[str, str] = field(default_factory=dict)


_MANY, _EXPLORE = (("--hypothesis-profile", name) for name in ("many", "explore"))
SIZES: Mapping[str, Size] = MappingProxyType(
    {
        "": Size(((*LANES, "-m", "not heavy and not soak"),)),
        "--all": Size(
            (
                (*LANES, "-m", "(heavy or property) and not alone", *_MANY),
                # What keeps to the clock as a camera does: a file at a time.
                ("-m", "alone", *_MANY),
            )
        ),
        "--soak": Size((("-m", "soak or property", *_EXPLORE),), {SOAK: "1"}),
    }
)
"""By the word on the command line."""


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
    chosen = next((word for word in words if word in SIZES), "")
    size, more = SIZES[chosen], [word for word in words if word not in SIZES]
    given = environment() | dict(size.environment)
    # Under `nohup`, a terminal that is closed must not end the studios of the tests either.
    apart = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    codes = [
        subprocess.call(
            [sys.executable, "-m", "pytest", *run, *more], cwd=PROJECT, env=given, start_new_session=apart
        )
        for run in size.runs
    ]
    failed = [code for code in codes if code not in (0, NOTHING_CHOSEN)]
    return failed[0] if failed else min(codes)


def environment() -> dict[str, str]:
    """The default one with the chosen colours; pytest's Python itself starts with it."""
    chosen = {name: os.environ[name] for name in COLOURS if name in os.environ}
    return default_environment(os.environ) | chosen


def install_chromium() -> None:
    """Installs Debian's or Ubuntu's Chromium if this process may: without windows, else the whole one."""
    apt = shutil.which("apt-get")
    if apt is None or os.geteuid() != 0:
        return
    sys.stderr.write("Installing Chromium by apt-get …\n")
    with open(apt, "rb") as program:
        fcntl.flock(
            program, fcntl.LOCK_EX
        )  # a second copy of the tests waits until the first has installed it
        if shutil.which(SHELL) is None:
            _install(apt)


def _install(apt: str) -> None:
    # Another program that installs packages is waited for.
    patient = ("-q", "-o", "DPkg::Lock::Timeout=600")
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}

    def run(*words: str) -> bool:
        done = subprocess.call(
            [apt, *patient, *words], env=quiet, stdout=sys.stderr, stdin=subprocess.DEVNULL
        )
        return done == 0

    install = ("install", "-y", "--no-install-recommends")
    if chromium_path() is None:
        run("update")
    if not run(*install, SHELL) and chromium_path() is None:
        run(*install, "chromium")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
