"""What routes of videos and cameras share: a picture with what tracking finds in it, and streams."""

from typing import Annotated, Literal

from fastapi import Query
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.cameras.setup_schema import Colours, LimitsDocument, SetupDocument
from app.common.json import Json
from app.studio.studio import Studio
from app.videos.service import LOOK_SECONDS
from app.vision.services import ask
from app.vision.worker import DetectBlobs, Source
from app.web.dependencies import RequestBody
from core.vision.setup import FEET, TrackingSetup

Width = Annotated[int | None, Query(ge=16, le=8192)]
"""A picture is shown no wider than so many pixels."""

BOUNDARY = "picture"
"""Between two pictures of a stream."""


class LookBody(RequestBody):
    """How a picture is looked at: whose colour (`foot` from 1, null for none), limits, setup for places."""

    foot: int | None = Field(default=1, ge=1, le=FEET)
    colours: Colours
    limits: LimitsDocument = Field(default_factory=LimitsDocument)
    shows: Literal["mask", "plain"] = "mask"
    setup: SetupDocument | None = None
    most: int = Field(default=1280, ge=16, le=8192)

    def tracking(self) -> TrackingSetup | None:
        """The setup, where it is complete."""
        setup = None if self.setup is None else self.setup.setup()
        return None if setup is None or setup.missing else setup.tracking()


async def look_at(studio: Studio, source: Source, look: LookBody) -> Json:
    """A picture with what tracking would find in it."""
    task = DetectBlobs(
        source,
        None if look.foot is None else look.foot - 1,
        tuple(colour.range() for colour in look.colours),
        look.limits.limits(),
        look.tracking(),
        look.shows == "mask",
        look.most,
    )
    found: Json = await run_in_threadpool(lambda: ask(studio.lab.vision.interactive, task, LOOK_SECONDS))
    return found


def part(picture: bytes) -> bytes:
    """A picture as a part of a stream."""
    head = f"--{BOUNDARY}\r\nContent-Type: image/jpeg\r\nContent-Length: {len(picture)}\r\n\r\n"
    return head.encode() + picture + b"\r\n"
