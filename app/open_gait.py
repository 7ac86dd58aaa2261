"""A gait on the desk: its document, its undo history, and what was found and approved of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from core.errors import StateError
from core.findings import Approval, Verdict
from core.gait import Gait

MOST_ENTRIES = 300
"""Undo steps that are kept."""


@dataclass(frozen=True)
class HistoryEntry:
    """The document after an edit, and what the edit was called."""

    label: str
    gait: Gait


@dataclass(frozen=True)
class OpenGait:
    """One gait while it is open; every change makes a new value and a new revision.

    Args:
        id: of the gait.
        builtin: whether a gait of this id comes with the program.
        history: entries, the oldest first.
        cursor: index of the present entry.
        revision: grows with every change of the document, undo included.
        saved: the document as saved or built in; None for one that was never saved.
        saved_at: when it was saved, s since the epoch; None where it was not.
        notice: what the last edit had to set aside.
        verdict: of the present revision, or None.
        approval: of the present revision, or None.
    """

    id: str
    builtin: bool
    history: tuple[HistoryEntry, ...]
    cursor: int
    revision: int
    saved: Gait | None
    saved_at: float | None
    notice: str | None = None
    verdict: Verdict | None = None
    approval: Approval | None = None

    @property
    def gait(self) -> Gait:
        """The present document."""
        return self.history[self.cursor].gait

    @property
    def edited(self) -> bool:
        """Whether the document differs from what is saved."""
        return self.gait != self.saved

    @property
    def undo_label(self) -> str | None:
        """What undo would take back."""
        return self.history[self.cursor].label if self.cursor > 0 else None

    @property
    def redo_label(self) -> str | None:
        """What redo would do again."""
        following = self.cursor + 1
        return self.history[following].label if following < len(self.history) else None

    def edit(self, gait: Gait, label: str, notice: str | None = None) -> OpenGait:
        """A new present document; what could be redone is gone."""
        history = (*self.history[: self.cursor + 1], HistoryEntry(label, gait))[-MOST_ENTRIES:]
        return self._moved(history, len(history) - 1, notice)

    def undo(self) -> OpenGait:
        """One step back.

        Raises:
            StateError: there is none.
        """
        if self.undo_label is None:
            raise StateError("There is nothing to undo.", "undo")
        return self._moved(self.history, self.cursor - 1, None)

    def redo(self) -> OpenGait:
        """One step forward again.

        Raises:
            StateError: there is none.
        """
        if self.redo_label is None:
            raise StateError("There is nothing to redo.", "redo")
        return self._moved(self.history, self.cursor + 1, None)

    def _moved(self, history: tuple[HistoryEntry, ...], cursor: int, notice: str | None) -> OpenGait:
        return replace(
            self,
            history=history,
            cursor=cursor,
            revision=self.revision + 1,
            notice=notice,
            verdict=None,
            approval=None,
        )


def fresh_gait(gait_id: str, gait: Gait, builtin: bool, saved_at: float | None) -> OpenGait:
    """A gait that was just opened."""
    return OpenGait(gait_id, builtin, (HistoryEntry("Open", gait),), 0, 1, gait, saved_at)
