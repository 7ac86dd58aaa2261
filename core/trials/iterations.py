"""When each iteration of a track ended, found from the feet's own steps."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats, interpolated
from core.errors import InputError
from core.trials.movement import Movement, foot_movements, mean_movement
from core.vision.track import FootTrack

SIDE_SECONDS = 1.5
"""A step is what lies between the mean places of a foot so long before and after, s."""
JITTER_SECONDS = 2.0
"""How far steps may come before or after an even pace while the pace itself is sought, s."""
SHORTEST_SHARE, LONGEST_SHARE = 0.75, 1.05
"""Pace of an iteration beside an even share of the track."""
SAME = 1e-6
"""Share by which intervals of an even rate differ at most."""
MOST_EVEN = 3
"""So many times as many frames as a film has, at most, make its rate even."""
LEAST_STEP = 1e-4
"""Floor under the logarithm of a step's size, m."""


@dataclass(frozen=True, eq=False)
class FoundIterations:
    """Where iterations end in a track.

    Args:
        steps: (feet, iterations) frame in the middle of each foot's step.
        ends: frame at which each iteration ends; the last is the track's last frame.
        is_clear: whether in each iteration every foot steps before any steps in the next.
    """

    steps: NDArray[np.int64]
    ends: tuple[int, ...]
    is_clear: bool


def find_iterations(track: FootTrack, count: int) -> FoundIterations:
    """Finds the iterations of a track in which every foot steps once an iteration, at an even pace.

    Each foot's way along the whole robot's direction is held against itself some seconds later, which is
    large at a step; of all paces and beginnings the one is taken at which the steps of all iterations
    together are largest. Slip of a standing foot, which comes at no even pace, misleads little.

    Args:
        track: the frames from the start of the walk to its end.
        count: number of iterations.

    Raises:
        InputError: the track is too short for so many, or has no frames where they end.
    """
    times, feet = _even(track)
    interval, frames = float(np.median(np.diff(times))), times.size
    side, jitter = max(1, round(SIDE_SECONDS / interval)), max(1, round(JITTER_SECONDS / interval))
    if count < 1 or frames < 4 * count * side:
        raise InputError(
            f"The track's {track.times.size} frames are too few for {count} iterations; give as many as it "
            "shows.",
            "iterations",
        )
    sizes = _step_sizes(feet, side)
    pace, begins = _pace(_softened(np.maximum(sizes, 0.0), jitter), count)
    steps = np.array([_steps(size, begin, pace, count) for size, begin in zip(sizes, begins, strict=True)])
    firsts, lasts = steps.min(axis=0), steps.max(axis=0)
    ends = np.append((lasts[:-1] + firsts[1:]) // 2, frames - 1)
    numbers = np.interp(times, track.times, np.arange(track.times.size)).round().astype(np.int64)
    found = numbers[ends]
    if (np.diff(found, prepend=0) <= 0).any():
        gaps = np.diff(track.times)
        last = int(gaps.argmax())
        raise InputError(
            f"The ends of {count} iterations cannot be told apart: after {track.times[last]:.2f} s the track "
            f"has no frame for {gaps[last]:.2f} s. Give fewer iterations, or a track without this gap.",
            "iterations",
        )
    return FoundIterations(numbers[steps], tuple(found.tolist()), bool((lasts[:-1] < firsts[1:]).all()))


def _even(track: FootTrack) -> tuple[Floats, Floats]:
    """(n,) times at an even rate and the feet then, since a film's own rate may vary."""
    intervals = np.diff(track.times)
    interval = float(np.median(intervals))
    if np.ptp(intervals) < SAME * interval:
        return track.times, track.feet
    count = min(round(track.seconds / interval), MOST_EVEN * track.times.size) + 1
    times = np.linspace(track.times[0], track.times[-1], count)
    return times, interpolated(times, track.times, track.feet)


def _step_sizes(feet: Floats, side: int) -> Floats:
    """(feet, n) mean place after each frame less that before, along the robot's direction, m.

    Args:
        feet: (n, feet, 2) at an even rate, m.
        side: frames before and after.
    """
    direction = (feet[-1] - feet[0]).mean(axis=0)
    way = feet @ (direction / max(float(np.hypot(*direction)), LEAST_STEP))
    frames = len(way)
    sums = np.concatenate([np.zeros((1, way.shape[1])), np.cumsum(way, axis=0)])
    here = np.arange(1, frames)
    low, high = np.maximum(here - side, 0), np.minimum(here + side, frames)
    before = (sums[here] - sums[low]) / (here - low)[:, None]
    after = (sums[high] - sums[here]) / (high - here)[:, None]
    return np.asarray(np.concatenate([np.zeros((1, way.shape[1])), after - before]).T)


def _softened(sizes: Floats, width: int) -> Floats:
    kernel = np.ones(width) / width
    return np.array([np.convolve(size, kernel, "same") for size in sizes])


def _pace(sizes: Floats, count: int) -> tuple[int, NDArray[np.int64]]:
    """Frames an iteration, and each foot's first step, at which all steps together are largest."""
    frames = sizes.shape[1]
    logarithms = np.log(sizes + LEAST_STEP)
    best = (-np.inf, 0, np.zeros(len(sizes), dtype=np.int64))
    paces = range(int(SHORTEST_SHARE * frames / count), int(LONGEST_SHARE * frames / count), 2)
    for pace in paces if count > 1 else (frames,):
        room = frames - (count - 1) * pace
        if room < 1:
            continue
        together = sum(logarithms[:, part * pace : part * pace + room] for part in range(count))
        score = float(np.max(together, axis=1).sum())
        if score > best[0]:
            best = (score, pace, np.argmax(together, axis=1))
    return best[1], best[2]


def _steps(size: Floats, begin: int, pace: int, count: int) -> list[int]:
    """The largest step near each place that the pace gives."""
    found = []
    for part in range(count):
        low = max(0, begin + part * pace - pace // 8)
        found.append(low + int(size[low : begin + part * pace + pace // 8 + 1].argmax()))
    return found


@dataclass(frozen=True)
class IterationMovement:
    """How far the feet went in one iteration.

    Args:
        feet: each foot's movement.
        mean: mean of the feet's columns.
        seconds: how long it took, s.
    """

    feet: tuple[Movement, ...]
    mean: Movement
    seconds: float


def iteration_movements(
    track: FootTrack, ends: tuple[int, ...], expected: float
) -> tuple[IterationMovement, ...]:
    """Each iteration's movement, from where the one before ended.

    Args:
        track: all frames.
        ends: last frame of each iteration, increasing.
        expected: wanted distance an iteration, m.

    Raises:
        InputError: the ends are no frames of the track in order.
    """
    starts = (0, *ends[:-1])
    if any(last <= first for first, last in zip(starts, ends, strict=True)) or ends[-1] >= track.times.size:
        raise InputError("Iterations must end one after the other, within the track.", "ends")
    movements = []
    for first, last in zip(starts, ends, strict=True):
        feet = foot_movements(track.between(first, last), expected)
        mean = mean_movement(feet)
        seconds = float(track.times[last] - track.times[first])
        movements.append(IterationMovement(feet, mean, seconds))
    return tuple(movements)


def standing_slip(track: FootTrack, steps: NDArray[np.int64]) -> Floats:
    """(feet, iterations + 1) farthest that each foot slid between its own steps, m.

    A foot stands from some seconds after a step to as long before the next; where no frame is left between
    two steps, it is taken not to have slid.

    Args:
        track: all frames.
        steps: (feet, iterations) as found.
    """
    feet, count = steps.shape
    slip = np.zeros((feet, count + 1))
    for foot in range(feet):
        borders = [-math.inf, *track.times[steps[foot]], math.inf]
        for part, (last, following) in enumerate(pairwise(borders)):
            first, end = np.searchsorted(track.times, [last + SIDE_SECONDS, following - SIDE_SECONDS])
            stand = track.feet[first:end, foot]
            if len(stand):
                slip[foot, part] = np.hypot(*(stand - stand[0]).T).max()
    return slip
