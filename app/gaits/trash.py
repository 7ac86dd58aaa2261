"""The gaits that were deleted and can be brought back."""

from contextlib import suppress
from dataclasses import dataclass

from app.documents.stored_gait import stored_gait
from app.store.edit_history_store import EditHistoryStore
from app.store.gait_files import GaitFiles
from core.errors import FootfallError
from core.library.library import library

ROUTE = "deleted"
"""What the list is called among the addresses of gaits; no gait gets it as its id."""


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

    One whose id is in use again cannot. A damaged file goes by its own name.

    Args:
        files: the saved gaits and the trash.
        log: what was edited and not saved.
    """
    found = []
    for gait_id in files.deleted_ids():
        if files.saved_at(gait_id) is not None:
            continue
        name = f"{gait_id}.json"
        with suppress(FootfallError):
            text = None if gait_id in library() else log.present_document(gait_id)
            name = files.deleted(gait_id).name if text is None else stored_gait(text).gait.name
        found.append(DeletedGait(gait_id, name, files.deleted_at(gait_id)))
    return tuple(found)
