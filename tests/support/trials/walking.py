"""A walk by hand as a trial's plan, and a track of a robot that did just that."""

from __future__ import annotations

import numpy as np

from app.runs.plan_json import sent_content
from app.trials.planned import PlannedFeet
from core.trials.alignment import repeated_motion
from core.vision.track import FootTrack
from tests.support.simulated_walk import walk_plan


def walk_planned(laps: int = 1, knows_sent: bool = True) -> PlannedFeet:
    plan, way = walk_plan(), walk_plan().way
    assert plan.trajectory is not None
    assert way is not None
    sent = sent_content(plan.model, way.waypoints, way.times, plan.trajectory) if knows_sent else None
    motion = plan.trajectory.times, plan.trajectory.feet_world[..., :2]
    return PlannedFeet(*repeated_motion(*motion, laps), laps, sent)


def walked(laps: int = 1) -> FootTrack:
    """A robot that did exactly as planned, on a platform that lies turned by 90°."""
    planned = walk_planned(laps)
    frames = np.linspace(planned.times[0], planned.times[-1], int(13 * planned.times[-1]))
    flat = planned.feet.reshape(len(planned.times), -1).T
    feet = np.stack([np.interp(frames, planned.times, way) for way in flat], axis=-1).reshape(-1, 4, 2)
    return FootTrack(frames, feet @ np.array([[0.0, 1.0], [-1.0, 0.0]]), np.zeros(feet.shape[:2], dtype=bool))
