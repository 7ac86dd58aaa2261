"""Random gaits through both tiers: is every answer solved and checked, or infeasible, explained and right?"""

import time
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from app.bench.common.edited_gaits import EditedGait
from app.bench.common.measure import Row, milliseconds
from app.bench.common.random_gaits import random_gait
from app.plans.verified_result import VerifiedResult, verify
from core.errors import InputError
from core.gait.gait import motion_problem
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Boundary, MotionProblem
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_exact, solve_live, solve_motion

COUNT = 500
SEED = 3


class Outcome(StrEnum):
    """What became of an edit in one tier."""

    SOLVED = "solved"
    """Solved, and the checker confirms it."""
    INFEASIBLE = "infeasible"
    """No motion, with sentences that say why."""
    REFUSED = "refused"
    """No problem can be made of it; a sentence says why."""
    FAILED = "failed"
    """Neither; the tier owes an answer."""


@dataclass(frozen=True, eq=False)
class Answers:
    """Both tiers' answers to one edit.

    Args:
        edit: what was asked.
        live: outcome of the live tier.
        exact: outcome of the exact tier.
        reason: why they disagree, or the sentence of a refusal or failure; else empty.
        found_by: the search that has a motion where the exact tier says there is none; else empty.
        live_seconds: wall time of the live tier's answer.
        exact_seconds: of the exact one's.
    """

    edit: EditedGait
    live: Outcome
    exact: Outcome
    reason: str
    found_by: str = ""
    live_seconds: float = 0.0
    exact_seconds: float = 0.0

    @property
    def disagree(self) -> bool:
        """Whether one tier has a motion and the other says there is none."""
        return {self.live, self.exact} == {Outcome.SOLVED, Outcome.INFEASIBLE}


def answers(edit: EditedGait) -> Answers:
    """Asks both tiers."""
    try:
        problem = motion_problem(edit.gait, load_robot(edit.gait.robot))
    except InputError as error:
        return Answers(edit, Outcome.REFUSED, Outcome.REFUSED, error.sentence)
    begin = time.perf_counter()
    live = verify(problem, solve_live(problem))
    between = time.perf_counter()
    exact = verify(problem, solve_exact(problem))
    end = time.perf_counter()
    found = Answers(edit, outcome_of(live), outcome_of(exact), "", "", between - begin, end - between)
    missed = _found_by(live) if found.exact is Outcome.INFEASIBLE else ""
    return replace(found, reason=_reason(found, live, exact), found_by=missed)


def _found_by(live: VerifiedResult) -> str:
    """Which other search has a motion that the checker confirms: the live tier's, or IPOPT's from two starts.

    So what the exact tier believes without a search, a proof of the live tier, is searched here.
    """
    problem, nearest = live.problem, live.trajectory
    if live.status is SolveStatus.SOLVED:
        return "the live tier"
    starts: dict[str, Trajectory | None] = {"IPOPT from a drawing": None}
    if nearest.body_velocity is not None and nearest.contact_forces is not None:
        starts["IPOPT from the nearest motion"] = nearest
    for name, start in starts.items():
        if verify(problem, solve_motion(problem, start=start)).status is SolveStatus.SOLVED:
            return name
    return ""


def outcome_of(verified: VerifiedResult) -> Outcome:
    """What a tier's answer is worth."""
    if verified.status is SolveStatus.SOLVED:
        return Outcome.SOLVED
    explained = verified.status is SolveStatus.INFEASIBLE and verified.explanation
    return Outcome.INFEASIBLE if explained else Outcome.FAILED


def _reason(found: Answers, live: VerifiedResult, exact: VerifiedResult) -> str:
    if Outcome.FAILED in (found.live, found.exact):
        return " ".join(live.explanation if found.live is Outcome.FAILED else exact.explanation)
    if not found.disagree:
        return ""
    if found.exact is Outcome.INFEASIBLE:
        return f"The exact tier missed a motion: {exact.explanation[0]}"
    return f"{live.explanation[0]} {_freedom(exact)}"


def _freedom(exact: VerifiedResult) -> str:
    """Which freedom that the live tier does not have the exact one needed, found by taking it away."""
    problem = exact.problem
    plane = exact.trajectory.body_world[:, 2] - problem.model.com_height
    lowest, highest = plane.min() * 1000, plane.max() * 1000
    if not _solves(_at_given_height(problem)):
        return f"The exact tier moves the body between {lowest:.1f} and {highest:.1f} mm."
    if problem.boundary is Boundary.PERIODIC:
        return "The exact tier chooses where the feet stand at first, and how high the body is."
    feet = [swing.foot for swing in problem.timeline.swings()]
    if len(feet) > len(set(feet)):
        return "The exact tier chooses the footholds between the first and the last."
    return "The exact tier chooses how each swing rises, and has discs where the live tier has polygons."


def _at_given_height(problem: MotionProblem) -> MotionProblem:
    heights = [pose.body_world[2] - problem.model.com_height for pose in (problem.start, problem.goal)]
    return replace(problem, limits=replace(problem.limits, plane_height=(min(heights), max(heights))))


def _solves(problem: MotionProblem) -> bool:
    return verify(problem, solve_exact(problem)).status is SolveStatus.SOLVED


def bench_edits(count: int = COUNT, seed: int = SEED) -> list[Row]:
    """Counts the outcomes, then every disagreement and failure by itself."""
    found = [answers(random_gait(seed, number)) for number in range(count)]
    rows = [
        _count(outcome.value, sum(a.live is outcome for a in found), sum(a.exact is outcome for a in found))
        for outcome in Outcome
    ]
    disagreeing = [a for a in found if a.disagree]
    rows.append(_count("disagree", len(disagreeing), len(disagreeing)))
    missed = [a for a in found if a.found_by]
    rows.append(_count("infeasible, and another search has a motion", len(missed), len(missed)))
    rows += [_seconds(found, outcome) for outcome in (Outcome.SOLVED, Outcome.INFEASIBLE)]
    told = [a for a in found if a.disagree or a.found_by or Outcome.FAILED in (a.live, a.exact)]
    return rows + [
        {
            "edit": f"{seed}/{a.edit.number}: {a.edit.words}",
            "live": a.live.value,
            "exact": a.exact.value,
            "reason": a.reason or f"Found by {a.found_by}.",
        }
        for a in told
    ]


def _seconds(found: list[Answers], outcome: Outcome) -> Row:
    """How long answers of four-legged gaits took: median and 95th percentile, ms."""
    four = [a for a in found if len(a.edit.gait.order) == 4]
    live = [a.live_seconds for a in four if a.live is outcome]
    exact = [a.exact_seconds for a in four if a.exact is outcome]
    texts = [
        f"{milliseconds(float(np.median(times)))}, {milliseconds(float(np.percentile(times, 95)))}"
        if times
        else "none"
        for times in (live, exact)
    ]
    return {
        "edit": f"{outcome.value}, four legs: median, p95, ms",
        "live": texts[0],
        "exact": texts[1],
        "reason": "",
    }


def _count(name: str, live: int, exact: int) -> Row:
    return {"edit": name, "live": str(live), "exact": str(exact), "reason": ""}
