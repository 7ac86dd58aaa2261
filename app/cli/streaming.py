"""A waypoint file on its way to the robot: kept as a run, with its progress told, and stopped by Ctrl-C."""

import secrets
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from app.bridge.bridge import RobotBridge
from app.bridge.delivery import HELD_STOP
from app.bridge.messages import away_sentence
from app.bridge.states import IN_RUN, LinkState, RobotSnapshot, RobotState, RunPhase, RunPlan, RunProgress
from app.bridge.stop_confirmation import STOP_LIMIT
from app.bridge.telemetry import SILENCE_LIMIT
from app.cli.common.keyboard import forget_typed, has_keyboard, has_typed_line
from app.cli.common.output import note
from app.cli.common.progress import end_line, is_watched, rewrite_line
from app.common.clock import boot_seconds
from app.common.signals import Interrupted, ignore_endings
from app.emulator.emulated_robot import start_emulator
from app.robot.recorded_bridge import RecordedBridge, RecordedRun
from app.robot.views import EMULATOR, RunOrigin
from app.runs.plan_json import file_plan_content
from app.store.database import Database
from app.store.gait_files import require_folder
from core.errors import RobotError, StateError
from core.robot.model import RobotModel
from core.running_time import Deadline, RunningClock
from core.wire.robot_time import move_estimates

READY_SECONDS = 20.0
"""The board needs about 8 s; later than this nothing will come."""
CLEAR_SECONDS = 10.0
"""A stop is confirmed or overdue by then."""
STOP_SECONDS = STOP_LIMIT + 0.5
"""By then a stop is confirmed, or said not to be."""
TOLD_SECONDS = 1.0
"""A run's progress is told at least this often, where it can be told on one line, s."""
STOP_HELD = (
    "The robot holds a stop from before this run, so nothing moved. The stop is still active. Find out who "
    "stopped the robot, and why. To lift the stop and send the file, add --clear-stop."
)
_NOBODY_THERE = "The run had paused with all feet down, but nobody at a keyboard could resume it."
_ENDS = frozenset({RobotState.DONE, RobotState.STOPPED, RobotState.FAULT})


@dataclass(frozen=True)
class Streamed:
    """How a run ended, and whether a person broke it off."""

    snapshot: RobotSnapshot
    is_interrupted: bool


class Tells(Protocol):
    """Tells how far a run is."""

    def tell(self, snapshot: RobotSnapshot) -> None:
        """Tells what is new."""

    def end(self) -> None:
        """Ends the telling."""


def stream(
    plan: RunPlan,
    run: RecordedRun,
    device: str,
    data: Path,
    *,
    clears_stop: bool = False,
    progress: Tells | None = None,
) -> Streamed:
    """Connects the robot, sends the waypoints as a run that is kept, and waits for its end.

    Args:
        plan: the waypoints, approved.
        run: what is kept of it.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
        data: the data folder.
        clears_stop: whether to lift a stop that the robot holds from before.
        progress: is told how far it is; None for lines on standard error.

    Raises:
        InputError: the data folder cannot be used.
        RobotError: there is no such device, or no robot answers.
        StateError: the robot cannot be armed or cleared, or the run's record cannot be begun.
    """
    require_folder(data)
    with closing(Database(data / "studio.sqlite3")) as database, _robot(device) as line:
        kept = RecordedBridge(database, lambda: note(kept.trouble or "The record of the run has caught up."))
        with closing(kept):
            sending = Sending(kept, plan, run, progress or Progress(plan), clears_stop=clears_stop)
            try:
                return Streamed(sending.run(line), is_interrupted=False)
            except (KeyboardInterrupt, Interrupted):
                ignore_endings()
                return Streamed(sending.stop(), is_interrupted=True)


def run_of_file(model: RobotModel, plan: RunPlan, file: Path) -> RecordedRun:
    """What is kept of a run of a waypoint file."""
    times = np.cumsum(plan.waypoints.durations) - plan.waypoints.durations[0]
    origin = RunOrigin("", f"file:{file.name}", file.name, plan.waypoints, times)
    return RecordedRun(origin, file_plan_content(model, plan))


@contextmanager
def _robot(device: str) -> Iterator[str]:
    if device != EMULATOR:
        yield device
        return
    with closing(start_emulator()) as emulator:
        yield emulator.device


class Sending:
    """One file's way to the robot.

    Args:
        kept: the bridge and the record.
        plan: what is sent.
        run: what is kept of it, but for its id.
        progress: is told how far it is.
        clears_stop: whether to lift a stop that the robot holds from before.
    """

    def __init__(
        self,
        kept: RecordedBridge,
        plan: RunPlan,
        run: RecordedRun,
        progress: Tells,
        *,
        clears_stop: bool = False,
    ) -> None:
        self._kept = kept
        self._plan = plan
        self._run = run
        self._clears_stop = clears_stop
        self._by = plan.approval.by
        self._progress = progress
        self._changed = threading.Event()
        self._running = RunningClock(boot_seconds)
        self._away = 0.0
        kept.bridge.subscribe(lambda snapshot: self._changed.set())

    @property
    def _bridge(self) -> RobotBridge:
        return self._kept.bridge

    def run(self, device: str) -> RobotSnapshot:
        """Connects and sends; once more where the robot held a stop from before that is to be lifted."""
        self._running.look()
        self._bridge.connect(device)
        note("The robot's line is open. Its board may restart; its motors may then move for about 8 s.")
        ended = self._send()
        if ended.robot is RobotState.FAULT and HELD_STOP in ended.sentence:
            if not self._clears_stop:
                return replace(ended, sentence=STOP_HELD)
            note("The robot held a stop from before. It is cleared, and the run begins again.")
            self._clear()
            ended = self._send()
        return ended

    def stop(self) -> RobotSnapshot:
        """Stops the robot, waits until it has confirmed that, and says what happened."""
        before, after = self._bridge.snapshot, self._stopped(self._by)
        what = "nothing was sent"
        if before.run is not None:
            what = f"{before.run.reached} of {before.run.count} waypoints were reached"
            what += "" if before.robot in IN_RUN else ", and the run had ended"
        return replace(after, sentence=f"Interrupted: {what}. {after.sentence}")

    def _stopped(self, by: str) -> RobotSnapshot:
        """Stops the robot and waits until it has confirmed that."""
        self._bridge.stop(by)
        note("Stop was sent; it takes effect after the move that is running.")
        deadline = Deadline(STOP_SECONDS, time.monotonic)
        while self._bridge.snapshot.robot is RobotState.STOPPING and not deadline.is_over:
            self._step()
        return self._bridge.snapshot

    def _send(self) -> RobotSnapshot:
        self._wait_ready()
        if self._away > SILENCE_LIMIT:
            away = away_sentence(self._away)
            raise RobotError(f"{away} Nothing was sent. Look at the robot, then send again.", "--robot")
        self._bridge.arm(self._by)
        origin = replace(self._run.origin, run_id=secrets.token_hex(6))
        self._kept.send(self._plan, replace(self._run, origin=origin), self._by)
        try:
            while True:
                snapshot = self._bridge.snapshot
                self._progress.tell(snapshot)
                if snapshot.robot in _ENDS or snapshot.link is LinkState.LOST:
                    return snapshot
                if snapshot.robot is RobotState.PAUSED and not self._goes_on(snapshot):
                    stopped = self._stopped("the program")
                    return replace(stopped, sentence=f"{stopped.sentence} {_NOBODY_THERE}")
                self._step()
        finally:
            self._progress.end()

    def _goes_on(self, paused: RobotSnapshot) -> bool:
        """Waits until a person at the keyboard resumes a paused run, or it ends; false where nobody can."""
        if not forget_typed():
            return False
        self._progress.end()
        note(f"{paused.sentence} Press Enter to resume, or Ctrl-C to stop.")
        while self._bridge.snapshot.robot is RobotState.PAUSED:
            if not has_keyboard():
                return False
            self._step()
            if has_typed_line():
                try:
                    self._bridge.resume(self._by)
                except StateError as refused:
                    note(refused.sentence)
        return True

    def _wait_ready(self) -> None:
        deadline = Deadline(READY_SECONDS, time.monotonic)
        while self._bridge.snapshot.robot is not RobotState.DISARMED:
            snapshot = self._bridge.snapshot
            if deadline.is_over or snapshot.link is LinkState.LOST:
                raise RobotError(
                    f"No robot answered within {READY_SECONDS:.0f} s: {snapshot.sentence}", "--robot"
                )
            self._step()

    def _clear(self) -> None:
        """Clears a stop as soon as the robot has confirmed it and stands still."""
        deadline = Deadline(CLEAR_SECONDS, time.monotonic)
        while True:
            try:
                return self._bridge.clear(self._by)
            except StateError:
                if deadline.is_over:
                    raise
            self._step()

    def _step(self) -> None:
        self._changed.wait(0.1)
        self._changed.clear()
        self._away = max(self._away, self._running.look())


class Progress:
    """Tells how far a run is, on standard error: on one line of a terminal, else a line each time.

    Args:
        plan: what is sent.
    """

    def __init__(self, plan: RunPlan) -> None:
        self._estimates = move_estimates(plan.waypoints)
        self._is_terminal = is_watched()
        self._told: tuple[RobotState, RunPhase, int] | None = None
        self._told_at = 0.0

    def tell(self, snapshot: RobotSnapshot) -> None:
        """Tells what is new; on a terminal also the time that is left, as it passes."""
        run = snapshot.run
        if run is None:
            return
        now, news = time.monotonic(), (snapshot.robot, run.phase, run.reached)
        is_due = self._is_terminal and now > self._told_at + TOLD_SECONDS
        if news == self._told and not is_due:
            return
        self._told, self._told_at = news, now
        text = f"{snapshot.robot}: {self._place(run)}"
        if self._is_terminal:
            rewrite_line(text)
        else:
            note(text)

    def end(self) -> None:
        """Ends the line."""
        if self._is_terminal and self._told is not None:
            end_line()

    def _place(self, run: RunProgress) -> str:
        left = float(self._estimates[run.reached :].sum())
        if run.phase is RunPhase.START_POSE:
            return f"on the way to the start pose, then {run.count} waypoints in about {left:.0f} s"
        if run.reached == run.count:
            return f"waypoint {run.count} of {run.count} reached, {run.elapsed:.0f} s in all"
        return f"waypoint {run.reached} of {run.count} reached, about {left:.0f} s left"
