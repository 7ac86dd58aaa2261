"""Setups of cameras, and their lenses out of pictures of a checkerboard."""

import base64
import binascii
from typing import Annotated

import numpy as np
from fastapi import APIRouter, Query, Request
from fastapi.responses import Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.cameras.setup_schema import LensDocument, Number, SetupDocument, Side
from app.common.json import Json
from app.studio.studio import Studio
from app.vision.services import ask
from app.vision.worker import FindCheckerboard, FitLens, Source, Straighten, data_url
from app.web.dependencies import RequestBody, Revision, TheStudio
from core.errors import InputError

router = APIRouter(prefix="/api", tags=["cameras"])
Corners = Annotated[int, Field(ge=3, le=30)]
CornersAsked = Annotated[int, Query(ge=3, le=30)]

MOST_PICTURE = 30_000_000
"""Bytes of a picture."""

MOST_CHECKERBOARDS = 100
"""Pictures of the checkerboard for a lens."""

CHECKERBOARD_SECONDS = 60.0
"""Longest wait for a checkerboard or a lens."""


class SetupChange(RequestBody):
    """A setup as it is to be, and the revision that was changed."""

    revision: Revision
    setup: SetupDocument


class CheckerboardBody(RequestBody):
    """Where a checkerboard's inner corners are in a picture."""

    name: str = Field(max_length=200)
    frame: int | None = None
    size: tuple[Side, Side]
    found: bool
    points: list[tuple[Number, Number]] = Field(max_length=900)


class LensBody(RequestBody):
    """Boards of which a lens is made."""

    columns: Corners
    rows: Corners
    boards: list[CheckerboardBody] = Field(max_length=MOST_CHECKERBOARDS)


class Straightening(RequestBody):
    """A picture that is to be shown as a lens without distortion would have it."""

    lens: LensDocument
    picture: str = Field(max_length=MOST_PICTURE)


@router.get("/setups")
async def list_setups(studio: TheStudio, deleted: bool = False) -> Json:
    """All setups, the last changed first, and what stands in a new one."""
    setups = studio.lab.setups
    views = await run_in_threadpool(lambda: setups.views(is_deleted=deleted))
    unreadable = await run_in_threadpool(lambda: setups.unreadable(is_deleted=deleted))
    defaults = SetupDocument(name="new").model_dump(mode="json", exclude={"name"})
    return {"setups": views, "unreadable": unreadable, "defaults": defaults}


@router.post("/setups", status_code=201)
async def add_setup(setup: SetupDocument, studio: TheStudio) -> Json:
    """Keeps a new setup."""
    return await run_in_threadpool(lambda: studio.lab.setups.add(setup))


@router.post("/setups/check")
async def check_setup(setup: SetupDocument, studio: TheStudio) -> Json:
    """What a setup would amount to; nothing is kept."""
    return await run_in_threadpool(lambda: studio.lab.setups.check(setup))


@router.get("/setups/{setup}")
async def read_setup(setup: str, studio: TheStudio, revision: Revision | None = None) -> Json:
    """A setup, or an older revision of it."""
    return await run_in_threadpool(lambda: studio.lab.setups.view(setup, revision))


@router.put("/setups/{setup}")
async def change_setup(setup: str, change: SetupChange, studio: TheStudio) -> Json:
    """Keeps a new revision; refused where somebody else changed it meanwhile."""
    return await run_in_threadpool(lambda: studio.lab.setups.change(setup, change.revision, change.setup))


@router.delete("/setups/{setup}")
async def delete_setup(setup: str, studio: TheStudio) -> Json:
    """Takes a setup out of the list; it can be restored."""
    await run_in_threadpool(lambda: studio.lab.setups.delete(setup))
    return {"id": setup, "deleted": True}


@router.post("/setups/{setup}/restore")
async def restore_setup(setup: str, studio: TheStudio) -> Json:
    """Brings a deleted setup back."""
    return await run_in_threadpool(lambda: studio.lab.setups.restore(setup))


@router.get("/setups/{setup}/export", response_class=Response)
async def export_setup(setup: str, studio: TheStudio) -> Response:
    """The setup as a file for `footfall trial VIDEO --setup FILE`."""
    view = await run_in_threadpool(lambda: studio.lab.setups.view(setup))
    text = SetupDocument.model_validate(view["setup"]).model_dump_json(indent=2) + "\n"
    headers = {"content-disposition": f'attachment; filename="setup-{setup}.json"'}
    return Response(text, media_type="application/json", headers=headers)


@router.post("/boards")
async def find_board(
    request: Request,
    studio: TheStudio,
    columns: CornersAsked,
    rows: CornersAsked,
    name: Annotated[str, Query(max_length=200)] = "picture",
) -> Json:
    """Where a checkerboard's inner corners are in the picture that is the request's body."""
    source = Source(file=await picture_in(request), name=name)
    return await checkerboard_of(studio, FindCheckerboard(source, (columns, rows)))


async def picture_in(request: Request) -> bytes:
    """The picture that is a request's body.

    Raises:
        InputError: it is too large.
    """
    content = bytearray()
    async for chunk in request.stream():
        content += chunk
        if len(content) > MOST_PICTURE:
            raise InputError(
                f"The picture has more than {MOST_PICTURE / 1e6:g} MB; save it smaller.", "picture"
            )
    return bytes(content)


async def checkerboard_of(studio: Studio, task: FindCheckerboard) -> Json:
    """Looks for a checkerboard."""
    found: Json = await run_in_threadpool(
        lambda: ask(studio.lab.vision.checkerboards, task, CHECKERBOARD_SECONDS)
    )
    return found


@router.post("/lens")
async def make_lens(lens: LensBody, studio: TheStudio) -> Json:
    """A camera's lens out of boards that were found; says how well it explains each of them."""
    shown = [board for board in lens.boards if board.found]
    sizes = {board.size for board in shown}
    if len(sizes) > 1:
        raise InputError("The pictures have different sizes; take all with one camera.", "boards")
    for board in shown:
        if len(board.points) != lens.columns * lens.rows:
            raise InputError(
                f"{board.name} has {len(board.points)} corners; a board of {lens.columns} × {lens.rows} has "
                f"{lens.columns * lens.rows}. Look for the board again.",
                "boards",
            )
    size = next(iter(sizes), (16, 16))
    boards = [np.array(board.points) for board in shown]
    for board, points in zip(shown, boards, strict=True):
        if (points < 0.0).any() or (points > size).any():
            raise InputError(f"{board.name} has corners outside its picture. Look for it again.", "boards")
    task = FitLens(boards, size, (lens.columns, lens.rows))
    found: Json = await run_in_threadpool(
        lambda: ask(studio.lab.vision.checkerboards, task, CHECKERBOARD_SECONDS)
    )
    each = iter(found.pop("each"))
    return {
        "lens": {**found, "boards": len(shown)},
        "size": list(size),
        "rms_px": found["rms_px"],
        "boards": [
            {"name": board.name, "found": board.found, "rms_px": next(each) if board.found else None}
            for board in lens.boards
        ],
    }


@router.post("/lens/look")
async def straighten(asked: Straightening, studio: TheStudio) -> Json:
    """A picture as a lens without distortion would have it."""

    def straight() -> bytes:
        task = Straighten(Source(file=_content(asked.picture)), asked.lens.value())
        file: bytes = ask(studio.lab.vision.interactive, task, CHECKERBOARD_SECONDS)
        return file

    return {"picture": await run_in_threadpool(lambda: data_url(straight()))}


def _content(address: str) -> bytes:
    try:
        return base64.b64decode(address.partition(",")[2], validate=True)
    except (binascii.Error, ValueError):
        raise InputError("The picture must be a data address of a JPEG or PNG file.", "picture") from None
