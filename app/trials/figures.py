"""A trial's figures as JSON content, in centimetres and degrees as their sources have them."""

import math
from collections.abc import Sequence

import numpy as np

from app.common.json import Json
from core.arrays import Floats
from core.trials.alignment import Alignment, placed_motion
from core.trials.iterations import FoundIterations, IterationMovement, iteration_movements, standing_slip
from core.trials.movement import Movement, foot_movements, mean_movement
from core.vision.track import FootTrack

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


def part_content(part: IterationMovement, end: int, body_length: float | None = None) -> Json:
    """An iteration: the mean of its columns, its time and its speed.

    Args:
        part: the iteration.
        end: its last frame.
        body_length: of the robot, m; None where it is not known.
    """
    content = {**movement_content(part.mean), "seconds": part.seconds, "speed_mm_s": part.speed * 1000.0}
    lengths = None if body_length is None else part.speed / body_length
    return {**content, "body_lengths_s": lengths, "end": end}


def track_content(
    track: FootTrack, expected: float, found: FoundIterations, ends: tuple[int, ...], body_length: float
) -> Json:
    """Everything that a track tells by itself.

    Args:
        track: all frames.
        expected: wanted distance of the whole walk, m.
        found: its iterations as the feet tell them.
        ends: last frame of each iteration as they count.
        body_length: of the robot, m.
    """
    parts = iteration_movements(track, ends, expected / len(ends))
    return {
        "frames": int(track.times.size),
        "seconds": float(track.times[-1] - track.times[0]),
        "filled": int(track.filled.sum()),
        "gaps": [{"foot": foot + 1, "first": first, "last": last} for foot, first, last in track.gaps],
        "figures": feet_content(foot_movements(track, expected)),
        "parts": [part_content(part, end, body_length) for part, end in zip(parts, ends, strict=True)],
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
