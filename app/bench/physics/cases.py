"""The gaits that the physics is measured by: as published, our own, and made to tip."""

from dataclasses import replace

import numpy as np

from app.bench.common.cases import Case, all_cases
from app.plans.verified_result import verify
from app.published.problems import own_problem, walker
from core.arrays import Floats, interpolated
from core.gait.gait import drawn_timeline, motion_problem
from core.gait.manual_motion import manual_motion
from core.library.library import manual_entry
from core.motion.trajectory import Trajectory
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem
from core.problem.motion_problem import Workspace
from solver_jobs import SolveStatus, solve_exact

MARGINS = (0.003, 0.0025, 0.002, 0.001, 0.0)
"""Stability margins that are asked for, m; the first one that has a motion counts."""

TIPPING = -0.005
"""Margin of a gait made to tip, m."""


def solved_cases(group: str) -> dict[str, tuple[float, Trajectory]]:
    """Our own gaits of a group of cases, each with the largest margin that has a motion, m.

    Args:
        group: `steps` or `paper`; the whole workspace, with the closing stance.
    """
    chosen = [
        case
        for case in all_cases()
        if case.group == group
        and case.gait.options.workspace is Workspace.STROKE
        and case.gait.options.closing_knots
    ]
    solved = {case.name: solved_case(case) for case in chosen}
    return {name: found for name, found in solved.items() if found is not None}


def solved_case(case: Case) -> tuple[float, Trajectory] | None:
    """Margin and checked motion of one case, or None where none of the margins has one."""
    for margin in MARGINS:
        gait = replace(case.gait, options=replace(case.gait.options, margin=margin))
        gait = replace(gait, timeline=drawn_timeline(gait))
        problem = motion_problem(gait, walker())
        found = verify(problem, solve_exact(problem))
        if found.status is SolveStatus.SOLVED:
            return margin, found.trajectory
    return None


def manual_problem(family: str, version: int, physics: PhysicsSet) -> SimulationProblem:
    """A gait made by hand, one waypoint a sample."""
    return own_problem(manual_motion(manual_entry(family, version).gait, walker()).trajectory, physics)


def tipping(motion: Trajectory, margin: float = TIPPING) -> Trajectory:
    """A motion whose body leans out over the line of the lifted foot's neighbours in every swing.

    Args:
        motion: of a four-legged robot, one foot in the air at a time.
        margin: of the centre of mass over that line while the foot is up, m; negative is outside.
    """
    shift = np.full((motion.knot_count, 2), np.nan)
    for knot in np.nonzero(~motion.contact.all(axis=1))[0]:
        shift[knot] = _shift_out(motion, int(knot), margin)
    shift[[0, -1]] = 0.0
    known = np.isfinite(shift[:, 0])
    body = motion.body_world.copy()
    body[:, :2] += interpolated(motion.times, motion.times[known], shift[known])
    return Trajectory(motion.times, body, motion.heading, motion.feet_world, motion.contact)


def _shift_out(motion: Trajectory, knot: int, margin: float) -> Floats:
    """(2,) what takes the body of a knot to a margin over the line of the lifted foot's neighbours, m."""
    feet, legs = motion.feet_world[knot, :, :2], motion.leg_count
    lifted = int(np.argmin(motion.contact[knot]))
    start, end = feet[(lifted - 1) % legs], feet[(lifted + 1) % legs]
    along = (end - start) / np.linalg.norm(end - start)
    outwards = np.array([along[1], -along[0]])
    outwards *= np.sign(outwards @ (feet[lifted] - start))
    inside = -float(outwards @ (motion.body_world[knot, :2] - start))
    return np.asarray((inside - margin) * outwards)
