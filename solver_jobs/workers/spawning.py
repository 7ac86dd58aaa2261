"""Starting a process of our own with a pipe to it."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from types import ModuleType
from typing import Any

from core.text.printable import printable_stream

NICENESS = 5
"""How far a solver stands back where cores are scarce, so that a stop of the robot never waits for one."""

START_METHOD = "spawn"
"""How Python starts a process (see `multiprocessing`): a fresh interpreter, as the studio has threads."""

_STARTING = threading.Lock()
"""One process is started at a time."""

BACKGROUND_NICENESS = 10
"""Niceness of background workers, which yield to the page and to live results."""

IDLE_NICENESS = 19
"""Niceness of workers for hours of work, which run only while a core is free."""


def start_process(
    body: Callable[[Connection, Any], None], warm_up: Any, name: str, niceness: int = NICENESS
) -> tuple[BaseProcess, Connection]:
    """Starts a fresh interpreter that runs `body`; it ends at the latest with this one.

    Args:
        body: gets the worker's end of the pipe and the problem to warm up with.
        warm_up: a problem, or None.
        name: of the process.
        niceness: how far it stands back.

    Returns:
        The process and our end of the pipe.
    """
    context: Any = multiprocessing.get_context(START_METHOD)
    ours, theirs = context.Pipe()
    process = context.Process(
        target=_stand_back, args=(body, theirs, warm_up, niceness), name=name, daemon=True
    )
    with _without_main():
        process.start()
    theirs.close()
    return process, ours


@contextmanager
def _without_main() -> Iterator[None]:
    """Starts a worker without the file that is the main program, of which no worker has any need.

    It would run a person's script once more, and load the command line in each worker of the studio. Other
    threads may meet the stand-in for some milliseconds.
    """
    with _STARTING:
        main = sys.modules["__main__"]
        sys.modules["__main__"] = ModuleType("__main__")
        try:
            yield
        finally:
            sys.modules["__main__"] = main


def _stand_back(
    body: Callable[[Connection, Any], None], pipe: Connection, warm_up: Any, niceness: int
) -> None:
    # Ctrl-C and a closed terminal reach the whole group; the parent decides when a worker ends.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "SIGHUP"):
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(niceness)
    if niceness == IDLE_NICENESS and hasattr(os, "SCHED_IDLE"):
        with suppress(OSError):  # some containers forbid it; the niceness holds anyway
            os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
    if sys.stderr is not None:
        sys.stderr = printable_stream(sys.stderr)  # a traceback may hold any name
    body(pipe, warm_up)
