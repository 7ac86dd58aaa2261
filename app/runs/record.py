"""A run as it was kept, read once for everything that is made of it."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.bridge.states import Direction
from app.runs.plan_json import ran_plan
from app.store.tables.run_store import RunRow, RunStore
from app.store.tables.table import reading
from core.arrays import Floats
from core.errors import NotFoundError, StateError
from core.runs.analysis import move_begins, plan_times
from core.runs.pose import RanPlan, measured_motion
from core.runs.reading import RunBytes, RunSeries, read_run


@dataclass(frozen=True)
class StateChange:
    """A change of state: s since the run began, link, robot and cause."""

    time: float
    link: str
    robot: str
    cause: str


@dataclass(frozen=True, eq=False)
class RunRecord:
    """Everything of a run.

    Args:
        row: as it is listed.
        plan: what it was to do.
        pieces: its bytes, on the run's clock.
        states: its changes of state.
        series: what it measured.
    """

    row: RunRow
    plan: RanPlan
    pieces: tuple[RunBytes, ...]
    states: tuple[StateChange, ...]
    series: RunSeries

    @property
    def content(self) -> dict[str, Any]:
        """The run as it was kept."""
        return self.row.content

    @property
    def commanded_mm(self) -> Floats:
        """(n, 12) what was commanded last at each telemetry; nan before the first command."""
        targets = np.array([c.target_mm for c in self.series.commands]).reshape(-1, 12)
        aims = self.series.aims
        result = np.full(self.series.measured_mm.shape, np.nan)
        result[aims >= 0] = targets[aims[aims >= 0]]
        return result

    @property
    def states_told(self) -> list[str]:
        """The robot's state at each telemetry; empty before the first change."""
        times = [state.time for state in self.states]
        at = np.searchsorted(times, self.series.times, side="right") - 1
        return [self.states[index].robot if index >= 0 else "" for index in at]

    @property
    def plan_times(self) -> Floats:
        """(n,) the plan's time at each telemetry, s; nan on the way to the start pose."""
        return plan_times(self.plan, self.series)

    @property
    def foot_heights(self) -> Floats:
        """(n, legs) height of each foot over the standing ones, m; nan on the way to the start pose."""
        legs, times = self.plan.model.leg_count, self.plan_times
        heights = np.full((len(times), legs), np.nan)
        known = np.flatnonzero(np.isfinite(times))
        strokes = self.series.measured_mm[known].reshape(-1, legs, 3) / 1000.0
        begins = move_begins(self.plan, self.series)[known]
        heights[known] = measured_motion(self.plan, strokes, times[known], begins).feet_world[..., 2]
        return heights


def read_record(log: RunStore, run: str) -> RunRecord:
    """Reads a run.

    Raises:
        NotFoundError: there is none of that id.
        StateError: it was kept without its plan, by an older program.
    """
    row = known_row(log, run)
    content = log.plan(run)
    if content is None:
        raise StateError(
            "This run was kept without its plan, by an older program or as its waypoints make no motion: its "
            "strokes cannot be laid over one.",
            run,
        )
    with reading(f"The run “{run}” cannot be read: "):
        plan, began = ran_plan(content), row.content["started_monotonic"]
        pieces = tuple(
            RunBytes(piece.time - began, piece.direction == Direction.TO_ROBOT, piece.data)
            for piece in log.bytes_of(run)
        )
        states = tuple(
            StateChange(state.time - began, state.link, state.robot, state.cause)
            for state in log.states_of(run)
        )
        series = read_run(pieces, plan.waypoints, row.content.get("from", 0))
    return RunRecord(row, plan, pieces, states, series)


def known_row(log: RunStore, run: str) -> RunRow:
    """A run as it is listed.

    Raises:
        NotFoundError: there is none of that id.
    """
    row = log.get(run)
    if row is None:
        raise _unknown(run)
    return row


def require_known(is_known: bool, run: str) -> None:
    """There is a run of that id.

    Raises:
        NotFoundError: there is none.
    """
    if not is_known:
        raise _unknown(run)


def _unknown(run: str) -> NotFoundError:
    return NotFoundError(f"There is no run “{run}”. It may be of another data folder.", run)
