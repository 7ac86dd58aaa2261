"""The motion that a robot really made, as far as its strokes tell, on the plan's time axis."""

import numpy as np

from app.runs.record import RunRecord
from core.errors import StateError
from core.motion.trajectory import Trajectory
from core.runs.pose import measured_motion, standing_feet
from core.runs.reading import SentWaypoint


def measured_trajectory(record: RunRecord) -> Trajectory:
    """Body and feet at the waypoints that were reached, in the first iteration that reached any.

    Raises:
        StateError: fewer than two waypoints were reached.
    """
    plan = record.plan
    reached = _growing(record)
    if len(reached) < 2:
        raise StateError(
            "The run reached fewer than two waypoints: there is no motion to be shown.", record.content["id"]
        )
    times = plan.times[[command.index for command in reached]]
    strokes = np.array([command.measured_mm for command in reached]) / 1000.0
    before = np.concatenate([times[:1], times[:-1]])
    motion = measured_motion(plan, strokes.reshape(len(times), -1, 3), times, before)
    com = np.array(motion.pose.position_world)
    com[:, 2] += plan.model.com_height
    return Trajectory(
        times=times,
        body_world=com,
        heading=motion.pose.heading,
        feet_world=motion.feet_world,
        contact=standing_feet(plan.trajectory, times),
    )


def _growing(record: RunRecord) -> list[SentWaypoint]:
    """Commands of one iteration that were reached, each later in the plan than the one before."""
    reached = [command for command in record.series.streamed if command.is_reached]
    kept: list[SentWaypoint] = []
    for command in reached:
        is_later = not kept or record.plan.times[command.index] > record.plan.times[kept[-1].index] + 1e-9
        if command.lap == reached[0].lap and is_later:
            kept.append(command)
    return kept
