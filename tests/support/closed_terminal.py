"""A command that runs in a terminal of its own, which can be closed under it."""

from __future__ import annotations

import os
import select
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from tests.support.studio_process import PATIENT, PROJECT

_IN_TERMINAL = (
    "import fcntl, os, sys, termios; os.setsid(); fcntl.ioctl(0, termios.TIOCSCTTY, 0); "
    f"os.execv(sys.executable, [sys.executable, '-m', '{PATIENT}', *sys.argv[1:]])"
)
"""Makes the terminal on standard input the process's own, then becomes the program."""


class Terminal:
    """A terminal with a program in it.

    Args:
        process: the program.
        ours: the terminal's other end.
    """

    def __init__(self, process: subprocess.Popen[bytes], ours: int) -> None:
        self.process = process
        self._ours = ours
        self._shown = bytearray()
        self._closing = threading.Event()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def shown(self) -> str:
        """What the program has written so far."""
        return bytes(self._shown).decode(errors="replace")

    def close(self) -> None:
        """Closes the terminal, as a person closes its window: SIGHUP, and every write fails from then on."""
        if not self._closing.is_set():
            self._closing.set()
            self._reader.join()  # as long as somebody reads, it is not closed
            os.close(self._ours)

    def end(self) -> None:
        """Kills what is left."""
        self.process.kill()
        self.process.wait()
        self.close()

    def _read(self) -> None:
        while not self._closing.is_set():
            if select.select([self._ours], [], [], 0.05)[0]:
                try:
                    self._shown += os.read(self._ours, 4096)
                except OSError:  # the program has ended
                    return


@contextmanager
def in_terminal(*words: str) -> Iterator[Terminal]:
    """Runs a command of the program in a terminal; it is killed at the end if it still runs."""
    ours, theirs = os.openpty()
    process = subprocess.Popen(
        [sys.executable, "-c", _IN_TERMINAL, *words], cwd=PROJECT, stdin=theirs, stdout=theirs, stderr=theirs
    )
    os.close(theirs)
    terminal = Terminal(process, ours)
    try:
        yield terminal
    finally:
        terminal.end()
