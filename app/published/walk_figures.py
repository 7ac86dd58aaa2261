"""Distance, angle and error of a walk's foot tracks, by each definition of the published tables."""

import math
from collections.abc import Sequence

import numpy as np

from app.published.figures import EXTENTS, STEP, TOTAL
from app.simulation.view import shown_samples
from core.arrays import Floats
from core.gait.gait import Orientation
from core.physics.motion import SimulatedMotion
from core.trials.alignment import repeated_motion
from core.trials.iterations import find_iterations, iteration_movements
from core.trials.movement import Movement, foot_movements, mean_movement
from core.vision.track import FootTrack

PLATFORM_TURN = {Orientation.FB: -math.pi / 4, Orientation.FBS: 0.0}
"""Turn of the robot on the platform in the published trials (T 5.1), rad."""


def track_of_motion(motion: SimulatedMotion, orientation: Orientation, laps: int = 1) -> FootTrack:
    """The foot track that a camera under the platform would have seen of a simulated robot.

    Args:
        motion: the simulation.
        orientation: of the gait, which says how the robot stood on the platform.
        laps: how often the motion was done, each time from where the one before ended.
    """
    kept = shown_samples(motion)
    times, feet = motion.times[kept] - motion.times[kept[0]], motion.feet_world[kept, :, :2]
    times, feet = repeated_motion(times, feet, laps)
    turned = feet @ _turning(PLATFORM_TURN[orientation]).T
    return FootTrack(times, turned, np.zeros(feet.shape[:2], dtype=np.bool_))


def _turning(angle: float) -> Floats:
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, -sine], [sine, cosine]])


def movement_figures(
    tracks: Sequence[FootTrack], wanted: float, iterations: int
) -> dict[str, dict[str, float | None]]:
    """Distance, angle and error of a walk by each definition; of a step where it has several iterations.

    Args:
        tracks: of its trials, or the one of a simulation.
        wanted: distance of the whole walk, m.
        iterations: that each track holds.

    Raises:
        InputError: a track is too short for its iterations.
    """
    whole = mean_movement([mean_movement(foot_movements(track, wanted)) for track in tracks])
    angle = math.degrees(whole.angle)
    figures = {
        TOTAL: _figures(whole.distance, angle, whole.error),
        EXTENTS: _figures(whole.extent_distance, angle, whole.extent_distance / wanted - 1.0),
    }
    if iterations > 1:
        step = mean_movement([_mean_step(track, wanted / iterations, iterations) for track in tracks])
        figures[STEP] = _figures(step.net_distance, math.degrees(step.net_angle), step.net_error)
    return figures


def _mean_step(track: FootTrack, wanted: float, iterations: int) -> Movement:
    ends = find_iterations(track, iterations).ends
    return mean_movement([part.mean for part in iteration_movements(track, ends, wanted)])


def _figures(distance: float, angle_deg: float, error: float) -> dict[str, float | None]:
    return {"distance_cm": distance * 100, "angle_deg": angle_deg, "error_percent": error * 100}
