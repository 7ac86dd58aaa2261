"""Kills a studio at random moments of its use, and looks each time for what was acknowledged."""

from __future__ import annotations

import json
import random
import sqlite3
import time
from collections import Counter
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from app.documents.gait_json import parse_gait
from app.emulator.emulated_robot import EmulatedRobot
from app.store.backups import FOLDER as BACKUPS
from tests.support.storm.actor import Actor
from tests.support.storm.collector import Collection, Collector, found_collection
from tests.support.storm.editors import Editor, found_state
from tests.support.storm.gait_ledger import GaitLedger, GaitState
from tests.support.storm.operators import GAIT, RUN, Operator, Runs, waypoints_heard
from tests.support.storm.processes import Launcher, marked
from tests.support.storm.workers import Jobs, Worker
from tests.support.studio_process import StudioProcess, wait_for

START = "start"
"""Counted with the kinds of action in flight: the studio was killed before it was ready."""
STARTS, RUNS = 0.1, 0.35
"""Shares of the kills while the studio starts, and while a run is under way."""
START_SECONDS, USE_SECONDS, RUN_SECONDS = 0.8, 1.2, 0.6
"""A kill comes at most this long after the start, after the first action, after a run was seen to go on."""
RUN_DEADLINE = 20.0
"""If no run goes on after so many s, as on a loaded machine, the kill comes all the same."""
GRACE_STARTS = 3
"""What a studio started must be gone this many starts after its kill."""


@dataclass
class Report:
    """What a storm came to.

    Args:
        kills: how many.
        in_flight: kills with an action of a kind in flight, by kind; several may be at one time.
        there: of the actions in flight that are looked for, how many were done all the same.
        not_there: how many were not done at all.
        answered: actions that were acknowledged, by kind.
        interrupted_jobs: jobs that a kill ended.
        run_ends: how runs ended that were under way at a kill.
    """

    kills: int = 0
    in_flight: Counter[str] = field(default_factory=Counter)
    there: int = 0
    not_there: int = 0
    answered: Counter[str] = field(default_factory=Counter)
    interrupted_jobs: int = 0
    run_ends: Counter[str] = field(default_factory=Counter)

    def text(self) -> str:
        """The figures in lines."""
        rows = [f"{self.kills} kills; in flight at the kill:"]
        rows += [f"  {kind:20} {count:4}" for kind, count in self.in_flight.most_common()]
        rows += [f"actions in flight that were done: {self.there}, not done: {self.not_there}"]
        rows += [f"acknowledged: {sum(self.answered.values())}: {dict(self.answered.most_common())}"]
        rows += [f"jobs that a kill ended: {self.interrupted_jobs}; runs: {dict(self.run_ends)}"]
        return "\n".join(rows) + "\n"


class Storm:
    """One data folder, one robot, and what is known of both.

    Args:
        folder: for the data and the studios' standard error.
        robot: the emulated robot.
        seed: of the dice.
    """

    def __init__(self, folder: Path, robot: EmulatedRobot, seed: int) -> None:
        self._data, self._robot, self._dice = folder / "data", robot, random.Random(seed)
        self._launcher = Launcher(self._data, robot.device, folder / "said.txt")
        self._gaits: list[GaitLedger] = []
        self._collection, self._jobs, self._runs = Collection(), Jobs(), Runs()
        self._waypoints = 0
        self.report = Report()

    def close(self) -> None:
        """Ends the studio."""
        self._launcher.close()

    def prepare(self) -> None:
        """Starts for the first time: takes down what is there, and approves the gait that is sent."""
        self._launcher.start()
        studio = self._launcher.studio()
        for gait, approves in (("walk-manual-0", True), ("walk", False)):
            self._gaits.append(GaitLedger(gait, GaitState(studio.document(gait)["name"]), approves))
        sent = GaitLedger(GAIT, GaitState(studio.document(GAIT)["name"]), approves=True)
        assert studio.ask("POST", f"/api/gaits/{GAIT}/check").status == 200
        approval = {"by": "Ada", "accept_warnings": True}
        assert studio.ask("POST", f"/api/gaits/{GAIT}/approve", approval).status == 200
        sent.state = sent.state.approved("Ada")
        self._gaits.append(sent)
        self._kill()

    def round(self) -> None:
        """One start, what is found, what is done, and the kill."""
        self._launcher.start()
        if self._dice.random() < STARTS:
            time.sleep(self._dice.uniform(0.0, START_SECONDS))
            self.report.in_flight[START] += 1
            self._kill()
            return
        studio = self._launcher.studio()
        self.look(studio)
        actors = self._actors(studio)
        for actor in actors:
            actor.start()
        self._wait_for_the_moment()
        alive = [actor for actor in actors if actor.is_alive()]
        self.report.in_flight.update({actor.doing for actor in actors if actor.doing} or {"nothing"})
        self.report.in_flight[RUN] += self._runs.moving.is_set()
        self._kill()
        for actor in actors:
            actor.join(60)
            assert not actor.is_alive()
            if actor.error is not None:
                raise actor.error
            self.report.answered += actor.done
        assert len(alive) == len(actors), "somebody got no answer before the kill"

    def finish(self) -> None:
        """Starts for the last time and looks; then nothing of any studio lives."""
        self._launcher.start()
        self.look(self._launcher.studio())
        self._launcher.kill()
        for start in range(self._launcher.starts):
            self._require_gone(start)

    def look(self, studio: StudioProcess) -> None:
        """Looks for everything that was acknowledged, and for anything that goes on by itself."""
        self._require_gone(self._launcher.starts - 1 - GRACE_STARTS)
        self._look_at_files()
        for ledger in self._gaits:
            self._count(ledger.compare(found_state(studio, self._data, ledger)))
        self._count(self._collection.compare(*found_collection(studio)))
        self.report.interrupted_jobs += self._jobs.compare(studio)
        end = self._runs.compare(studio)
        if end is not None:
            self.report.run_ends[end] += 1
        assert waypoints_heard(self._robot) == self._waypoints

    def _look_at_files(self) -> None:
        for file in (*self._data.glob("gaits/*.json"), *self._data.glob("trash/*.json")):
            parse_gait(file.read_bytes(), file.name)
        for file in self._data.glob("*.json"):
            json.loads(file.read_bytes())
        left = [file for pattern in ("*.partial", "*.journal") for file in self._data.rglob(pattern)]
        # The studio may be at its backup; half of one stays after a kill, until a backup of a later day.
        left = [file for file in left if file.parent.name != BACKUPS]
        assert left == [], left
        with closing(sqlite3.connect(f"file:{self._data / 'studio.sqlite3'}?mode=ro", uri=True)) as database:
            assert database.execute("PRAGMA quick_check").fetchall() == [("ok",)]
            states = "SELECT json_extract(content, '$.state') FROM job"
            on = {state for (state,) in database.execute(states)} & {"queued", "running", "cancelling"}
            assert on == set()

    def _actors(self, studio: StudioProcess) -> list[Actor]:
        def dice() -> random.Random:
            return random.Random(self._dice.randrange(2**32))

        return [
            *(Editor(studio, ledger, dice()) for ledger in self._gaits if ledger.gait != GAIT),
            Collector(studio, self._collection, dice()),
            Worker(studio, self._jobs, dice()),
            Operator(studio, self._runs, dice()),
        ]

    def _wait_for_the_moment(self) -> None:
        if self._dice.random() < RUNS / (1.0 - STARTS):
            self._runs.moving.wait(RUN_DEADLINE)
            time.sleep(self._dice.uniform(0.0, RUN_SECONDS))
        else:
            time.sleep(self._dice.uniform(0.0, USE_SECONDS))

    def _kill(self) -> None:
        self._launcher.kill()
        self.report.kills += 1
        self._waypoints = waypoints_heard(self._robot)

    def _require_gone(self, start: int) -> None:
        mark = self._launcher.mark(start)
        wait_for(lambda: not marked(mark), f"the processes of start {start} are gone")

    def _count(self, is_there: bool | None) -> None:
        self.report.there += is_there is True
        self.report.not_there += is_there is False
