"""The published experiments: their tables beside our figures, computed in the background."""

from fastapi import APIRouter
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.web.dependencies import RequestBody, TheStudio

router = APIRouter(prefix="/api/published", tags=["published"])

MOST_PATH = 4096
"""Characters of a folder's name."""


class Folder(RequestBody):
    """The folder of the published data; empty to forget it."""

    folder: str = Field(max_length=MOST_PATH)


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


@router.post("/{table}/compute", status_code=202)
async def compute(table: str, studio: TheStudio) -> Json:
    """Computes what is missing of a table, in the background."""
    return await run_in_threadpool(studio.published.compute, table)


@router.delete("/{table}/compute")
async def cancel(table: str, studio: TheStudio) -> Json:
    """Ends the computation of a table; what is done stays."""
    return await run_in_threadpool(studio.published.cancel, table)
