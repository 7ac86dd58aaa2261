"""A gait's file beside what the studio saved there last: anybody may have changed it since."""

from dataclasses import dataclass
from itertools import pairwise

from app.documents.stored_gait import stored_gait
from app.gaits.open_gait import gait_text
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import EditHistoryStore
from core.errors import FootfallError, InputError
from core.gait.gait import Gait

WAYS_OUT = "Use the file, or keep yours; neither is lost."
"""What a person can do about a file that was changed outside the studio."""


@dataclass(frozen=True)
class SavedFile:
    """A gait's file.

    Args:
        gait: what counts as saved: what the studio saved last, or the file's document where it saved nothing.
        theirs: the file's document; None where it cannot be read.
        outside: how the file differs from what the studio saved, in a sentence; None where it does not.
        notice: what of the file is different from how an earlier version kept it, in a sentence, or None.
    """

    gait: Gait
    theirs: Gait | None
    outside: str | None
    notice: str | None = None


class SavedFiles:
    """The files of all gaits, each looked at again only when it changed.

    Args:
        files: the files.
        edits: what was saved in them, in the database.
    """

    def __init__(self, files: GaitFiles, edits: EditHistoryStore) -> None:
        self._files = files
        self._edits = edits
        self._kept: dict[str, tuple[tuple[int, int], SavedFile]] = {}

    def of(self, gait_id: str) -> SavedFile | None:
        """A gait's file; None where it has none.

        Raises:
            InputError: it cannot be read, and the studio never saved anything in it.
        """
        stamp = self._files.stamp(gait_id)
        kept = self._kept.get(gait_id)
        if stamp is None or (kept is not None and kept[0] == stamp):
            return None if stamp is None or kept is None else kept[1]
        found = self._look(gait_id, stamp[0] / 1e9)
        self._kept[gait_id] = (stamp, found)
        return found

    def forget(self, gait_id: str) -> None:
        """The studio writes the file or takes it away."""
        self._kept.pop(gait_id, None)

    def _look(self, gait_id: str, written: float) -> SavedFile:
        saved = self._edits.last_saved(gait_id)
        mine = _readable(saved[0][1]) if saved else None
        try:
            found = self._files.stored(gait_id)
        except InputError as error:
            if mine is None:
                raise
            sentence = f"{error.sentence} It was changed outside the studio, which goes on with its own copy."
            return SavedFile(mine, None, f"{sentence} Correct it and use it, or keep yours.")
        theirs = found.gait
        if mine is None or theirs == mine or _was_broken_off(saved, theirs, written):
            return SavedFile(theirs, theirs, None, found.notice)
        return SavedFile(mine, theirs, f"{gait_id}.json was changed outside the studio. {WAYS_OUT}")


def _was_broken_off(saved: list[tuple[float, str]], theirs: Gait, written: float) -> bool:
    """Whether the studio ended between keeping a saved document and writing its file, once or repeatedly.

    The file is then older than the documents that were kept after it, and holds the one before them.
    """
    text = gait_text(theirs)
    return any(
        written <= newer[0] and (text == older[1] or theirs == _readable(older[1]))
        for newer, older in pairwise(saved)
    )


def _readable(text: str) -> Gait | None:
    try:
        return stored_gait(text).gait
    except FootfallError:  # of an older program, whose bounds were wider
        return None
