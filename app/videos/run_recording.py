"""Recording with the run: cameras begin and end with it, and what they saw becomes its trial.

The bridge only puts a word on a queue. One thread begins and ends recordings; another makes trials of them,
so that a run that follows at once is recorded from its beginning.
"""

import logging
import queue
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

from app.bridge.states import LinkState, RobotSnapshot
from app.cameras.process import CameraError, CameraProcess
from app.cameras.service import UNDER, CameraService
from app.cameras.setup_service import CameraSetupService
from app.common.json import Json
from app.robot.views import RUNNING
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.run_store import RunStore
from app.trials.run_trial import run_trial
from app.trials.service import TrialService
from app.trials.track_source import TrackRecord, TrackSource
from app.videos.service import VideoService
from app.vision.recorder import Recorded, RecordingJob
from app.vision.tracking import missing_remarks
from core.errors import FootfallError, StateError
from core.running_time import Deadline
from core.vision.setup import CameraSetup

_log = logging.getLogger(__name__)

FINISH_SECONDS = 20.0
"""Longest wait for a camera's track at the end of a run."""

KEPT_SECONDS = 10.0
"""Longest wait for the record of the run after its end."""

BROKEN = "An error of the studio broke the recording off."
"""Said of a recording that the studio failed to end."""

LOOK_SECONDS = 0.02
"""Between two looks for that."""


@dataclass(frozen=True)
class _Turn:
    """A run began or ended."""

    run: str
    began: bool


@dataclass(frozen=True, eq=False)
class _Recording:
    """A recording that is on, or was."""

    video: str
    link: CameraProcess
    camera: str
    setup: CameraSetup | None
    source: TrackSource


@dataclass(frozen=True, eq=False)
class _Ended:
    """What a camera recorded of a run."""

    run: str
    recording: _Recording
    recorded: Recorded


class RunRecordings:
    """The recordings of runs.

    Args:
        database: where runs are kept.
        cameras: which cameras there are.
        setups: how they see the platform.
        videos: where recordings are kept.
        runs: the records of runs.
        trials: where tracks go.
        told: told of each new trial's id.
    """

    def __init__(
        self,
        database: Database,
        cameras: CameraService,
        setups: CameraSetupService,
        videos: VideoService,
        runs: RunService,
        trials: TrialService,
        told: Callable[[str], None],
    ) -> None:
        self._store = RunStore(database)
        self._cameras, self._setups, self._videos = cameras, setups, videos
        self._runs, self._trials, self._told = runs, trials, told
        self._turns: queue.SimpleQueue[_Turn | None] = queue.SimpleQueue()
        self._run = ""
        self._is_on = False
        self._recordings: list[_Recording] = []
        self._ended: queue.SimpleQueue[_Ended | None] = queue.SimpleQueue()
        self._threads = [
            threading.Thread(target=self._work, name="run recordings", daemon=True),
            threading.Thread(target=self._file, name="trials of recordings", daemon=True),
        ]
        for thread in self._threads:
            thread.start()

    def follow(self, snapshot: RobotSnapshot) -> None:
        """Hears from the bridge; only puts a word on a queue."""
        run = snapshot.run
        if run is None:
            return
        is_on = snapshot.robot in RUNNING and snapshot.link is not LinkState.LOST
        if run.run_id != self._run and is_on:
            self._end()
            self._run, self._is_on = run.run_id, True
            self._turns.put(_Turn(run.run_id, True))
        elif run.run_id == self._run and not is_on:
            self._end()

    def _end(self) -> None:
        if self._is_on:
            self._is_on = False
            self._turns.put(_Turn(self._run, False))

    def close(self) -> None:
        """Ends the recordings that are on, and keeps them."""
        self._end()
        self._turns.put(None)
        for thread in self._threads:
            thread.join()

    def _work(self) -> None:
        while (turn := self._turns.get()) is not None:
            try:
                if turn.began:
                    self._begin(turn.run)
                else:
                    self._finish(turn.run)
            except Exception:
                _log.exception("A recording of the run %s failed.", turn.run)
        self._ended.put(None)

    def _file(self) -> None:
        while (ended := self._ended.get()) is not None:
            with self._kept_whatever_comes(ended.run, ended.recording):
                trial, remarks = self._trial(ended.run, ended.recording, ended.recorded)
                self._keep(ended.recording, ended.recorded, trial, remarks)
                self._cameras.tell()

    def _begin(self, run: str) -> None:
        row = self._store.get(run)
        if row is None:
            return
        for view in self._cameras.recording():
            name = f"{row.content['gait_name']}, {view['name']}"
            video = self._videos.begin_recording(name, run, view["id"])["id"]
            try:
                self._recordings.append(self._record(video, view, row.content))
            except FootfallError as error:
                self._videos.change(video, state="removed", sentence=error.sentence)
            except Exception:
                _log.exception("A recording of the run %s could not begin.", run)
                self._break_off(video)
        self._cameras.tell()

    def _record(self, video: str, view: Json, run: Json) -> _Recording:
        self._videos.make_room()
        self._videos.files.require_room(0)
        link = self._cameras.link(view["id"])
        setup, source = None, TrackSource("", view["id"], "", "", 0)
        if view["use"] == UNDER:
            setup, revision = self._setups.complete(view["setup"])
            source = TrackSource("", view["id"], view["setup"], setup.name, revision)
        tracking = None if setup is None else setup.tracking()
        folder = self._videos.files.path(video)
        link.record(RecordingJob(folder, run["started_monotonic"], tracking, view["name"]))
        return _Recording(video, link, view["id"], setup, source)

    def _finish(self, run: str) -> None:
        recordings, self._recordings = self._recordings, []
        for one in recordings:
            with self._kept_whatever_comes(run, one):
                self._finish_one(run, one)
        self._cameras.tell()

    @contextmanager
    def _kept_whatever_comes(self, run: str, one: _Recording) -> Iterator[None]:
        try:
            yield
        except Exception:
            _log.exception("The recording %s of the run %s failed.", one.video, run)
            self._break_off(one.video)

    def _break_off(self, video: str) -> None:
        """Keeps what there is of a recording that is not ended as it should be."""
        try:
            if self._videos.view(video)["state"] == "recording":
                self._videos.salvage(video, BROKEN)
        except Exception:
            _log.exception("What became of the recording %s could not be kept.", video)

    def _finish_one(self, run: str, one: _Recording) -> None:
        try:
            recorded = one.link.finish(FINISH_SECONDS)
        except CameraError as error:
            self._videos.salvage(one.video, error.sentence)
            return
        self._ended.put(_Ended(run, one, recorded))

    def _keep(self, one: _Recording, recorded: Recorded, trial: str, remarks: tuple[str, ...]) -> None:
        self._videos.change(
            one.video,
            state="kept" if recorded.count else "removed",
            sentence=" ".join(remarks),
            trial=trial,
            frames=recorded.count,
            bytes=recorded.size,
            rate=recorded.rate,
            seconds=recorded.seconds,
            size=list(recorded.shape or (0, 0)),
        )
        if trial:
            self._told(trial)

    def _trial(self, run: str, one: _Recording, recorded: Recorded) -> tuple[str, tuple[str, ...]]:
        """The trial's id, "" where there is none, and what is to be said."""
        remarks = recorded.remarks
        if one.setup is None:
            return "", remarks
        if recorded.found is None:
            return "", (*remarks, f"There is no trial: {recorded.refusal}")
        try:
            self._await_record(run)
            made = run_trial(self._runs.record(run), recorded.found)
            source = replace(one.source, video=one.video)
            track_record = TrackRecord(
                made.found, source, (*remarks, *missing_remarks(made.found), *made.remarks), made.ends
            )
            trial = self._trials.add(made.found.track, made.words, made.planned, track_record)
        except FootfallError as error:
            return "", (*remarks, f"There is no trial: {error.sentence}")
        return trial["id"], remarks

    def _await_record(self, run: str) -> None:
        """Waits until the run's record is whole.

        Raises:
            StateError: it does not become so.
        """
        deadline = Deadline(KEPT_SECONDS, time.monotonic)
        while (row := self._store.get(run)) is None or row.content["ended"] is None:
            if deadline.is_over:
                raise StateError("The record of the run is not whole yet. Track the recording later.", "run")
            time.sleep(LOOK_SECONDS)
