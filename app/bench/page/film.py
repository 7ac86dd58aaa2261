"""A film of four feet under a platform, drawn through a lens with noise: where each foot is, is known."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.vision.recording_file import RecordingWriter
from app.vision.video_io import jpeg
from core.arrays import Floats
from core.vision.camera import Lens
from core.vision.setup import CameraSetup

RATE = 30.0
"""Frames a second."""

PAINT = ((60, 160, 40), (40, 40, 200), (20, 130, 235), (210, 110, 40))
"""Blue, green and red of feet 1 to 4."""

SOLE_RADIUS = 0.0125
"""m."""

STANCE = np.array([[0.04, 0.0], [0.0, 0.04], [-0.04, 0.0], [0.0, -0.04]])
"""Where the feet stand at first, m."""

ACROSS = 0.20
"""Width of the platform in the picture, m."""

GLASS, NOISE, NOISES = 200, 6.0, 4
"""Brightness of the platform, standard deviation of the noise, and how many pictures of it there are."""


@dataclass(frozen=True, eq=False)
class Film:
    """A film that was drawn.

    Args:
        folder: a recording.
        feet: (n, 4, 2) where the feet are, m.
        setup: how the camera sees the platform.
    """

    folder: Path
    feet: Floats
    setup: CameraSetup


def stepping_feet(seconds: float, step: float = 0.012) -> Floats:
    """(n, 4, 2) feet that step one after the other along x, one every two seconds, m.

    Args:
        seconds: of the film.
        step: of each foot, m.
    """
    times = np.arange(round(seconds * RATE)) / RATE
    feet = np.repeat(STANCE[None], len(times), axis=0)
    for number in range(int(seconds // 2)):
        feet[:, number % 4, 0] += step * np.clip(times - 2 * number - 0.5, 0.0, 1.0)
    return feet


def draw_film(folder: Path, size: tuple[int, int], feet: Floats) -> Film:
    """Draws a film as a recording.

    Args:
        folder: made for it.
        size: width and height of the pictures, px.
        feet: (n, 4, 2) m.
    """
    setup = _setup(size)
    places = _places(setup, size)
    dice = np.random.default_rng(3)
    noise = dice.normal(0.0, NOISE, (NOISES, size[1], size[0], 3)).astype(np.int16)
    writer = RecordingWriter(folder)
    for number, four in enumerate(feet):
        picture = np.full((size[1], size[0], 3), GLASS, dtype=np.int16)
        for foot, place in enumerate(four):
            _paint(picture, places, place, PAINT[foot], size[0] / ACROSS)
        picture += noise[number % NOISES]
        writer.add(jpeg(np.clip(picture, 0, 255).astype(np.uint8)), number / RATE)
    writer.close()
    return Film(folder, feet, setup)


def _setup(size: tuple[int, int]) -> CameraSetup:
    focal = float(size[0])
    lens = Lens(
        np.array([[focal, 0.0, size[0] / 2], [0.0, focal, size[1] / 2], [0.0, 0.0, 1.0]]),
        np.array([-0.3, 0.08, 0.0, 0.0, 0.0]),
    )
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * ACROSS / 4
    scale = size[0] / ACROSS
    straight = corners * [scale, -scale] + [size[0] / 2, size[1] / 2]
    return CameraSetup("film", size, lens, lens.bent(straight), corners)


def _places(setup: CameraSetup, size: tuple[int, int]) -> Floats:
    """(height, width, 2) place on the platform that each pixel shows, m."""
    columns, rows = np.meshgrid(np.arange(size[0], dtype=np.float64), np.arange(size[1], dtype=np.float64))
    return setup.tracking().places(np.stack([columns, rows], axis=-1))


def _paint(
    picture: NDArray[np.int16], places: Floats, place: Floats, paint: tuple[int, int, int], scale: float
) -> None:
    """Draws a sole with soft edges."""
    away = np.hypot(places[..., 0] - place[0], places[..., 1] - place[1])
    rows, columns = np.nonzero(away < SOLE_RADIUS + 2.0 / scale)
    share = np.clip((SOLE_RADIUS - away[rows, columns]) * scale + 0.5, 0.0, 1.0)[:, None]
    picture[rows, columns] = (share * paint + (1.0 - share) * GLASS).astype(np.int16)
