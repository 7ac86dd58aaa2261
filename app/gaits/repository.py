"""Loads and stores gaits: the library, the saved files, and the edit history in the database.

Only the command queue's thread calls this.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

from app.documents.stored_gait import StoredGait, stored_gait
from app.gaits.open_gait import OpenGait, fresh_gait, stored_entry
from app.gaits.saved_file import WAYS_OUT, SavedFiles
from app.gaits.trash import IN_TRASH, ROUTE, DeletedGait, deleted_gaits, put_away, trash_key, way_key
from app.store.gait_files import GaitFiles, free_id
from app.store.storage_errors import left_undone
from app.store.tables.edit_history_store import EditHistoryRow, EditHistoryStore, VersionRow
from app.undo.history import History
from core.errors import FootfallError, InputError, NotFoundError, StateError
from core.gait.gait import Gait
from core.library.library import library

MISNAMED = (
    "{0} is no gait's file name: lower-case letters, digits and hyphens stand before .json. Rename or remove "
    "the file {0} in the folder gaits, or import it."
)


class GaitRepository:
    """Stored gaits, by id.

    Args:
        files: the saved gaits.
        edits: the edited gaits, in the database.
    """

    def __init__(self, files: GaitFiles, edits: EditHistoryStore) -> None:
        self._files = files
        self._edits = edits
        self._saved_files = SavedFiles(files, edits)
        self._stored: dict[str, History] = {}
        self._put_away()

    def stamps(self) -> dict[str, tuple[int, int] | None]:
        """Built-in gaits first, then saved ones; each with what changes when its file does."""
        stamps = self._files.stamps()
        return {gait_id: stamps.get(gait_id) for gait_id in dict.fromkeys((*library(), *sorted(stamps)))}

    def glance(self, gait_id: str) -> tuple[Gait, bool, bool]:
        """A gait's present document, whether it is built in, and whether it is edited; not its history."""
        saved = self._saved(gait_id)
        text = self._edits.present_document(gait_id)
        gait = saved.gait if text is None else stored_gait(text).gait
        return gait, gait_id in library(), gait != saved.gait

    def gait(self, gait_id: str) -> OpenGait:
        """A gait as it was put last.

        Raises:
            NotFoundError: there is none of that id.
            InputError: its document or its file cannot be read.
        """
        saved, builtin = self._saved(gait_id), gait_id in library()
        saved_at = self._files.saved_at(gait_id)
        row = self._edits.editing(gait_id)
        if row is None:
            return fresh_gait(gait_id, saved.gait, builtin, saved_at, saved.notice)
        present = stored_entry(row.history.present)
        self._stored[gait_id] = row.history
        notice = row.notice or present.notice
        opened = OpenGait(
            gait_id, builtin, row.history, present.gait, row.revision, saved.gait, saved_at, notice
        )
        return replace(opened, kept_approval=row.approval, revoked=row.revoked)

    def saved(self, gait_id: str) -> Gait:
        """A gait's document as saved or built in.

        Raises:
            NotFoundError: there is none of that id.
            InputError: its file cannot be read.
        """
        return self._saved(gait_id).gait

    def _saved(self, gait_id: str) -> StoredGait:
        if not self._files.is_id(gait_id):
            is_file = gait_id in self.misnamed()
            sentence = MISNAMED.format(gait_id) if is_file else f"There is no gait “{gait_id}”."
            raise NotFoundError(sentence, gait_id)
        file = self._saved_files.of(gait_id)
        if file is not None:
            return StoredGait(file.gait, file.notice)
        builtin = library().get(gait_id)
        if builtin is None:
            raise NotFoundError(f"There is no gait “{gait_id}”.", gait_id)
        return StoredGait(builtin.gait)

    def has_file(self, gait_id: str) -> bool:
        """Whether a gait has a file, readable or not."""
        return self._files.is_id(gait_id) and self._files.stamp(gait_id) is not None

    def replace_unreadable(self, gait_id: str, gait: Gait) -> None:
        """Sets a file that cannot be read aside; a gait that does not come with the program gets another.

        Args:
            gait_id: whose file. One that can be read, or that there is not, stays as it is.
            gait: what the other file holds.

        Raises:
            StorageError: the disk does not take it.
        """
        try:
            self._saved_files.of(gait_id)
        except InputError:
            is_builtin = gait_id in library()
            write = (lambda: None) if is_builtin else (lambda: self._files.write(gait_id, gait))
            self._files.set_aside(gait_id, write)
        self._forget(gait_id)

    def put(
        self, open_gait: OpenGait, version: VersionRow | None = None, record: dict[str, Any] | None = None
    ) -> None:
        """Keeps an edited gait in the database, with version and approval record; its file stays."""
        state = (open_gait.revision, open_gait.history, open_gait.notice)
        row = EditHistoryRow(*state, open_gait.approval_text, open_gait.revoked)
        self._edits.put(open_gait.id, row, self._stored.get(open_gait.id), version, record)
        self._stored[open_gait.id] = open_gait.history

    def write(self, open_gait: OpenGait, before: Callable[[OpenGait], object]) -> OpenGait:
        """Writes a gait's present document to its file; gives the gait back as saved.

        Args:
            open_gait: the gait.
            before: keeps what goes with it; what it raises leaves the file as it was.

        Raises:
            StateError: the file was changed outside the studio.
        """
        outside = self.outside(open_gait)
        if outside is not None:
            raise StateError(outside, open_gait.id)
        self._files.write(open_gait.id, open_gait.gait, lambda: before(open_gait))
        return self._as_saved(open_gait)

    def _as_saved(self, open_gait: OpenGait) -> OpenGait:
        self._saved_files.forget(open_gait.id)
        return replace(open_gait, saved=open_gait.gait, saved_at=self._files.saved_at(open_gait.id))

    def misnamed(self) -> tuple[str, ...]:
        """JSON files beside the gaits whose names are no ids."""
        return self._files.misnamed()

    def outside(self, open_gait: OpenGait) -> str | None:
        """How an open gait's file differs from what the studio saved, in a sentence; None where it does not.

        Raises:
            InputError: it cannot be read, and the studio never saved anything in it.
        """
        file = self._saved_files.of(open_gait.id)
        if file is None or file.outside is not None:
            return None if file is None else file.outside
        is_known = file.gait == open_gait.saved
        return None if is_known else f"{open_gait.id}.json was changed outside the studio. {WAYS_OUT}"

    def outside_of(self, gait_id: str) -> str | None:
        """The same of a gait that is not open."""
        file = self._saved_files.of(gait_id)
        return None if file is None else file.outside

    def theirs(self, gait_id: str) -> Gait:
        """The document in a gait's file, whoever wrote it.

        Raises:
            InputError: it cannot be read.
            StateError: there is none.
        """
        if self._files.stamp(gait_id) is None:
            raise StateError(f"{gait_id}.json is gone; save the gait to write it again.", gait_id)
        return self._files.read(gait_id)

    def taken_over(self, open_gait: OpenGait) -> OpenGait:
        """A gait whose present document is the one in its file."""
        return self._as_saved(open_gait)

    def keep_mine(self, open_gait: OpenGait) -> OpenGait:
        """Writes what the studio saved last; what was in the file is kept in the folder `set-aside`."""
        mine = open_gait.gait if open_gait.saved is None else open_gait.saved
        self._files.set_aside(open_gait.id, lambda: self._files.write(open_gait.id, mine))
        self._saved_files.forget(open_gait.id)
        return replace(open_gait, saved=mine, saved_at=self._files.saved_at(open_gait.id))

    def add(self, gait: Gait, taken: frozenset[str], before: Callable[[OpenGait], object]) -> OpenGait:
        """Saves a document as a new gait, under an id made from its name.

        Args:
            gait: the document.
            taken: ids that it must not get, besides those of the repository.
            before: as for `write`.
        """
        return self.write(fresh_gait(self._free_id(gait.name, taken), gait, False, None), before)

    def _free_id(self, name: str, taken: frozenset[str] = frozenset()) -> str:
        kept = (part for key in self._edits.ids() for part in key.removeprefix(IN_TRASH).split("/"))
        used = {ROUTE, *taken, *self.stamps(), *self._files.deleted_ids(), *kept}
        return free_id(name, used)

    def remove(self, gait_id: str) -> None:
        """Takes a gait away, with all that is kept of it; `restore` brings it back.

        An older one of the same id stays in the trash, under another id.

        Raises:
            StorageError: the disk does not take it; the gait stays.
        """
        put_away(self._files, self._edits)
        key, spare = trash_key(gait_id), self._free_id(gait_id)
        if gait_id in self._files.deleted_ids():
            with self._on_its_way(gait_id, spare) as way:
                self._files.rename_deleted(gait_id, spare, lambda: self._edits.rename(way, trash_key(spare)))
        elif key != gait_id:
            self._edits.rename(key, trash_key(spare))
        self._files.remove(gait_id, lambda: self._edits.rename(gait_id, key))
        self._forget(gait_id)

    def _forget(self, gait_id: str) -> None:
        self._saved_files.forget(gait_id)
        self._stored.pop(gait_id, None)

    @contextmanager
    def _on_its_way(self, gait_id: str, to: str) -> Iterator[str]:
        """Gives what is kept of a gait in the trash a key that says where its file goes.

        What is refused on the way brings it back to where the file is.
        """
        way = way_key(gait_id, to)
        if trash_key(gait_id) != gait_id:
            self._edits.rename(trash_key(gait_id), way)
        try:
            yield way
        except FootfallError:
            self._put_away()
            raise

    def _put_away(self) -> None:
        with left_undone("What is kept of deleted gaits is not put away"):
            put_away(self._files, self._edits)

    def deleted(self) -> tuple[DeletedGait, ...]:
        """What `restore` can bring back, the last deleted first."""
        self._put_away()
        return deleted_gaits(self._files, self._edits)

    def restore(self, gait_id: str) -> tuple[str, bool]:
        """Brings a gait back that was taken away, without the approval that it had.

        Returns:
            Its id, which is another one where its own is in use by now, and whether it was approved.

        Raises:
            InputError: it is not in the trash.
            StorageError: the disk does not take it; the gait stays in the trash, whole.
        """
        put_away(self._files, self._edits)
        self._files.require_deleted(gait_id)
        is_built_in = trash_key(gait_id) == gait_id
        is_free = self._files.stamp(gait_id) is None and (is_built_in or gait_id not in self._edits.ids())
        to = gait_id if is_free else self._free_id(gait_id)
        approvals: list[bool] = []
        with self._on_its_way(gait_id, to) as way:
            self._files.restore(gait_id, to, lambda: approvals.append(self._edits.bring_back(way, to)))
        self._forget(to)
        return to, any(approvals)
