"""Videos: uploading, looking, tuning, tracking."""

import asyncio
import time
from collections.abc import AsyncIterator
from typing import Annotated
from urllib.parse import quote

import numpy as np
from fastapi import APIRouter, Query, Request
from fastapi.responses import FileResponse, Response, StreamingResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.routes.lab.camera_setups import Corners, checkerboard_of
from app.routes.lab.picture_streams import BOUNDARY, LookBody, Width, look_at, part
from app.routes.lab.trials import Iterations, Length, Name, planned_for
from app.trials.service import TrialDescription
from app.videos.files import MOST_BYTES, Upload
from app.videos.tracking_service import TrackingJob
from app.vision.frame_source import PICTURES
from app.vision.worker import FindCheckerboard, Source
from app.web.dependencies import FiniteBody, TheAuthor, TheStudio, on_command_thread
from core.errors import FootfallError

router = APIRouter(prefix="/api/videos", tags=["videos"])
Frame = Annotated[int | None, Query(ge=0)]

GATHER = 1 << 20
"""Bytes of an upload that are written at one time."""

BOARD_FRAMES = 24
"""Pictures of a video that are looked through for a checkerboard where none are named."""


BOARD_SECONDS = 2.5
"""After that long the pictures that are left are named, and not looked through in the same answer."""


class TrackBody(FiniteBody):
    """What a video shows; `run` brings the plan that the robot was sent, `gait` the plan it has now."""

    setup: str = Field(max_length=200)
    name: Name
    expected_cm: Length
    iterations: Iterations = 1
    gait: str = Field(default="", max_length=200)
    run: str = Field(default="", max_length=200)
    note: str = Field(default="", max_length=4000)


class CheckerboardsBody(FiniteBody):
    """In which pictures a checkerboard is looked for; null takes some from the whole video."""

    columns: Corners
    rows: Corners
    frames: list[Annotated[int, Field(ge=0)]] | None = Field(default=None, min_length=1, max_length=100)


@router.get("")
async def list_videos(
    studio: TheStudio, run: Annotated[str, Query(max_length=200)] = "", deleted: bool = False
) -> Json:
    """Videos, the newest first, of one run or all."""
    views = await run_in_threadpool(studio.lab.videos.views, run, is_deleted=deleted)
    unreadable = await run_in_threadpool(studio.lab.videos.unreadable, run, is_deleted=deleted)
    return {"videos": views, "unreadable": unreadable, "most_bytes": MOST_BYTES}


@router.post("", status_code=201)
async def upload(
    request: Request,
    response: Response,
    studio: TheStudio,
    name: Annotated[str, Query(min_length=1, max_length=200)],
) -> Json:
    """Keeps the video that is the request's body; what is no video or breaks off leaves nothing.

    A file that is kept already is not kept twice: the answer is 200 with `again` and the video that is there.
    """
    said = request.headers.get("content-length", "")
    size = int(said) if said.isdigit() else None
    taken = await run_in_threadpool(studio.lab.videos.begin, name, size)
    try:
        await _take(request, taken)
        kept = await run_in_threadpool(studio.lab.videos.keep, taken)
        if kept["again"]:
            response.status_code = 200
        return kept
    finally:
        await run_in_threadpool(taken.discard)


async def _take(request: Request, taken: Upload) -> None:
    gathered = bytearray()
    async for chunk in request.stream():
        gathered += chunk
        if len(gathered) >= GATHER:
            data, gathered = bytes(gathered), bytearray()
            await run_in_threadpool(taken.add, data)
    await run_in_threadpool(lambda: taken.add(bytes(gathered)))


@router.get("/{video}")
async def read_video(video: str, studio: TheStudio) -> Json:
    """A video."""
    return await run_in_threadpool(studio.lab.videos.view, video)


@router.delete("/{video}")
async def delete_video(video: str, studio: TheStudio) -> Json:
    """Takes a video out of the list; it can be restored."""
    await run_in_threadpool(studio.lab.videos.delete, video)
    return {"id": video, "deleted": True}


@router.post("/{video}/restore")
async def restore_video(video: str, studio: TheStudio) -> Json:
    """Brings a deleted video back."""
    return await run_in_threadpool(studio.lab.videos.restore, video)


@router.get("/{video}/picture.jpg", response_class=Response)
async def picture_of_video(
    video: str,
    studio: TheStudio,
    frame: Frame = None,
    seconds: Annotated[float | None, Query(ge=0.0, le=1e6)] = None,
    most: Width = None,
) -> Response:
    """One picture, by its number or by the video's time."""
    videos = studio.lab.videos
    content = await run_in_threadpool(lambda: videos.picture(videos.source(video, frame, seconds), most))
    return Response(content, media_type="image/jpeg", headers={"cache-control": "no-cache"})


@router.get("/{video}/times")
async def times_of_video(video: str, studio: TheStudio) -> Json:
    """The time of each picture after the first, s; films of many phones have a varying rate."""
    times = await run_in_threadpool(studio.lab.videos.times, video)
    return {"times": [round(time, 4) for time in times.tolist()]}


@router.get("/{video}/file", response_class=Response)
async def file_of_video(video: str, studio: TheStudio) -> FileResponse:
    """The video as it is kept; a recording as JPEG pictures one after the other (MJPEG)."""
    path, view = await run_in_threadpool(
        lambda: (studio.lab.videos.path(video), studio.lab.videos.view(video))
    )
    is_recording = path.is_dir()
    name = quote(f"{view['name']}.mjpeg" if is_recording else view["name"])
    headers = {"content-disposition": f"attachment; filename*=UTF-8''{name}"}
    return FileResponse(path / PICTURES if is_recording else path, headers=headers)


@router.get("/{video}/stream", response_class=Response)
async def play_video(
    video: str,
    studio: TheStudio,
    from_frame: Annotated[int, Query(ge=0)] = 0,
    speed: Annotated[float, Query(gt=0.0, le=20.0)] = 1.0,
    most: Width = 960,
) -> StreamingResponse:
    """The video's pictures in real time (multipart), to its end; late ones are left out."""
    times = await run_in_threadpool(studio.lab.videos.times, video)
    first = await run_in_threadpool(studio.lab.videos.source, video, from_frame)
    due = (times - times[from_frame]) / speed

    async def parts() -> AsyncIterator[bytes]:
        begun, number = time.monotonic(), from_frame
        while number < times.size and not studio.hub.is_closed:
            source = Source(first.path, number, name=first.name)
            try:
                yield part(await run_in_threadpool(studio.lab.videos.picture, source, most))
            except FootfallError:  # it does not decode, or the file is gone
                return
            late = int(np.searchsorted(due, time.monotonic() - begun, side="right")) - 1
            number = max(number + 1, late)
            if number < due.size:
                await asyncio.sleep(max(0.0, begun + float(due[number]) - time.monotonic()))

    return StreamingResponse(parts(), media_type=f"multipart/x-mixed-replace; boundary={BOUNDARY}")


@router.post("/{video}/look")
async def look_at_video(video: str, look: LookBody, studio: TheStudio, frame: Frame = None) -> Json:
    """A picture with what tracking would find in it."""
    source = await run_in_threadpool(studio.lab.videos.source, video, frame)
    return await look_at(studio, source, look)


@router.post("/{video}/boards")
async def find_checkerboards(video: str, asked: CheckerboardsBody, studio: TheStudio) -> Json:
    """Where a checkerboard is in some pictures of a video; `left` are those for another request."""
    frames = asked.frames
    if frames is None:
        last = (await run_in_threadpool(studio.lab.videos.times, video)).size - 1
        count = min(BOARD_FRAMES, last + 1)
        frames = [number * last // max(count - 1, 1) for number in range(count)]
    boards: list[Json] = []
    due = time.monotonic() + BOARD_SECONDS
    for frame in frames:
        if boards and time.monotonic() > due:
            break
        source = await run_in_threadpool(studio.lab.videos.source, video, frame)
        boards.append(await checkerboard_of(studio, FindCheckerboard(source, (asked.columns, asked.rows))))
    return {"boards": boards, "left": frames[len(boards) :]}


@router.post("/{video}/track", status_code=202)
async def track(video: str, asked: TrackBody, studio: TheStudio, author: TheAuthor) -> Json:
    """Starts following the feet; the job's result names the trial."""
    gait, gait_name, planned = await planned_for(studio, asked.run, asked.gait, asked.iterations)
    words = TrialDescription(
        asked.name,
        author.name,
        asked.expected_cm,
        asked.iterations,
        asked.note,
        gait,
        gait_name,
        asked.run,
    )
    order = TrackingJob(video, asked.setup, words, planned)
    content = await on_command_thread(studio, lambda: studio.job_commands.submit_tracking(order))
    return {"id": content["id"]}
