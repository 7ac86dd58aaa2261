"""What a camera under the platform needs to be told: lens, platform in the picture, colours of the feet."""

import math
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError


@dataclass(frozen=True)
class ColourRange:
    """A range of hue, saturation and value, all 0 to 1; hues whose `low` is above `high` go over red.

    Args:
        hue: (low, high), shares of the colour circle.
        saturation: least.
        value: least.
    """

    hue: tuple[float, float]
    saturation: float = 0.4
    value: float = 0.25

    def __post_init__(self) -> None:
        numbers = (*self.hue, self.saturation, self.value)
        if not all(math.isfinite(number) and 0.0 <= number <= 1.0 for number in numbers):
            raise InputError("Hue, saturation and value must lie between 0 and 1.", "colours")


SUBSTITUTIONS = 40
"""Steps towards the inverse of a lens; each leaves a share of the error that grows with the distortion."""

INVERSE_PX = 0.01
"""The inverse of a lens is known where it leads back this near, px."""

HORIZON = 1e-9
"""Depth of a pixel, as a share of the clicked points', below which it shows no place."""

FLAT = 1e-4
"""A view of points that are scaled to unit size is none where it flattens the platform so much."""

FARTHEST_RAY = 4.0
"""Farthest ray from the middle, in focal lengths: it keeps a search that fails finite."""

FOOT_COLOURS = (
    ColourRange((0.28, 0.45)),
    ColourRange((0.95, 0.03)),
    ColourRange((0.045, 0.12)),
    ColourRange((0.54, 0.70)),
)
"""Feet 1 to 4: green, red, orange, blue (thesis 5.1); to be tuned on the lab's own light."""


@dataclass(frozen=True)
class BlobLimits:
    """Which spots of a foot's colour may be the foot.

    Args:
        least_area: of the contour, px².
        most_area: px².
        least_fill: contour's area as a share of its smallest enclosing circle's; a round sole has nearly 1.
    """

    least_area: float = 60.0
    most_area: float = 20_000.0
    least_fill: float = 0.5

    def __post_init__(self) -> None:
        if not 0.0 < self.least_area <= self.most_area < math.inf:
            raise InputError("A spot's least area must be above 0 and at most its largest.", "limits")
        if not 0.0 <= self.least_fill <= 1.0:
            raise InputError(f"The fill is a share from 0 to 1, and not {self.least_fill:g}.", "limits")

    def refusal(self, area: float, fill: float) -> str | None:
        """Why a spot cannot be the foot; None where it can.

        Args:
            area: of its contour, px².
            fill: that as a share of its smallest enclosing circle's.
        """
        if area < self.least_area:
            return f"Its area of {area:.0f} px² is below {self.least_area:g} px²."
        if area > self.most_area:
            return f"Its area of {area:.0f} px² is above {self.most_area:g} px²."
        if fill < self.least_fill:
            return f"It fills {fill:.0%} of its circle, less than {self.least_fill:.0%}."
        return None


@dataclass(frozen=True, eq=False)
class Lens:
    """A camera's matrix and its five distortion coefficients k1, k2, p1, p2, k3.

    Args:
        matrix: (3, 3) px.
        distortion: (5,).
    """

    matrix: Floats
    distortion: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", frozen_floats(self.matrix, (3, 3), "camera matrix"))
        object.__setattr__(self, "distortion", frozen_floats(self.distortion, (5,), "distortion"))
        if self.matrix[0, 0] <= 0 or self.matrix[1, 1] <= 0:
            raise InputError("The camera matrix needs focal lengths of more than 0 px.", "lens")

    def bent(self, pixels: Floats) -> Floats:
        """Where the lens shows what a lens without distortion has at some pixels.

        With x, y over the focal lengths from the middle and r² = x² + y²,
        x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), and y' likewise (Brown's model).

        Args:
            pixels: (..., 2) px.
        """
        return self._pixels(self._bent(self._rays(pixels)))

    def straight(self, pixels: Floats) -> Floats:
        """Inverse of `bent`, by repeated substitution.

        Args:
            pixels: (..., 2) px.

        Returns:
            (..., 2) px; nan where the lens has no inverse, far outside where it was calibrated.
        """
        seen = self._rays(pixels)
        rays = seen
        for _ in range(SUBSTITUTIONS):
            rays = np.clip(rays + (seen - self._bent(rays)), -FARTHEST_RAY, FARTHEST_RAY)
        lost = np.linalg.norm(self._bent(rays) - seen, axis=-1) * self.matrix[0, 0] > INVERSE_PX
        return np.where(lost[..., None], np.nan, self._pixels(rays))

    def _bent(self, rays: Floats) -> Floats:
        k1, k2, p1, p2, k3 = self.distortion
        x, y = rays[..., 0], rays[..., 1]
        square = x * x + y * y
        along = 1.0 + square * (k1 + square * (k2 + square * k3))
        sideways = [2 * p1 * x * y + p2 * (square + 2 * x * x), p1 * (square + 2 * y * y) + 2 * p2 * x * y]
        return np.asarray(rays * along[..., None] + np.stack(sideways, axis=-1))

    def _rays(self, pixels: Floats) -> Floats:
        return np.asarray((pixels - self.matrix[:2, 2]) / self.matrix[[0, 1], [0, 1]])

    def _pixels(self, rays: Floats) -> Floats:
        return np.asarray(rays * self.matrix[[0, 1], [0, 1]] + self.matrix[:2, 2])


@dataclass(frozen=True, eq=False)
class PlatformView:
    """Where the platform is in the undistorted picture.

    Args:
        H_platform_pixel: (3, 3) homography from pixels to metres on the platform, x and y as the lab's.
    """

    H_platform_pixel: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "H_platform_pixel", frozen_floats(self.H_platform_pixel, (3, 3), "view"))

    def places(self, pixels: Floats) -> Floats:
        """Places on the platform.

        Args:
            pixels: (..., 2) undistorted, px; nan stays nan.

        Returns:
            (..., 2) m; nan where a pixel shows no place, on the platform's horizon.
        """
        ones = np.ones((*pixels.shape[:-1], 1))
        turned = np.concatenate([pixels, ones], axis=-1) @ self.H_platform_pixel.T
        depth = turned[..., 2:]
        return np.asarray(turned[..., :2] / np.where(np.abs(depth) < HORIZON, np.nan, depth))

    def pixels(self, places: Floats) -> Floats:
        """Inverse of `places`: (..., 2) undistorted pixels of (..., 2) places in m."""
        inverse = np.linalg.inv(self.H_platform_pixel)
        return PlatformView(inverse / np.abs(inverse).max()).places(places)


def view_of_points(pixels: Floats, places: Floats) -> PlatformView:
    """The platform's view from points whose places are known, such as corners of its etched grid.

    The homography is the direct linear transform over points that are first moved and scaled to unit size.

    Args:
        pixels: (k, 2) clicked, undistorted, px; at least four, no three of the first four on a line.
        places: (k, 2) on the platform, m.

    Raises:
        InputError: there are fewer than four points, or they tell no plane.
    """
    count = len(pixels)
    if count < 4:
        raise InputError(f"{count} points are clicked; the platform needs at least four.", "points")
    seen, real = frozen_floats(pixels, (count, 2), "pixels"), frozen_floats(places, (count, 2), "places")
    T_unit_pixel, T_unit_place = _unit_scale(seen), _unit_scale(real)
    rows = []
    for (u, v), (x, y) in zip(_scaled(T_unit_pixel, seen), _scaled(T_unit_place, real), strict=True):
        rows += [[u, v, 1, 0, 0, 0, -x * u, -x * v, -x], [0, 0, 0, u, v, 1, -y * u, -y * v, -y]]
    _, sizes, turned = np.linalg.svd(np.array(rows))
    if sizes[7] < 1e-6 * sizes[0]:
        raise InputError(
            "The points lie on a line or upon each other; click the corners of a square.", "points"
        )
    unit = turned[-1].reshape(3, 3)
    spread = np.linalg.svd(unit, compute_uv=False)
    if spread[2] < FLAT * spread[0] or abs(unit[2, 2]) < FLAT * spread[0]:
        raise InputError(
            "The points or their places lie on a line or upon each other; click the corners of a square.",
            "points",
        )
    homography = np.linalg.inv(T_unit_place) @ unit @ T_unit_pixel
    depths = seen @ homography[2, :2] + homography[2, 2]
    if depths.min() * depths.max() <= 0.0:
        raise InputError(
            "Some points seem to lie behind the camera: two of them have their places exchanged.", "points"
        )
    return PlatformView(homography / depths.mean())


def _unit_scale(points: Floats) -> Floats:
    middle = points.mean(axis=0)
    size = float(np.hypot(*(points - middle).T).mean())
    if size < 1e-12:
        raise InputError("The points lie upon each other; click the corners of a square.", "points")
    scale = 1.0 / size
    return np.array([[scale, 0.0, -scale * middle[0]], [0.0, scale, -scale * middle[1]], [0.0, 0.0, 1.0]])


def _scaled(transform: Floats, points: Floats) -> Floats:
    return np.asarray(points @ transform[:2, :2].T + transform[:2, 2])
