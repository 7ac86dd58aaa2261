"""Figures by which a drawn gait and a gait for the robot's clock are compared."""

from dataclasses import dataclass

from app.plans.plan import Plan
from core.gait.gait import Gait, is_drawn
from core.pose_gaits.pose_check import PoseCheck
from core.pose_gaits.pose_gait import PoseGait
from core.wire.robot_time import estimate_seconds, move_estimates, stop_time
from core.wire.waypoint_merging import WaypointPlan

FEWEST_FOR_MIDDLE = 3
"""Iterations from which a plan has some that are neither the first nor the last."""
SAME_TIME = 1e-6
"""Times that differ by less are the same, s."""


@dataclass(frozen=True)
class WalkFigures:
    """What a robot makes of a gait, by the law of its time, SI.

    Args:
        cycle_seconds: of one cycle in mid-walk; None where it is not known.
        cycle_speed: way of a cycle a second in mid-walk, m/s; likewise.
        cycle_turn_rate: turn a second in mid-walk, rad/s; likewise.
        cycle_moves: messages of that cycle; likewise.
        seconds: of the whole gait, from rest to rest.
        speed: way a second from rest to rest, m/s.
        turn_rate: turn a second from rest to rest, rad/s.
        moves: messages of the whole gait, the first one left out, which is where the robot stands.
        distance: way of the body over the whole gait, m.
        turn: of the body over the whole gait, rad.
        margin: least stability margin, m; None where it is not known.
        stop_seconds: longest time until a stop takes effect.
    """

    cycle_seconds: float | None
    cycle_speed: float | None
    cycle_turn_rate: float | None
    cycle_moves: float | None
    seconds: float
    speed: float
    turn_rate: float
    moves: int
    distance: float
    turn: float
    margin: float | None
    stop_seconds: float


def plan_figures(gait: Gait, plan: Plan) -> WalkFigures | None:
    """Figures of a gait's present plan, as it would be sent; None where it cannot be sent.

    Where the plan has three iterations or more, a cycle in mid-walk is the mean of those within; else it is
    the mean of all, with the beginning from rest and the end at rest.

    Args:
        gait: the document, without poses.
        plan: of it.
    """
    way, trajectory = plan.way, plan.trajectory
    if way is None or trajectory is None or plan.is_draft:
        return None
    seconds = estimate_seconds(way.waypoints)
    distance, turn = plan.advance
    cycle_seconds, cycle_moves = _cycle(gait, way)
    return WalkFigures(
        cycle_seconds=cycle_seconds,
        cycle_speed=distance / gait.iterations / cycle_seconds,
        cycle_turn_rate=turn / gait.iterations / cycle_seconds,
        cycle_moves=cycle_moves,
        seconds=seconds,
        speed=distance / seconds,
        turn_rate=turn / seconds,
        moves=way.waypoints.count - 1,
        distance=distance,
        turn=turn,
        margin=plan.balance,
        stop_seconds=stop_time(way.waypoints),
    )


def _cycle(gait: Gait, way: WaypointPlan) -> tuple[float, float]:
    """Seconds and messages of a cycle."""
    seconds = move_estimates(way.waypoints)[1:]
    count, length = gait.iterations, 2 * gait.options.phase_knots * gait.timeline.leg_count
    if count < FEWEST_FOR_MIDDLE or not is_drawn(gait):
        return float(seconds.sum()) / count, len(seconds) / count
    period, ends = length * gait.timeline.sample_time, way.times[1:]
    within = (ends > period + SAME_TIME) & (ends <= (count - 1) * period + SAME_TIME)
    return float(seconds[within].sum()) / (count - 2), int(within.sum()) / (count - 2)


def pose_figures(walk: PoseGait, check: PoseCheck, cycle: PoseGait | None) -> WalkFigures:
    """Figures of poses that were found.

    Args:
        walk: all cycles, from the standard stance to rest.
        check: of the walk.
        cycle: one cycle in mid-walk; None where none was found.
    """
    seconds = estimate_seconds(walk.waypoints)
    turn = walk.turn * walk.problem.all_cycles
    return WalkFigures(
        cycle_seconds=None if cycle is None else cycle.seconds,
        cycle_speed=None if cycle is None else cycle.speed,
        cycle_turn_rate=None if cycle is None else cycle.turn_rate,
        cycle_moves=None if cycle is None else cycle.problem.move_count,
        seconds=seconds,
        speed=walk.distance / seconds,
        turn_rate=turn / seconds,
        moves=walk.problem.move_count,
        distance=walk.distance,
        turn=turn,
        margin=check.figures.margin,
        stop_seconds=stop_time(walk.waypoints),
    )
