"""Where the feet of a trial were to be, and what the robot was sent: of a run, or of a gait as it is now."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.plans.plan import Plan
from app.runs.plan_json import ran_plan, sent_content
from app.runs.record import RunRecord
from app.store.tables.table import reading
from core.arrays import Floats
from core.errors import StateError
from core.gait.gait import Gait
from core.motion.trajectory import Trajectory
from core.physics.masses import default_physics
from core.physics.problem import SimulationProblem
from core.trials.alignment import repeated_motion


@dataclass(frozen=True, eq=False)
class PlannedFeet:
    """Where a motion's feet were to be, kept with the trial, since gaits change.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) x, y, m.
        laps: how often the motion was to be done.
        sent: the waypoints of one lap with their motion (`app.runs.plan_json.sent_content`); None where
            they are not known.
        lap_seconds: how long a lap takes, s; None where the times hold exactly the laps.
    """

    times: Floats
    feet: Floats
    laps: int = 1
    sent: Mapping[str, Any] | None = None
    lap_seconds: float | None = None


def planned_of_run(record: RunRecord) -> PlannedFeet:
    """What a run was to do, as often as it did it."""
    plan = record.plan
    laps = 1 + max((command.lap for command in record.series.streamed), default=0)
    return _planned(
        plan.trajectory, laps, sent_content(plan.model, plan.waypoints, plan.times, plan.trajectory)
    )


def planned_of_gait(gait: Gait, plan: Plan, iterations: int) -> PlannedFeet:
    """What a gait is planned to do now, walked as often as it fits a trial.

    Args:
        gait: the document.
        plan: what it amounts to.
        iterations: of the trial.

    Raises:
        StateError: the gait has no motion.
    """
    if plan.trajectory is None:
        raise StateError(
            "This gait has no motion yet, so there is nothing to compare the trial with.", "gait"
        )
    laps, rest = divmod(iterations, gait.iterations)
    sent = None
    if plan.way is not None:
        sent = sent_content(plan.model, plan.way.waypoints, plan.way.times, plan.trajectory)
    return _planned(plan.trajectory, 1 if rest else laps, sent)


def _planned(trajectory: Trajectory, laps: int, sent: Mapping[str, Any] | None) -> PlannedFeet:
    count = max(laps, 1)
    return PlannedFeet(*repeated_motion(trajectory.times, trajectory.feet_world[..., :2], count), count, sent)


SAME_TIME = 1e-6
"""Times nearer to each other are one, s."""


def sent_problem(content: Mapping[str, Any]) -> SimulationProblem:
    """What physics is asked of waypoints that were sent, with the robot's usual parameters.

    A foot counts as standing at a waypoint where it stands by the plan at the knots on both sides of it, and
    along a move where it stands at all knots from the one's to the other's. The motion depends on neither.

    Args:
        content: as `PlannedFeet.sent`.

    Raises:
        DamagedRowError: something in it is missing or of another kind.
    """
    with reading("What the robot was sent cannot be read: "):
        return _sent_problem(content)


def _sent_problem(content: Mapping[str, Any]) -> SimulationProblem:
    plan = ran_plan(dict(content))
    trajectory, knots = plan.trajectory, plan.trajectory.times
    first = np.maximum(np.searchsorted(knots, plan.times + SAME_TIME, side="right") - 1, 0)
    last = np.minimum(np.searchsorted(knots, plan.times - SAME_TIME, side="left"), knots.size - 1)
    contact = [trajectory.contact[a : b + 1].all(axis=0) for a, b in zip(first, last, strict=True)]
    begins = [int(first[0]), *first[:-1].tolist()]
    standing = [trajectory.contact[a : b + 1].all(axis=0) for a, b in zip(begins, last, strict=True)]
    return SimulationProblem(
        plan.model,
        plan.waypoints,
        trajectory,
        plan.times,
        np.array(contact),
        np.array(standing),
        default_physics(plan.model),
    )
