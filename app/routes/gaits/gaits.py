"""Gaits: list, documents, edits, plans, checks and approvals."""

from collections.abc import Callable
from dataclasses import asdict, replace
from enum import StrEnum
from functools import partial
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.bridge.run_range import RunRange
from app.common.json import Json
from app.documents.gait_json import MOST_BYTES, gait_content, parse_gait
from app.gaits.approvals import ApprovalRequest
from app.gaits.open_gait import OpenGait
from app.gaits.trash import ROUTE, RestoredUnshownError
from app.gaits.verdict_views import approval_view, verdict_view
from app.scene.overlay import plan_poses
from app.studio.studio import Studio
from app.web.dependencies import (
    RequestBody,
    Revision,
    TheAuthor,
    TheStudio,
    changed,
    on_command_thread,
    on_planned,
)
from core.errors import InputError, StateError
from core.gait.gait import MOST_NAME, Gait
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS
from core.overrides import MOST_REASON, OVERRIDABLE, OverrideRequest

router = APIRouter(prefix="/api/gaits", tags=["gaits"])

_DOCUMENT = {
    "requestBody": {
        "required": True,
        "content": {"application/json": {"schema": {"$ref": "/api/schema/gait"}}},
    }
}


class Kept(StrEnum):
    """Which of two documents is kept as a gait's file."""

    FILE = "file"
    """What somebody else wrote into it; it becomes the present document, and the studio's one a version."""
    MINE = "mine"
    """What the studio saved last; the other file is set aside."""


class FileChoice(RequestBody):
    """What becomes of a file that was changed outside the studio."""

    keep: Kept


class Redraw(RequestBody):
    """A foot order and phase lengths to draw the timeline from."""

    order: list[int]
    phase_knots: int = Field(default=5, ge=LEAST_PHASE_KNOTS, le=MOST_PHASE_KNOTS)
    closing_knots: int = Field(default=5, ge=0, le=MOST_CLOSING_KNOTS)


class OverrideErrors(RequestBody):
    """Errors in spite of which a person approves."""

    rules: list[str] = Field(
        min_length=1,
        max_length=len(OVERRIDABLE),
        description="Every rule of which an error stands.",
        json_schema_extra={"items": {"type": "string", "enum": list(OVERRIDABLE)}},
    )
    reason: str = Field(max_length=MOST_REASON, description="Why the robot may move in spite of them.")


class Approve(RequestBody):
    """Who approves, and the verdict that they saw."""

    by: str = Field(max_length=80)
    verdict_hash: str | None = None
    accept_warnings: bool = Field(False, description="They have seen every warning of it and accept it.")
    override: OverrideErrors | None = None


async def _document(request: Request) -> bytes:
    body = await request.body()
    if len(body) > MOST_BYTES:
        raise InputError(f"The gait document has {len(body)} bytes; at most {MOST_BYTES} are read.", "body")
    return body


@router.get("")
async def list_gaits(studio: TheStudio) -> Json:
    """Built-in and saved gaits."""
    return {"gaits": await on_command_thread(studio, studio.publisher.summaries)}


@router.get(f"/{ROUTE}")
async def list_deleted(studio: TheStudio) -> Json:
    """Deleted gaits that can be brought back, the last deleted first: id, name, when (s since the epoch)."""
    deleted = await on_command_thread(studio, studio.gaits.deleted)
    return {"gaits": [asdict(gait) for gait in deleted]}


@router.post("", status_code=201, openapi_extra=_DOCUMENT)
async def create_gait(
    request: Request,
    studio: TheStudio,
    copy_of: Annotated[str | None, Query(max_length=80)] = None,
    name: Annotated[str | None, Query(max_length=MOST_NAME)] = None,
) -> Json:
    """Saves a new gait from a document, or from a copy of another."""
    body = await _document(request)

    def create() -> OpenGait:
        gait = parse_gait(body, "body") if copy_of is None else _copy(studio.gaits.document(copy_of), name)
        return studio.gaits.create(gait)

    return await changed(studio, create)


def _copy(gait: Gait, name: str | None) -> Gait:
    """The gait under another name; its own with “copy” behind it where none is given."""
    suffix = " copy"
    return replace(gait, name=name or f"{gait.name[: MOST_NAME - len(suffix)]}{suffix}")


@router.get("/{gait_id}")
async def read_gait(gait_id: str, studio: TheStudio) -> Json:
    """The gait's document as it is now."""
    return await on_command_thread(studio, lambda: gait_content(studio.gaits.open_gait(gait_id).gait))


@router.get("/{gait_id}/view")
async def view_gait(gait_id: str, studio: TheStudio) -> Json:
    """The gait with its plan, verdict and approval."""
    return await on_planned(studio, gait_id, lambda: studio.publisher.view(gait_id))


@router.put("/{gait_id}", openapi_extra=_DOCUMENT)
async def edit_gait(
    gait_id: str,
    request: Request,
    studio: TheStudio,
    author: TheAuthor,
    label: Annotated[str, Query(max_length=120, pattern=r"^[^\x00]*$")] = "Edit",
    revision: Revision | None = None,
    edit: Annotated[str, Query(max_length=64, pattern=r"^[0-9A-Za-z.-]*$")] = "",
) -> Json:
    """Changes the document, as one undo step; a page that had no answer sends the same `edit` again."""
    body = await _document(request)

    def change() -> OpenGait:
        return studio.gaits.edit(gait_id, parse_gait(body, "body"), label, revision, author, edit)

    return await changed(studio, change)


@router.delete("/{gait_id}")
async def delete_gait(gait_id: str, studio: TheStudio) -> Json:
    """Takes a saved gait away; it can be restored."""

    def delete() -> Json:
        instead = studio.gaits.delete(gait_id)
        studio.pose_searches.forget(gait_id)
        if instead is not None:
            studio.publisher.publish_soon(instead.id)
        studio.publisher.publish_list()
        return {"deleted": gait_id}

    return await on_command_thread(studio, delete)


@router.post("/{gait_id}/redraw")
async def redraw_gait(gait_id: str, redraw: Redraw, studio: TheStudio, author: TheAuthor) -> Json:
    """Draws the timeline anew from a foot order."""
    change = partial(
        studio.gaits.redraw, gait_id, tuple(redraw.order), redraw.phase_knots, redraw.closing_knots, author
    )
    return await changed(studio, change)


@router.post("/{gait_id}/undo")
async def undo(gait_id: str, studio: TheStudio, author: TheAuthor) -> Json:
    """Takes back the newest edit of who asks; a page names itself by the header X-Footfall-Page."""
    return await changed(studio, lambda: studio.gaits.undo(gait_id, author))


@router.post("/{gait_id}/redo")
async def redo(gait_id: str, studio: TheStudio, author: TheAuthor) -> Json:
    """Does the newest undone edit of who asks again."""
    return await changed(studio, lambda: studio.gaits.redo(gait_id, author))


@router.post("/{gait_id}/save")
async def save(gait_id: str, studio: TheStudio, author: TheAuthor) -> Json:
    """Writes the gait to the data folder."""
    return await changed(studio, lambda: studio.gaits.save(gait_id, author))


@router.post("/{gait_id}/recover")
async def recover(gait_id: str, studio: TheStudio, author: TheAuthor) -> Json:
    """Takes the way out of a gait that cannot be shown: its last state that can, or how it came."""
    return await changed(studio, lambda: studio.gaits.recover(gait_id, author))


@router.post("/{gait_id}/restore")
async def restore(gait_id: str, studio: TheStudio) -> Json:
    """Brings a deleted gait back; one that cannot be shown is answered with its line in the list."""
    lines: list[Json] = []

    def restored() -> OpenGait:
        try:
            return studio.gaits.restore(gait_id)
        except RestoredUnshownError as error:
            studio.publisher.publish_list()
            lines.extend(line for line in studio.publisher.summaries() if line["id"] == error.gait_id)
            raise

    try:
        return await changed(studio, restored)
    except RestoredUnshownError:
        return lines[0]


@router.post("/{gait_id}/file")
async def settle_file(gait_id: str, choice: FileChoice, studio: TheStudio, author: TheAuthor) -> Json:
    """Takes over a file that was changed outside the studio, or writes the studio's own document again."""
    gaits = studio.gaits
    if choice.keep is Kept.FILE:
        return await changed(studio, lambda: gaits.take_file(gait_id, author))
    return await changed(studio, lambda: gaits.keep_mine(gait_id))


@router.delete("/{gait_id}/search")
async def cancel_search(gait_id: str, studio: TheStudio) -> Json:
    """Ends the search for the poses of a gait for the robot's clock."""
    return await _searched(gait_id, studio, studio.pose_searches.cancel)


@router.post("/{gait_id}/search")
async def search_again(gait_id: str, studio: TheStudio) -> Json:
    """Searches again for poses after the search was cancelled."""
    return await _searched(gait_id, studio, studio.pose_searches.again)


async def _searched(gait_id: str, studio: Studio, act: Callable[[str], None]) -> Json:
    def acted() -> Json:
        open_gait = studio.gaits.open_gait(gait_id)
        act(gait_id)
        studio.publisher.publish_gait(open_gait)
        return studio.publisher.view(gait_id)

    return await on_planned(studio, gait_id, acted)


@router.post("/{gait_id}/check")
async def check(gait_id: str, studio: TheStudio) -> Json:
    """Checks the plan by every rule and gives the verdict."""

    def checked() -> Json:
        open_gait = studio.gaits.check(gait_id)
        studio.publisher.publish_gait(open_gait)
        if open_gait.verdict is None:
            raise StateError("The check gave no verdict.", "check")
        return verdict_view(open_gait.verdict)

    return await on_planned(studio, gait_id, checked)


@router.post("/{gait_id}/approve")
async def approve(gait_id: str, approval: Approve, studio: TheStudio) -> Json:
    """Records a person's approval of the present verdict, or in spite of errors that may be overridden."""
    asked = approval.override
    override = None if asked is None else OverrideRequest(tuple(asked.rules), asked.reason)

    def approved() -> Json:
        seen = (approval.verdict_hash, approval.accept_warnings)
        request = ApprovalRequest(approval.by, *seen, override)
        open_gait = studio.gaits.approve(gait_id, request)
        studio.publisher.publish_gait(open_gait)
        if open_gait.approval is None:
            raise StateError("The approval was not recorded.", "approve")
        return approval_view(open_gait.approval)

    return await on_planned(studio, gait_id, approved)


@router.get("/{gait_id}/poses", response_class=Response)
async def poses(gait_id: str, plan: str, studio: TheStudio) -> Response:
    """Every moving part's pose over the plan, for playback; binary."""
    shown = await on_planned(studio, gait_id, lambda: studio.gaits.plan(gait_id))
    if shown.session_hash != plan:
        shown = studio.live.kept(plan)
    trajectory = shown.moved
    if trajectory is None:
        raise StateError("This plan cannot be shown: there is no motion.", "plan")
    stops = None if shown.poses is None else shown.poses.trajectory.times
    blob = await run_in_threadpool(plan_poses, shown.model, trajectory, stops)
    return Response(blob.to_bytes(), media_type="application/octet-stream")


@router.get("/{gait_id}/run")
async def run(
    gait_id: str, studio: TheStudio, first: Annotated[int, Query(alias="from")] = 0, iterations: int = 1
) -> Json:
    """What a person should know before they press Send."""

    def summary() -> Json:
        open_gait, plan = studio.gaits.open_gait(gait_id), studio.gaits.plan(gait_id)
        return studio.robot.run_summary(open_gait, plan, RunRange(first, iterations))

    return await on_planned(studio, gait_id, summary)
