"""The studio and the emulated robot as processes of their own, and a tap on the line between them."""

import json
import multiprocessing
import os
import re
import select
import signal
import subprocess
import threading
import time
import tty
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np

from app.common.json import Json
from app.common.own_command import own_command
from app.emulator.ports import PtyPort
from app.emulator.profiles import ProfileName
from core.errors import StateError

CHUNK_BYTES = 65536
ANSWER_SECONDS = 30.0
POLL = 0.02


def wait_until(condition: Callable[[], bool], what: str, seconds: float = 60.0) -> None:
    """Looks again and again until a condition holds.

    Raises:
        StateError: it does not within so many seconds.
    """
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise StateError(f"After {seconds:.0f} s still not: {what}. Look at the studio's log.", "bridge")
        time.sleep(POLL)


@dataclass(frozen=True)
class Piece:
    """Bytes that passed the tap, at `time.monotonic()` in s."""

    time: float
    data: bytes


class Tap:
    """Lies between host and robot and notes what passes.

    Args:
        robot: path of the robot's device.

    Attributes:
        from_host: what the host wrote.
        to_host: what the robot said, as it was passed on.
    """

    def __init__(self, robot: str) -> None:
        self.from_host: list[Piece] = []
        self.to_host: list[Piece] = []
        self._host = PtyPort()
        self._robot = os.open(robot, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._robot)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._copy, name="tap", daemon=True)
        self._thread.start()

    @property
    def device(self) -> str:
        """What the host opens."""
        return self._host.device

    def close(self) -> None:
        """Takes the tap out of the line."""
        self._closing.set()
        self._thread.join()
        self._host.close()
        os.close(self._robot)

    def _copy(self) -> None:
        while not self._closing.is_set():
            select.select([self._host.fileno(), self._robot], [], [], 0.1)
            if data := self._host.read():
                self.from_host.append(Piece(time.monotonic(), data))
                os.write(self._robot, data)
            if select.select([self._robot], [], [], 0)[0] and (data := os.read(self._robot, CHUNK_BYTES)):
                taken = data[: self._host.write(data)]
                if taken:
                    self.to_host.append(Piece(time.monotonic(), taken))


@contextmanager
def emulator_process(speed: float = 1.0, profile: ProfileName = ProfileName.PUBLISHED) -> Iterator[str]:
    """Device of a `footfall emulate` that is a process of its own."""
    options = ("--speed", str(speed), "--profile", profile.value)
    words = own_command("emulate", *options)
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    try:
        yield (process.stdout.readline() if process.stdout is not None else "").strip()
    finally:
        process.terminate()
        process.communicate()


class Studio:
    """A studio as a process of its own.

    Args:
        data: its data folder.
        device: its robot.
        *more: further words of `footfall serve`.
        log: where its log goes; to ours where None.

    Raises:
        StateError: it does not start.
    """

    def __init__(self, data: Path, device: str, *more: str, log: Path | None = None) -> None:
        options = ("--port", "0", "--data", str(data), "--robot", device, "--no-browser")
        words = own_command("serve", *options, *more)
        with log.open("wb") if log is not None else nullcontext() as said:
            self._process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=said, text=True)
        line = self._process.stdout.readline() if self._process.stdout is not None else ""
        found = re.search(r"(http://[^\s?]+)(?:\?token=(\S+))?", line)
        if found is None:
            raise StateError(f"The studio does not start; it said {line!r}.", "bridge")
        self._url, token = found.groups()
        self._headers = {"content-type": "application/json"}
        if token is not None:
            self._headers["authorization"] = f"Bearer {token}"

    @property
    def address(self) -> str:
        """Where its page is, without a token."""
        return self._url

    def memory_mb(self) -> float:
        """What it holds in memory itself, MB.

        Raises:
            StateError: this system does not tell.
        """
        listing = Path(f"/proc/{self._process.pid}/status")
        found = re.search(r"VmRSS:\s+(\d+) kB", listing.read_text() if listing.exists() else "")
        if found is None:
            raise StateError("This system does not tell a process's memory. Measure on Linux.", "memory")
        return int(found.group(1)) / 1000.0

    def ask(self, method: str, path: str, content: Json | None = None) -> Any:
        """One request; the content of its answer.

        Raises:
            urllib.error.HTTPError: it was refused.
        """
        body = None if content is None else json.dumps(content).encode()
        request = urllib.request.Request(self._url + path, data=body, method=method, headers=self._headers)
        with urllib.request.urlopen(request, timeout=ANSWER_SECONDS) as answer:
            return json.loads(answer.read())

    def robot(self) -> Json:
        """What is shown of the robot."""
        view: Json = self.ask("GET", "api/robot")
        return view

    def connect(self) -> None:
        """Connects the robot and waits until it answers and stands still."""
        self.ask("POST", "api/robot/connect", {})
        wait_until(lambda: self.robot()["link"] == "ready", "the robot answers")

    def begin_run(self, gait: str, iterations: int = 1) -> str:
        """Approves a gait, arms, sends, waits for the first waypoint, and returns the run's name."""
        self.ask("POST", f"api/gaits/{gait}/check")
        self.ask("POST", f"api/gaits/{gait}/approve", {"by": "bench", "accept_warnings": True})
        self.ask("POST", "api/robot/arm", {"by": "bench"})
        self.ask("POST", "api/robot/send", {"gait": gait, "by": "bench", "iterations": iterations})
        wait_until(lambda: (self.robot()["run"] or {}).get("sent", 0) > 0, "a waypoint was sent")
        return str(self.robot()["run"]["id"])

    def kill(self) -> float:
        """Kill −9; returns when, by `time.monotonic()` in s: taken before a busy machine may come between."""
        when = time.monotonic()
        self._process.send_signal(signal.SIGKILL)
        self._process.communicate()
        return when

    def close(self) -> None:
        """Ends it in peace."""
        self._process.terminate()
        try:
            self._process.communicate(timeout=ANSWER_SECONDS)
        except subprocess.TimeoutExpired:
            self.kill()


@contextmanager
def busy_cores(niceness: int) -> Iterator[None]:
    """As many processes that compute as there are cores, standing back by so much."""
    context = multiprocessing.get_context("spawn")
    workers = [
        context.Process(target=_compute, args=(niceness,), daemon=True) for _ in range(os.cpu_count() or 1)
    ]
    for worker in workers:
        worker.start()
    try:
        yield
    finally:
        for worker in workers:
            worker.terminate()
            worker.join()


@contextmanager
def sleeper() -> Iterator[Callable[[], list[float]]]:
    """A process that does nothing but sleep, and how much later than asked for it woke up each time, s.

    What the machine itself makes anybody wait, whatever a program does.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_sleep, args=(theirs,), daemon=True)
    process.start()
    ours.recv()

    def late() -> list[float]:
        ours.send(None)
        wakes: list[float] = ours.recv()
        return wakes

    try:
        yield late
    finally:
        process.terminate()
        process.join()


def _sleep(pipe: Connection) -> None:
    pipe.send(None)
    wakes: list[float] = []
    while True:
        due = time.monotonic() + POLL
        if pipe.poll(POLL):
            pipe.recv()
            pipe.send(wakes)
            wakes = []
        else:
            wakes.append(time.monotonic() - due)


def _compute(niceness: int) -> None:
    """Factorises matrices as a solver does, for ever."""
    os.nice(niceness)
    matrix = np.random.default_rng(0).normal(size=(200, 200)) + 200 * np.eye(200)
    while True:
        np.linalg.inv(matrix)
