"""The published experiments: their tables beside our figures, computed in the background."""

from fastapi import APIRouter, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.documents.gait_json import sent_hash
from app.gaits.open_gait import OpenGait
from app.published.opening import Source
from app.web.dependencies import RequestBody, TheStudio, changed

router = APIRouter(prefix="/api/published", tags=["published"])

MOST_PATH = 4096
"""Characters of a folder's name."""


class Folder(RequestBody):
    """The folder of the published data; empty to forget it."""

    folder: str = Field(max_length=MOST_PATH)


class Opening(RequestBody):
    """The gait of a row that opens."""

    source: Source = Source.OURS


@router.get("")
async def list_tables(studio: TheStudio) -> Json:
    """The published tables without their rows, and the folder of the published data."""
    return await run_in_threadpool(studio.published.overview)


@router.put("/reference")
async def name_folder(folder: Folder, studio: TheStudio) -> Json:
    """Names the folder of the published data, which does not come with the program."""
    await run_in_threadpool(studio.published.name_folder, folder.folder)
    return await run_in_threadpool(studio.published.overview)


@router.get("/{table}")
async def read_table(table: str, studio: TheStudio) -> Json:
    """A table: sentences about its figures, columns, and rows; a cell is a number, a text or null."""
    return await run_in_threadpool(studio.published.view, table)


@router.post("/{table}/{row}/open", status_code=201)
async def open_row(table: str, row: str, wanted: Opening, studio: TheStudio) -> Json:
    """Makes a gait of a row: ours, or the published motion; where it is there unchanged, that one opens."""
    gait = await run_in_threadpool(studio.published.gait, table, row, wanted.source)

    def opened() -> OpenGait:
        same = (line["id"] for line in studio.publisher.summaries() if line["name"] == gait.name)
        for gait_id in same:
            if sent_hash(studio.gaits.document(gait_id)) == sent_hash(gait):
                return studio.gaits.open_gait(gait_id)
        return studio.gaits.create(gait)

    return await changed(studio, opened)


@router.get("/{table}/{row}/plot.svg", response_class=Response)
async def plot(table: str, row: str, studio: TheStudio) -> Response:
    """The x–y plot of a row beside the thesis's Figures 4.2 to 4.8."""
    drawing = await run_in_threadpool(studio.published.plot, table, row)
    return Response(drawing, media_type="image/svg+xml")


@router.post("/{table}/compute", status_code=202)
async def compute(table: str, studio: TheStudio) -> Json:
    """Computes what is missing of a table, in the background."""
    return await run_in_threadpool(studio.published.compute, table)


@router.delete("/{table}/compute")
async def cancel(table: str, studio: TheStudio) -> Json:
    """Ends the computation of a table; what is done stays."""
    return await run_in_threadpool(studio.published.cancel, table)
