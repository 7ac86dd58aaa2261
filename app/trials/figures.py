"""A trial's figures as JSON content, in centimetres and degrees as their sources have them."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from app.common.json import Json
from core.arrays import Floats
from core.robot.model import load_robot
from core.trials.alignment import Alignment, placed_motion
from core.trials.iterations import FoundIterations, IterationMovement, iteration_movements, standing_slip
from core.trials.movement import Movement, foot_movements, mean_movement
from core.vision.track import FootTrack

ROBOT = "deltawalker"
"""The one robot that stands on a platform (its cable's robot)."""
FIGURES = (
    "net_distance",
    "net_angle_deg",
    "net_error_percent",
    "distance",
    "angle_deg",
    "error_percent",
    "extent_distance",
)
"""Keys of a movement's figures: the net ones by which a trial is known, and those of published tables."""
PACE = ("seconds", "speed_mm_s", "body_lengths_s")
"""Keys of a movement's time and speed."""
CM = 100.0
"""Centimetres in a metre."""


def movement_content(movement: Movement) -> dict[str, float]:
    """A movement in centimetres, degrees and percent."""
    return {
        "plus_x": movement.plus_x * CM,
        "minus_x": movement.minus_x * CM,
        "dx": movement.dx * CM,
        "plus_y": movement.plus_y * CM,
        "minus_y": movement.minus_y * CM,
        "dy": movement.dy * CM,
        "distance": movement.distance * CM,
        "angle_deg": math.degrees(movement.angle),
        "error_percent": movement.error * 100.0,
        "net_distance": movement.net_distance * CM,
        "net_angle_deg": math.degrees(movement.net_angle),
        "net_error_percent": movement.net_error * 100.0,
        "extent_distance": movement.extent_distance * CM,
    }


def feet_content(feet: Sequence[Movement]) -> Json:
    """The mean of the feet's movements, with each foot's beside it."""
    return {**movement_content(mean_movement(feet)), "feet": [movement_content(foot) for foot in feet]}


def pace_content(mean: Movement, seconds: float) -> dict[str, float]:
    """Time, and the net distance a second.

    Args:
        mean: of the feet.
        seconds: how long the movement took.

    Returns:
        `speed_mm_s`, and the same in lengths of the robot's body (its plate, across).
    """
    speed = mean.net_distance / seconds
    length = load_robot(ROBOT).shape.plate_across
    return {"seconds": seconds, "speed_mm_s": speed * 1000.0, "body_lengths_s": speed / length}


def part_content(part: IterationMovement, end: int) -> Json:
    """An iteration: the mean of its columns, its time, its speed and its last frame."""
    return {**movement_content(part.mean), **pace_content(part.mean, part.seconds), "end": end}


def step_content(part: IterationMovement) -> dict[str, float]:
    """An iteration as the published tables of single steps have it: distance and angle are the net ones."""
    content = movement_content(part.mean)
    return {
        "dx": content["dx"],
        "dy": content["dy"],
        "distance": content["net_distance"],
        "angle_deg": content["net_angle_deg"],
        "error_percent": content["net_error_percent"],
        **pace_content(part.mean, part.seconds),
    }


def mean_content(rows: Sequence[Mapping[str, float]]) -> dict[str, float] | None:
    """The mean of each figure; None of no rows."""
    return {key: float(np.mean([row[key] for row in rows])) for key in rows[0]} if rows else None


def track_content(track: FootTrack, expected: float, found: FoundIterations, ends: tuple[int, ...]) -> Json:
    """Everything that a track tells by itself.

    Args:
        track: all frames.
        expected: wanted distance of the whole walk, m.
        found: its iterations as the feet tell them.
        ends: last frame of each iteration as they count.
    """
    parts = iteration_movements(track, ends, expected / len(ends))
    feet = foot_movements(track, expected)
    return {
        "frames": int(track.times.size),
        **pace_content(mean_movement(feet), track.seconds),
        "filled": int(track.filled.sum()),
        "gaps": [{"foot": foot + 1, "first": first, "last": last} for foot, first, last in track.gaps],
        "figures": feet_content(feet),
        "parts": [part_content(part, end) for part, end in zip(parts, ends, strict=True)],
        "step_mean": mean_content([step_content(part) for part in parts]),
        "is_clear": found.is_clear,
        "found_ends": list(found.ends),
        "slip": (standing_slip(track, found.steps) * CM).tolist(),
    }


def plan_content(times: Floats, feet_world: Floats, alignment: Alignment, expected: float) -> Json:
    """A planned or simulated motion by the same definitions, and how it was laid over the track.

    Args:
        times: (n,) s.
        feet_world: (n, feet, 2 or 3) m.
        alignment: how it lies in the track's frame.
        expected: wanted distance of the whole walk, m.
    """
    placed = placed_motion(times, feet_world, alignment)
    return {
        "turn_deg": math.degrees(alignment.turn),
        "gaps_cm": (alignment.gaps * CM).tolist(),
        "figures": feet_content(foot_movements(placed, expected)),
    }


def path_content(track: FootTrack, most: int) -> Json:
    """Each foot's way for a plot, thinned to about `most` places, cm; frames, and their shares of time."""
    every = max(1, -(-track.times.size // most))
    kept = np.unique(np.append(np.arange(0, track.times.size, every), track.times.size - 1))
    ways = np.round(track.feet[kept] * CM, 3)
    feet = [
        {"x": ways[:, foot, 0].tolist(), "y": ways[:, foot, 1].tolist()} for foot in range(track.foot_count)
    ]
    shares = (track.times[kept] - track.times[0]) / (track.times[-1] - track.times[0])
    return {"frames": kept.tolist(), "shares": np.round(shares, 5).tolist(), "feet": feet}
