"""The gaits that were deleted and can be brought back.

What the database keeps of a gait goes into the trash with its file, under a key of its own. A file that
appears under the gait's name is therefore a new gait.
"""

from contextlib import suppress
from dataclasses import dataclass

from app.documents.stored_gait import stored_gait
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import EditHistoryStore
from core.errors import FootfallError, InputError
from core.library.library import library

ROUTE = "deleted"
"""What the list is called among the addresses of gaits; no gait gets it as its id."""


IN_TRASH = "trash/"
"""Begins the key of what belongs to a gait in the trash; no gait's id has a slash."""


def trash_key(gait_id: str) -> str:
    """Key of what the database keeps of a gait in the trash. What comes with the program is never there."""
    return gait_id if gait_id in library() else f"{IN_TRASH}{gait_id}"


def way_key(gait_id: str, to: str) -> str:
    """Key of the same while its file goes from its place in the trash to another id, there or outside."""
    return f"{IN_TRASH}{gait_id}/{to}"


def put_away(files: GaitFiles, log: EditHistoryStore) -> None:
    """Puts what is kept of deleted gaits to where their files are.

    They are apart where a program ended, or the disk refused, between the two; an older program left them so.
    A gait whose id is in use stays as it is: nobody can tell what belongs to which.
    """
    kept, deleted = log.ids(), files.deleted_ids()
    for key in kept:
        gait_id, _, to = key.removeprefix(IN_TRASH).partition("/")
        if not (key.startswith(IN_TRASH) and files.is_id(gait_id) and files.is_id(to)):
            continue
        is_back = {gait_id, to}.isdisjoint(deleted) and files.stamp(to) is not None
        at = to if is_back else trash_key(to if to in deleted and gait_id not in deleted else gait_id)
        if at not in kept:
            (log.bring_back if is_back else log.rename)(key, at)
    for gait_id in deleted:
        key = trash_key(gait_id)
        if gait_id in kept and key not in kept and files.is_id(gait_id) and files.stamp(gait_id) is None:
            log.rename(gait_id, key)


class RestoredUnshownError(InputError):
    """A deleted gait is back, and no state of it can be shown.

    Args:
        gait_id: its id.
        error: why it cannot be shown.
    """

    def __init__(self, gait_id: str, error: InputError) -> None:
        super().__init__(error.sentence, error.where)
        self.gait_id = gait_id


@dataclass(frozen=True)
class DeletedGait:
    """A gait in the trash.

    Args:
        id: by which it is brought back.
        name: as it was last called, also where that was not saved.
        when: it was deleted, s since the epoch.
    """

    id: str
    name: str
    when: float


def deleted_gaits(files: GaitFiles, log: EditHistoryStore) -> tuple[DeletedGait, ...]:
    """What can be brought back, the last deleted first.

    A damaged file goes by its own name.

    Args:
        files: the saved gaits and the trash.
        log: what was edited and not saved.
    """
    found = []
    for gait_id in files.deleted_ids():
        name = f"{gait_id}.json"
        with suppress(FootfallError):
            text = None if gait_id in library() else log.present_document(trash_key(gait_id))
            name = files.deleted(gait_id).name if text is None else stored_gait(text).gait.name
        found.append(DeletedGait(gait_id, name, files.deleted_at(gait_id)))
    return tuple(found)
