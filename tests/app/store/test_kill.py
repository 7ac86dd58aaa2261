"""Kill −9 at random moments: whatever was acknowledged is there afterwards, and every file is whole."""

from __future__ import annotations

import json
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
import urllib.error
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, field
from http.client import HTTPException
from pathlib import Path

import pytest

from app.documents.gait_json import parse_gait
from tests.support.kill_worker import GAITS, number_of, opened
from tests.support.studio_process import PROJECT, StudioProcess

pytestmark = pytest.mark.heavy

ROUNDS = 45
SERVER_ROUNDS = 5
MOST_DEEDS = 12
"""Acknowledged deeds before a kill, at most."""
LONGEST_WAIT = 0.008
"""Between the last deed that was waited for and the kill, s: about as long as two deeds take."""
SEED = 20240601


@dataclass
class Acknowledged:
    """What has to be there: numbers of edits and saves, and named versions with the number that they hold."""

    edits: dict[str, int] = field(default_factory=lambda: dict.fromkeys(GAITS, 0))
    saves: dict[str, int] = field(default_factory=lambda: dict.fromkeys(GAITS, 0))
    versions: dict[tuple[str, int], int] = field(default_factory=dict)

    def take(self, action: str, gait: str, number: int) -> None:
        if action == "edit":
            self.edits[gait] = number
        elif action == "save":
            self.saves[gait] = self.edits[gait]
        elif action == "version":
            self.versions[gait, number] = self.edits[gait]


@pytest.fixture
def worker() -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [sys.executable, "-m", "tests.support.kill_worker"],
        cwd=PROJECT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    yield process
    process.kill()
    process.communicate()


def actions(process: subprocess.Popen[str]) -> Iterator[tuple[str, str, int]]:
    assert process.stdout is not None
    while line := process.stdout.readline():
        action, gait, number = line.split()
        yield action, gait, int(number)


def wait_about(seconds: float) -> None:
    """Lets the worker get anywhere into its next deed."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        pass


def one_round(worker: subprocess.Popen[str], folder: Path, dice: random.Random, known: Acknowledged) -> int:
    """Lets a child work, kills it, and takes note of all that it had told until then."""
    assert worker.stdin is not None
    worker.stdin.write(f"{folder} {dice.randrange(10**6)}\n")
    worker.stdin.flush()
    told = actions(worker)
    wanted, done, child = dice.randrange(MOST_DEEDS + 1), 0, 0
    while done < wanted or child == 0:
        action, gait, number = next(told)
        assert action != "ended", "the child ended by itself; its error is on standard error"
        if action == "child":
            child = int(gait)
        else:
            known.take(action, gait, number)
            done += 1
    wait_about(dice.uniform(0, LONGEST_WAIT))
    os.kill(child, signal.SIGKILL)
    for action, gait, number in told:
        if action == "ended":
            break
        known.take(action, gait, number)
        done += 1
    return done


def check(folder: Path, known: Acknowledged) -> None:
    """Opens the folder as the next start of the studio does, and looks for everything."""
    service, database = opened(folder)
    with closing(database):
        for gait in GAITS:
            present = service.open_gait(gait)
            assert number_of(present.gait.name) in (known.edits[gait], known.edits[gait] + 1)
            known.edits[gait] = number_of(present.gait.name)
            file = folder / "gaits" / f"{gait}.json"
            if known.saves[gait] or file.exists():
                saved = number_of(parse_gait(file.read_bytes(), file.name).name)
                assert known.saves[gait] <= saved <= known.edits[gait]
                known.saves[gait] = saved
            held = {version.number: version for version in service.versions.all(gait).rows}
            for (owner, number), content in known.versions.items():
                if owner == gait:
                    assert number_of(json.loads(held[number].document)["name"]) == content
        assert not list(folder.rglob("*.partial"))


def test_what_a_killed_service_acknowledged_is_there(worker: subprocess.Popen[str], tmp_path: Path) -> None:
    dice, known = random.Random(SEED), Acknowledged()
    done = 0
    for _ in range(ROUNDS):
        done += one_round(worker, tmp_path, dice, known)
        check(tmp_path, known)
    assert done > ROUNDS * MOST_DEEDS / 4
    assert known.versions
    assert all(known.saves.values())


def start(folder: Path) -> tuple[subprocess.Popen[str], StudioProcess]:
    command = [
        sys.executable,
        "-u",
        "-m",
        "app",
        "serve",
        "--port",
        "0",
        "--data",
        str(folder),
        "--no-browser",
    ]
    process = subprocess.Popen(command, cwd=PROJECT, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    found = re.search(r"http://\S+", process.stdout.readline())
    assert found is not None
    return process, StudioProcess(process.pid, found.group())


def kill(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.communicate()


class Editor(threading.Thread):
    """Edits one gait over HTTP, now and then saving it, until the studio no longer answers."""

    def __init__(self, studio: StudioProcess, gait: str, number: int) -> None:
        super().__init__()
        self._studio = studio
        self._path = f"/api/gaits/{gait}"
        self.sent = self.acknowledged = number
        self.saved = 0
        self.moved = threading.Event()

    def run(self) -> None:
        try:
            document = self._studio.ask("GET", self._path).content
            while True:
                self.sent = self.acknowledged + 1
                document["name"] = f"Number {self.sent}"
                if self._studio.ask("PUT", f"{self._path}?label=Name", document).status == 200:
                    self.acknowledged = self.sent
                if self.sent % 3 == 0 and self._studio.ask("POST", f"{self._path}/save").status == 200:
                    self.saved = self.acknowledged
                self.moved.set()
        except (urllib.error.URLError, HTTPException, OSError, ValueError):
            self.moved.set()  # the studio was killed


def test_what_a_killed_server_acknowledged_is_there(tmp_path: Path) -> None:
    dice = random.Random(SEED)
    acknowledged = sent = saved = 0
    for _ in range(SERVER_ROUNDS):
        process, studio = start(tmp_path)
        try:
            number = number_of(studio.ask("GET", "/api/gaits/walk").content["name"])
            assert acknowledged <= number <= sent
            editor = Editor(studio, "walk", number)
            editor.start()
            for _ in range(dice.randrange(1, 8)):
                assert editor.moved.wait(60)
                editor.moved.clear()
            wait_about(dice.uniform(0, 2 * LONGEST_WAIT))
        finally:
            kill(process)
        editor.join(60)
        assert not editor.is_alive()
        acknowledged, sent, saved = editor.acknowledged, editor.sent, max(saved, editor.saved)
        file = tmp_path / "gaits" / "walk.json"
        if saved:
            assert saved <= number_of(parse_gait(file.read_bytes(), file.name).name) <= sent
    assert acknowledged > SERVER_ROUNDS
    assert saved
