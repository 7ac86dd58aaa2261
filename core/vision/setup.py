"""How one camera sees the platform: a named document of lens, clicked points, colours and limits."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError
from core.vision.camera import FOOT_COLOURS, BlobLimits, ColourRange, Lens, PlatformView, view_of_points

SPOTS = BlobLimits()
"""Limits where nothing else is said."""

LEAST_POINTS = 4
"""Clicked points that tell where the platform is."""

FEET = 4
"""Feet of the robot that walks on a platform."""

DOUBTFUL = 0.003
"""A clicked point that is farther from its place than this is worth a second look, m."""

OUTLINE = 0.05
"""Half the side of the square that shows how the platform lies, m."""


LINE_DISTANCE = 0.01
"""Between two lines of the etched grid, m."""

LINE_POINTS, MOST_LINES = 13, 60
"""Points of a line that a lens may bend, and lines of one direction."""


@dataclass(frozen=True, eq=False)
class GridLine:
    """A line of the etched grid in the picture as it is.

    Args:
        axis: x or y, which has one value along it.
        at: that value, m.
        pixels: (n, 2) along it, px.
    """

    axis: str
    at: float
    pixels: Floats


@dataclass(frozen=True)
class TrackingSetup:
    """How feet are found in a video.

    Args:
        view: the platform in the undistorted picture.
        lens: of the camera; None where the video has no distortion.
        colours: of feet 1, 2, ….
        limits: which spots may be a foot.
        size: width and height of the pictures that it is for, px; None where any will do.
    """

    view: PlatformView
    lens: Lens | None = None
    colours: tuple[ColourRange, ...] = FOOT_COLOURS
    limits: BlobLimits = SPOTS
    size: tuple[int, int] | None = None

    def require_size(self, size: tuple[int, int]) -> None:
        """Refuses pictures of another size.

        Raises:
            InputError: with both sizes and what to do.
        """
        if self.size is not None and self.size != size:
            raise InputError(
                f"The setup is for pictures of {self.size[0]} × {self.size[1]} px; these have {size[0]} × "
                f"{size[1]} px. Choose the setup of this camera, or make one in these pictures.",
                "setup",
            )

    def places(self, pixels: Floats) -> Floats:
        """Places on the platform of (..., 2) pixels as they are in the picture, m; nan stays nan."""
        return self.view.places(pixels if self.lens is None else self.lens.straight(pixels))


@dataclass(frozen=True, eq=False)
class CameraSetup:
    """A camera's setup as a person makes it, step by step.

    Args:
        name: what a person calls it.
        size: width and height of the pictures that lens and points belong to, px.
        lens: of the camera; None where its pictures are straight enough.
        pixels: (k, 2) clicked points as they are in the picture, px.
        places: (k, 2) where they are on the platform, m.
        colours: of feet 1, 2, ….
        limits: which spots may be a foot.
        note: anything else.
    """

    name: str
    size: tuple[int, int] | None = None
    lens: Lens | None = None
    pixels: Floats = field(default_factory=lambda: np.zeros((0, 2)))
    places: Floats = field(default_factory=lambda: np.zeros((0, 2)))
    colours: tuple[ColourRange, ...] = FOOT_COLOURS
    limits: BlobLimits = SPOTS
    note: str = ""

    def __post_init__(self) -> None:
        count = len(self.pixels)
        object.__setattr__(self, "pixels", frozen_floats(self.pixels, (count, 2), "pixels"))
        object.__setattr__(self, "places", frozen_floats(self.places, (count, 2), "places"))
        if len(self.colours) != FEET:
            raise InputError(f"{len(self.colours)} colours are given; the robot has {FEET} feet.", "colours")
        if self.size is None and (count or self.lens is not None):
            raise InputError("Lens and points belong to pictures of one size; give it as `size`.", "size")
        if self.size is not None:
            self._require_inside(self.size)

    def _require_inside(self, size: tuple[int, int]) -> None:
        outside = ((self.pixels < 0.0) | (self.pixels > np.array(size))).any(axis=1)
        if outside.any():
            number = int(outside.argmax())
            u, v = self.pixels[number]
            raise InputError(
                f"Point {number + 1} at ({u:g}, {v:g}) px lies outside the picture of {size[0]} × {size[1]} "
                "px; click it again.",
                "points",
            )

    @property
    def missing(self) -> tuple[str, ...]:
        """What tracking still needs, in sentences; empty where nothing."""
        count = len(self.pixels)
        if count < LEAST_POINTS:
            return (f"{count} points are clicked; the platform needs at least {LEAST_POINTS}.",)
        return ()

    @cached_property
    def view(self) -> PlatformView:
        """The platform in the undistorted picture.

        Raises:
            InputError: the points are too few, or they tell no plane.
        """
        straight = self.pixels if self.lens is None else self.lens.straight(self.pixels)
        bent = np.isnan(straight).any(axis=1)
        if bent.any():
            raise InputError(
                f"The lens cannot be straight at point {int(bent.argmax()) + 1}; take pictures of the "
                "checkerboard up to the edges, or click nearer to the middle.",
                "points",
            )
        return view_of_points(straight, self.places)

    @property
    def off(self) -> Floats:
        """(k,) how far each clicked point is from its place in the view, m; 0 with four points."""
        tracking = TrackingSetup(self.view, self.lens)
        return np.asarray(np.hypot(*(tracking.places(self.pixels) - self.places).T))

    @property
    def doubt(self) -> str | None:
        """Says which clicked point does not fit the others; None where all do."""
        off = self.off
        if off.max() <= DOUBTFUL:
            return None
        return (
            f"Point {int(off.argmax()) + 1} is {off.max() * 1000:.1f} mm from where the others put it. Click "
            "it again, or correct its place."
        )

    def tracking(self) -> TrackingSetup:
        """What tracking takes of it.

        Raises:
            InputError: something is missing.
        """
        if self.missing:
            raise InputError(f"“{self.name}” is not complete: {self.missing[0]}", "setup")
        return TrackingSetup(self.view, self.lens, self.colours, self.limits, self.size)

    @property
    def outline(self) -> Floats:
        """(4, 2) pixels, as they are in the picture, of a square of 10 cm about the middle of the places."""
        corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * OUTLINE
        return self.seen(corners + self.places.mean(axis=0))

    def seen(self, places: Floats) -> Floats:
        """(..., 2) pixels, as they are in the picture, of (..., 2) places in m."""
        straight = self.view.pixels(places)
        return straight if self.lens is None else self.lens.bent(straight)

    @property
    def grid(self) -> tuple[GridLine, ...]:
        """Lines a centimetre apart over all clicked places, and over the square of `outline`."""
        middle = self.places.mean(axis=0)
        low = np.minimum(self.places.min(axis=0) - LINE_DISTANCE, middle - OUTLINE)
        high = np.maximum(self.places.max(axis=0) + LINE_DISTANCE, middle + OUTLINE)
        first, last = np.ceil(low / LINE_DISTANCE - 1e-9), np.floor(high / LINE_DISTANCE + 1e-9)
        lines = []
        for axis in range(2):
            count = min(int(last[axis] - first[axis]) + 1, MOST_LINES)
            along = np.linspace(low[1 - axis], high[1 - axis], LINE_POINTS)
            for number in range(count):
                at = (first[axis] + number) * LINE_DISTANCE
                places = np.full((LINE_POINTS, 2), at)
                places[:, 1 - axis] = along
                lines.append(GridLine("xy"[axis], float(at), self.seen(places)))
        return tuple(lines)
