"""An open gait: its document, its history, its verdict and its approval."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from functools import lru_cache

from app.documents.gait_json import gait_content
from app.documents.stored_gait import StoredGait, stored_gait
from app.gaits.kept_approval import approval_of, in_todays_form, what_changed
from app.plans.plan import Plan
from app.store.tables.contents import APPROVAL
from app.store.tables.shapes import Fields, Stored
from app.store.tables.table import reading
from app.undo.history import History, LogEntry, fresh_history
from core.errors import DamagedRowError, FootfallError, InputError
from core.findings import Approval, Verdict
from core.gait.gait import Gait

VerdictOf = Callable[[Plan, Gait], Verdict]
"""Checks a plan of a document as everything stands now, the physics included."""
NO_PLAN = "There is no plan any more"


@dataclass(frozen=True)
class OpenGait:
    """One gait while it is open; every change makes a new value and a new revision.

    Args:
        id: of the gait.
        builtin: whether a gait of this id comes with the program.
        history: every document that it was.
        gait: the present document.
        revision: grows with every change of the document, undo included.
        saved: the document as saved or built in; None for one that was never saved.
        saved_at: when it was saved, s since the epoch; None where it was not.
        notice: what the last edit had to set aside.
        verdict: of the present revision, or None.
        approval: of the present revision, or None.
        kept_approval: of before the program's start, JSON text; looked at again once the plan is made.
        revoked: why the last approval is gone, in a sentence; None where it stands or there was none.
    """

    id: str
    builtin: bool
    history: History
    gait: Gait
    revision: int
    saved: Gait | None
    saved_at: float | None
    notice: str | None = None
    verdict: Verdict | None = None
    approval: Approval | None = None
    kept_approval: str | None = None
    revoked: str | None = None

    @property
    def before(self) -> Gait | None:
        """The document before the present one; None where it was never changed, or cannot be read."""
        entry = self.history.before
        with suppress(InputError):
            return None if entry is None else gait_of(entry)
        return None

    @property
    def approval_text(self) -> str | None:
        """The approval as it is kept, JSON text; None where there is none."""
        return self.kept_approval if self.approval is None else json.dumps(asdict(self.approval))

    @property
    def edited(self) -> bool:
        """Whether the document differs from what is saved."""
        return self.gait != self.saved

    def undo_label(self, others: frozenset[str] = frozenset()) -> str | None:
        """Label of the edit that undo would revert for one page while `others` are connected."""
        return self.history.label_of(self.history.undoable(others))

    def redo_label(self, others: frozenset[str] = frozenset()) -> str | None:
        """What redo would do again, for a page beside which others are connected."""
        return self.history.label_of(self.history.redoable(others))

    def changed(self, history: History, gait: Gait, notice: str | None = None) -> OpenGait:
        """The gait with another document; what was found of the old one is gone."""
        left = self.unapproved(f"The gait changed (“{history.present.label}”)")
        return replace(left, history=history, gait=gait, revision=self.revision + 1, notice=notice)

    def unapproved(self, why: str) -> OpenGait:
        """The gait without verdict and approval.

        Args:
            why: what happened, as the beginning of a sentence.
        """
        had_one = self.approval is not None or self.kept_approval is not None
        revoked = f"{why}, so it is no longer approved." if had_one else self.revoked
        return replace(self, verdict=None, approval=None, kept_approval=None, revoked=revoked)

    def lapsed(self, approval: Approval, why: str) -> OpenGait:
        """The gait without an approval that nobody took away.

        Args:
            approval: which one.
            why: what is different, as the beginning of a sentence.
        """
        day = datetime.fromisoformat(approval.when).astimezone().date()
        revoked = f"{why}, so the approval by {approval.by} of {day} is no longer valid."
        return replace(self.unapproved(why), revoked=revoked)

    def with_plan(self, plan: Plan, verdict_of: VerdictOf) -> OpenGait:
        """Restores a kept approval once the plan is known, if it is for exactly this plan's verdict.

        Args:
            plan: what it amounts to.
            verdict_of: checks it as everything stands now.
        """
        if self.kept_approval is None:
            return self
        try:
            kept = _read_approval(self.kept_approval)
        except DamagedRowError as error:
            return self.unapproved(error.sentence)
        try:
            verdict = verdict_of(plan, self.gait)
        except FootfallError:
            return self.lapsed(kept, NO_PLAN)
        approval = in_todays_form(kept, verdict)
        why = what_changed(approval, verdict)
        if why is not None:
            return self.lapsed(kept, why)
        return replace(self, verdict=verdict, approval=approval, kept_approval=None)

    def confirmed(self, plan: Plan, verdict_of: VerdictOf) -> OpenGait:
        """The gait, without its approval where that is not of this moment's verdict (see `with_plan`)."""
        if self.approval is None:
            return self
        try:
            why = what_changed(self.approval, verdict_of(plan, self.gait))
        except FootfallError:
            why = NO_PLAN
        return self if why is None else self.lapsed(self.approval, why)


def _read_approval(text: str) -> Approval:
    with reading("The kept approval cannot be read: "):
        approval = approval_of(Stored(Fields(APPROVAL))(text, "approval"))
        datetime.fromisoformat(approval.when)
        return approval


def fresh_gait(
    gait_id: str, gait: Gait, builtin: bool, saved_at: float | None, notice: str | None = None
) -> OpenGait:
    """A gait that was just opened."""
    return OpenGait(gait_id, builtin, fresh_history(gait_text(gait)), gait, 1, gait, saved_at, notice)


def gait_text(gait: Gait) -> str:
    """The document as one line of JSON."""
    return json.dumps(gait_content(gait))


def gait_of(entry: LogEntry) -> Gait:
    """The document of an entry of the log.

    Raises:
        InputError: it cannot be read.
    """
    return stored_entry(entry).gait


def stored_entry(entry: LogEntry) -> StoredGait:
    """The document of an entry of the log, and what of it is different now (see `gait_of`)."""
    return _parsed(entry.document)


@lru_cache(maxsize=64)
def _parsed(document: str) -> StoredGait:
    return stored_gait(document)
