"""The search for a gait's fastest timing: what is asked, and what the page is shown of the answer."""

from dataclasses import replace

from app.common.json import Json, finite
from app.documents.gait_json import gait_content
from core.errors import FootfallError, StateError
from core.gait.gait import Gait
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem
from core.wire.robot_time import estimate_seconds
from core.wire.waypoint_merging import plan_waypoints
from solver_jobs import SolveStatus, TimingResult


def timing_problem(gait: Gait, problem: MotionProblem) -> MotionProblem:
    """The gait's problem with the motors' limits, without which stances shrink to nothing.

    Raises:
        StateError: the gait turns; its heading belongs to the timing as drawn.
    """
    if gait.step[2] != 0.0:
        raise StateError("The fastest timing is for gaits that do not turn; set the turn to 0.", "step")
    stroke, limits = problem.model.stroke, problem.limits
    return replace(
        problem,
        limits=replace(
            limits,
            motor_speed=limits.motor_speed or stroke.speed,
            motor_acceleration=limits.motor_acceleration or stroke.acceleration,
        ),
    )


def timed_gait(gait: Gait, result: TimingResult) -> Gait | None:
    """The gait in the timings found, with the motors' limits that they rest on; None where none is usable."""
    if result.usable_timeline is None:
        return None
    limits = result.problem.limits
    options = replace(
        gait.options, motor_speed=limits.motor_speed, motor_acceleration=limits.motor_acceleration
    )
    return replace(gait, timeline=result.usable_timeline, options=options)


def _robot_seconds(timed: Gait, result: TimingResult) -> float | None:
    """What the robot takes for the usable motion as it is sent, s; None where it cannot be sent."""
    if result.usable is None:
        return None
    options = timed.options
    try:
        way = plan_waypoints(
            result.problem.model, result.usable.trajectory, options.merge, options.stop_bound
        )
    except FootfallError:
        return None
    return round(estimate_seconds(way.waypoints), 1)


def timing_content(gait: Gait, result: TimingResult) -> Json:
    """A timing as JSON content, with the gait's document in these timings where they can be used.

    Args:
        gait: as it was when the search began.
        result: of the search, whose motion the checker has confirmed where it is solved.
    """
    check = check_motion(result.problem, result.trajectory)
    usable = None
    if (timed := timed_gait(gait, result)) is not None:
        usable = {
            "seconds": float(timed.timeline.times[-1]),
            "robot_seconds": _robot_seconds(timed, result),
            "sample_time": timed.timeline.sample_time,
            "document": gait_content(timed),
        }
    # The motion of a search that broke off is no motion: how far it is off says nothing.
    solved = result.status is SolveStatus.SOLVED
    figures = {
        "status": result.status.value,
        "iterations": result.iterations,
        "solve_seconds": result.solve_seconds,
        "total_seconds": result.total_seconds,
        "drawn_seconds": result.drawn_seconds,
        "phases": [
            {"first": phase.first, "last": phase.last, "seconds": phase.seconds} for phase in result.phases
        ],
        "max_violation": check.max_violation if solved else None,
        "min_cop_margin": check.min_cop_margin if solved else None,
        "explanation": list(result.explanation),
        "usable": usable,
    }
    content: Json = finite(figures)
    return content
