"""Provenance of computed results: made once the checker has confirmed one, and shown with its validity.

A document names the result that it has; another document that asks the same keeps its own plan.
"""

from collections.abc import Callable
from dataclasses import asdict, replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version

from app.common.json import Json
from app.common.version import VERSION
from app.documents.gait_json import asked_hash, motion_hash
from app.documents.trajectory_json import content_sha256
from app.plans.plan import Plan
from core.errors import InputError
from core.gait.gait import Gait, SequencePart
from core.gait.poses import FoundPoses
from core.gait.provenance import Provenance
from core.library.sequence import run_of
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


def with_found_poses(gait: Gait, motion: str, content: Json) -> Gait:
    """The gait with the poses of a search, where they are of this gait.

    Args:
        gait: the document.
        motion: hash of what was asked.
        content: the result as it is kept.
    """
    found = content.get("found")
    if gait.poses is None or found is None or motion_hash(gait) != motion:
        return gait
    problem = pose_problem(gait, load_robot(gait.robot))
    if found["answers"] != asked_of(problem):  # of an earlier program, which asked otherwise
        return gait
    return with_poses(gait, gait_of_poses(problem, FoundPoses(**found)))


def with_result(gait: Gait, provenance: Provenance) -> Gait:
    """The gait, or each part of a sequence whose run asks for it, with a result of the exact tier.

    The same motion, found once more, changes nothing.

    Args:
        gait: the document.
        provenance: of the result.
    """
    if gait.sequence:
        parts = tuple(
            replace(part, gait=replace(part.gait, provenance=provenance))
            if _run_hash(part) == provenance.motion and not _is_named(part.gait, provenance)
            else part
            for part in gait.sequence
        )
        return replace(gait, sequence=parts)
    if gait.recorded is not None or asked_hash(gait) != provenance.motion:
        return gait
    return gait if _is_named(gait, provenance) else replace(gait, provenance=provenance)


def _is_named(gait: Gait, provenance: Provenance) -> bool:
    named, found = gait.provenance, (provenance.motion, provenance.trajectory)
    return named is not None and (named.motion, named.trajectory) == found


def _run_hash(part: SequencePart) -> str | None:
    """Hash of what a part of a sequence asks for; None where it would run through too many iterations."""
    try:
        return motion_hash(run_of(part).gait)
    except InputError:
        return None


def stored_result(gait: Gait, result_for: Callable[[str], Json | None]) -> Json | None:
    """The stored result that a document has; None where it has none.

    Of a gait for the robot's clock it is what a search for exactly this gait ended with.

    Args:
        gait: the document, or the run of a part.
        result_for: gives the result under a key: the hash of a result of the exact tier, or the hash of what
            was asked.
    """
    motion, named = motion_hash(gait), gait.provenance
    if gait.poses is None and named is not None and named.motion == motion:
        content = result_for(named.trajectory)
        if content is not None:
            return content
    content = result_for(motion)
    kept = None if content is None else content.get("provenance")
    # Older results stand under what was asked; the oldest name no provenance, nor do their documents.
    is_of_another = kept is not None and (named is None or kept["trajectory"] != named.trajectory)
    return None if is_of_another else content


def provenance_view(gait: Gait, plan: Plan) -> Json | None:
    """Where the result came from that the document names, and its worth.

    Args:
        gait: the document.
        plan: what it amounts to.

    Returns:
        Its fields with `matches`, whether it is of the gait as it is, and `at_hand`, whether the plan is that
        very result; None where it names none.
    """
    provenance = gait.provenance
    if provenance is None:
        return None
    matches = gait.recorded is None and provenance.motion == asked_hash(gait)
    return {**asdict(provenance), "matches": matches, "at_hand": plan.result == provenance.trajectory}
