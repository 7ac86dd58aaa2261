"""The way out of a gait that cannot be shown: its document, or its file, is of no use to this program.

Only the command queue's thread calls this.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

from app.documents.stored_gait import stored_gait
from app.gaits.open_gait import OpenGait, gait_of, gait_text
from app.gaits.repository import GaitRepository
from app.gaits.versions import Versions
from app.store.tables.edit_history_store import EditHistoryRow, EditHistoryStore
from app.undo.history import Author, History, LogEntry, fresh_history
from core.errors import FootfallError, InputError, StateError
from core.gait.gait import Gait
from core.library.library import library

LAST_LABEL, ORIGINAL_LABEL = "Go back to the last state that can be shown", "Restore the original gait"
"""What the two ways out are called, on the page and in the history."""


class WayOut(StrEnum):
    """What can be done about a gait that cannot be shown."""

    LAST = "last"
    """The newest document that can be shown becomes the present one."""
    ORIGINAL = "original"
    """The document that comes with the program becomes the present one."""


@dataclass(frozen=True)
class ShownState:
    """A document that can be shown.

    Args:
        gait: the document.
        position: its place in the gait's history; None where it is not from there.
    """

    gait: Gait
    position: int | None = None


class GaitRecovery:
    """Makes a document that can be shown the present one. Every document that cannot is kept.

    Args:
        gaits: files and present documents.
        edits: the edit histories.
        versions: of every gait.
    """

    def __init__(self, gaits: GaitRepository, edits: EditHistoryStore, versions: Versions) -> None:
        self._gaits = gaits
        self._edits = edits
        self._versions = versions

    def way_out(self, gait_id: str) -> WayOut | None:
        """What can be done about a gait that cannot be shown; None where it can only be deleted."""
        if gait_id in library():
            return WayOut.ORIGINAL
        return None if self._last_shown(gait_id) is None else WayOut.LAST

    def recover(self, gait_id: str, author: Author, others: frozenset[str]) -> OpenGait:
        """Takes a gait's way out.

        A document that cannot be shown becomes a version, and such a file goes to the folder `set-aside`.

        Args:
            gait_id: a gait that cannot be shown.
            author: who does so.
            others: the other pages that are connected.

        Raises:
            StateError: no state of it can be shown.
        """
        shown = self._last_shown(gait_id)
        if shown is None:
            raise StateError(f"No state of “{gait_id}” can be shown. Delete it; its file is kept.", gait_id)
        history, revision = self._history(gait_id), self._edits.revision(gait_id)
        if history is None and self._edits.is_edited(gait_id):  # all of it is lost
            history = fresh_history(gait_text(shown.gait))
        if history is not None:
            version = None
            if not _is_readable(history.present):
                document = history.present.document
                version = self._versions.unreadable(gait_id, history.last, document, author)
            recovered = self._recovered(gait_id, history, shown, author, others)
            self._edits.put(gait_id, EditHistoryRow(revision + 1, recovered, None, None), None, version)
        self._gaits.replace_unreadable(gait_id, shown.gait)
        return self._gaits.gait(gait_id)

    def _recovered(
        self, gait_id: str, history: History, shown: ShownState, author: Author, others: frozenset[str]
    ) -> History:
        """The history with the shown state as its present one."""
        if not _is_readable(history.present):
            history = history.gone_back(gait_text(shown.gait), LAST_LABEL, author, shown.position)
        if gait_id not in library():
            return history
        original = gait_text(library()[gait_id].gait)
        if history.present.document == original:
            return history
        return history.edited(original, ORIGINAL_LABEL, author, others)

    def _history(self, gait_id: str) -> History | None:
        """A gait's history, without its steps where these contradict it; None where it was never edited."""
        try:
            row = self._edits.editing(gait_id)
        except InputError:
            entries = self._edits.entries(gait_id)
            return History(entries, max(entries)) if entries else None
        return None if row is None else row.history

    def _last_shown(self, gait_id: str) -> ShownState | None:
        return next(self._shown_states(gait_id), None)

    def _shown_states(self, gait_id: str) -> Iterator[ShownState]:
        """Every document of a gait that can be shown: its history, what is saved, versions, as it came."""
        history = self._history(gait_id)
        entries = {} if history is None else history.entries
        for position in sorted(entries, reverse=True):
            with suppress(FootfallError):
                yield ShownState(gait_of(entries[position]), position)
        with suppress(FootfallError):
            yield ShownState(self._gaits.saved(gait_id))
        for version in self._versions.all(gait_id).rows:
            with suppress(FootfallError):
                yield ShownState(stored_gait(version.document).gait)
        if gait_id in library():
            yield ShownState(library()[gait_id].gait)


def _is_readable(entry: LogEntry) -> bool:
    try:
        gait_of(entry)
    except FootfallError:
        return False
    return True
