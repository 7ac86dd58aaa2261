"""Studios that start cheaply and are killed, and the processes that they leave behind."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

from tests.support.studio_process import PROJECT, StudioProcess, text_of

MARK = "FOOTFALL_STORM"
"""Environment variable of the processes that a studio starts: which start of the studio they belong to."""


def marked(mark: str) -> list[int]:
    """The living processes that bear a mark."""
    sought = f"{MARK}={mark}".encode()
    found = []
    for place in Path("/proc").glob("[0-9]*"):
        try:
            if sought in (place / "environ").read_bytes().split(b"\0"):
                found.append(int(place.name))
        except OSError:  # it has ended, or is somebody else's
            continue
    return found


class Launcher:
    """Starts one studio after the other on one data folder.

    Each is the command `footfall serve` in a fork of a process that has loaded the program already, so that
    a start costs no imports. Everything else is as users have it.

    Args:
        data: the data folder.
        device: the robot's.
        said: file for what the studios write to standard error.
    """

    def __init__(self, data: Path, device: str, said: Path) -> None:
        self._words = ["serve", "--port", "0", "--data", str(data), "--robot", device, "--no-browser"]
        self._said = said
        with said.open("wb") as errors:
            self._process = subprocess.Popen(
                [sys.executable, "-u", "-m", "tests.support.storm.forks"],
                cwd=PROJECT,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
            )
        self._child = 0
        self.starts = 0

    def start(self) -> None:
        """Starts a studio, which is not ready yet."""
        if self._process.stdin is None:
            raise AssertionError("the launcher has no standard input")
        self._process.stdin.write(json.dumps([f"{os.getpid()}-{self.starts}", *self._words]) + "\n")
        self._process.stdin.flush()
        self.starts += 1
        word, number = self._line().split()
        if word != "child":
            raise AssertionError(f"{word!r} instead of a child; {text_of(self._said)}")
        self._child = int(number)

    def mark(self, start: int) -> str:
        """What the processes of a start are marked with; starts count from 0."""
        return f"{os.getpid()}-{start}"

    def studio(self) -> StudioProcess:
        """The studio that was started, once it is ready."""
        line = self._line()
        found = re.search(r"http://\S+", line)
        if found is None:
            raise AssertionError(f"no address in {line!r}\n{text_of(self._said)}")
        return StudioProcess(self._child, found.group(), self._said)

    def kill(self) -> None:
        """Kills the studio by SIGKILL, and returns when it is dead."""
        os.kill(self._child, signal.SIGKILL)
        while not (line := self._line()).startswith("ended"):
            pass
        if line.split() != ["ended", str(-signal.SIGKILL)]:
            raise AssertionError(f"the studio had ended by itself: {line}\n{text_of(self._said)}")

    def close(self) -> None:
        """Ends the launcher, and a studio that still lives."""
        if self._child and self._process.poll() is None and self._is_alive():
            os.kill(self._child, signal.SIGKILL)
        self._process.kill()
        self._process.communicate()

    def _is_alive(self) -> bool:
        return Path(f"/proc/{self._child}/cmdline").exists()

    def _line(self) -> str:
        if self._process.stdout is None:
            raise AssertionError("the launcher has no standard output")
        line = self._process.stdout.readline()
        if not line:
            raise AssertionError(f"the launcher has ended\n{text_of(self._said)}")
        return line
