"""The plan of any gait; that of a sequence is the plans of its parts, one after the other as one motion."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from app.documents.gait_json import motion_hash, sent_hash
from app.plans.make_plan import Solve, make_plan
from app.plans.plan import Plan, PlanSource, with_waypoints
from app.plans.sequence_parts import placed_parts, unplaced_parts
from app.plans.verified_result import verify
from core.errors import CheckError, FootfallError, InfeasibleError, InputError
from core.gait.chain import Chain, Piece
from core.gait.gait import Gait, motion_problem
from core.gait.manual_motion import stance_slip
from core.gait.transition import straight
from core.library.sequence import chain_runs, part_name, require_own, run_of
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem
from core.problem.start_footholds import SAME_PLACE
from core.robot.model import load_robot
from solver_jobs import SolveStatus

ResultFor = Callable[[Gait], dict[str, Any] | None]
"""Gives the stored result that a document has, where there is one."""
SolveFor = Callable[[Gait], Solve]
"""Gives what asks the live tier for a gait."""


def plan_of(gait: Gait, result_for: ResultFor, solve_for: SolveFor) -> Plan:
    """The plan of a gait, or of a sequence of gaits.

    Args:
        gait: the document.
        result_for: gives the stored result that a document has.
        solve_for: gives what asks the live tier where nothing else makes the plan.
    """

    def plan_single(single: Gait) -> Plan:
        return make_plan(single, result_for(single), solve_for(single))

    plan = sequence_plan(gait, plan_single, solve_for(gait)) if gait.sequence else plan_single(gait)
    return replace(plan, made_of=sent_hash(gait))


def run_motions(gait: Gait) -> frozenset[str]:
    """Hashes of the solved motions that a document's plan is made of: its own, or those of its parts.

    None where a part would run through too many iterations, so that there is no plan.
    """
    try:
        return frozenset(motion_hash(run) for run in _solved_runs(gait))
    except InputError:
        return frozenset()


def runs_without_result(gait: Gait, result_for: ResultFor) -> tuple[Gait, ...]:
    """The runs of a sequence, each once, that the exact tier can solve and of which it has no result yet.

    Raises:
        InputError: a part would run through too many iterations.
    """
    runs = {motion_hash(run): run for run in _solved_runs(gait)}
    return tuple(run for run in runs.values() if result_for(run) is None)


def _solved_runs(gait: Gait) -> list[Gait]:
    runs = [run_of(part).gait for part in gait.sequence] or [gait]
    return [run for run in runs if run.segment_table is None and run.recorded is None]


def sequence_plan(gait: Gait, plan_single: Callable[[Gait], Plan], solve: Solve) -> Plan:
    """The plan of a sequence; without a motion where one part has none, or two do not fit.

    Args:
        gait: the sequence.
        plan_single: makes the plan of one run.
        solve: asks the live tier for the steps between two parts.
    """
    model = load_robot(gait.robot)
    plans: list[Plan] = []
    alone: frozenset[int] = frozenset()
    try:
        plans += [plan_single(run_of(part).gait) for part in gait.sequence]
        alone = _with_motion_alone(gait, plans, plan_single)
        _require_motions(gait, plans, alone)
        motions = [plan.trajectory for plan in plans if plan.trajectory is not None]
        whole = chain_runs(gait, model, motions, partial(steps_between, solve))
        require_own(gait, whole)
    except FootfallError as refusal:
        return _drawn_plan(gait, plans, refusal, alone)
    t = whole.trajectory
    slip = stance_slip(t.feet_world, t.contact) if any(p.slip is not None for p in plans) else None
    seconds = [plan.seconds for plan in plans if plan.seconds is not None]
    return with_waypoints(
        Plan(
            PlanSource.SEQUENCE,
            _note(whole, len(plans)),
            model,
            t,
            None,
            None,
            slip=slip,
            seconds=sum(seconds) if seconds else None,
            parts=placed_parts(gait, plans, whole),
            clipped=whole.clipped([plan.clipped for plan in plans]),
        ),
        gait.options,
    )


def _drawn_plan(gait: Gait, plans: Sequence[Plan], refusal: FootfallError, alone: frozenset[int]) -> Plan:
    """A substitute for a plan without a motion: the parts in a row, with drawings for missing motions."""
    model, whole = load_robot(gait.robot), None
    if len(plans) == len(gait.sequence):
        with suppress(FootfallError):
            motions = [
                _shown_motion(run_of(p).gait, plan) for p, plan in zip(gait.sequence, plans, strict=True)
            ]
            whole = chain_runs(gait, model, motions, lambda before, piece, problem: straight(problem))
    t = None if whole is None else whole.trajectory
    parts = unplaced_parts(gait, plans) if whole is None else placed_parts(gait, plans, whole)
    parts = tuple(
        replace(part, has_own_motion=True) if part.part in alone and not part.is_transition else part
        for part in parts
    )
    # A solver that broke off between two parts is asked again like one that broke off in a part.
    if isinstance(refusal, CheckError) and parts:
        parts = (*parts[:-1], replace(parts[-1], broke_off=True))
    return Plan(PlanSource.DRAFT, refusal.sentence, model, t, None, refusal, parts=parts)


def _shown_motion(run: Gait, plan: Plan) -> Trajectory:
    if plan.trajectory is not None and plan.source is not PlanSource.DRAFT:
        return plan.trajectory
    return initial_guess(motion_problem(run, plan.model))


def steps_between(solve: Solve, before: Piece, piece: Piece, problem: MotionProblem) -> Trajectory:
    """The motion of the steps between two parts.

    Args:
        solve: the live tier.
        before: the part that ends.
        piece: the part that follows.
        problem: what is asked.

    Raises:
        InfeasibleError: there is none, naming the feet and how far each has to go.
        CheckError: the solver gave no answer that is confirmed.
    """
    verified = verify(problem, solve(problem))
    if verified.has_motion:
        return verified.trajectory
    ways = np.linalg.norm(problem.goal.feet_world - problem.start.feet_world, axis=1)
    feet = ", ".join(f"foot {f + 1} by {way * 1000:.1f} mm" for f, way in enumerate(ways) if way > SAME_PLACE)
    why = verified.explanation[0] if verified.explanation else "the live optimiser gave no answer."
    sentence = (
        f"Between {before.name} and {piece.name} feet have to step: {feet}. There is no motion for that: "
        f"{why} Let the first end where the second begins, or put a gait between them."
    )
    kind = InfeasibleError if verified.status is SolveStatus.INFEASIBLE else CheckError
    raise kind(sentence, "sequence")


def _with_motion_alone(
    gait: Gait, plans: Sequence[Plan], plan_single: Callable[[Gait], Plan]
) -> frozenset[int]:
    """The repeated parts without a motion whose gait, run once, has one that they can repeat from rest."""
    return frozenset(
        index
        for index, (part, plan) in enumerate(zip(gait.sequence, plans, strict=True))
        if not _has_motion(plan) and run_of(part).gait != part.gait and _has_motion(plan_single(part.gait))
    )


def _has_motion(plan: Plan) -> bool:
    return plan.trajectory is not None and plan.waypoints is not None and not plan.is_draft


def _require_motions(gait: Gait, plans: Sequence[Plan], alone: frozenset[int]) -> None:
    """Every part has a motion that may be sent.

    Args:
        gait: the sequence.
        plans: of its runs.
        alone: parts whose gait has a motion where it is run once.

    Raises:
        InfeasibleError: naming the first one that has none.
    """
    for index, (part, plan) in enumerate(zip(gait.sequence, plans, strict=True)):
        if _has_motion(plan):
            continue
        sentence = f"{part_name(index, part)}, has no motion: {_reason(plan)}"
        way = (
            "Run once, the gait has a motion: let each repetition start from rest."
            if index in alone
            else "Open the gait itself to see all that is missing."
        )
        raise InfeasibleError(f"{sentence} {way}", "sequence")


def _reason(plan: Plan) -> str:
    """The first of what is lacking, which is the worst."""
    if plan.live is not None and plan.live.explanation:
        return plan.live.explanation[0]
    return plan.note if plan.refusal is None else plan.refusal.sentence


def _note(whole: Chain, parts: int) -> str:
    moves = sum(span.is_transition for span in whole.spans)
    between = f", {moves} transition{'s' if moves > 1 else ''} in between" if moves else ""
    dx, dy = whole.travel * 1000
    turn = f" and turns {np.degrees(whole.turn):.0f}°" if abs(whole.turn) > 1e-6 else ""
    return (
        f"{parts} part{'s' if parts > 1 else ''} in {whole.trajectory.times[-1]:.1f} s{between}; the body "
        f"goes ({dx:.1f}, {dy:.1f}) mm{turn}."
    )
