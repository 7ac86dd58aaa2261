"""Foot tracks out of a video: the only place that knows OpenCV."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.errors import InputError
from core.trials.camera import FOOT_COLOURS, ColourRange, Lens, PlatformView, SpotLimits
from core.trials.false_sights import false_sights
from core.trials.track import FootTrack, filled_track

Picture = NDArray[np.uint8]
"""(height, width, 3) blue, green, red."""

Mask = NDArray[np.uint8]
"""(height, width), 255 where something is, else 0."""

SPOTS = SpotLimits()
"""Limits where nothing else is said."""

LEAST_BOARDS = 3
"""Pictures of the checkerboard that a lens needs."""

HUES = 180
"""Hues of 8-bit pictures go up to here."""


@dataclass(frozen=True)
class TrackingSetup:
    """How feet are found in a video.

    Args:
        view: the platform in the undistorted picture.
        lens: of the camera; None where the video has no distortion.
        colours: of feet 1, 2, ….
        limits: which spots may be a foot.
    """

    view: PlatformView
    lens: Lens | None = None
    colours: tuple[ColourRange, ...] = FOOT_COLOURS
    limits: SpotLimits = SPOTS


@dataclass(frozen=True, eq=False)
class VideoTrack:
    """A track, and what was wrong on the way.

    Args:
        track: with its gaps filled and marked.
        unseen: (n, feet) no spot of the foot's colour was fit.
        false: (n, feet) a spot was found where the foot cannot have been.
        frame_rate: of the video, 1/s.
    """

    track: FootTrack
    unseen: Bools
    false: Bools
    frame_rate: float


def track_video(
    path: Path, setup: TrackingSetup, progress: Callable[[float], bool] = lambda share: True
) -> VideoTrack | None:
    """Follows the feet through a video file.

    Args:
        path: of the file.
        setup: lens, platform, colours.
        progress: told the share that is done, 0 to 1; false ends it.

    Returns:
        The track; None where it was ended.

    Raises:
        InputError: the file is no video, or a foot is never seen.
    """
    frame_rate, count = video_facts(path)
    pixels: list[Floats] = []
    for frame in frames_of(path):
        pixels.append(find_feet(frame, setup.colours, setup.limits))
        if len(pixels) % 20 == 0 and not progress(min(1.0, len(pixels) / max(count, 1))):
            return None
    if len(pixels) < 2:
        raise InputError(f"{path.name} holds {len(pixels)} pictures; a track needs at least two.", path.name)
    feet = setup.view.places(_undistorted(np.array(pixels), setup.lens))
    times = np.arange(len(pixels)) / frame_rate
    unseen = np.asarray(np.isnan(feet).any(axis=2))
    false = false_sights(times, feet)
    feet[false] = math.nan
    return VideoTrack(filled_track(times, feet, path.name), unseen, false, frame_rate)


def video_facts(path: Path) -> tuple[float, int]:
    """Frame rate in 1/s and number of pictures, as the file says.

    Raises:
        InputError: the file is no video, or tells no frame rate.
    """
    capture = _opened(path)
    try:
        rate, count = capture.get(cv2.CAP_PROP_FPS), int(capture.get(cv2.CAP_PROP_FRAME_COUNT))
    finally:
        capture.release()
    if not (math.isfinite(rate) and rate > 0):
        raise InputError(f"{path.name} tells no frame rate; save it again with one.", path.name)
    return rate, count


def frames_of(path: Path) -> Iterator[Picture]:
    """The pictures of a video file, one after the other."""
    capture = _opened(path)
    try:
        while True:
            there, frame = capture.read()
            if not there:
                return
            yield np.asarray(frame, dtype=np.uint8)
    finally:
        capture.release()


def find_feet(frame: Picture, colours: tuple[ColourRange, ...], limits: SpotLimits) -> Floats:
    """(feet, 2) pixel of each foot in one picture, nan where no spot is fit; the largest counts."""
    hsv = np.asarray(cv2.cvtColor(frame, cv2.COLOR_BGR2HSV), dtype=np.uint8)
    return np.array([_largest_spot(mask_of(hsv, colour), limits) for colour in colours])


def mask_of(hsv: Picture, colour: ColourRange) -> Mask:
    """255 where a picture in hue, saturation and value has a colour, else 0."""
    low, high = (round(hue * HUES) for hue in colour.hue)
    least = (round(colour.saturation * 255), round(colour.value * 255))
    parts = [(low, high)] if low <= high else [(low, HUES), (0, high)]
    masks = [cv2.inRange(hsv, np.array([a, *least]), np.array([b, 255, 255])) for a, b in parts]
    return np.asarray(masks[0] if len(masks) == 1 else cv2.bitwise_or(*masks), dtype=np.uint8)


def _largest_spot(mask: Mask, limits: SpotLimits) -> tuple[float, float]:
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    best, place = 0.0, (math.nan, math.nan)
    for contour in contours:
        area = cv2.contourArea(contour)
        if not max(best, limits.least_area) <= area <= limits.most_area:
            continue
        _, radius = cv2.minEnclosingCircle(contour)
        if area < limits.least_fill * math.pi * radius**2:
            continue
        sums = cv2.moments(contour)
        best, place = area, (sums["m10"] / sums["m00"], sums["m01"] / sums["m00"])
    return place


def _undistorted(pixels: Floats, lens: Lens | None) -> Floats:
    """(n, feet, 2) pixels as a lens without distortion would have them."""
    if lens is None:
        return pixels
    seen = ~np.isnan(pixels).any(axis=2)
    straight = np.full(pixels.shape, math.nan)
    points = pixels[seen].reshape(-1, 1, 2)
    if len(points):
        moved = cv2.undistortPoints(points, lens.matrix, lens.distortion, P=lens.matrix)
        straight[seen] = np.asarray(moved).reshape(-1, 2)
    return straight


def _opened(path: Path) -> cv2.VideoCapture:
    capture = cv2.VideoCapture(str(path))
    if not capture.isOpened():
        capture.release()
        raise InputError(f"{path.name} cannot be read as a video.", path.name)
    return capture


def lens_of_checkerboards(
    pictures: Sequence[Picture], corners: tuple[int, int]
) -> tuple[Lens, float, tuple[bool, ...]]:
    """A camera's lens from pictures of a checkerboard.

    Args:
        pictures: of the board in different places and slopes, all of one size.
        corners: inner corners along the board's two sides.

    Returns:
        The lens; the root mean square of what it leaves unexplained, px; which pictures show the board.

    Raises:
        InputError: fewer than three pictures show the board, or they are of different sizes.
    """
    sizes = {picture.shape[:2] for picture in pictures}
    if len(sizes) > 1:
        raise InputError("The pictures have different sizes; take all with one camera.", "pictures")
    found = [_board_corners(picture, corners) for picture in pictures]
    seen = [points for points in found if points is not None]
    if len(seen) < LEAST_BOARDS:
        raise InputError(
            f"The board with {corners[0]} × {corners[1]} inner corners is found in {len(seen)} of "
            f"{len(pictures)} pictures; at least {LEAST_BOARDS} are needed, flat, whole and sharp.",
            "pictures",
        )
    board = np.zeros((corners[0] * corners[1], 3), dtype=np.float32)
    board[:, :2] = np.mgrid[: corners[0], : corners[1]].T.reshape(-1, 2)
    ((height, width),) = sizes
    unexplained, matrix, distortion, _, _ = cv2.calibrateCamera(
        [board] * len(seen), seen, (width, height), np.eye(3), np.zeros(5)
    )
    lens = Lens(np.asarray(matrix, dtype=np.float64), np.asarray(distortion, dtype=np.float64).ravel()[:5])
    return lens, float(unexplained), tuple(points is not None for points in found)


def _board_corners(picture: Picture, corners: tuple[int, int]) -> NDArray[np.float32] | None:
    grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
    there, points = cv2.findChessboardCornersSB(grey, corners)
    return np.asarray(points, dtype=np.float32) if there else None


def read_picture(content: bytes, name: str) -> Picture:
    """A picture file's content.

    Raises:
        InputError: it is no picture.
    """
    data = np.frombuffer(content, dtype=np.uint8)
    picture = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    if picture is None:
        raise InputError(f"{name} is no picture that can be read; use PNG or JPEG.", name)
    return np.asarray(picture, dtype=np.uint8)


def jpeg(picture: Picture) -> bytes:
    """A picture as a JPEG file."""
    _, content = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 85])
    return content.tobytes()
