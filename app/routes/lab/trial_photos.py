"""Photos of trials: adding, captions, deleting, the pictures themselves."""

from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.trials.photos import check_bytes
from app.web.dependencies import RequestBody, TheAuthor, TheStudio

router = APIRouter(prefix="/api/trials/{trial}/photos", tags=["trials"])

_PICTURE = {
    "requestBody": {
        "required": True,
        "content": {
            kind: {"schema": {"type": "string", "format": "binary"}} for kind in ("image/png", "image/jpeg")
        },
    }
}


class Caption(RequestBody):
    """What a person says of a photo; nothing takes the words away."""

    caption: str = Field(max_length=500)


@router.get("")
async def list_photos(trial: str, studio: TheStudio) -> Json:
    """A trial's photos, in the order in which they came."""
    return {
        "photos": await run_in_threadpool(studio.photos.photos, trial),
        "unreadable": await run_in_threadpool(studio.photos.unreadable, trial),
    }


@router.post("", status_code=201, openapi_extra=_PICTURE)
async def add_photo(
    trial: str,
    request: Request,
    studio: TheStudio,
    author: TheAuthor,
    name: Annotated[str, Query(min_length=1, max_length=200)] = "The photo",
) -> Json:
    """Keeps the PNG or JPEG picture that is the request's body, without place, time and camera."""
    gathered = bytearray()
    async for chunk in request.stream():
        gathered += chunk
        check_bytes(len(gathered), name)
    return await run_in_threadpool(lambda: studio.photos.add(trial, bytes(gathered), name, author.name))


@router.put("/{photo}")
async def caption_photo(trial: str, photo: str, words: Caption, studio: TheStudio) -> Json:
    """Keeps a caption."""
    return await run_in_threadpool(lambda: studio.photos.caption(trial, photo, words.caption.strip()))


@router.delete("/{photo}")
async def delete_photo(trial: str, photo: str, studio: TheStudio) -> Json:
    """Takes a photo away; it can be restored."""
    await run_in_threadpool(studio.photos.delete, trial, photo)
    return {"id": photo, "deleted": True}


@router.post("/{photo}/restore")
async def restore_photo(trial: str, photo: str, studio: TheStudio) -> Json:
    """Brings a deleted photo back."""
    return await run_in_threadpool(studio.photos.restore, trial, photo)


@router.get("/{photo}/picture", response_class=Response)
async def read_picture(trial: str, photo: str, studio: TheStudio, small: bool = False) -> Response:
    """The photo as JPEG, or its thumbnail."""
    content = await run_in_threadpool(studio.photos.picture, trial, photo, is_small=small)
    headers = {"cache-control": "private, max-age=31536000, immutable"}
    return Response(content, media_type="image/jpeg", headers=headers)
