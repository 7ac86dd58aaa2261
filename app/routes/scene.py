"""What the 3D scene shows on demand: other versions of a gait, and where its feet can be."""

from enum import StrEnum
from typing import Any

from fastapi import APIRouter, Response
from starlette.concurrency import run_in_threadpool

from app.plans.plan import Plan
from app.scene.ghost import ghost_blob
from app.scene.reach import reach_table
from app.studio.studio import Studio
from app.web.dependencies import TheStudio, on_command_thread, on_planned
from core.errors import StateError
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Workspace

router = APIRouter(prefix="/api/gaits", tags=["gaits"])


class Version(StrEnum):
    """Which version of a gait a ghost is of."""

    BEFORE = "before"
    """The document before the present one."""
    SAVED = "saved"
    PRESENT = "present"
    """The document as it is, while an edit is under way on a page."""


@router.get("/{gait_id}/ghost", response_class=Response)
async def ghost(gait_id: str, of: Version, studio: TheStudio) -> Response:
    """Another version of the gait as poses of lines; binary."""
    plan = await _version(studio, gait_id, of)
    blob = await run_in_threadpool(ghost_blob, plan.model, _motion(plan))
    return Response(blob.to_bytes(), media_type="application/octet-stream")


@router.get("/{gait_id}/reach")
async def reach(gait_id: str, plan: str, workspace: Workspace, studio: TheStudio) -> dict[str, Any]:
    """Where each foot can be at the body's height of each sample."""
    shown = await on_planned(studio, gait_id, lambda: studio.gaits.plan(gait_id))
    if shown.session_hash != plan:
        shown = studio.live.kept(plan)
    return await run_in_threadpool(reach_table, shown.model, _motion(shown), workspace)


async def _version(studio: Studio, gait_id: str, of: Version) -> Plan:
    if of is Version.PRESENT:
        return await on_planned(studio, gait_id, lambda: studio.gaits.plan(gait_id))
    open_gait = await on_command_thread(studio, lambda: studio.gaits.open_gait(gait_id))
    gait = open_gait.before if of is Version.BEFORE else open_gait.saved
    if gait is None:
        reason = "was not changed yet" if of is Version.BEFORE else "was never saved"
        raise StateError(f"“{open_gait.gait.name}” {reason}, so there is no such version to show.", "of")
    return await run_in_threadpool(studio.gaits.open_gaits.planned, gait)


def _motion(plan: Plan) -> Trajectory:
    if plan.moved is None:
        sentence = "This version makes no motion." if plan.refusal is None else plan.refusal.sentence
        raise StateError(sentence, "plan")
    return plan.moved
