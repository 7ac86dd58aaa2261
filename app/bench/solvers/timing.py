"""The shortest timing of the built-in gaits, beside the timing as drawn."""

from collections.abc import Sequence
from dataclasses import replace

from app.bench.common.measure import Row
from core.gait.gait import Gait, drawn_timeline, motion_problem
from core.library.library import library
from core.problem.motion_check import check_motion
from core.robot.model import RobotModel, load_robot
from solver_jobs import TimingResult, fastest_timing

GAITS = ("walk", "amble", "s-gait", "c-gait")
PHASE_KNOTS = (4, 5, 6, 8)
"""Knots a phase: with few of them long intervals flatter, because balance holds at knots."""

MARGIN = 0.003
"""Of every gait here, m."""


def bench_timing(gaits: Sequence[str] = GAITS, phase_knots: Sequence[int] = PHASE_KNOTS) -> list[Row]:
    """10 mm steps with 3 mm margin and clearance, with the motors' limits and without."""
    return [
        _row(name, knots, limited)
        for name in gaits
        for knots in phase_knots
        for limited in (True, False)
        if limited or knots == PHASE_KNOTS[1]
    ]


def _row(name: str, knots: int, limited: bool) -> Row:
    gait = library()[name].gait
    model = load_robot(gait.robot)
    problem = motion_problem(_asked(gait, model, knots, limited), model)
    timing = fastest_timing(problem)
    check = check_motion(timing.problem, timing.trajectory)
    return {
        "gait": name,
        "motor_limits": "15 mm/s, 15 mm/s²" if limited else "none",
        "phase_knots": knots,
        "status": timing.status.value,
        "drawn_s": round(timing.drawn_seconds, 1),
        "fastest_s": round(timing.total_seconds, 2),
        "swings_s": _swings(timing),
        "solve_s": round(timing.solve_seconds, 2),
        "iterations": timing.iterations,
        "violation": f"{check.max_violation:.0e}",
    }


def _asked(gait: Gait, model: RobotModel, knots: int, limited: bool) -> Gait:
    limits = (model.stroke.speed, model.stroke.acceleration) if limited else (None, None)
    options = replace(
        gait.options,
        margin=MARGIN,
        phase_knots=knots,
        closing_knots=knots,
        motor_speed=limits[0],
        motor_acceleration=limits[1],
    )
    changed = replace(gait, options=options)
    return replace(changed, timeline=drawn_timeline(changed))


def _swings(timing: TimingResult) -> str:
    """Shortest and longest swing, s."""
    stance = timing.problem.timeline.stance
    seconds = [phase.seconds for phase in timing.phases if not stance[:, phase.first].all()]
    return f"{min(seconds):.2f} to {max(seconds):.2f}"
