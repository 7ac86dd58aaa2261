"""A camera's lens out of pictures of a checkerboard."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.vision.opencv import cv2
from app.vision.video_io import Picture
from core.errors import InputError
from core.vision.camera import Lens

LEAST_CHECKERBOARDS = 3
"""Pictures of the checkerboard that a lens needs."""

LARGEST_LOOKED = 1920
"""A board is looked for in a picture whose longer side is this at most, px; seconds in a photo otherwise."""

MOST_UNEXPLAINED = 5.0
"""A lens that leaves more than this is none, px; a good one leaves less than one."""

Corners = NDArray[np.float32]
"""(columns × rows, 1, 2) inner corners of a board in a picture, px."""


@dataclass(frozen=True, eq=False)
class CalibratedLens:
    """A lens and how well it explains the pictures.

    Args:
        lens: of the camera.
        unexplained: root mean square of what it leaves, px.
        each: the same of each picture.
    """

    lens: Lens
    unexplained: float
    each: tuple[float, ...]


def board_corners(picture: Picture, corners: tuple[int, int]) -> Corners | None:
    """The board's inner corners in a picture; None where it is not seen whole."""
    grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
    scale = LARGEST_LOOKED / max(grey.shape)
    if scale >= 1.0:
        there, points = cv2.findChessboardCornersSB(grey, corners)
        return np.asarray(points, dtype=np.float32) if there else None
    small = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    there, points = cv2.findChessboardCornersSB(small, corners)
    return _refined(np.asarray(grey, np.uint8), np.asarray(points), scale) if there else None


def _refined(grey: Picture, points: NDArray[np.float32], scale: float) -> Corners:
    """Corners in the whole picture, close to those in one that was made smaller by a scale."""
    whole = np.asarray((points + 0.5) / scale - 0.5, dtype=np.float32)
    reach = math.ceil(2.0 / scale)
    ending = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 40, 0.01)
    return np.asarray(cv2.cornerSubPix(grey, whole, (reach, reach), (-1, -1), ending), dtype=np.float32)


def lens_of_corners(
    boards: Sequence[Corners], size: tuple[int, int], corners: tuple[int, int]
) -> CalibratedLens:
    """A camera's lens from where it saw a board's corners.

    Args:
        boards: one for each picture, in different places and slopes.
        size: width and height of the pictures, px.
        corners: inner corners along the board's two sides.

    Raises:
        InputError: fewer than three boards, or boards that tell no lens.
    """
    if len(boards) < LEAST_CHECKERBOARDS:
        raise InputError(
            f"The board with {corners[0]} × {corners[1]} inner corners is found in {len(boards)} pictures; "
            f"at least {LEAST_CHECKERBOARDS} are needed, flat, whole and sharp.",
            "pictures",
        )
    flat = np.zeros((corners[0] * corners[1], 3), dtype=np.float32)
    flat[:, :2] = np.mgrid[: corners[0], : corners[1]].T.reshape(-1, 2)
    try:
        unexplained, matrix, distortion, turns, shifts = cv2.calibrateCamera(
            [flat] * len(boards), list(boards), size, np.eye(3), np.zeros(5)
        )
    except cv2.error:
        raise _no_lens() from None
    numbers = np.concatenate([np.ravel(matrix), np.ravel(distortion), [unexplained]])
    if not np.isfinite(numbers).all() or unexplained > MOST_UNEXPLAINED:
        raise _no_lens()
    each = []
    for board, turn, shift in zip(boards, turns, shifts, strict=True):
        ask, _ = cv2.projectPoints(flat, turn, shift, matrix, distortion)
        off = np.asarray(ask).reshape(-1, 2) - board.reshape(-1, 2)
        each.append(float(np.sqrt((off**2).sum(axis=1).mean())))
    lens = Lens(np.asarray(matrix, dtype=np.float64), np.asarray(distortion, dtype=np.float64).ravel()[:5])
    return CalibratedLens(lens, float(unexplained), tuple(each))


def straightened(picture: Picture, lens: Lens) -> Picture:
    """A picture as a lens without distortion would have it."""
    return np.asarray(cv2.undistort(picture, lens.matrix, lens.distortion), dtype=np.uint8)


def _no_lens() -> InputError:
    return InputError(
        "The lens cannot be computed from these pictures. Take pictures with the board in other "
        "places and slopes, also near the "
        "edges of the picture.",
        "pictures",
    )
