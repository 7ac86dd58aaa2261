"""Provenance of computed results: made once the checker has confirmed one, and shown with its validity."""

from dataclasses import asdict, replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version

from app.common.json import Json
from app.common.version import VERSION
from app.documents.gait_json import asked_hash, motion_hash
from app.documents.trajectory_json import content_sha256
from app.plans.plan import Plan
from core.gait.gait import Gait
from core.gait.poses import FoundPoses
from core.gait.provenance import Provenance
from core.pose_gaits.gait_poses import asked_of, gait_of_poses, pose_problem, with_poses
from core.robot.model import load_robot

EXACT = "nlp"
"""The exact tier, as the command line calls it."""


@cache
def _solver() -> str:
    return f"IPOPT in CasADi {version('casadi')}"


def result_provenance(motion: str, content: Json) -> Provenance:
    """The provenance of a result of the exact tier that the checker has confirmed just now.

    Args:
        motion: hash of what was asked.
        content: the result as it is kept, with `trajectory`, `status` and `solve_seconds`.
    """
    return Provenance(
        motion=motion,
        trajectory=content_sha256(content["trajectory"]),
        method=EXACT,
        solver=_solver(),
        status=content["status"],
        seconds=content["solve_seconds"],
        made=datetime.now(UTC).isoformat(timespec="seconds"),
        program=VERSION,
    )


def with_result(gait: Gait, motion: str, content: Json) -> Gait:
    """The gait with the poses or the provenance of a result, where it is of this gait.

    Args:
        gait: the document.
        motion: hash of what was asked.
        content: the result as it is kept; of older ones the provenance is not known.
    """
    found = content.get("found")
    if gait.poses is not None and found is not None and motion_hash(gait) == motion:
        problem = pose_problem(gait, load_robot(gait.robot))
        if found["answers"] != asked_of(problem):  # of an earlier program, which asked otherwise
            return gait
        return with_poses(gait, gait_of_poses(problem, FoundPoses(**found)))
    kept = content.get("provenance")
    if kept is None or gait.recorded is not None or asked_hash(gait) != motion:
        return gait
    return replace(gait, provenance=Provenance(**kept))


def provenance_view(gait: Gait, plan: Plan) -> Json | None:
    """Where the result came from that is shown, or else the one that the document names, and its worth.

    Args:
        gait: the document.
        plan: what it amounts to.

    Returns:
        Its fields with `matches`, whether it is of the gait as it is, and `at_hand`, whether the plan is that
        very result; None where neither plan nor document have one.
    """
    provenance = gait.provenance
    if plan.provenance is not None and (provenance is None or provenance.trajectory != plan.result):
        provenance = plan.provenance
    if provenance is None:
        return None
    matches = gait.recorded is None and provenance.motion == asked_hash(gait)
    return {**asdict(provenance), "matches": matches, "at_hand": plan.result == provenance.trajectory}
