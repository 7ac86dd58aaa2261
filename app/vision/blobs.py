"""Blobs of a foot's colour in a picture: all of them, the one that is the foot, and why others are not."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.vision.opencv import cv2
from app.vision.video_io import Picture, scaled
from core.arrays import Floats
from core.vision.camera import BlobLimits, ColourRange

Mask = NDArray[np.uint8]
"""(height, width), 255 where something is, else 0."""

HUES = 180
"""Hues of 8-bit pictures go up to here."""

MOST_SPOTS = 20
"""Spots that are told of, the largest first."""

RING = (255, 255, 255)
"""Colour of the ring about a spot that may be the foot."""


@dataclass(frozen=True)
class Blob:
    """A spot of a foot's colour.

    Args:
        pixel: middle of its area.
        area: of its contour, px².
        radius: of its smallest enclosing circle, px.
        fill: its area as a share of that circle's.
        refusal: why it cannot be the foot; None where it can.
    """

    pixel: tuple[float, float]
    area: float
    radius: float
    fill: float
    refusal: str | None


def in_colours(picture: Picture) -> Picture:
    """A picture in hue, saturation and value."""
    return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2HSV), dtype=np.uint8)


def mask_of(hsv: Picture, colour: ColourRange) -> Mask:
    """255 where a picture in hue, saturation and value has a colour, else 0."""
    low, high = (round(hue * HUES) for hue in colour.hue)
    least = (round(colour.saturation * 255), round(colour.value * 255))
    parts = [(low, high)] if low <= high else [(low, HUES), (0, high)]
    masks = [cv2.inRange(hsv, np.array([a, *least]), np.array([b, 255, 255])) for a, b in parts]
    return np.asarray(masks[0] if len(masks) == 1 else cv2.bitwise_or(*masks), dtype=np.uint8)


def find_feet(frame: Picture, colours: tuple[ColourRange, ...], limits: BlobLimits) -> Floats:
    """(feet, 2) pixel of each foot in one picture, nan where no spot is fit; the largest counts."""
    hsv = in_colours(frame)
    return np.array([_largest(mask_of(hsv, colour), limits) for colour in colours])


def _largest(mask: Mask, limits: BlobLimits) -> tuple[float, float]:
    for contour, area in _contours(mask):
        if area < limits.least_area:
            break
        if area <= limits.most_area:
            blob = _blob(contour, area, limits)
            if blob.refusal is None:
                return blob.pixel
    return (math.nan, math.nan)


def blobs_of(mask: Mask, limits: BlobLimits) -> tuple[tuple[Blob, ...], int]:
    """The largest spots of a mask, and how many smaller ones there are."""
    found = _contours(mask)
    return tuple(_blob(*one, limits) for one in found[:MOST_SPOTS]), max(len(found) - MOST_SPOTS, 0)


def _contours(mask: Mask) -> list[tuple[NDArray[np.int32], float]]:
    """Contours with their areas, the largest first."""
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    found = [(np.asarray(contour, dtype=np.int32), cv2.contourArea(contour)) for contour in contours]
    return sorted(found, key=lambda one: -one[1])


def _blob(contour: NDArray[np.int32], area: float, limits: BlobLimits) -> Blob:
    middle, radius = cv2.minEnclosingCircle(contour)
    fill = area / (math.pi * max(radius, 0.5) ** 2)
    sums = cv2.moments(contour)
    if sums["m00"] > 0:
        middle = (sums["m10"] / sums["m00"], sums["m01"] / sums["m00"])
    return Blob((float(middle[0]), float(middle[1])), area, radius, fill, limits.refusal(area, fill))


def shown_mask(picture: Picture, mask: Mask, blobs: tuple[Blob, ...], most: int | None) -> Picture:
    """A picture where only what has a foot's colour stays in colour, and what may be the foot is ringed.

    Args:
        picture: as it is.
        mask: of the foot's colour.
        blobs: found in it.
        most: width of the result at most, px; None for the picture's own.
    """
    small = scaled(picture, most)
    height, width = small.shape[:2]
    kept = cv2.resize(mask, (width, height), interpolation=cv2.INTER_NEAREST)
    dim = cv2.convertScaleAbs(cv2.cvtColor(small, cv2.COLOR_BGR2GRAY), alpha=0.45)
    shown = cv2.cvtColor(dim, cv2.COLOR_GRAY2BGR)
    cv2.copyTo(small, kept, shown)
    scale = width / picture.shape[1]
    for blob in blobs:
        if blob.refusal is None:
            middle = (round(blob.pixel[0] * scale), round(blob.pixel[1] * scale))
            cv2.circle(shown, middle, round(blob.radius * scale) + 4, RING, 2, cv2.LINE_AA)
    return np.asarray(shown, dtype=np.uint8)
