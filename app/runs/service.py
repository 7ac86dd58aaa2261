"""Runs for the page and scripts: list, figures, series, notes, deleting, files."""

import time
from datetime import UTC, datetime

import numpy as np

from app.common.json import Json, finite
from app.runs.comparison import comparison_content
from app.runs.figures import FIGURES_VERSION, mm_content, rounded_content, run_figures
from app.runs.record import RunRecord, known_row, read_record, require_known
from app.runs.recovery import end_abandoned
from app.store.database import Database
from app.store.tables.run_store import RunFilter, RunRow, RunStore
from core.errors import FootfallError


class RunService:
    """What there is to see of runs; every method may be called from any thread.

    Args:
        database: where runs are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._store = RunStore(database)

    def found(self, wanted: RunFilter, offset: int, most: int) -> Json:
        """Some of the runs that a filter leaves, the newest first, and what can be filtered by."""
        end_abandoned(self._database)
        selection = self._store.listed(wanted, offset, most)
        return {
            "runs": [self._line(row) for row in selection.rows],
            "unreadable": selection.unreadable,
            "total": self._store.count(wanted),
            "offset": offset,
            **self._store.choices(),
        }

    def summary(self, run: str) -> Json:
        """A run with its plan's words, its states and its errors."""
        row = known_row(self._store, run)
        plan, began = self._store.plan(run) or {}, row.content["started_monotonic"]
        return {
            **self._line(row),
            "approval": plan.get("approval"),
            "merge": plan.get("merge"),
            "stop_bound": plan.get("stop_bound"),
            "states": [
                {"time": state.time - began, "link": state.link, "robot": state.robot, "cause": state.cause}
                for state in self._store.states_of(run)
            ],
        }

    def strokes(self, run: str, most: int) -> Json:
        """Measured and commanded strokes over time, thinned to about `most` samples, arrivals always kept."""
        record = self.record(run)
        kept = _thinned(record, most)
        return {
            "id": run,
            "waypoints_hash": record.content["waypoints_hash"],
            "count": len(record.series.times),
            "times": np.round(record.series.times[kept], 4).tolist(),
            "plan_times": rounded_content(record.plan_times[kept], 4),
            "laps": [_lap(record, index) for index in kept],
            "measured_mm": np.round(record.series.measured_mm[kept], 4).tolist(),
            "foot_heights_mm": mm_content(record.foot_heights[kept]),
            "commanded_mm": rounded_content(record.commanded_mm[kept], 4),
            "arrivals": [
                {"waypoint": c.index, "lap": c.lap, "sent": c.sent, "arrived": finite(c.arrived)}
                for c in record.series.streamed
            ],
        }

    def comparison(self, run: str, other: str) -> Json:
        """Two runs at the waypoints that both reached (see `comparison_content`)."""
        return comparison_content(self.record(run), self.record(other))

    def record(self, run: str) -> RunRecord:
        """A run as it was kept, for its files."""
        return read_record(self._store, run)

    def note(self, run: str, text: str) -> Json:
        """Keeps a person's note."""
        known_row(self._store, run)
        self._store.put_note(run, text)
        return self.summary(run)

    def delete(self, run: str) -> Json:
        """Takes a run out of every list; `restore` brings it back."""
        require_known(self._store.put_deleted(run, time.time()), run)
        return {"id": run, "deleted": True}

    def restore(self, run: str) -> Json:
        """Brings a deleted run back."""
        require_known(self._store.put_deleted(run, None), run)
        return self.summary(run)

    def _line(self, row: RunRow) -> Json:
        content = row.content
        keys = ("id", "gait", "gait_name", "waypoints_hash", "by", "state", "sentence")
        return {
            **{key: content[key] for key in keys},
            "started": _iso(content["started"]),
            "ended": None if content.get("ended") is None else _iso(content["ended"]),
            "seconds": content.get("seconds"),
            "reached": content.get("reached"),
            "count": content.get("count"),
            "left_out": content.get("left_out", 0),
            "override": content.get("override"),
            "note": row.note,
            "deleted": row.deleted is not None,
            "errors": self._errors(row),
        }

    def _errors(self, row: RunRow) -> Json | None:
        """Figures of a run; kept once it has ended. None where it was kept without its plan."""
        run, is_on = row.content["id"], row.content.get("ended") is None and row.content["state"] == "running"
        kept = None if is_on else self._store.figures(run)
        if kept is not None and kept["version"] == FIGURES_VERSION:
            return kept
        try:
            record = self.record(run)
            figures = run_figures(record.plan, record.series)
        except FootfallError:
            return None
        if not is_on:
            self._store.put_figures(run, figures)
        return figures


def _iso(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat()


def _lap(record: RunRecord, index: int) -> int:
    aim = int(record.series.aims[index])
    return record.series.commands[aim].lap if aim >= 0 else 0


def _thinned(record: RunRecord, most: int) -> list[int]:
    times = record.series.times
    every = max(1, -(-len(times) // most))
    arrived = [c.arrived for c in record.series.streamed if c.is_reached]
    return sorted({*range(0, len(times), every), *np.searchsorted(times, arrived).tolist()})
