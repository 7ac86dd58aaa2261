"""Everything that happens to gaits: opening, editing, saving, planning, checking and approving.

Only the session's thread calls this.
"""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from datetime import UTC, datetime
from typing import Any

from app.documents import gait_content, motion_hash, parse_gait
from app.open_gait import HistoryEntry, OpenGait, fresh_gait
from app.plans import Plan, make_plan, verdict_of
from app.settling import drawn_timeline, require_locks, settle_iterations, settle_table
from app.store.database import Database, HistoryRow, OpenGaitRow
from app.store.files import GaitFiles, slug
from core.errors import FootfallError, InputError, StateError
from core.findings import Approval, approve
from core.gait import Gait
from core.library import library


class UnknownGaitError(InputError):
    """There is no gait of that id."""


class GaitDesk:
    """The open gaits.

    Args:
        files: the saved gaits.
        database: histories, results and approvals.
    """

    def __init__(self, files: GaitFiles, database: Database) -> None:
        self._files = files
        self._database = database
        self._open: dict[str, OpenGait] = {}
        self._plans: dict[str, tuple[int, Plan]] = {}

    def ids(self) -> tuple[str, ...]:
        """Built-in gaits first, then saved ones."""
        saved = [gait_id for gait_id in self._files.ids() if gait_id not in library()]
        unsaved = [gait_id for gait_id in self._open if gait_id not in library() and gait_id not in saved]
        return (*library(), *saved, *unsaved)

    def open_gaits(self) -> tuple[OpenGait, ...]:
        """Every gait that can be opened; one whose file is damaged is left out of the list."""
        found = []
        for gait_id in self.ids():
            try:
                found.append(self.open_gait(gait_id))
            except FootfallError:
                continue
        return tuple(found)

    def open_gait(self, gait_id: str) -> OpenGait:
        """The gait's present state.

        Raises:
            UnknownGaitError: there is none of that id.
        """
        if gait_id not in self._open:
            self._open[gait_id] = self._load(gait_id)
        return self._open[gait_id]

    def _load(self, gait_id: str) -> OpenGait:
        if not self._files.is_id(gait_id):
            raise UnknownGaitError(f"There is no gait “{gait_id}”.", gait_id)
        builtin = library().get(gait_id)
        saved_at = self._files.saved_at(gait_id)
        if saved_at is None and builtin is None:
            raise UnknownGaitError(f"There is no gait “{gait_id}”.", gait_id)
        saved = builtin.gait if saved_at is None and builtin is not None else self._files.read(gait_id)
        stored = self._database.open_gait(gait_id)
        if stored is None:
            return fresh_gait(gait_id, saved, builtin is not None, saved_at)
        row, history = stored
        entries = tuple(HistoryEntry(h.label, parse_gait(h.document)) for h in history)
        opened = OpenGait(
            gait_id, builtin is not None, entries, row.cursor, row.revision, saved, saved_at, row.notice
        )
        return self._with_approval(opened, row.approval)

    def _with_approval(self, open_gait: OpenGait, text: str | None) -> OpenGait:
        """Brings an approval back where it still is of exactly this verdict and these waypoints."""
        if text is None:
            return open_gait
        approval = Approval(**json.loads(text))
        try:
            verdict = verdict_of(self._plan_of(open_gait), open_gait.gait)
        except FootfallError:
            return open_gait
        if verdict.content_hash != approval.verdict_hash:
            return open_gait
        return replace(open_gait, verdict=verdict, approval=approval)

    def plan(self, gait_id: str) -> Plan:
        """What the gait amounts to now; computed once a revision."""
        return self._plan_of(self.open_gait(gait_id))

    def _plan_of(self, open_gait: OpenGait) -> Plan:
        cached = self._plans.get(open_gait.id)
        if cached is not None and cached[0] == open_gait.revision:
            return cached[1]
        result = self._database.result(motion_hash(open_gait.gait))
        plan = make_plan(open_gait.gait, result)
        self._plans[open_gait.id] = (open_gait.revision, plan)
        return plan

    def edit(self, gait_id: str, gait: Gait, label: str, revision: int | None) -> OpenGait:
        """Puts a changed document on the desk.

        Raises:
            StateError: somebody else changed it since the given revision.
        """
        open_gait = self.open_gait(gait_id)
        if revision is not None and revision != open_gait.revision:
            raise StateError(
                f"“{open_gait.gait.name}” was changed elsewhere; look at its new state and edit again.",
                "revision",
            )
        require_locks(open_gait.gait, gait)
        settled, notice = settle_table(open_gait.gait, settle_iterations(open_gait.gait, gait))
        if settled == open_gait.gait:
            return open_gait
        return self._put(open_gait.edit(settled, label or "Edit", notice), open_gait)

    def redraw(self, gait_id: str, order: tuple[int, ...], phase_knots: int, closing_knots: int) -> OpenGait:
        """Draws the timeline anew from a foot order and phase lengths."""
        open_gait = self.open_gait(gait_id)
        options = replace(open_gait.gait.options, phase_knots=phase_knots, closing_knots=closing_knots)
        changed = replace(open_gait.gait, order=order, options=options)
        changed = replace(changed, timeline=drawn_timeline(changed))
        return self.edit(gait_id, changed, f"Draw order {'-'.join(map(str, order))}", None)

    def undo(self, gait_id: str) -> OpenGait:
        """One step back."""
        open_gait = self.open_gait(gait_id)
        return self._put(open_gait.undo(), open_gait)

    def redo(self, gait_id: str) -> OpenGait:
        """One step forward again."""
        open_gait = self.open_gait(gait_id)
        return self._put(open_gait.redo(), open_gait)

    def save(self, gait_id: str) -> OpenGait:
        """Writes the present document to the data folder."""
        open_gait = self.open_gait(gait_id)
        self._files.write(gait_id, open_gait.gait)
        saved = replace(open_gait, saved=open_gait.gait, saved_at=self._files.saved_at(gait_id))
        self._open[gait_id] = saved
        return saved

    def create(self, gait: Gait) -> OpenGait:
        """Adds a gait under a new id made from its name, and saves it."""
        base, taken, number = slug(gait.name), set(self.ids()), 1
        gait_id = base
        while gait_id in taken:
            number += 1
            gait_id = f"{base}-{number}"
        self._database.drop_open_gait(gait_id)
        self._files.write(gait_id, gait)
        self._open[gait_id] = fresh_gait(gait_id, gait, False, self._files.saved_at(gait_id))
        return self._open[gait_id]

    def delete(self, gait_id: str) -> None:
        """Takes a saved gait away; `restore` brings it back.

        Raises:
            StateError: the gait comes with the program and was not saved over.
        """
        open_gait = self.open_gait(gait_id)
        if open_gait.saved_at is None:
            raise StateError(
                f"“{open_gait.gait.name}” comes with the program and cannot be deleted; "
                "undo takes edits back.",
                gait_id,
            )
        self._files.remove(gait_id)
        self._forget(gait_id)

    def restore(self, gait_id: str) -> OpenGait:
        """Brings a deleted gait back as it was saved."""
        self._files.restore(gait_id)
        self._forget(gait_id)
        return self.open_gait(gait_id)

    def _forget(self, gait_id: str) -> None:
        self._open.pop(gait_id, None)
        self._plans.pop(gait_id, None)
        self._database.drop_open_gait(gait_id)

    def check(self, gait_id: str) -> OpenGait:
        """Checks the present plan by every rule; an approval of another verdict is gone."""
        open_gait = self.open_gait(gait_id)
        verdict = verdict_of(self._plan_of(open_gait), open_gait.gait)
        approval = open_gait.approval
        if approval is not None and approval.verdict_hash != verdict.content_hash:
            approval = None
        self._open[gait_id] = replace(open_gait, verdict=verdict, approval=approval)
        return self._open[gait_id]

    def approve(self, gait_id: str, by: str, verdict_hash: str | None = None) -> OpenGait:
        """Records a person's approval of the present verdict.

        Args:
            gait_id: which gait.
            by: the person's name.
            verdict_hash: of the verdict that they saw, where it is known.

        Raises:
            StateError: the gait was not checked since its last change, another verdict stands by now, or an
                error stands.
        """
        open_gait = self.open_gait(gait_id)
        if open_gait.verdict is None:
            raise StateError(
                "Check this gait first: it changed since the last check, or was never checked.", "check"
            )
        if verdict_hash is not None and verdict_hash != open_gait.verdict.content_hash:
            raise StateError("Another verdict stands by now; look at it and approve again.", "verdict_hash")
        approval = approve(open_gait.verdict, by, datetime.now(UTC))
        self._database.add_approval(gait_id, asdict(approval))
        return self._put(replace(open_gait, approval=approval), open_gait)

    def take_result(self, motion: str, content: dict[str, Any]) -> tuple[OpenGait, ...]:
        """Stores a checked result and gives back the open gaits whose plan it becomes."""
        self._database.put_result(motion, content)
        touched = []
        for gait_id, open_gait in self._open.items():
            if open_gait.gait.segment_table is None and motion_hash(open_gait.gait) == motion:
                self._plans.pop(gait_id, None)
                self._open[gait_id] = replace(open_gait, verdict=None, approval=None)
                touched.append(self._open[gait_id])
        return tuple(touched)

    def _put(self, open_gait: OpenGait, before: OpenGait) -> OpenGait:
        """Keeps a changed open_gait in memory and in the database."""
        shared = 0
        for old, new in zip(before.history, open_gait.history, strict=False):
            if old is not new:
                break
            shared += 1
        tail = tuple(_row(entry) for entry in open_gait.history[shared:])
        approval = None if open_gait.approval is None else json.dumps(asdict(open_gait.approval))
        row = OpenGaitRow(open_gait.revision, open_gait.cursor, open_gait.notice, approval)
        if not self._database.has_open_gait(open_gait.id):
            shared, tail = 0, tuple(_row(entry) for entry in open_gait.history)
        self._database.put_open_gait(open_gait.id, row, shared, tail)
        self._open[open_gait.id] = open_gait
        return open_gait


def _row(entry: HistoryEntry) -> HistoryRow:
    return HistoryRow(entry.label, json.dumps(gait_content(entry.gait)))


def refusal_text(error: FootfallError) -> dict[str, Any]:
    """An expected refusal as JSON content."""
    return {"error": error.sentence, "where": error.where}
