"""Trials for the page and scripts: adding, figures beside the plan, ends of iterations, tables."""

import time
import uuid
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.common.json import Json
from app.store.database import Database
from app.store.tables.table import Selection, reading
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.store.tables.trial_store import TrialRow, TrialStore
from app.trials.figures import FIGURES, PACE, path_content, plan_content, track_content
from app.trials.planned import PlannedFeet
from app.trials.record import TrialRecord, kept_track, told_ends, trial_record
from app.trials.track_source import TrackRecord, astray_content, fit_content
from core.arrays import Floats
from core.errors import DamagedRowError, FootfallError, InputError, NotFoundError, StateError
from core.trials.alignment import align, placed_motion
from core.trials.iterations import find_iterations
from core.vision.track import FootTrack
from core.vision.track_csv import format_track_csv

MOST_PLACES = 600
"""Places of a foot's way in a plot."""


@dataclass(frozen=True)
class TrialDescription:
    """What a person says of a trial.

    Args:
        name: of the trial.
        by: who did it.
        expected_cm: wanted distance of the whole walk.
        iterations: how many the track shows.
        note: anything else.
        gait: the id of the gait that walked, or "".
        gait_name: its name then.
        run: the id of the robot's run, or "".
        is_example: whether it was made by simulation, to be looked at.
    """

    name: str
    by: str
    expected_cm: float
    iterations: int
    note: str = ""
    gait: str = ""
    gait_name: str = ""
    run: str = ""
    is_example: bool = False


class TrialService:
    """What there is to see of trials; every method may be called from any thread.

    Args:
        database: where trials are kept.
        changed: told the id, revision and whether it is deleted, of a trial that is new or another now.
    """

    def __init__(self, database: Database, changed: Callable[[Json], None] = lambda change: None) -> None:
        self._changed = changed
        self._store = TrialStore(database)
        self._beside = TrialReferenceStore(database)
        self._lines: dict[str, tuple[Json, Json]] = {}
        """Content and line of each listed trial; the line of one without figures has a `sentence`."""

    def add(
        self,
        track: FootTrack,
        words: TrialDescription,
        planned: PlannedFeet | None,
        track_record: TrackRecord | None = None,
    ) -> Json:
        """Keeps a new trial and tells its figures.

        Args:
            track: where the feet were.
            words: what a person says of it.
            planned: where the feet were to be; None where that is not known.
            track_record: how a camera saw the track; None where it came as a file without times.

        Raises:
            InputError: the track is too short for its iterations, or has no figures.
        """
        find_iterations(track, words.iterations)
        content = {
            "id": uuid.uuid4().hex[:12],
            "made": time.time(),
            **vars(words),
            "frame_rate": track.frame_rate,
            "ends": None,
            "plan": None if planned is None else _kept_plan(planned),
            "sight": None if track_record is None else track_record.content(),
        }
        row = TrialRow(content["id"], content, format_track_csv(track))
        summary = _summary(row)
        self._store.add(content, row.track)
        if planned is not None and planned.sent is not None:
            self._beside.put_sent(content["id"], dict(planned.sent))
        self._tell(row)
        return summary

    def lines(self) -> list[Json]:
        """All trials that have figures, the newest first, each with its mean figures."""
        return [line for line in self._all_lines().rows if "sentence" not in line]

    def unreadable(self) -> list[Json]:
        """Trials that cannot be read, or whose figures cannot be computed: id, name and a sentence why."""
        selection = self._all_lines()
        return [*(line for line in selection.rows if "sentence" in line), *selection.unreadable]

    def _all_lines(self) -> Selection[Json]:
        """The line of each listed trial, computed once for what is known of it."""
        lines: dict[str, tuple[Json, Json]] = {}

        def line_of(row: TrialRow) -> Json:
            content, line = self._lines.get(row.id, ({}, {}))
            lines[row.id] = (row.content, line if content == row.content else _line(row))
            return lines[row.id][1]

        selection = self._store.listed(line_of)
        self._lines = lines
        return selection

    def summary(self, trial: str) -> Json:
        """A trial's figures, each foot's and each iteration's, beside its plan's."""
        return _summary(self._known(trial))

    def paths(self, trial: str) -> Json:
        """The feet's ways, tracked and planned, for a plot; cm in the track's frame."""
        row = self._known(trial)
        with reading(f"The trial {trial} cannot be read: "):
            track, plan = kept_track(row), row.content.get("plan")
            content: Json = {"id": trial, "track": path_content(track, MOST_PLACES), "plan": None}
            if plan is not None:
                times, feet = _plan_arrays(plan)
                placed = placed_motion(times, feet, align(track, feet[0]))
                content["plan"] = path_content(placed, MOST_PLACES)
            return content

    def change(self, trial: str, revision: int, changes: Json) -> Json:
        """Changes name, note, wanted distance, iterations or their ends.

        Args:
            trial: its id.
            revision: that the changes are made from.
            changes: what is another now.

        Raises:
            NotFoundError: there is no such trial.
            StateError: it is deleted, or somebody changed it meanwhile.
            InputError: the ends are no frames in order, or the iterations too many.
        """
        row = self.require_listed(trial)
        if revision != revision_of(row.content):
            raise _moved_on(row, revision)
        content = {**row.content, **changes, "revision": revision + 1}
        if content["iterations"] != row.content["iterations"] and "ends" not in changes:
            content["ends"] = None
        changed = replace(row, content=content)
        shown = _summary(changed)
        if not self._store.change(content, revision):
            raise _moved_on(self.require_listed(trial), revision)
        self._tell(changed)
        return shown

    def delete(self, trial: str) -> None:
        """Takes a trial out of the list; `restore` brings it back."""
        if not self._store.put_deleted(trial, time.time()):
            raise _unknown(trial)
        with suppress(DamagedRowError):  # it can be deleted all the same, and its line goes
            self._tell(self._known(trial))

    def restore(self, trial: str) -> Json:
        """Brings a deleted trial back."""
        if not self._store.put_deleted(trial, None):
            raise _unknown(trial)
        row = self._known(trial)
        self._tell(row)
        return _summary(row)

    def record(self, trial: str) -> TrialRecord:
        """A trial as it was kept, for what is laid over it."""
        return trial_record(self._known(trial))

    def sent(self, trial: str) -> Json | None:
        """What the robot was sent in a trial (`app.runs.plan_json.sent_content`); None where not known."""
        return self._beside.sent(self._known(trial).content["id"])

    def track(self, trial: str) -> str:
        """The track as a file in centimetres; what was not seen is empty."""
        return self._known(trial).track

    def require_listed(self, trial: str) -> TrialRow:
        """A trial that may be changed.

        Raises:
            StateError: it is deleted.
        """
        row = self._known(trial)
        if row.is_deleted:
            raise StateError(f"The trial “{row.content['name']}” is deleted. Bring it back first.", "trial")
        return row

    def _tell(self, row: TrialRow) -> None:
        revision = revision_of(row.content)
        self._changed({"id": row.content["id"], "revision": revision, "deleted": row.is_deleted})

    def _known(self, trial: str) -> TrialRow:
        row = self._store.get(trial)
        if row is None:
            raise _unknown(trial)
        return row


def _unknown(trial: str) -> NotFoundError:
    return NotFoundError(f"There is no trial {trial}.", "trial")


def revision_of(content: Json) -> int:
    """How often a trial was changed, from 1; trials kept before revisions were counted have 1."""
    return int(content.get("revision", 1))


def is_example(content: Json) -> bool:
    """Whether a trial was made by simulation, to be looked at; earlier versions kept none such."""
    return bool(content.get("is_example", False))


def _moved_on(row: TrialRow, revision: int) -> StateError:
    return StateError(
        f"The trial was changed meanwhile: it has revision {revision_of(row.content)}, and you changed "
        f"{revision}. Load it again and repeat your change.",
        "revision",
    )


def _kept_plan(planned: PlannedFeet) -> Json:
    feet = np.round(planned.feet, 6)
    laps = {"laps": planned.laps, "lap_seconds": planned.lap_seconds}
    return {"times": planned.times.tolist(), "feet": feet.tolist(), **laps}


def _plan_arrays(plan: Json) -> tuple[Floats, Floats]:
    return np.array(plan["times"]), np.array(plan["feet"])


_WORDS = ("id", "made", "name", "by", "note", "gait", "gait_name", "run", "expected_cm", "iterations")


def _summary(row: TrialRow) -> Json:
    with reading(f"The trial “{row.content['name']}” cannot be read: "):
        return _summary_of(row)


def _summary_of(row: TrialRow) -> Json:
    content, track = row.content, kept_track(row)
    expected = content["expected_cm"] / 100.0
    found = find_iterations(track, content["iterations"])
    told, ends_from = told_ends(content)
    ends = found.ends if told is None else told
    if len(ends) != content["iterations"]:
        raise InputError(f"{content['iterations']} iterations need as many ends.", "ends")
    summary = {
        **{key: content[key] for key in _WORDS},
        "is_example": is_example(content),
        "revision": revision_of(content),
        "frame_rate": content["frame_rate"],
        "deleted": row.is_deleted,
        "ends_by_hand": content.get("ends") is not None,
        "ends_from": ends_from,
        **_record_content(content.get("sight")),
        **track_content(track, expected, found, ends),
        "plan": None,
    }
    if content.get("plan") is not None:
        times, feet = _plan_arrays(content["plan"])
        plan = plan_content(times, feet, align(track, feet[0]), expected)
        astray = astray_content(summary["figures"], plan["figures"])
        summary["plan"] = {**plan, **fit_content(plan["gaps_cm"]), **astray}
    return summary


def _record_content(track_record: Json | None) -> Json:
    if track_record is None:
        return {"source": None, "unseen": [], "false": [], "remarks": [], "first_seconds": 0.0}
    return {
        **{key: track_record[key] for key in ("source", "unseen", "false", "remarks")},
        "first_seconds": track_record["times"][0],
    }


def _line(row: TrialRow) -> Json:
    try:
        summary = _summary(row)
    except FootfallError as error:
        return {"id": row.content["id"], "name": row.content["name"], "sentence": error.sentence}
    mean = summary["figures"]
    plan = summary["plan"]
    walk = summary["expected_cm"] if plan is None else plan["figures"]["net_distance"]
    return {
        **{key: summary[key] for key in (*_WORDS, "is_example")},
        "step_cm": round(walk / summary["iterations"], 2),
        **{key: mean[key] for key in FIGURES},
        "part_distances": [part["net_distance"] for part in summary["parts"]],
        **{key: summary[key] for key in PACE},
        "slip_cm": float(np.max(summary["slip"])),
        "filled": summary["filled"],
    }


def compared(lines: Sequence[Json]) -> list[Json]:
    """Trials of one gait, step and count of iterations together: mean and spread of their figures, by name.

    The step is the plan's that is kept with a trial; without a plan it is what was wanted. Examples made by
    simulation are left out.

    Args:
        lines: of the list.
    """
    groups: dict[tuple[str, float, int], list[Json]] = {}
    for line in lines:
        if line["is_example"]:
            continue
        key = (line["gait_name"] or line["name"], line["step_cm"], line["iterations"])
        groups.setdefault(key, []).append(line)
    return [_group(*key, groups[key]) for key in sorted(groups)]


def _group(name: str, step: float, iterations: int, trials: Sequence[Json]) -> Json:
    def folded(key: str, fold: Callable[[list[float]], Any]) -> float:
        return float(fold([trial[key] for trial in trials]))

    keys = (*FIGURES, *PACE, "slip_cm")
    spread = {f"{key}_spread": folded(key, lambda v: np.std(v, ddof=1)) for key in keys if len(trials) > 1}
    return {
        "gait_name": name,
        "step_cm": step,
        "iterations": iterations,
        "trials": [trial["id"] for trial in trials],
        "expected_cm": folded("expected_cm", np.mean),
        **{key: folded(key, np.mean) for key in keys},
        **{f"{key}_spread": spread.get(f"{key}_spread") for key in keys},
        "distances": [trial["net_distance"] for trial in reversed(trials)],
    }
