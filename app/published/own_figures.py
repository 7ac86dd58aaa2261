"""Figures of our own gait of a published row."""

from app.common.json import Json
from app.published.figures import (
    PACE,
    SIMULATED,
    Tools,
    fall_sentence,
    figures_content,
    joined,
    physics_of,
    tracking_figures,
    walk_ways,
)
from app.published.own_gait import OwnGait, own_gait
from app.published.problems import own_problem
from app.published.walk_figures import movement_figures, track_of_motion
from app.published.walked import walked_motion
from app.simulation.problem import simulation_problem
from core.errors import CheckError
from core.motion.trajectory import Trajectory
from core.published.gaits import published_gait
from core.published.tables import Kind, PublishedRow, PublishedTable
from core.wire.robot_time import estimate_seconds


def own_figures(table: PublishedTable, row: PublishedRow, tools: Tools) -> Json:
    """Makes our gait's plan, simulates it, and gives the content that is kept.

    Args:
        table: of the row.
        row: which one.
        tools: what solves and simulates.
    """
    try:
        own = own_gait(published_gait(table, row), tools.solve)
    except CheckError as refusal:
        return figures_content({}, f"Our gait cannot be made. {refusal.sentence}", is_refused=True)
    margin = {"margin_mm": None if own.margin is None else own.margin * 1000}
    if table.kind is Kind.PACE:
        return figures_content({PACE: _pace(own) | margin}, own.sentence)
    if table.kind in SIMULATED:
        problem = own_problem(_motion(own), physics_of(table.kind))
    else:
        problem = simulation_problem(own.plan, physics_of(table.kind))
    motion = tools.simulate(problem)
    walk = walked_motion(problem, motion)
    sentence = joined(own.sentence, fall_sentence("Our gait", walk))
    if table.kind in SIMULATED:
        figures, ways = tracking_figures(walk), walk_ways(walk)
    else:
        iterations = row.gait.iterations
        track = track_of_motion(motion, own.gait.orientation)
        figures, ways = movement_figures([track], row.gait.step * iterations, iterations), None
    ours = {definition: values | margin for definition, values in figures.items()}
    return figures_content(ours, sentence, ways)


def _motion(own: OwnGait) -> Trajectory:
    if own.plan.trajectory is None:
        raise CheckError("The plan has no motion.", "plan")
    return own.plan.trajectory


def _pace(own: OwnGait) -> dict[str, float | None]:
    if own.plan.way is None:
        raise CheckError("The plan has no waypoints.", "plan")
    seconds = estimate_seconds(own.plan.way.waypoints)
    return {"seconds": seconds, "speed_mm_s": own.plan.advance[0] * 1000 / seconds}
