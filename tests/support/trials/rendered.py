"""A rendered video of four feet under a platform, with known motion, lens, noise and a hidden foot."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from app.vision.video_io import Picture
from core.arrays import Floats
from core.vision.camera import Lens, PlatformView

SIZE = (640, 480)
PIXELS_PER_METRE = 4000.0
ORIGIN = (300.0, 250.0)
SOLE_RADIUS = 0.0125
PAINT = ((60, 160, 40), (40, 40, 200), (20, 130, 235), (210, 110, 40))
"""Blue, green, red of feet 1 to 4: green, red, orange, blue."""

LENS = Lens(
    np.array([[620.0, 0.0, 320.0], [0.0, 620.0, 240.0], [0.0, 0.0, 1.0]]),
    np.array([-0.35, 0.08, 0.001, -0.0008, 0.0]),
)
VIEW = PlatformView(
    np.array(
        [
            [1 / PIXELS_PER_METRE, 0.0, -ORIGIN[0] / PIXELS_PER_METRE],
            [0.0, -1 / PIXELS_PER_METRE, ORIGIN[1] / PIXELS_PER_METRE],
            [0.0, 0.0, 1.0],
        ]
    )
)


@dataclass(frozen=True)
class Hidden:
    """A foot that something covers from one frame to another, the last excluded."""

    foot: int
    first: int
    last: int


def distorting_maps() -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Where each pixel of the distorted picture comes from in the straight one."""
    x, y = np.meshgrid(np.arange(SIZE[0], dtype=np.float64), np.arange(SIZE[1], dtype=np.float64))
    straight = cv2.undistortPoints(
        np.stack([x, y], axis=-1).reshape(-1, 1, 2), LENS.matrix, LENS.distortion, P=LENS.matrix
    )
    both = np.asarray(straight).reshape(SIZE[1], SIZE[0], 2).astype(np.float32)
    return np.asarray(both[..., 0]), np.asarray(both[..., 1])


def write_video(
    path: Path,
    feet: Floats,
    rate: float,
    hidden: tuple[Hidden, ...] = (),
    *,
    false_spot: int | None = None,
    code: str = "MJPG",
) -> None:
    """Draws (n, 4, 2) feet in m through the lens, with noise, into a file.

    Args:
        path: of the file.
        feet: positions.
        rate: frames a second.
        hidden: feet that are covered.
        false_spot: a frame with a large patch of foot 1's colour elsewhere while foot 1 is covered.
        code: how pictures are packed (FourCC).
    """
    maps = distorting_maps()
    noise = np.random.default_rng(3).normal(0.0, 6.0, (8, SIZE[1], SIZE[0], 3)).astype(np.int16)
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*code), rate, SIZE)
    try:
        for number, places in enumerate(feet):
            covered = {h.foot for h in hidden if h.first <= number < h.last}
            if number == false_spot:
                covered.add(0)
            frame = _drawn(places, covered, is_false=number == false_spot)
            bent = cv2.remap(frame, *maps, cv2.INTER_LINEAR, borderValue=(90, 90, 90))
            writer.write(cv2.add(bent.astype(np.int16), noise[number % len(noise)], dtype=cv2.CV_8U))
    finally:
        writer.release()


def _drawn(places: Floats, covered: set[int], *, is_false: bool) -> Picture:
    frame = np.full((SIZE[1], SIZE[0], 3), 200, dtype=np.uint8)
    scale = 16
    for foot, (x, y) in enumerate(places):
        if foot in covered:
            continue
        middle = (ORIGIN[0] + x * PIXELS_PER_METRE, ORIGIN[1] - y * PIXELS_PER_METRE)
        _disc(frame, middle, SOLE_RADIUS * PIXELS_PER_METRE, PAINT[foot], scale)
    if is_false:
        _disc(frame, (60.0, 60.0), 24.0, PAINT[0], scale)
    return frame


def _disc(
    frame: Picture, middle: tuple[float, float], radius: float, paint: tuple[int, int, int], scale: int
) -> None:
    place = (round(middle[0] * scale), round(middle[1] * scale))
    cv2.circle(frame, place, round(radius * scale), paint, -1, cv2.LINE_AA, shift=4)
