"""Versions of a gait: list, naming, differences in words, going back."""

from datetime import UTC, datetime

from fastapi import APIRouter
from pydantic import Field

from app.common.json import Json
from app.documents.gait_json import gait_content, motion_hash
from app.documents.stored_gait import stored_gait
from app.gaits.open_gait import OpenGait
from app.gaits.versions import MOST_NAME, UNREADABLE, VersionKind, is_said_already
from app.store.tables.edit_history_store import VersionRow
from app.web.dependencies import (
    RequestBody,
    Revision,
    TheAuthor,
    TheStudio,
    changed,
    on_command_thread,
    on_planned,
)
from core.errors import FootfallError
from core.gait.gait import Gait
from core.gait.gait_difference import gait_difference

router = APIRouter(prefix="/api/gaits/{gait_id}/versions", tags=["versions"])


_UNREADABLE = (
    "This version of the program cannot show the document, so that it cannot be restored. It is kept."
)


class Naming(RequestBody):
    """What a person calls the present state."""

    name: str = Field(pattern=r"\S", max_length=MOST_NAME)


@router.get("")
async def list_versions(gait_id: str, studio: TheStudio) -> Json:
    """A gait's versions, the newest first."""

    def versions() -> Json:
        open_gait = studio.gaits.open_gait(gait_id)
        motion = motion_hash(open_gait.gait)
        selection = studio.gaits.versions.all(gait_id)
        lines = [_line(row, open_gait, motion) for row in selection.rows]
        return {"versions": lines, "unreadable": selection.unreadable}

    return await on_command_thread(studio, versions)


@router.post("", status_code=201)
async def name_version(gait_id: str, naming: Naming, studio: TheStudio, author: TheAuthor) -> Json:
    """Keeps the present state under a name."""

    def keep() -> Json:
        open_gait = studio.gaits.open_gait(gait_id)
        row = studio.gaits.versions.keep(open_gait, VersionKind.NAMED, author, naming.name)
        studio.publisher.publish_gait(open_gait)
        return _line(row, open_gait, row.motion)

    return await on_planned(studio, gait_id, keep)


@router.get("/{number}")
async def read_version(gait_id: str, number: Revision, studio: TheStudio) -> Json:
    """A version with its document."""

    def version() -> Json:
        row = studio.gaits.versions.get(gait_id, number)
        open_gait = studio.gaits.open_gait(gait_id)
        line = _line(row, open_gait, motion_hash(open_gait.gait))
        return {**line, "document": gait_content(_gait(row))}

    return await on_command_thread(studio, version)


@router.get("/{number}/difference")
async def difference(gait_id: str, number: Revision, studio: TheStudio, to: Revision | None = None) -> Json:
    """What another version, or the present document, says that this version does not; in sentences."""

    def groups() -> Json:
        versions, open_gait = studio.gaits.versions, studio.gaits.open_gait(gait_id)
        before = _gait(versions.get(gait_id, number))
        after = open_gait.gait if to is None else _gait(versions.get(gait_id, to))
        found = gait_difference(before, after)
        return {
            "from": number,
            "to": to,
            "groups": [{"title": group.title, "sentences": list(group.sentences)} for group in found],
        }

    return await on_command_thread(studio, groups)


@router.post("/{number}/restore")
async def restore_version(gait_id: str, number: Revision, studio: TheStudio, author: TheAuthor) -> Json:
    """Makes a version's document the present one again, as an edit that can be undone."""
    return await changed(studio, lambda: studio.gaits.restore_version(gait_id, number, author))


def _gait(row: VersionRow) -> Gait:
    return stored_gait(row.document, f"version {row.number}").gait


def _is_present(row: VersionRow, open_gait: OpenGait) -> bool:
    try:
        return is_said_already(_gait(row), open_gait.gait)
    except FootfallError:
        return False


def _line(row: VersionRow, open_gait: OpenGait, motion: str) -> Json:
    """A line of the list; `motion` is the present document's hash."""
    same_motion = row.motion == motion
    return {
        "number": row.number,
        "made": datetime.fromtimestamp(row.made, UTC).isoformat(),
        "kind": row.kind,
        "name": row.name,
        "by": row.by,
        "motion": row.motion,
        "present": same_motion and _is_present(row, open_gait),
        "same_motion": same_motion,
        "problem": _UNREADABLE if row.motion == UNREADABLE else None,
    }
