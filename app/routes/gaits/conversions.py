"""A drawn gait as a gait for the robot's clock, and back; and what that would make of it."""

from enum import StrEnum
from functools import partial

from fastapi import APIRouter
from fastapi.responses import StreamingResponse

from app.common.json import Json
from app.gaits.open_gait import OpenGait
from app.plans.plan import Plan
from app.web.dependencies import RequestBody, Revision, TheAuthor, TheStudio, changed, on_planned
from app.web.state_lines import state_lines
from core.gait.gait import Gait
from core.pose_gaits.conversion import as_drawn_gait, as_pose_gait
from core.robot.model import load_robot

router = APIRouter(prefix="/api/gaits", tags=["gaits"])


class Kind(StrEnum):
    """The two kinds of gaits."""

    POSES = "poses"
    """A gait for the robot's clock."""
    DRAWN = "drawn"
    """A drawn gait."""


_ACTS = {
    Kind.POSES: (as_pose_gait, "Make it for the robot's clock"),
    Kind.DRAWN: (as_drawn_gait, "Draw it freely"),
}


class Conversion(RequestBody):
    """The kind that a gait becomes, and the revision that a person saw; None for any."""

    to: Kind
    revision: Revision | None = None


@router.post("/{gait_id}/convert")
async def convert(gait_id: str, conversion: Conversion, studio: TheStudio, author: TheAuthor) -> Json:
    """Converts a gait into the other kind, as one undo step; 422 with the reason where that cannot be.

    Poses that were found for exactly this gait, as by `faster`, are taken over and not searched again.
    """
    act, label = _ACTS[conversion.to]

    def converted() -> OpenGait:
        gait = studio.gaits.document(gait_id)
        changed_gait = act(gait, load_robot(gait.robot))
        return studio.gaits.edit(gait_id, changed_gait, label, conversion.revision, author)

    return await changed(studio, converted)


@router.post("/{gait_id}/faster", response_model=Json)
async def faster(gait_id: str, studio: TheStudio) -> StreamingResponse:
    """Compares a drawn gait with the one for the robot's clock of the same foot order and step.

    The answer is one JSON object a line (NDJSON), each with all that is known so far; the last one has the
    `state` `solved`, `infeasible` or `failed`. `now` and `faster` have the figures of both gaits, SI: of a
    cycle in mid-walk, and from rest to rest. `document` is the gait with its poses. Nothing is changed; the
    search ends with the request.
    """

    def planned() -> tuple[Gait, Plan]:
        return studio.gaits.document(gait_id), studio.gaits.plan(gait_id)

    gait, plan = await on_planned(studio, gait_id, planned)
    return await state_lines(partial(studio.faster.search, gait, plan))
