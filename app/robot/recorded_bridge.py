"""The bridge with a record of every run, from before its first byte to its end."""

import threading
from collections.abc import Callable
from dataclasses import dataclass

from app.bridge.bridge import RobotBridge
from app.bridge.states import LinkState, RobotSnapshot, RunPlan
from app.common.clock import boot_seconds
from app.common.json import Json
from app.gaits.verdict_views import override_view
from app.robot.run_recorder import RunRecorder
from app.robot.views import RUNNING, RunOrigin, run_end
from app.runs.recovery import end_abandoned
from app.store.database import Database
from app.store.storage_errors import left_undone
from app.store.tables.run_store import RunStore
from core.errors import FootfallError, StateError


@dataclass(frozen=True)
class RecordedRun:
    """What is kept of a run from its beginning on.

    Args:
        origin: where it comes from.
        plan: what it is to do, as content; None where no motion can be made of it.
    """

    origin: RunOrigin
    plan: Json | None


class RecordedBridge:
    """A bridge whose runs are kept.

    Args:
        database: where they are kept.
        changed: called when there is something new to show of the record.

    Attributes:
        bridge: the robot; runs are sent by `send`.
        previous: the newest run that there was before; None where there was none.
        origin: where the last run that was sent came from.
    """

    def __init__(self, database: Database, changed: Callable[[], None] = lambda: None) -> None:
        end_abandoned(database)
        self.previous: Json | None = None
        with left_undone("The last run is not shown"):
            self.previous = RunStore(database).newest()
        self.origin: RunOrigin | None = None
        self._recorder = RunRecorder(database, changed)
        self._record: Json | None = None
        self._clock = database.clock
        self._span = self._clock.start()
        self._sending = threading.Lock()
        self._recording = threading.Lock()
        self.bridge = RobotBridge(self._recorder.log, clock=boot_seconds)
        self.bridge.subscribe(self._follow)

    @property
    def trouble(self) -> str | None:
        """Why the record is incomplete or late, or None if it is complete."""
        return self._recorder.trouble

    def close(self) -> None:
        """Stops a run, closes the line and writes what is left of the record."""
        self.bridge.close()
        self._recorder.close()

    def send(self, run_plan: RunPlan, kept: RecordedRun, by: str) -> None:
        """Sends a run whose record begins before the first byte goes out.

        Raises:
            StateError: a run is on, the robot is not armed, or the record cannot be begun.
            InputError: a stroke cannot be sent.
        """
        with self._sending:
            snapshot = self.bridge.snapshot
            self._end(snapshot)
            if self._record is not None and snapshot.robot in RUNNING:
                raise StateError("A run is on. Let it end, or stop it, then send again.", "send")
            self._begin(run_plan, kept, by)

    def _begin(self, run_plan: RunPlan, kept: RecordedRun, by: str) -> None:
        origin, run_range, before = kept.origin, run_plan.run_range, self.origin
        self._span = self._clock.start()
        record = {
            "id": origin.run_id,
            "gait": origin.gait,
            "gait_name": origin.gait_name,
            "waypoints_hash": origin.waypoints.content_hash,
            "by": by,
            "from": run_range.first,
            "iterations": run_range.iterations,
            "started": self._span.started,
            "started_monotonic": boot_seconds(),  # an older name; goes on while the machine is suspended
            "ended": None,
            "state": "running",
            "sentence": "",
        }
        if (override := override_view(run_plan.approval)) is not None:
            record["override"] = override
        changes = self.bridge.transitions
        self._recorder.begin(record, kept.plan, after=changes[-1].number if changes else 0)
        self._record, self.origin = record, origin
        try:
            self.bridge.send(run_plan, by, origin.run_id)
        except FootfallError as refusal:
            self._record, self.origin = None, before
            self._recorder.end(
                {**record, "ended": self._span.now, "state": "refused", "sentence": refusal.sentence}
            )
            raise

    def _follow(self, snapshot: RobotSnapshot) -> None:
        if self._record is not None:
            self._recorder.note(self.bridge.transitions)
        self._end(snapshot)

    def _end(self, snapshot: RobotSnapshot) -> None:
        """Completes the record of the run if it has ended."""
        run = snapshot.run
        if run is None or (snapshot.robot in RUNNING and snapshot.link is not LinkState.LOST):
            return
        with self._recording:
            record = self._record
            if record is None or run.run_id != record["id"]:
                return
            self._record = None
            self._recorder.note(self.bridge.transitions)
            reached = {"reached": run.reached, "count": run.count, "seconds": run.elapsed}
            state = {"state": run_end(snapshot, run), "sentence": snapshot.sentence}
            self._recorder.end({**record, **reached, **state, "ended": self._span.now})
