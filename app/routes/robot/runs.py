"""Runs that were kept: list, figures, strokes, note, deleting, files."""

from datetime import date, datetime, timedelta
from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.runs.export import run_csv, run_mcap
from app.runs.motion import measured_trajectory
from app.scene.ghost import ghost_blob
from app.store.tables.run_store import RunFilter
from app.web.dependencies import MOST_NUMBER, RequestBody, TheStudio

router = APIRouter(prefix="/api/runs", tags=["runs"])
Word = Annotated[str, Query(max_length=200)]

FIRST_DAY, LAST_DAY = date(1970, 1, 2), date(9000, 1, 1)
"""Between these the clock has a time for every day; no run is of another one."""

MOST_NOTE = 4000
"""Characters of a note."""


class Note(RequestBody):
    """What a person wrote of a run; nothing takes the note away."""

    note: str = Field(max_length=MOST_NOTE)


@router.get("")
async def list_runs(
    studio: TheStudio,
    gait: Word = "",
    state: Word = "",
    operator: Word = "",
    since: date | None = None,
    until: date | None = None,
    offset: Annotated[int, Query(ge=0, le=MOST_NUMBER)] = 0,
    most: Annotated[int, Query(ge=1, le=200)] = 50,
) -> Json:
    """Runs, the newest first: of a gait, a state, an operator, and of days, the last one included."""
    wanted = RunFilter(
        gait,
        state,
        operator,
        None if since is None else _begin(since),
        None if until is None else _begin(until, timedelta(days=1)),
    )
    return await run_in_threadpool(studio.runs.found, wanted, offset, most)


@router.get("/{run}")
async def read_run(run: str, studio: TheStudio) -> Json:
    """A run with its states and errors."""
    return await run_in_threadpool(studio.runs.summary, run)


@router.get("/{run}/strokes")
async def read_strokes(
    run: str, studio: TheStudio, most: Annotated[int, Query(ge=10, le=100_000)] = 2000
) -> Json:
    """Measured and commanded strokes over time, thinned for plots; mm."""
    return await run_in_threadpool(studio.runs.strokes, run, most)


@router.get("/{run}/comparison")
async def compare_runs(run: str, other: Word, studio: TheStudio) -> Json:
    """Two runs, aligned by waypoint: times and strokes of both at the waypoints that both reached."""
    return await run_in_threadpool(studio.runs.comparison, run, other)


@router.put("/{run}/note")
async def write_note(run: str, note: Note, studio: TheStudio) -> Json:
    """Keeps a note with a run."""
    return await run_in_threadpool(lambda: studio.runs.note(run, note.note.strip()))


@router.delete("/{run}")
async def delete_run(run: str, studio: TheStudio) -> Json:
    """Takes a run out of the list; it can be restored."""
    return await run_in_threadpool(studio.runs.delete, run)


@router.post("/{run}/restore")
async def restore_run(run: str, studio: TheStudio) -> Json:
    """Brings a deleted run back."""
    return await run_in_threadpool(studio.runs.restore, run)


@router.get("/{run}/run.csv", response_class=Response)
async def csv_of_run(run: str, studio: TheStudio) -> Response:
    """The run as CSV: t in s, state, commanded and measured strokes in mm."""
    text = await run_in_threadpool(lambda: run_csv(studio.runs.record(run)))
    return _file(text.encode(), f"run-{run}.csv", "text/csv")


@router.get("/{run}/run.mcap", response_class=Response)
async def mcap_of_run(run: str, studio: TheStudio) -> Response:
    """The run as MCAP: strokes, commands, states and raw bytes."""
    content = await run_in_threadpool(lambda: run_mcap(studio.runs.record(run)))
    return _file(content, f"run-{run}.mcap", "application/octet-stream")


@router.get("/{run}/ghost", response_class=Response)
async def ghost_of_run(run: str, studio: TheStudio) -> Response:
    """The measured robot as poses of lines, on the plan's time axis; binary."""

    def blob() -> bytes:
        record = studio.runs.record(run)
        return ghost_blob(record.plan.model, measured_trajectory(record)).to_bytes()

    return Response(await run_in_threadpool(blob), media_type="application/octet-stream")


def _begin(day: date, later: timedelta = timedelta()) -> float:
    """When a day, or one that is later, begins where the studio runs, s since the epoch."""
    day = min(max(day, FIRST_DAY), LAST_DAY) + later
    return datetime(day.year, day.month, day.day).astimezone().timestamp()


def _file(content: bytes, name: str, kind: str) -> Response:
    headers = {"content-disposition": f'attachment; filename="{name}"', "cache-control": "no-cache"}
    return Response(content, media_type=kind, headers=headers)
