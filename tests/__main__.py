"""Runs the tests, the browser tests included: `python -m tests [--ci | --soak] [PYTEST ARGUMENTS]`.

Without a size it is every test that is neither `heavy` nor `soak`, two files at a time; properties are tried
with few examples, the same each time. `--ci` runs these and the heavy tests (cameras, 3D scenes, most of the
page, the benchmarks' own), and every property with many examples, the same each time. `--soak` runs the soaks
at full length (fuzz, storms of kills, floods, the oldest versions), and every property with other examples
each time; it takes long, and a quiet machine. docs/tests.md says when to run which.

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
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

from tests.support.chromium import SHELL, chromium_path
from tests.support.process_defaults import COLOURS, default_environment
from tests.support.soak import VARIABLE as SOAK

PROJECT = Path(__file__).resolve().parents[1]

ENDING = ("--durations=30", "--durations-min=1")
"""Has a run say which tests were the slowest."""
LANES = ("-n", "2", "--dist", "loadfile", "--no-loadscope-reorder", *ENDING)
"""Two files at a time, in the order of `conftest.py`; the tests of one file share its studio and its page."""
UNHURRIED = ("tests/core", "tests/solver_jobs/live", "tests/solver_jobs/nlp", "tests/solver_jobs/pose_gaits")
"""Folders of tests without a process or a deadline, which may run beside one that keeps to the clock."""

NOTHING_CHOSEN = 5
"""Status of pytest where no test is of a run's marks."""


@dataclass(frozen=True)
class Size:
    """One of the three sizes of checks.

    Args:
        runs: the runs of pytest that it has, as arguments, one after the other.
        beside: arguments of a run of the folders `UNHURRIED`, which gets the time that the last one leaves.
        environment: what is set besides.
    """

    runs: tuple[tuple[str, ...], ...]
    beside: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)


_MANY, _EXPLORE = (("--hypothesis-profile", name) for name in ("many", "explore"))
_CI_MARKS = "(not soak or soak(short=True))"
_CI = ("-m", f"{_CI_MARKS} and not alone", *_MANY)
SIZES: Mapping[str, Size] = MappingProxyType(
    {
        "": Size(((*LANES, "-m", "not heavy and not soak"),)),
        # What keeps to the clock as a camera does comes last: a file at a time.
        "--ci": Size(((*LANES, *_CI), ("-m", f"{_CI_MARKS} and alone", *ENDING)), beside=(*_CI, *ENDING)),
        "--soak": Size((("-m", "soak or property", *_EXPLORE, *ENDING),), environment={SOAK: "1"}),
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
    pytest = [sys.executable, "-m", "pytest"]
    options: dict[str, Any] = {"cwd": PROJECT, "env": given, "start_new_session": apart}
    if size.beside and not more:
        codes = _run_side_by_side(size, pytest, options)
    else:
        codes = [subprocess.call([*pytest, *run, *more], **options) for run in size.runs]
    failed = [code for code in codes if code not in (0, NOTHING_CHOSEN)]
    return failed[0] if failed else min(codes)


def _run_side_by_side(size: Size, pytest: list[str], options: dict[str, Any]) -> list[int]:
    """Runs a size whose last run has another one beside it, which is shown after it; returns the statuses."""
    *runs, last = size.runs
    elsewhere = [f"--ignore={folder}" for folder in UNHURRIED]
    codes = [subprocess.call([*pytest, *run, *elsewhere], **options) for run in runs]
    with tempfile.TemporaryFile() as shown:
        patiently = ["nice", "-n", "19", *pytest, *size.beside, *UNHURRIED]
        beside = subprocess.Popen(patiently, stdout=shown, stderr=subprocess.STDOUT, **options)
        codes += [subprocess.call([*pytest, *last], **options), beside.wait()]
        shown.seek(0)
        sys.stdout.write(shown.read().decode(errors="replace"))
    return codes


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
