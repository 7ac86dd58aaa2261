"""Sequences: gaits chained into one, and brought up to date with the gaits that they were made of."""

from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import Field

from app.common.json import Json
from app.gaits.open_gait import OpenGait
from app.gaits.sequence_documents import PartReference, made_sequence, refreshed
from app.web.dependencies import RequestBody, TheAuthor, TheStudio, changed, on_command_thread
from core.gait.gait import MOST_NAME, MOST_NOTES, MOST_PARTS, MOST_TIMES

router = APIRouter(prefix="/api", tags=["sequences"])


class NewPart(RequestBody):
    """A gait by its id, and how often it runs."""

    gait: str = Field(max_length=80)
    times: int = Field(default=1, ge=1, le=MOST_TIMES)


class NewSequence(RequestBody):
    """A name, and the gaits that follow each other; a sequence among them stands for its parts."""

    name: str = Field(max_length=MOST_NAME)
    parts: list[NewPart] = Field(min_length=1, max_length=MOST_PARTS)
    notes: str = Field(default="", max_length=MOST_NOTES)


@router.post("/sequences", status_code=201)
async def create_sequence(asked: NewSequence, studio: TheStudio) -> Json:
    """Saves a new gait that chains others, and gives its view."""

    def create() -> OpenGait:
        parts = [PartReference(part.gait, part.times) for part in asked.parts]
        gait = made_sequence(asked.name, parts, studio.gaits.document, asked.notes)
        return studio.gaits.create(gait)

    return await changed(studio, create)


@router.post("/gaits/{gait_id}/sequence/refresh")
async def refresh_sequence(
    gait_id: str, studio: TheStudio, author: TheAuthor, part: Annotated[int | None, Query(ge=0)] = None
) -> Json:
    """Takes over the gaits that changed since they became parts: all, or that of one part (from 0)."""

    def refresh() -> OpenGait:
        gait = refreshed(studio.gaits.document(gait_id), studio.gaits.document, part)
        label = "Take over changed gaits" if part is None else f"Take over part {part + 1}"
        return studio.gaits.edit(gait_id, gait, label, None, author)

    return await changed(studio, refresh)


@router.post("/gaits/{gait_id}/sequence/optimise", status_code=202)
async def optimise_parts(gait_id: str, studio: TheStudio) -> Json:
    """Starts the exact tier for each part that has no exact motion yet."""
    views = await on_command_thread(studio, lambda: studio.job_commands.submit_parts(gait_id))
    return {"jobs": [view["id"] for view in views]}
