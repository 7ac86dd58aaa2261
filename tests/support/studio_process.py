"""The studio as a real process, beside an emulated robot that lives in the test and runs fast."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from tests.support.spent_seconds import spending
from tests.support.studio_forks import fork_studio

PROJECT = Path(__file__).resolve().parents[2]
START_SECONDS = 30.0
END_SECONDS = 60.0
ANSWER_SECONDS = 180.0
"""How long an answer may take: a deadline for loaded machines, which no test waits out."""
PATIENT = "tests.support.patient_studio"
"""The module that runs the program with deadlines for loaded machines."""
PROGRAM, USUAL = (sys.executable, "-m", "app"), (sys.executable, "-m", PATIENT)
"""What starts the program, and the same with these deadlines."""


def wait_for(condition: Callable[[], bool], what: str, seconds: float = 180.0) -> None:
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

    pid: int
    url: str
    said: Path | None = None
    """What it writes to standard error."""
    data: Path = Path()
    """Its data folder."""

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
            with urllib.request.urlopen(request, timeout=ANSWER_SECONDS) as answer:
                return Answer(answer.status, json.loads(answer.read() or b"null"))
        except urllib.error.HTTPError as error:
            with error:
                return Answer(error.code, json.loads(error.read() or b"null"))

    def blob(self, path: str) -> bytes:
        """The bytes at a path."""
        with urllib.request.urlopen(self.url + path.lstrip("/"), timeout=ANSWER_SECONDS) as answer:
            content: bytes = answer.read()
            return content

    def lines(self, path: str, content: Any) -> list[Any]:
        """The JSON objects that an answer to a POST has, one a line."""
        body = json.dumps(content).encode()
        request = urllib.request.Request(
            self.url + path.lstrip("/"), body, {"content-type": "application/json"}, method="POST"
        )
        with urllib.request.urlopen(request, timeout=ANSWER_SECONDS) as answer:
            return [json.loads(line) for line in answer]

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
        [*PROGRAM, *words],
        cwd=PROJECT,
        capture_output=True,
        text=True,
        timeout=ANSWER_SECONDS,
        **options,
    )


RUNNING: list[StudioProcess] = []
"""Studios of this process's tests, for reports of tests that fail."""


def said_by_studios() -> str:
    """The ends of what the running studios wrote to standard error."""
    texts = [(one.url, text_of(one.said)) for one in RUNNING]
    return "\n".join(f"{url}\n{text}" for url, text in texts if text)


def text_of(path: Path | None) -> str:
    """The end of a text file, or nothing."""
    text = path.read_text(errors="replace") if path is not None and path.exists() else ""
    return text[-20_000:]


@dataclass(frozen=True)
class _Child:
    """The process of a studio, however it was started."""

    pid: int
    output: IO[str]
    wait: Callable[[float], int | None]
    """The exit status, or None where it still runs after so many seconds."""
    kill: Callable[[], None]


@contextmanager
def running_studio(
    data: Path,
    *words: str,
    cwd: Path = PROJECT,
    environment: dict[str, str] | None = None,
    program: Sequence[str] = USUAL,
) -> Iterator[StudioProcess]:
    """A studio on a free port; ended by SIGTERM, and its exit status must be 0.

    Where nothing is asked of how it is started, it is a fork of a process that has loaded the program.
    """
    command = ["serve", "--port", "0", "--data", str(data), "--no-browser", *words]
    is_usual = (cwd, environment, program) == (PROJECT, None, USUAL)
    descriptor, name = tempfile.mkstemp(prefix="footfall-said-", suffix=".txt")
    os.close(descriptor)
    said = Path(name)
    child: _Child | None = None
    studio: StudioProcess | None = None
    try:
        with spending("starting studios"):
            child = (
                _forked(command, said) if is_usual else _started([*program, *command], said, cwd, environment)
            )
            line = child.output.readline()
        found = re.search(r"http://\S+", line)
        if found is None:
            status = child.wait(START_SECONDS)
            raise AssertionError(f"no address in {line!r}; exit status {status}\n{text_of(said)}")
        studio = StudioProcess(child.pid, found.group(), said, data)
        RUNNING.append(studio)
        yield studio
        with spending("ending studios"):
            os.kill(child.pid, signal.SIGTERM)
            status = child.wait(END_SECONDS)
        if status != 0:
            raise AssertionError(f"serve ended with status {status}\n{text_of(said)}")
    finally:
        if studio in RUNNING:
            RUNNING.remove(studio)
        if child is not None:
            child.kill()
            child.output.close()
        said.unlink()


def _forked(words: list[str], said: Path) -> _Child:
    process, output = fork_studio(words, said)

    def wait(seconds: float) -> int | None:
        process.join(seconds)
        return process.exitcode

    def kill() -> None:
        process.kill()
        process.join()
        process.close()

    return _Child(process.pid or 0, output, wait, kill)


def _started(words: list[str], said: Path, cwd: Path, environment: dict[str, str] | None) -> _Child:
    given = {**(environment or os.environ), "PYTHONUNBUFFERED": "1"}
    with said.open("wb") as errors:
        process = subprocess.Popen(
            words, cwd=cwd, stdout=subprocess.PIPE, stderr=errors, text=True, env=given
        )

    def wait(seconds: float) -> int | None:
        with suppress(subprocess.TimeoutExpired):
            process.wait(seconds)
        return process.returncode

    def kill() -> None:
        process.kill()
        process.wait()

    if process.stdout is None:
        raise AssertionError("the studio has no standard output")
    return _Child(process.pid, process.stdout, wait, kill)
