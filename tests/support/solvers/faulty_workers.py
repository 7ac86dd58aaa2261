"""Bodies of worker processes that fail in every way once they have a task; the file `warm_up` says so."""

from __future__ import annotations

import itertools
import os
import signal
import struct
import threading
from collections import deque
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

Body = Callable[[Connection, Any], None]


def _begin(pipe: Connection, mark: str) -> None:
    pipe.recv()
    Path(mark).touch()


def _wait() -> None:
    threading.Event().wait()


def sleeps(pipe: Connection, mark: str) -> None:
    """Waits for ever."""
    _begin(pipe, mark)
    _wait()


def spins(pipe: Connection, mark: str) -> None:
    """Runs in C for ever, and lets no other thread run."""
    _begin(pipe, mark)
    deque(itertools.repeat(None), maxlen=0)


def stops(pipe: Connection, mark: str) -> None:
    """Is stopped as by Ctrl-Z."""
    _begin(pipe, mark)
    os.kill(os.getpid(), signal.SIGSTOP)


def reads_nothing(pipe: Connection, mark: str) -> None:
    """Is stopped before it reads its task."""
    del pipe
    Path(mark).touch()
    os.kill(os.getpid(), signal.SIGSTOP)


def dies(pipe: Connection, mark: str) -> None:
    """Is killed as by the system that has no memory left."""
    _begin(pipe, mark)
    os.kill(os.getpid(), signal.SIGKILL)


def hangs_up(pipe: Connection, mark: str) -> None:
    """Closes its pipe and lives on."""
    _begin(pipe, mark)
    pipe.close()
    _wait()


def sends_junk(pipe: Connection, mark: str) -> None:
    """Sends what is no message."""
    _begin(pipe, mark)
    pipe.send_bytes(b"\x80junk")
    _wait()


def sends_half(pipe: Connection, mark: str) -> None:
    """Sends half of a message."""
    _begin(pipe, mark)
    os.write(pipe.fileno(), struct.pack("!i", 1_000_000) + b"half")
    _wait()


def sends_others(pipe: Connection, mark: str) -> None:
    """Sends messages that nobody knows, again and again."""
    _begin(pipe, mark)
    while True:
        pipe.send({"what": "?"})
        threading.Event().wait(0.01)


def stops_as_camera(pipe: Connection, address: Any) -> None:
    """Is stopped once it is asked for a picture."""
    del address
    pipe.recv()
    os.kill(os.getpid(), signal.SIGSTOP)


HANGING: tuple[Body, ...] = (sleeps, spins, stops, reads_nothing, sends_half, sends_others)
ENDING: tuple[Body, ...] = (dies, hangs_up, sends_junk)
