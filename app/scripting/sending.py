"""Runs for scripts: a plan goes to the robot, or to an emulated one, and its measured strokes come back."""

from __future__ import annotations

import secrets
import signal
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunPlan
from app.cli.common.output import end_on_signals
from app.cli.streaming import stream
from app.common.signals import ending_signals
from app.robot.recorded_bridge import RecordedRun
from app.robot.views import RunOrigin
from app.runs.plan_json import sent_content
from app.runs.record import read_record
from app.scripting.gaits import Gait
from app.scripting.html import Cell, table
from app.scripting.planning import plan
from app.scripting.plans import Plan
from app.scripting.progress import progress_bar
from app.scripting.verdicts import verdict_on
from app.store.database import DATABASE, Database
from app.store.gait_files import default_data_folder
from app.store.tables.run_store import RunStore
from core.arrays import Floats
from core.errors import CheckError, InputError, RobotError, StateError
from core.findings import Verdict, approve, override_all
from core.names import is_visible
from core.runs.pose import RanPlan
from core.wire.robot_time import move_estimates


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """What the robot did, by its own telemetry. `footfall.send` gives one.

    Args:
        id: under which the data folder keeps it, and the studio lists it.
        state: how it ended: `done`.
        times: (lines,) time of each line of telemetry, s from the beginning of the run.
        measured: (lines, legs, 3) measured strokes, m.
        commanded: (lines, legs, 3) strokes that were commanded last, m; nan before the first command.
        reached: number of waypoints that were reached.
        seconds: how long the run took, s.

    Raises:
        FootfallError: never.

    Example:
        >>> import footfall as ff
        >>> run = ff.send(ff.optimise("walk", step=0.005), to="emulator", by="Ada")  # doctest: +SKIP
        >>> run.measured.shape[1:]  # doctest: +SKIP
        (4, 3)
    """

    id: str
    state: str
    times: Floats
    measured: Floats
    commanded: Floats
    reached: int
    seconds: float

    @property
    def error(self) -> Floats:
        """(lines, legs, 3) how far each motor is from what was commanded last, m; nan where nothing was."""
        return self.measured - self.commanded

    def __repr__(self) -> str:
        return (
            f"Run {self.id}: {self.state}, {self.reached} waypoints in {self.seconds:.1f} s, "
            f"{len(self.times)} lines of telemetry"
        )

    def _repr_html_(self) -> str:
        rows: list[list[Cell]] = [
            ["state", self.state],
            ["waypoints reached", self.reached],
            ["seconds", self.seconds],
            ["lines of telemetry", len(self.times)],
        ]
        return table(["", ""], rows, f"Run {self.id}")


class _Bar:
    """Tells how far a run is by a bar."""

    def __init__(self, seconds: Floats, tell: Any) -> None:
        self._done, self._all, self._tell = np.cumsum(seconds), float(seconds.sum()) or 1.0, tell

    def tell(self, snapshot: RobotSnapshot) -> None:
        """Moves the bar to the waypoint that was reached last."""
        if snapshot.run is not None and snapshot.run.reached:
            self._tell(float(self._done[min(snapshot.run.reached, len(self._done)) - 1]) / self._all)

    def end(self) -> None:
        """The bar closes by itself."""


def send(
    source: Plan | Gait | str | Path | ArrayLike,
    *,
    to: str,
    by: str,
    data: str | Path | None = None,
    clear_stop: bool = False,
    override: str | None = None,
) -> Run:
    """Checks and approves a plan in a person's name, and streams it to the robot as a run that is kept.

    The robot moves: slowly to the start pose first, then along the waypoints. Interrupting the program
    (Ctrl-C, or the notebook's stop button) is Stop; it takes effect after the move that is running. Keep a
    hand near the switch of the motor power.

    Args:
        source: a plan, or anything that `footfall.plan` takes, such as an array (lines, legs, 3) of strokes
            in m.
        to: `emulator`, a serial device such as `/dev/ttyACM0`, or `socket://HOST:PORT`.
        by: the name of the person who approves it, warnings included.
        data: the data folder, where the run is kept; the usual one where None.
        clear_stop: whether to lift a stop that the robot holds from another program.
        override: the reason why the robot may move in spite of the errors that stand; None where none does.

    Returns:
        The run; strokes in m, times in s.

    Raises:
        InputError: no name was given, the plan cannot be read, or the override has no reason, is of a rule
            that may not be overridden, or finds no error.
        InfeasibleError, CheckError: the plan has no motion, or an error stands that is not overridden;
            nothing was sent.
        RobotError: no robot answers, or the run did not reach its end; it is kept all the same.
        StateError: it was not called in the main thread, or the robot cannot be armed.
        StorageError: the data folder takes no record of the run.

    Example:
        >>> import footfall as ff
        >>> run = ff.send(ff.optimise("walk", step=0.005), to="emulator", by="Ada")  # doctest: +SKIP
        >>> run.state  # doctest: +SKIP
        'done'
    """
    of = plan(source)
    if threading.current_thread() is not threading.main_thread():
        raise StateError("send works in the main thread alone, since interrupting it is Stop.", "send")
    if not isinstance(by, str) or not is_visible(by):
        raise InputError("by must be the name of the person who approves the run.", "by")
    if not of.robot.model.wired:
        raise InputError(f"{of.robot.title} has no cable here; only the DeltaWalker can be sent to.", "robot")
    verdict, way = verdict_on(of), of.need_way()
    if override is None:
        _require_fit(verdict)
    elif not isinstance(override, str):
        raise InputError("override must be the reason why the robot may move in spite of errors.", "override")
    request = None if override is None else override_all(verdict, override)
    approval = approve(verdict, by, datetime.now(UTC), accept_warnings=True, override=request)
    run_plan = RunPlan(way.waypoints, approval, way.hold_ok)
    folder = (default_data_folder() if data is None else Path(data)).expanduser()
    with progress_bar("Run") as tell, _handlers_kept():
        bar = _Bar(move_estimates(way.waypoints), tell)
        ended = stream(run_plan, _kept(of, run_plan), to, folder, clears_stop=clear_stop, progress=bar)
    if ended.is_interrupted:
        raise KeyboardInterrupt(ended.snapshot.sentence)
    run = ended.snapshot.run
    if run is None or ended.snapshot.robot is not RobotState.DONE or ended.snapshot.link is LinkState.LOST:
        raise RobotError(ended.snapshot.sentence, "to")
    return _read(folder, run.run_id)


def _require_fit(verdict: Verdict) -> None:
    errors = verdict.errors
    if errors:
        more = f" {len(errors) - 1} more errors stand." if len(errors) > 1 else ""
        raise CheckError(f"Not fit to send: {errors[0].sentence}{more} Nothing was sent.", errors[0].rule)


def _kept(of: Plan, run_plan: RunPlan) -> RecordedRun:
    """What is kept of a run: the motion that it was made from too."""
    way, motion, model = of.need_way(), of.need_motion(), of.robot.model
    content = sent_content(model, way.waypoints, way.times, motion)
    content |= {"approval": asdict(run_plan.approval), "merge": way.merge, "stop_bound": way.stop_bound}
    name = "Strokes of a script" if of.gait is None else of.gait.name
    gait_id = "" if of.gait is None else of.gait.id or ""
    ran = RanPlan(model, way.waypoints, way.times, motion)
    return RecordedRun(
        RunOrigin(secrets.token_hex(6), gait_id or f"script:{name}", name, way.waypoints, way.times, ran),
        content,
    )


def _read(folder: Path, run_id: str) -> Run:
    with closing(Database(folder / DATABASE)) as database:
        record = read_record(RunStore(database), run_id)
    shape = (-1, record.plan.model.leg_count, 3)
    return Run(
        run_id,
        record.content["state"],
        record.series.times,
        record.series.measured_mm.reshape(shape) / 1000.0,
        record.commanded_mm.reshape(shape) / 1000.0,
        int(record.content["reached"]),
        float(record.content["seconds"]),
    )


@contextmanager
def _handlers_kept() -> Iterator[None]:
    """Makes every signal that ends the program a Stop, and gives them back as they were."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, *ending_signals())}
    end_on_signals()
    try:
        yield
    finally:
        for number, handler in before.items():
            if handler is not None:  # None: it was not set by Python
                signal.signal(number, handler)
