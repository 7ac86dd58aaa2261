"""One answer from the two tiers: the exact one starts from the live one, and both tell why there is none."""

from dataclasses import replace

from core.problem.footholds import are_footholds_given
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Cost, MotionProblem
from solver_jobs.live.solve import solve_live
from solver_jobs.nlp.attempts import Progress
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.results.motion import Evidence, MotionResult, SolveStatus

_WITHOUT = (SolveStatus.INFEASIBLE, SolveStatus.FAILED)
"""How a search without a motion ends."""

NOT_OPTIMAL = (
    "Optimise found no better motion. This is the live plan, which keeps every limit; its footholds and "
    "body height are not optimised."
)

OUTSIDE = "With other footholds it is diagnosed from a local search, not proven."


SMALLER_MARGINS = (0.002, 0.0)
"""Stability margins that are tried where the asked one forbids a motion, m."""

PATIENCE = 45
"""Iterations after which a smaller margin is taken to give no motion; one that exists takes 9 to 30. They are
not reported, and a cancel takes effect after about a second."""

MARGIN_FAMILIES = ("body_torque", "margin")
"""What a motion lacks whose margin is too large, by the names of `Lack.family`."""


def solve_exact(
    problem: MotionProblem, progress: Progress = lambda iterate: True, *, resume: bool = False
) -> MotionResult:
    """Solves a problem by both tiers; a no also says whether the asked margin alone forbids a motion.

    Args and result are those of `solve_by_both`.
    """
    result = solve_by_both(problem, progress, resume=resume)
    if result.status is not SolveStatus.INFEASIBLE:
        return result
    if problem.model.is_coupled or not any(lack.family in MARGIN_FAMILIES for lack in result.lacks):
        return result
    for margin in (one for one in SMALLER_MARGINS if one < problem.limits.margin):
        smaller = replace(problem, limits=replace(problem.limits, margin=margin))
        found = solve_motion(smaller, lambda iterate: iterate.number < PATIENCE)
        if found.status is SolveStatus.SOLVED and check_motion(smaller, found.trajectory).confirmed:
            words = (
                f"Only the margin forbids it: with {margin * 1000:.0f} mm instead of "
                f"{problem.limits.margin * 1000:.1f} mm there is a motion."
            )
            *told, evidence = result.explanation
            return replace(result, explanation=(*told, words, evidence))
    return result


def solve_by_both(
    problem: MotionProblem, progress: Progress = lambda iterate: True, *, resume: bool = False
) -> MotionResult:
    """Solves a problem by the exact tier with its convex start; not for several threads at once.

    What the live tier proves needs no search. Where IPOPT finds no motion, the live tier's is the answer,
    marked as not optimal. Where that has none either and IPOPT does not say why, what the live tier proves or
    diagnoses is the answer.

    Args:
        problem: what is asked.
        progress: told of each iteration; false cancels.
        resume: whether to go on from the last solution where this problem is an edit of it.

    Returns:
        The exact tier's result; its seconds are those of both tiers.
    """
    live = solve_live(problem)
    if live.evidence is Evidence.PROVEN and are_footholds_given(problem):
        return live
    has_motion = _has_motion(problem, live)
    # Over several iterations its footholds are a guess, and a worse start than a drawing.
    start = live.trajectory if has_motion and are_footholds_given(problem) else None
    doubtful = live.status is SolveStatus.INFEASIBLE
    exact = solve_motion(problem, progress, start, resume=resume, doubtful=doubtful)
    if has_motion and start is None and exact.status in _WITHOUT:
        # A start with guessed footholds is slower as a rule, but it is a motion where IPOPT found none.
        exact = _after(exact, solve_motion(problem, progress, live.trajectory, resume=resume))
    if problem.cost is Cost.GOAL_EFFORT and exact.status in _WITHOUT:
        exact = _by_plain_cost(problem, progress, exact)
    merged = _after(live, exact)
    if exact.status not in _WITHOUT or exact.evidence is Evidence.PROVEN:
        return merged
    return _by_live(problem, merged, live) if has_motion else _told_by_both(merged, live)


def _by_plain_cost(problem: MotionProblem, progress: Progress, exact: MotionResult) -> MotionResult:
    """From the motion of the plain cost, where IPOPT found none under the cost with effort."""
    plain = solve_motion(replace(problem, cost=Cost.GOAL), progress)
    if plain.status is not SolveStatus.SOLVED:
        return exact
    return _after(exact, _after(plain, solve_motion(problem, progress, plain.trajectory)))


def _has_motion(problem: MotionProblem, live: MotionResult) -> bool:
    """Whether the live tier has a motion that the checker confirms."""
    return live.status is SolveStatus.SOLVED and check_motion(problem, live.trajectory).confirmed


def _after(first: MotionResult, second: MotionResult) -> MotionResult:
    """The second result with the seconds of both."""
    return replace(
        second,
        solve_seconds=first.solve_seconds + second.solve_seconds,
        build_seconds=first.build_seconds + second.build_seconds,
    )


def _by_live(problem: MotionProblem, exact: MotionResult, live: MotionResult) -> MotionResult:
    """The live tier's motion, with the course of the exact tier's search."""
    return replace(
        exact,
        status=SolveStatus.SOLVED,
        explanation=(NOT_OPTIMAL,),
        evidence=None,
        lacks=(),
        trajectory=live.trajectory,
        # The live tier knows no forces to count.
        objective=None if problem.cost is Cost.GOAL_EFFORT else live.objective,
    )


def _told_by_both(exact: MotionResult, live: MotionResult) -> MotionResult:
    """The exact tier's answer with what the live tier knows of it; the evidence comes last, once."""
    if live.status is not SolveStatus.INFEASIBLE:
        return exact
    *others, model = live.explanation
    evidence = f"{model} {OUTSIDE}" if live.evidence is Evidence.PROVEN else model
    if exact.status is SolveStatus.FAILED:
        return replace(
            exact,
            status=SolveStatus.INFEASIBLE,
            evidence=Evidence.DIAGNOSED,
            explanation=(*others, evidence),
            lacks=live.lacks,
            trajectory=live.trajectory,
        )
    *own, _ = exact.explanation
    added = [sentence for sentence in others if sentence not in own]
    if added:
        added.insert(0, "In the model of the live plan the following is missing.")
    return replace(exact, explanation=(*own, *added, evidence), lacks=exact.lacks or live.lacks)
