"""Builds the distributions of this checkout and installs them, without fetching anything."""

from __future__ import annotations

import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

from tests.support.studio_process import PROJECT

NO_SOURCE = (".git", ".venv", "node_modules", ".hypothesis", "build", "*.egg-info", "__pycache__", ".*_cache")
BUILD = "import setuptools.build_meta as tools, sys; getattr(tools, sys.argv[1])(sys.argv[2])"
BUILD_SECONDS, INSTALL_SECONDS = 300, 1200
"""Deadlines for loaded machines, which no test waits out."""


def run(*words: str | Path, cwd: Path, seconds: float) -> str:
    """What a command prints; it has to succeed."""
    done = subprocess.run(words, cwd=cwd, capture_output=True, text=True, timeout=seconds, check=False)
    assert done.returncode == 0, f"{words}\n{done.stdout[-4000:]}{done.stderr[-4000:]}"
    return done.stdout


def copied_source(folder: Path) -> Path:
    """A copy of this checkout, in which building leaves its files."""
    shutil.copytree(PROJECT, folder, ignore=shutil.ignore_patterns(*NO_SOURCE))
    return folder


def built(source: Path, kind: str, target: Path) -> Path:
    """Builds the `sdist`, the `wheel` or the `editable` wheel of a folder."""
    run(sys.executable, "-c", BUILD, f"build_{kind}", target, cwd=source, seconds=BUILD_SECONDS)
    return next(target.glob("*.tar.gz" if kind == "sdist" else "*.whl"))


def installed(wheel: Path, home: Path) -> Path:
    """The Python of a new environment with a wheel, and with what is installed where the tests run."""
    venv.create(home, with_pip=False)
    python = home / "bin" / "python"
    words = ("--no-input", "--disable-pip-version-check", "--python", python, "install", "--no-deps")
    run(sys.executable, "-m", "pip", *words, wheel, cwd=home, seconds=INSTALL_SECONDS)
    packages = next((home / "lib").glob("python*/site-packages"))
    (packages / "tested.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return python
