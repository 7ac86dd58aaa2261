"""Approvals of a gait: their list, and what changed from one to another."""

from dataclasses import asdict

from fastapi import APIRouter

from app.common.json import Json
from app.gaits.approvals import ApprovalRecord, approval_difference, approval_figures
from app.studio.studio import Studio
from app.web.dependencies import TheStudio, on_planned

router = APIRouter(prefix="/api/gaits/{gait_id}/approvals", tags=["approvals"])


@router.get("")
async def list_approvals(gait_id: str, studio: TheStudio) -> Json:
    """A gait's approvals, the newest first, and which one stands."""

    def approvals() -> Json:
        stands = studio.gaits.open_gait(gait_id).approval
        selection = studio.gaits.approvals.all(gait_id)
        given = None if stands is None else (stands.by, stands.when)  # the record keeps its old form
        lines = [_line(one, (one.approval.by, one.approval.when) == given) for one in selection.rows]
        return {"approvals": lines, "unreadable": selection.unreadable}

    return await on_planned(studio, gait_id, approvals)


@router.get("/{number}/difference")
async def difference(gait_id: str, number: int, studio: TheStudio, to: int | None = None) -> Json:
    """What another approval, or the gait as it is now, has that this one has not; in sentences."""

    def groups() -> Json:
        approvals = studio.gaits.approvals
        before = approvals.get(gait_id, number)
        after = _present(studio, gait_id) if to is None else _sides(approvals.get(gait_id, to))
        open_gait = studio.gaits.open_gait(gait_id)
        document = open_gait.gait if to is None else approvals.document(gait_id, approvals.get(gait_id, to))
        documents = (approvals.document(gait_id, before), document)
        found = approval_difference(documents, _sides(before), after)
        return {
            "from": number,
            "to": to,
            "groups": [{"title": group.title, "sentences": list(group.sentences)} for group in found],
        }

    return await on_planned(studio, gait_id, groups)


def _line(record: ApprovalRecord, stands: bool) -> Json:
    return {
        "number": record.number,
        **asdict(record.approval),
        "version": record.version,
        "figures": record.figures,
        "stands": stands,
    }


def _sides(record: ApprovalRecord) -> Json:
    return {**asdict(record.approval), "figures": record.figures}


def _present(studio: Studio, gait_id: str) -> Json:
    """The gait as it is; without figures where it was not checked."""
    open_gait, plan = studio.gaits.open_gait(gait_id), studio.gaits.plan(gait_id)
    verdict = open_gait.verdict
    return {
        "waypoints_hash": None if plan.waypoints is None else plan.waypoints.content_hash,
        "robot_hash": plan.model.parameters_hash,
        "figures": {} if verdict is None else approval_figures(plan, verdict),
    }
