"""A gait of an atlas in physics: solved again, walked with the usual parameters and with variations."""

from collections.abc import Callable

import numpy as np

from core.atlas.physics_row import PhysicsRow
from core.atlas.row import AtlasRow
from core.atlas.space import AtlasKind, AtlasSpace
from core.errors import CheckError
from core.physics.masses import default_physics
from core.physics.metrics import report as report_of
from core.physics.pose_gait_problem import pose_gait_problem
from core.physics.problem import SimulationProblem
from solver_jobs.atlas.draw import drawn_points
from solver_jobs.atlas.evaluate import pose_gaits
from solver_jobs.physics.simulate import simulate, simulate_variations

SEED = 0
"""Of the variations; `footfall simulate` has the same by default."""
OWN_SHARE = 0.15
"""Of a gait's computing time, with the parameters as they are."""
DIFFERS = "Solved again, its motion differs from its row."


def simulated_row(
    space: AtlasSpace,
    stored: AtlasRow,
    variations: int,
    progress: Callable[[float], bool] = lambda share: True,
) -> PhysicsRow:
    """What physics makes of a solved gait; the same in every process.

    A gait for the robot's clock is a cycle in mid-walk, which is repeated from its own first pose. A drawn
    gait is simulated as a whole.

    Args:
        space: that it is of.
        stored: its row.
        variations: how many variations of the parameters are tried.
        progress: told the share that is done; False cancels.

    Raises:
        SimulationCancelledError: `progress` said so.
    """
    problem = simulation_problem(space, stored)
    if problem is None:
        return PhysicsRow(stored.number, variations, DIFFERS)
    try:
        figures = report_of(problem, simulate(problem, lambda share: progress(share * OWN_SHARE)))
        runs = simulate_variations(
            problem,
            variations,
            SEED,
            lambda share: progress(OWN_SHARE + share * (1.0 - OWN_SHARE)),
            threads=1,
        )
    except CheckError as error:
        return PhysicsRow(stored.number, variations, error.sentence)
    seconds = max(float(figures.arrival_times[-1] - figures.arrival_times[0]), np.finfo(float).tiny)
    return PhysicsRow(
        stored.number,
        variations,
        walked=sum(run.walks for run in runs) / len(runs),
        simulated_speed=figures.way.made / seconds,
        simulated_turn_rate=figures.heading / seconds,
        max_tilt=figures.max_tilt,
        swing_load=float(figures.swing_load.max()),
        slip=float(figures.slip.max()),
    )


def simulation_problem(space: AtlasSpace, stored: AtlasRow) -> SimulationProblem | None:
    """What physics is asked of a solved gait; None where its motion now differs from its row.

    Args:
        space: that it is of.
        stored: its row.
    """
    (point,) = drawn_points(space, stored.number, 1)
    model = space.model(point.numbers)
    if space.kind is AtlasKind.FAST:
        gait, row = pose_gaits(space, [point])[0]
        return pose_gait_problem(gait) if gait is not None and row.agrees_with(stored) else None
    from solver_jobs.atlas.drawn_gaits import drawn_plan, planned_row

    drawn = drawn_plan(point, model)
    if isinstance(drawn, AtlasRow) or not planned_row(point.number, model, *drawn).agrees_with(stored):
        return None
    motion, way = drawn
    physics = default_physics(model)
    return SimulationProblem(model, way.waypoints, motion, way.times, way.contact, way.standing, physics)
