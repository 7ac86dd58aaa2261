"""Entries of the database that cannot be read: the list, setting one aside, and bringing it back."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.web.dependencies import RequestBody, TheStudio

router = APIRouter(prefix="/api/storage", tags=["studio"])

LARGEST_ROW = 2**63 - 1


class DamagedRow(RequestBody):
    """An entry that cannot be read."""

    table: str = Field(max_length=64)
    row: int = Field(ge=-LARGEST_ROW, le=LARGEST_ROW, description="its number in the table")


class SetAside(RequestBody):
    """An entry that was set aside."""

    number: int = Field(ge=1, le=LARGEST_ROW)


@router.get("/unreadable")
async def list_unreadable(studio: TheStudio) -> Json:
    """Entries that cannot be read: how many, the first 100 with sentences, and those that were set aside."""
    return await run_in_threadpool(studio.storage.unreadable.full_view)


@router.post("/unreadable/set-aside")
async def set_aside(damaged: DamagedRow, studio: TheStudio) -> Json:
    """Takes an entry that cannot be read out of its list; it is kept, and can be brought back."""
    number = await run_in_threadpool(studio.storage.unreadable.set_aside, damaged.table, damaged.row)
    return {"number": number}


@router.post("/unreadable/bring-back")
async def bring_back(aside: SetAside, studio: TheStudio) -> Json:
    """Puts an entry that was set aside back where it was."""
    await run_in_threadpool(studio.storage.unreadable.bring_back, aside.number)
    return {"number": aside.number}
