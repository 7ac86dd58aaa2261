"""Made tracks with known answers."""

from __future__ import annotations

import numpy as np

from core.vision.track import FootTrack

RATE = 13.0
STANCE = np.array([[0.04, 0.0], [0.0, 0.04], [-0.04, 0.0], [0.0, -0.04]])


def stepping_track(
    step: tuple[float, float], iterations: int, order: tuple[int, ...] = (2, 1, 3, 0), noise: float = 0.0
) -> FootTrack:
    """Feet that step one after the other in the middle of their 8 s, each by the whole step.

    Args:
        step: x, y of each step, m.
        iterations: how often each foot steps.
        order: feet in order, 0-based.
        noise: standard deviation of each position, m.
    """
    slot = round(8.0 * RATE)
    frames = slot * len(order) * iterations
    feet = np.repeat(STANCE[None], frames, axis=0)
    rise = np.clip((np.arange(frames)[:, None] - slot / 2) / RATE, 0.0, 1.0)
    for number in range(iterations * len(order)):
        foot = order[number % len(order)]
        share = np.concatenate([np.zeros((number * slot, 1)), rise])[:frames]
        feet[:, foot] += share * np.array(step)
    feet += np.random.default_rng(1).normal(0.0, noise, feet.shape) if noise else 0.0
    return FootTrack(np.arange(frames) / RATE, feet, np.zeros((frames, 4), dtype=np.bool_))
