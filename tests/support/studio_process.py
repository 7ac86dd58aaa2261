"""The studio as a real process, beside an emulated robot that lives in the test and runs fast."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

PROJECT = Path(__file__).resolve().parents[2]
START_SECONDS = 30.0


def wait_for(condition: Callable[[], bool], what: str, seconds: float = 60.0) -> None:
    """Looks again and again until a condition holds, at most some seconds."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"after {seconds} s still not: {what}")
        time.sleep(0.02)


@dataclass(frozen=True)
class Answer:
    """Status and JSON content of an HTTP answer."""

    status: int
    content: Any


@dataclass(frozen=True)
class StudioProcess:
    """A running studio."""

    process: subprocess.Popen[str]
    url: str

    def ask(
        self, method: str, path: str, content: Any = None, headers: dict[str, str] | None = None
    ) -> Answer:
        """One request."""
        body = (
            content
            if isinstance(content, bytes)
            else None
            if content is None
            else json.dumps(content).encode()
        )
        request = urllib.request.Request(
            self.url + path.lstrip("/"),
            data=body,
            method=method,
            headers={"content-type": "application/json", **(headers or {})},
        )
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return Answer(answer.status, json.loads(answer.read() or b"null"))
        except urllib.error.HTTPError as error:
            with error:
                return Answer(error.code, json.loads(error.read() or b"null"))

    def blob(self, path: str) -> bytes:
        """The bytes at a path."""
        with urllib.request.urlopen(self.url + path.lstrip("/"), timeout=60) as answer:
            content: bytes = answer.read()
            return content

    def text(self, path: str) -> str:
        """The text at a path."""
        return self.blob(path).decode()

    def document(self, gait: str) -> dict[str, Any]:
        """A gait's document."""
        content: dict[str, Any] = self.ask("GET", f"/api/gaits/{gait}").content
        return content

    def robot(self) -> dict[str, Any]:
        """The robot's view."""
        view: dict[str, Any] = self.ask("GET", "/api/robot").content
        return view


def footfall(*words: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """Runs a command of the program to its end."""
    return subprocess.run(
        [sys.executable, "-m", "app", *words],
        cwd=PROJECT,
        capture_output=True,
        text=True,
        timeout=60,
        **options,
    )


@contextmanager
def running_studio(
    data: Path,
    *words: str,
    cwd: Path = PROJECT,
    environment: dict[str, str] | None = None,
) -> Iterator[StudioProcess]:
    """A studio on a free port; ended by SIGTERM, and its exit status must be 0."""
    command = [sys.executable, "-m", "app", "serve", "--port", "0", "--data", str(data), "--no-browser"]
    process = subprocess.Popen(
        [*command, *words],
        cwd=cwd,
        stdout=subprocess.PIPE,
        text=True,
        env={**(environment or os.environ), "PYTHONUNBUFFERED": "1"},
    )
    try:
        if process.stdout is None:
            raise AssertionError("the studio has no standard output")
        line = process.stdout.readline()
        found = re.search(r"http://\S+", line)
        if found is None:
            raise AssertionError(f"no address in {line!r}; exit status {process.wait(START_SECONDS)}")
        yield StudioProcess(process, found.group())
        process.send_signal(signal.SIGTERM)
        if process.wait(60) != 0:
            raise AssertionError(f"serve ended with status {process.returncode}")
    finally:
        process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()
