"""Short moves made long where that costs nothing: the board often ramps twice for short ones."""

import numpy as np

from core.arrays import SAME, first_highest
from core.pose_gaits.pose_problem import SHORTEST_MOVE
from core.pose_gaits.start_motion import MM
from solver_jobs.pose_gaits.pose_program import PoseProgram
from solver_jobs.pose_gaits.program import Attempt
from solver_jobs.pose_gaits.runs import Forced, Runs, pace_of

LENGTHENING_ITERATIONS = 60
"""IPOPT gets this many to make short moves long; where it needs more it stalls."""
LENGTHENINGS = 3
"""Times that short moves are made long."""
NEARLY_LONG = 0.02
"""A move that is shorter than `SHORTEST_MOVE` by less than this is long enough, mm."""
WORTH = 0.995
"""Longer moves are taken where the gait stays this fast by the law: the board has fewer second ramps then."""


def lengthened(runs: Runs, program: PoseProgram, best: Attempt) -> tuple[Attempt, Forced]:
    """The gait with moves of at least `SHORTEST_MOVE` where the law calls it as fast, and the motors so kept.

    The program counts a shorter move as if it were that long; the board ramps twice for it instead.
    """
    run = runs.of(program)
    kept: Forced = ()
    forced: Forced = ()
    if runs.problem.largest_move <= SHORTEST_MOVE:
        return best, kept
    for number in range(LENGTHENINGS):
        short = _short_moves(program, best)
        if not short:
            break
        runs.tell("Making short moves long", 0.7 + 0.03 * number)
        forced = (*forced, *short)
        attempt = run(
            best.values,
            runs.weights,
            reach=runs.reach,
            forced=forced,
            most_iterations=LENGTHENING_ITERATIONS,
        )
        if not attempt.converged or pace_of(program, attempt) < WORTH * pace_of(program, best):
            break
        best, kept = attempt, forced
    return best, kept


def _short_moves(program: PoseProgram, attempt: Attempt) -> Forced:
    """The largest motor of each move that is shorter than `SHORTEST_MOVE`."""
    strokes = program.gait(attempt.values).strokes.reshape(program.problem.move_count + 1, -1) * MM
    changes = np.diff(strokes, axis=0)
    largest = first_highest(np.abs(changes), SAME * MM, axis=1)
    return tuple(
        (move, int(motor), 1 if changes[move, motor] >= 0 else -1)
        for move, motor in enumerate(largest)
        if abs(changes[move, motor]) < SHORTEST_MOVE * MM - NEARLY_LONG
    )
