"""Defaults of a process, so that no test depends on how the tests were started.

A process passes ignored and blocked signals, umask, limits and environment on to its children. A script's
background job ignores SIGINT, a job under `nohup` ignores SIGHUP, and a login may set any locale.
"""

from __future__ import annotations

import atexit
import os
import resource
import shutil
import signal
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from types import FrameType

UMASK = 0o022
OPEN_FILES = 1024
"""Usual soft limit of open files. A lower one is raised as far as the system allows."""
LOCAL = ("localhost", "127.0.0.1", "::1")
"""Hosts of the tests' own studios, which no proxy can reach."""
COLOURS = ("CLICOLOR", "CLICOLOR_FORCE", "FORCE_COLOR", "NO_COLOR", "PYTHON_COLORS", "PY_COLORS")
"""Variables that choose the colours of a program's output."""

_FIXED = {"LANG": "C.UTF-8", "TERM": "xterm", "TZ": "UTC"}
_DROPPED = {*COLOURS, "COLUMNS", "LANGUAGE", "LINES"}
_DROPPED_BEGINNINGS = ("LC_", "PYTHON", "XDG_")
_KEPT = {"PYTHONHOME", "PYTHONPATH"}
"""Without these, an unusual installation of Python finds no modules. The others go: PYTHONSAFEPATH hides the
checkout, and with PYTHONDONTWRITEBYTECODE each of a hundred processes compiles the program anew."""
_IGNORED_BY_PYTHON = {signal.SIGPIPE, signal.SIGXFSZ}


def restore_defaults() -> None:
    """Restores the defaults of this process; the processes that it starts inherit them."""
    _restore_signals()
    os.umask(UMASK)
    _open_standard_input()
    _raise_open_files()
    environment = default_environment(os.environ)
    if not _is_usable(environment.get("HOME")):
        environment["HOME"] = _new_home()
    os.environ.clear()
    os.environ.update(environment)
    time.tzset()


def default_environment(given: Mapping[str, str]) -> dict[str, str]:
    """The environment with default locale, time zone, terminal, folders and Python.

    Args:
        given: the environment with which a process was started.
    """
    environment = {name: value for name, value in given.items() if not _is_dropped(name)} | _FIXED
    for name in ("NO_PROXY", "no_proxy"):
        hosts = [host for host in given.get(name, "").split(",") if host]
        environment[name] = ",".join([*hosts, *(host for host in LOCAL if host not in hosts)])
    return environment


def _is_dropped(name: str) -> bool:
    return name not in _KEPT and (name in _DROPPED or name.startswith(_DROPPED_BEGINNINGS))


def _restore_signals() -> None:
    """Unblocks all signals, and lets no child of this process inherit an ignored one.

    A child inherits an ignored signal, but not a handler. This process itself goes on after a signal that was
    ignored. SIGINT is the exception, because tests send it to their own process.
    """
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
    for number in signal.valid_signals() - _IGNORED_BY_PYTHON:
        if signal.getsignal(number) is signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else _go_on)


def _go_on(number: int, frame: FrameType | None) -> None:
    """Does nothing about a signal."""


def _open_standard_input() -> None:
    """Opens an empty standard input if it was closed."""
    try:
        os.fstat(0)
    except OSError:
        opened = os.open(os.devnull, os.O_RDONLY)
        if opened != 0:
            os.dup2(opened, 0)
            os.close(opened)
        else:
            os.set_inheritable(0, True)


def _raise_open_files() -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = OPEN_FILES if hard == resource.RLIM_INFINITY else min(OPEN_FILES, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))


def _is_usable(home: str | None) -> bool:
    return home is not None and Path(home).is_dir() and os.access(home, os.W_OK | os.X_OK)


def _new_home() -> str:
    """A home folder for as long as this process lives."""
    home = tempfile.mkdtemp(prefix="footfall-home-")
    atexit.register(shutil.rmtree, home, ignore_errors=True)
    return home
