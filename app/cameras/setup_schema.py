"""The JSON document of a camera's setup: pixels as they are, places in cm, colours as shares."""

from typing import Annotated

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from core.errors import InputError
from core.text.documents import json_content
from core.vision.camera import FOOT_COLOURS, BlobLimits, ColourRange, Lens
from core.vision.setup import FEET, SPOTS, CameraSetup

Number = Annotated[float, Field(allow_inf_nan=False, strict=True)]
Share = Annotated[float, Field(ge=0.0, le=1.0, strict=True)]
Side = Annotated[int, Field(ge=16, le=16_384, strict=True)]
Row = tuple[Number, Number, Number]

MOST_POINTS = 200
"""Clicked points of a setup."""


class _Document(BaseModel):
    model_config = ConfigDict(extra="forbid")


class LensDocument(_Document):
    """A lens, and how well it was known when it was made."""

    matrix: tuple[Row, Row, Row]
    distortion: tuple[Number, Number, Number, Number, Number]
    rms_px: float | None = Field(default=None, ge=0.0, allow_inf_nan=False, strict=True)
    boards: int | None = Field(default=None, ge=0, strict=True)

    def value(self) -> Lens:
        """The lens."""
        return Lens(np.array(self.matrix), np.array(self.distortion))


class PointDocument(_Document):
    """A clicked point: where it is in the picture as it is, and on the platform."""

    pixel: tuple[Number, Number]
    place_cm: tuple[Number, Number]


class ColourDocument(_Document):
    """A foot's colour."""

    hue: tuple[Share, Share]
    saturation: Share
    value: Share

    def range(self) -> ColourRange:
        """The range of colours."""
        return ColourRange(self.hue, self.saturation, self.value)


class LimitsDocument(_Document):
    """Which spots may be a foot."""

    least_area: Number = SPOTS.least_area
    most_area: Number = SPOTS.most_area
    least_fill: Number = SPOTS.least_fill

    def limits(self) -> BlobLimits:
        """The limits."""
        return BlobLimits(self.least_area, self.most_area, self.least_fill)


def _usual_colours() -> list[ColourDocument]:
    return [ColourDocument(hue=c.hue, saturation=c.saturation, value=c.value) for c in FOOT_COLOURS]


Colours = Annotated[list[ColourDocument], Field(min_length=FEET, max_length=FEET)]


class SetupDocument(_Document):
    """A camera's setup as it is kept, sent and exported."""

    name: str = Field(min_length=1, max_length=120)
    size: tuple[Side, Side] | None = None
    lens: LensDocument | None = None
    points: list[PointDocument] = Field(default_factory=list, max_length=MOST_POINTS)
    colours: Colours = Field(default_factory=_usual_colours)
    limits: LimitsDocument = Field(default_factory=LimitsDocument)
    note: str = Field(default="", max_length=4000)

    def setup(self) -> CameraSetup:
        """The setup.

        Raises:
            InputError: a value that no setup can have.
        """
        return CameraSetup(
            self.name,
            self.size,
            None if self.lens is None else self.lens.value(),
            np.array([point.pixel for point in self.points], dtype=np.float64).reshape(-1, 2),
            np.array([point.place_cm for point in self.points], dtype=np.float64).reshape(-1, 2) / 100.0,
            tuple(colour.range() for colour in self.colours),
            self.limits.limits(),
            self.note,
        )


def parse_setup(text: str, name: str) -> SetupDocument:
    """Reads a setup's file.

    Args:
        text: of the file.
        name: of the file, for messages.

    Raises:
        InputError: naming the first field that is wrong.
    """
    try:
        return SetupDocument.model_validate(json_content(text, name))
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or name
        raise InputError(f"{name}, {field}: {first['msg']}.", field) from None
