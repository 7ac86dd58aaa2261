"""The fastest gait whose arms keep apart: it is looked for anew with rows where arms came too near."""

import numpy as np

from core.pose_gaits.motion_in_move import least_arm_distance
from core.pose_gaits.pose_check import rest_strokes
from core.pose_gaits.pose_problem import PoseProblem
from core.pose_gaits.start_motion import MM
from core.robot.arms import arm_gaps
from solver_jobs.pose_gaits.arms import NEAR, ArmPlace, ArmRows, Plane, near_arms
from solver_jobs.pose_gaits.pose_program import PoseProgram
from solver_jobs.pose_gaits.program import Attempt
from solver_jobs.pose_gaits.runs import Runs, pace_of

MOST_ARM_ROUNDS = 4
"""Times that a gait whose arms come too near is looked for anew."""
ARM_TOLERANCE = 0.00002
"""Less than this is no lack of room between arms, m; the check allows more."""
ARM_ROOM = 0.0001
"""Arms are kept this much farther apart than asked at the places that have rows, m."""
SAME_PACE = 1e-3
"""Starts that lead to gaits as near as this in speed lead to the same one."""


def fastest_apart(
    runs: Runs, program: PoseProgram, found: list[Attempt]
) -> tuple[PoseProgram, Attempt] | None:
    """The fastest gait whose arms keep apart, and its program. The arm limit only makes gaits slower.

    Args:
        runs: of the search.
        program: of the gaits that were found.
        found: the gaits, the fastest first.

    Returns:
        None where none of them can keep its arms apart.
    """
    best: tuple[PoseProgram, Attempt] | None = None
    for attempt in found:
        if best is not None and pace_of(program, attempt) < (1.0 + SAME_PACE) * pace_of(*best):
            break
        apart = _with_arms_apart(runs, program, attempt)
        if apart is not None and (best is None or pace_of(*apart) > (1.0 + SAME_PACE) * pace_of(*best)):
            best = apart
    return best


def _with_arms_apart(runs: Runs, program: PoseProgram, best: Attempt) -> tuple[PoseProgram, Attempt] | None:
    """The fastest gait near the one that was found whose arms keep apart, and its program."""
    asked, room = runs.problem.bounds.arm_distance, ARM_ROOM
    planes: dict[ArmPlace, Plane] = {}
    for number in range(MOST_ARM_ROUNDS):
        gait = program.gait(best.values)
        lacking = asked - least_arm_distance(gait)
        if asked == 0.0 or lacking <= ARM_TOLERANCE:
            break
        runs.tell("Keeping arms apart", 0.62 + 0.02 * number, gait)
        if planes and near_arms(gait, asked - NEAR).keys() <= planes.keys():
            # Between the places that have rows the arms come a little nearer.
            room += lacking
        planes |= near_arms(gait, asked + room)
        program = PoseProgram(runs.problem, gait.step, ArmRows(asked + room, planes))
        start = program.program.start
        start[: program.own_count] = best.values[: program.own_count]
        best = runs.of(program)(start, runs.weights, reach=runs.reach)
        if not best.converged:
            return None
    return program, best


def too_near_at_rest(problem: PoseProblem) -> str | None:
    """That arms are nearer than asked where the walk begins and ends; None where they are not."""
    asked = problem.bounds.arm_distance
    if problem.cycles is None or asked == 0.0:
        return None
    gap = float(np.nanmin(arm_gaps(problem.model, rest_strokes(problem.model)[None])))
    if gap >= asked:
        return None
    return (
        f"The arms of neighbouring legs are {gap * MM:.1f} mm apart in the standard stance, and "
        f"{asked * MM:g} mm are asked (--arm-distance). Ask for less."
    )
