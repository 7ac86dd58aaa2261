"""Cameras of the computer that the studio runs on."""

import asyncio
import time
from collections.abc import AsyncIterator
from typing import Annotated, Literal

from fastapi import APIRouter, Query
from fastapi.responses import Response, StreamingResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.routes.lab.camera_setups import CornersAsked, checkerboard_of
from app.routes.lab.picture_streams import BOUNDARY, LookBody, Width, look_at, part
from app.vision.worker import FindCheckerboard, Source, data_url
from app.web.dependencies import RequestBody, TheStudio
from core.errors import FootfallError

router = APIRouter(prefix="/api/cameras", tags=["cameras"])


class CameraChanges(RequestBody):
    """What a camera is for; what is left out stays."""

    use: Literal["under", "side"] | None = None
    setup: str | None = Field(default=None, max_length=200)
    records: bool | None = None


@router.get("")
async def list_cameras(studio: TheStudio) -> Json:
    """Cameras that are plugged in, and those that are missed."""
    return {"cameras": await run_in_threadpool(studio.lab.cameras.views)}


@router.put("/{camera}")
async def change_camera(camera: str, changes: CameraChanges, studio: TheStudio) -> Json:
    """Says what a camera is for, and whether it records with the run."""
    given = {key: value for key, value in changes.model_dump().items() if value is not None}
    return await run_in_threadpool(studio.lab.cameras.change, camera, given)


@router.get("/{camera}/picture.jpg", response_class=Response)
async def picture_of_camera(camera: str, studio: TheStudio, most: Width = None) -> Response:
    """What the camera sees now."""
    content = await run_in_threadpool(studio.lab.cameras.picture, camera, most)
    return Response(content, media_type="image/jpeg", headers={"cache-control": "no-store"})


@router.get("/{camera}/stream", response_class=Response)
async def stream_camera(
    camera: str,
    studio: TheStudio,
    rate: Annotated[float, Query(gt=0.0, le=60.0)] = 10.0,
    most: Width = 960,
) -> StreamingResponse:
    """What the camera sees (multipart), until it is unplugged."""
    first = await run_in_threadpool(studio.lab.cameras.picture, camera, most)

    async def parts() -> AsyncIterator[bytes]:
        yield part(first)
        due = time.monotonic()
        while not studio.hub.is_closed:
            due = max(due + 1.0 / rate, time.monotonic())
            await asyncio.sleep(due - time.monotonic())
            try:
                yield part(await run_in_threadpool(studio.lab.cameras.picture, camera, most))
            except FootfallError:
                return

    return StreamingResponse(parts(), media_type=f"multipart/x-mixed-replace; boundary={BOUNDARY}")


@router.post("/{camera}/look")
async def look_at_camera(camera: str, look: LookBody, studio: TheStudio) -> Json:
    """What the camera sees now, with what tracking would find in it."""
    content = await run_in_threadpool(studio.lab.cameras.picture, camera)
    return await look_at(studio, Source(file=content, name=camera), look)


@router.post("/{camera}/board")
async def board_before_camera(
    camera: str, columns: CornersAsked, rows: CornersAsked, studio: TheStudio
) -> Json:
    """Where a checkerboard is in what the camera sees now; the picture comes with it."""
    content = await run_in_threadpool(studio.lab.cameras.picture, camera)
    found = await checkerboard_of(
        studio, FindCheckerboard(Source(file=content, name=camera), (columns, rows))
    )
    return {**found, "picture": data_url(content)}
