"""Gaits: list, documents, edits, plans, checks and approvals."""

from __future__ import annotations

from functools import partial
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request, Response
from pydantic import BaseModel, ConfigDict, Field
from starlette.concurrency import run_in_threadpool

from app.documents import GaitDocument, gait_content, parse_gait
from app.routes.edge import on_session, studio_of
from app.scene.overlay import plan_poses
from app.scene.server import SceneServer
from app.studio import Studio
from app.views import approval_view, verdict_view
from core.errors import InputError, StateError

router = APIRouter(prefix="/api/gaits", tags=["gaits"])
TheStudio = Annotated[Studio, Depends(studio_of)]

_DOCUMENT = {
    "requestBody": {
        "required": True,
        "content": {"application/json": {"schema": GaitDocument.model_json_schema()}},
    }
}
MOST_BYTES = 2_000_000
"""A gait document is far smaller; more is refused."""


class Redraw(BaseModel):
    """A foot order and phase lengths to draw the timeline from."""

    model_config = ConfigDict(extra="forbid")
    order: list[int]
    phase_knots: int = Field(default=5, ge=2, le=50)
    closing_knots: int = Field(default=5, ge=0, le=100)


class Approve(BaseModel):
    """Who approves, and the verdict that they saw."""

    model_config = ConfigDict(extra="forbid")
    by: str = Field(max_length=80)
    verdict_hash: str | None = None


async def _document(request: Request) -> bytes:
    body = await request.body()
    if len(body) > MOST_BYTES:
        raise InputError(f"The gait document has {len(body)} bytes; at most {MOST_BYTES} are read.", "body")
    return body


@router.get("")
async def list_gaits(studio: TheStudio) -> dict[str, Any]:
    """Built-in and saved gaits."""
    return {"gaits": await on_session(studio, studio.summaries)}


@router.post("", status_code=201, openapi_extra=_DOCUMENT)
async def create_gait(
    request: Request,
    studio: TheStudio,
    copy_of: Annotated[str | None, Query(max_length=80)] = None,
    name: Annotated[str | None, Query(max_length=120)] = None,
) -> dict[str, Any]:
    """Saves a new gait from a document, or from a copy of another."""
    body = await _document(request)

    def create() -> dict[str, Any]:
        content = None if copy_of is None else gait_content(studio.gaits.open_gait(copy_of).gait)
        gait = parse_gait(body if content is None else _renamed(content, name), "body")
        return studio.publish_gait(studio.gaits.create(gait))

    return await on_session(studio, create)


def _renamed(content: dict[str, Any], name: str | None) -> bytes:
    document = GaitDocument.model_validate({**content, "name": name or f"{content['name']} copy"})
    return document.model_dump_json().encode()


@router.get("/{gait_id}")
async def read_gait(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """The gait's document as it is on the desk."""
    return await on_session(studio, lambda: gait_content(studio.gaits.open_gait(gait_id).gait))


@router.get("/{gait_id}/view")
async def view_gait(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """The gait with its plan, verdict and approval."""
    return await on_session(studio, lambda: studio.view(gait_id))


@router.put("/{gait_id}", openapi_extra=_DOCUMENT)
async def edit_gait(
    gait_id: str,
    request: Request,
    studio: TheStudio,
    label: Annotated[str, Query(max_length=120)] = "Edit",
    revision: int | None = None,
) -> dict[str, Any]:
    """Puts a changed document on the desk as one undo step."""
    body = await _document(request)

    def edit() -> dict[str, Any]:
        gait = parse_gait(body, "body")
        return studio.publish_gait(studio.gaits.edit(gait_id, gait, label, revision))

    return await on_session(studio, edit)


@router.delete("/{gait_id}")
async def delete_gait(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """Takes a saved gait away; it can be restored."""

    def delete() -> dict[str, Any]:
        studio.gaits.delete(gait_id)
        studio.publish_list()
        return {"deleted": gait_id}

    return await on_session(studio, delete)


@router.post("/{gait_id}/redraw")
async def redraw_gait(gait_id: str, redraw: Redraw, studio: TheStudio) -> dict[str, Any]:
    """Draws the timeline anew from a foot order."""
    change = partial(
        studio.gaits.redraw, gait_id, tuple(redraw.order), redraw.phase_knots, redraw.closing_knots
    )
    return await on_session(studio, lambda: studio.publish_gait(change()))


@router.post("/{gait_id}/undo")
async def undo(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """One step back."""
    return await on_session(studio, lambda: studio.publish_gait(studio.gaits.undo(gait_id)))


@router.post("/{gait_id}/redo")
async def redo(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """One step forward again."""
    return await on_session(studio, lambda: studio.publish_gait(studio.gaits.redo(gait_id)))


@router.post("/{gait_id}/save")
async def save(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """Writes the gait to the data folder."""
    return await on_session(studio, lambda: studio.publish_gait(studio.gaits.save(gait_id)))


@router.post("/{gait_id}/restore")
async def restore(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """Brings a deleted gait back."""
    return await on_session(studio, lambda: studio.publish_gait(studio.gaits.restore(gait_id)))


@router.post("/{gait_id}/check")
async def check(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """Checks the plan by every rule and gives the verdict."""

    def checked() -> dict[str, Any]:
        open_gait = studio.gaits.check(gait_id)
        studio.publish_gait(open_gait)
        if open_gait.verdict is None:
            raise StateError("The check gave no verdict.", "check")
        return verdict_view(open_gait.verdict)

    return await on_session(studio, checked)


@router.post("/{gait_id}/approve")
async def approve(gait_id: str, approval: Approve, studio: TheStudio) -> dict[str, Any]:
    """Records a person's approval of the present verdict."""

    def approved() -> dict[str, Any]:
        open_gait = studio.gaits.approve(gait_id, approval.by, approval.verdict_hash)
        studio.publish_gait(open_gait)
        if open_gait.approval is None:
            raise StateError("The approval was not recorded.", "approve")
        return approval_view(open_gait.approval)

    return await on_session(studio, approved)


@router.get("/{gait_id}/poses", response_class=Response)
async def poses(gait_id: str, plan: str, request: Request, studio: TheStudio) -> Response:
    """Every moving part's pose over the plan, for playback; binary."""
    shown = await on_session(studio, lambda: studio.gaits.plan(gait_id))
    trajectory = shown.trajectory
    if shown.hash != plan:
        raise StateError("The plan changed meanwhile; ask for the new one.", "plan")
    if trajectory is None or shown.waypoints is None:
        raise StateError("This plan cannot be shown: a foot is out of reach.", "plan")

    # All pages look into one scene: it holds the robot of the gait that was opened last.
    scene: SceneServer = request.app.state.scene
    await run_in_threadpool(scene.show, shown.model.name)
    blob = await run_in_threadpool(plan_poses, shown.model, trajectory)
    return Response(blob.to_bytes(), media_type="application/octet-stream")


@router.get("/{gait_id}/run")
async def run(gait_id: str, studio: TheStudio) -> dict[str, Any]:
    """What a person should know before they press Send."""

    def summary() -> dict[str, Any]:
        return studio.robot.run_summary(studio.gaits.open_gait(gait_id), studio.gaits.plan(gait_id))

    return await on_session(studio, summary)
