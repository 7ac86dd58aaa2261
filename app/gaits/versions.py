"""Versions: the states of a document that are worth going back to.

Saving, approving and naming make one, and so does what could lose a state: restoring and deleting. While
somebody edits, one is made by itself of the document as it was before an edit.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum

from app.documents.gait_json import motion_hash
from app.gaits.open_gait import OpenGait, gait_text
from app.store.tables.edit_history_store import EditHistoryStore, VersionRow
from app.store.tables.table import Selection
from app.undo.history import Author
from core.errors import InputError, NotFoundError
from core.gait.gait import Gait

AUTOMATIC_SECONDS = 120.0
"""An edit comes, and the newest version is older than this: one is made."""

AUTOMATIC_EDITS = 25
"""So many changes after the newest version: one is made."""

MOST_NAME = 80
"""Characters of a version's name."""

LARGEST_NUMBER = 2**63 - 1
"""The database has no larger integer."""


UNREADABLE = ""
"""Stands in place of the motion's hash in a version whose document cannot be shown."""


class VersionKind(StrEnum):
    """Why a version was kept."""

    SAVED = "saved"
    NAMED = "named"
    APPROVED = "approved"
    AUTOMATIC = "automatic"
    BEFORE_RESTORE = "before restore"
    BEFORE_DELETE = "before delete"


def is_said_already(gait: Gait, other: Gait) -> bool:
    """Whether two documents are equal apart from the provenance of results."""
    return replace(gait, provenance=None) == replace(other, provenance=None)


class Versions:
    """The versions of every gait.

    Args:
        log: where they are kept.
        clock: gives the time, s since the epoch.
    """

    def __init__(self, log: EditHistoryStore, clock: Callable[[], float] = time.time) -> None:
        self._log = log
        self._clock = clock

    def all(self, gait_id: str) -> Selection[VersionRow]:
        """A gait's versions, the newest first."""
        return self._log.versions(gait_id)

    def newest_number(self, gait_id: str) -> int:
        """Number of the version that was made last; 0 where there is none."""
        return self._log.newest_number(gait_id)

    def get(self, gait_id: str, number: int) -> VersionRow:
        """One version.

        Raises:
            NotFoundError: there is none of that number.
        """
        version = self._log.version(gait_id, number) if 0 < number <= LARGEST_NUMBER else None
        if version is None:
            raise NotFoundError(f"“{gait_id}” has no version {number}; look at its list of versions.", "n")
        return version

    def due(self, open_gait: OpenGait) -> VersionRow | None:
        """The automatic version to be kept with the next edit: of the document before it; None for none."""
        newest = self._log.newest_version(open_gait.id)
        if newest is not None:
            edits = open_gait.history.last - newest.position
            age = self._clock() - newest.made  # negative where the clock was set back meanwhile
            recent = 0 <= age < AUTOMATIC_SECONDS and 0 <= edits < AUTOMATIC_EDITS
            if recent or newest.document == open_gait.history.present.document:
                return None
        return self._row(open_gait, VersionKind.AUTOMATIC, "", "")

    def keep(
        self, open_gait: OpenGait, kind: VersionKind, author: Author | None = None, name: str = ""
    ) -> VersionRow:
        """Keeps the present document as a version, unless the newest one says the same already.

        Args:
            open_gait: whose document.
            kind: why.
            author: who did what made it.
            name: a person's name for it.

        Raises:
            InputError: the name is too long.
        """
        row = self.made(open_gait, kind, author, name)
        if row is None:
            return self.get(open_gait.id, self.newest_number(open_gait.id))
        self._log.add_version(open_gait.id, row)
        return row

    def made(
        self, open_gait: OpenGait, kind: VersionKind, author: Author | None = None, name: str = ""
    ) -> VersionRow | None:
        """The version that `keep` would keep; None where the newest one says the same already.

        Raises:
            InputError: the name is too long.
        """
        if len(name) > MOST_NAME:
            raise InputError(f"The name has {len(name)} characters; at most {MOST_NAME} are kept.", "name")
        newest = self._log.newest_version(open_gait.id)
        protective = kind in (VersionKind.BEFORE_RESTORE, VersionKind.BEFORE_DELETE)
        if (
            newest is not None
            and newest.document == gait_text(open_gait.gait)
            and (protective or (newest.kind, newest.name) == (kind, name))
        ):
            return None
        return self._row(open_gait, kind, name, "" if author is None else author.name)

    def unreadable(self, gait_id: str, position: int, document: str, author: Author) -> VersionRow:
        """The version of a document that cannot be shown, before something else takes its place.

        Args:
            gait_id: of which gait.
            position: of the document in the gait's log.
            document: its text.
            author: who replaces it.
        """
        number = self.newest_number(gait_id) + 1
        kind = VersionKind.BEFORE_RESTORE.value
        return VersionRow(number, self._clock(), kind, "", author.name, position, UNREADABLE, document)

    def keep_unreadable(self, gait_id: str, position: int, document: str, author: Author) -> None:
        """Keeps a document that cannot be shown as a version (see `unreadable`)."""
        self._log.add_version(gait_id, self.unreadable(gait_id, position, document, author))

    def _row(self, open_gait: OpenGait, kind: VersionKind, name: str, by: str) -> VersionRow:
        return VersionRow(
            number=self.newest_number(open_gait.id) + 1,
            made=self._clock(),
            kind=kind.value,
            name=name.strip(),
            by=by,
            position=open_gait.history.last,
            motion=motion_hash(open_gait.gait),
            document=gait_text(open_gait.gait),
        )
