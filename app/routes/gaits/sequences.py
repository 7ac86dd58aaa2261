"""Sequences: gaits chained into one, and brought up to date with the gaits that they were made of."""

from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import Field

from app.common.json import Json
from app.documents.gait_json import gait_content, gait_from_content
from app.gaits.open_gait import OpenGait
from app.gaits.sequence_documents import PartReference, made_sequence, refreshed, resampled
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
    resample: bool = Field(default=False, description="bring parts to one sample time where theirs differ")


class Resampling(RequestBody):
    """The parts of a sequence as it is to be, and the sample time that they are brought to."""

    sequence: list[Json] | None = Field(
        default=None, max_length=MOST_PARTS, description="parts as in the document; null: those it has"
    )
    sample_time: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="s; null: that of the most parts"
    )
    label: str = Field(default="", max_length=MOST_NAME, description="of the edit; empty: Resample")
    revision: int | None = Field(default=None, description="that the parts were edited on; null: any")


@router.post("/sequences", status_code=201)
async def create_sequence(asked: NewSequence, studio: TheStudio) -> Json:
    """Saves a new gait that chains others, and gives its view."""

    def create() -> OpenGait:
        parts = [PartReference(part.gait, part.times) for part in asked.parts]
        gait = made_sequence(asked.name, parts, studio.gaits.document, asked.notes, resample=asked.resample)
        return studio.gaits.create(gait)

    return await changed(studio, create)


@router.post("/gaits/{gait_id}/sequence/refresh")
async def refresh_sequence(
    gait_id: str,
    studio: TheStudio,
    author: TheAuthor,
    part: Annotated[int | None, Query(ge=0)] = None,
    resample: Annotated[bool, Query()] = False,
) -> Json:
    """Takes over the gaits that changed since they became parts: all, or that of one part (from 0).

    With `resample` parts with other sample times are brought to one; without it they are refused.
    """

    def refresh() -> OpenGait:
        gait = refreshed(studio.gaits.document(gait_id), studio.gaits.document, part, resample=resample)
        label = "Take over changed gaits" if part is None else f"Take over part {part + 1}"
        return studio.gaits.edit(gait_id, gait, label, None, author)

    return await changed(studio, refresh)


@router.post("/gaits/{gait_id}/sequence/resample")
async def resample_sequence(gait_id: str, asked: Resampling, studio: TheStudio, author: TheAuthor) -> Json:
    """Brings the parts of a sequence to one sample time, as one undo step.

    Parts in the request replace those of the sequence in the same step, so that an edit that was refused for
    its sample times is made after all. `resampled` of the answer has a sentence on each part that changed.
    """
    sentences: list[str] = []

    def resample() -> OpenGait:
        gait = studio.gaits.document(gait_id)
        if asked.sequence is not None:
            gait = gait_from_content({**gait_content(gait), "sequence": asked.sequence})
        outcome = resampled(gait, asked.sample_time)
        sentences.extend(outcome.changes)
        label = asked.label or "Resample"
        return studio.gaits.edit(gait_id, outcome.gait, label, asked.revision, author)

    view = await changed(studio, resample)
    return {**view, "resampled": sentences}


@router.post("/gaits/{gait_id}/sequence/optimise", status_code=202)
async def optimise_parts(gait_id: str, studio: TheStudio, author: TheAuthor) -> Json:
    """Starts the exact tier for each part that has no exact motion yet."""
    views = await on_command_thread(studio, lambda: studio.job_commands.submit_parts(gait_id, author))
    return {"jobs": [view["id"] for view in views]}
