"""Trials of the real robot: adding tracks, figures beside the plan, ends of iterations, tables."""

from typing import Annotated, Literal

from fastapi import APIRouter, Query, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.studio.studio import Studio
from app.trials.planned import PlannedFeet, planned_of_gait, planned_of_run
from app.trials.service import TrialDescription, compared
from app.trials.tables import table_csv, table_latex
from app.trials.track_source import TrackRecord, filed_record
from app.web.dependencies import FiniteBody, RequestBody, Revision, TheAuthor, TheStudio, on_planned
from core.errors import InputError
from core.vision.frame_times import read_frame_times
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE, PixelScale, read_track_csv

router = APIRouter(prefix="/api/trials", tags=["trials"])

MOST_TEXT = 20_000_000
"""Characters of a track file."""
Name = Annotated[str, Field(min_length=1, max_length=120)]
Length = Annotated[float, Field(gt=0, le=1000)]
Iterations = Annotated[int, Field(ge=1, le=50)]


class Pixels(RequestBody):
    """A track in pixels, y downwards, 0,0 a gap."""

    per_cm: float = Field(gt=0, le=10_000)
    origin: tuple[float, float]


class NewTrial(FiniteBody):
    """A track; `run` brings the plan that the robot was sent, `gait` the plan that the gait has now.

    `frame_times` is the text of a file with the time of each frame in s, one a line or a column `time`, for a
    film whose rate varies; it stands in place of `frame_rate`.
    """

    name: Name
    csv: str = Field(max_length=MOST_TEXT)
    expected_cm: Length
    iterations: Iterations = 1
    frame_rate: float = Field(default=FRAME_RATE, gt=0, le=1000)
    frame_times: str | None = Field(default=None, max_length=MOST_TEXT)
    pixels: Pixels | None = None
    gait: str = Field(default="", max_length=200)
    run: str = Field(default="", max_length=200)
    note: str = Field(default="", max_length=4000)


class TrialChanges(FiniteBody):
    """What is to be changed of a revision; what is left out stays. `ends` null finds the ends again."""

    revision: Revision
    name: Name | None = None
    note: str | None = Field(default=None, max_length=4000)
    expected_cm: Length | None = None
    iterations: Iterations | None = None
    ends: list[int] | None = None


@router.post("", status_code=201)
async def add_trial(trial: NewTrial, studio: TheStudio, author: TheAuthor) -> Json:
    """Keeps a track as a trial and tells its figures; `remarks` say what is unusual in its file's form."""
    scale = None if trial.pixels is None else PixelScale(0.01 / trial.pixels.per_cm, trial.pixels.origin)

    def read() -> tuple[FootTrack, TrackRecord | None, list[str]]:
        file = read_track_csv(trial.csv, trial.name, frame_rate=trial.frame_rate, pixels=scale)
        if trial.frame_times is None:
            return file.track, None, list(file.notes)
        clock = read_frame_times(trial.frame_times, f"frame times of {trial.name}")
        track = clock.timed(file.track, trial.name)
        return track, filed_record(track), [*file.notes, *(f"{clock.name}: {one}" for one in clock.notes)]

    if trial.frame_times is not None and "frame_rate" in trial.model_fields_set:
        raise InputError("Give either frame_rate or frame_times.", "frame_times")
    track, record, remarks = await run_in_threadpool(read)
    gait, gait_name, planned = await planned_for(studio, trial.run, trial.gait, trial.iterations)
    words = TrialDescription(
        trial.name, author.name, trial.expected_cm, trial.iterations, trial.note, gait, gait_name, trial.run
    )
    added = await run_in_threadpool(studio.trials.add, track, words, planned, record)
    return {**added, "remarks": remarks}


@router.post("/example", status_code=201)
async def add_example(studio: TheStudio) -> Json:
    """Keeps an example made by simulation from a gait of the library.

    `is_example` marks it, also in the list. It counts in no comparison of gaits, and nothing is learned
    from it.
    """
    return await run_in_threadpool(studio.examples.add)


async def planned_for(
    studio: Studio, run: str, gait_id: str, iterations: int
) -> tuple[str, str, PlannedFeet | None]:
    """Id and name of the gait of a trial, and where its feet were to be: by its run, or else by its gait."""
    if run:
        record = await run_in_threadpool(studio.runs.record, run)
        planned = await run_in_threadpool(planned_of_run, record)
        return record.content["gait"], record.content["gait_name"], planned
    if not gait_id:
        return "", "", None

    def of_gait() -> tuple[str, str, PlannedFeet | None]:
        gait, plan = studio.gaits.open_gait(gait_id).gait, studio.gaits.plan(gait_id)
        return gait_id, gait.name, planned_of_gait(gait, plan, iterations)

    return await on_planned(studio, gait_id, of_gait)


@router.get("")
async def list_trials(studio: TheStudio) -> Json:
    """All trials, the newest first, gaits by steps compared, and kept trials without figures."""
    lines = await run_in_threadpool(studio.trials.lines)
    unreadable = await run_in_threadpool(studio.trials.unreadable)
    return {"trials": lines, "compared": compared(lines), "unreadable": unreadable}


@router.get("/table", response_class=Response)
async def table(studio: TheStudio, form: Annotated[Literal["csv", "latex"], Query()] = "csv") -> Response:
    """Gaits by steps compared, as CSV or as a LaTeX tabular."""
    groups = compared(await run_in_threadpool(studio.trials.lines))
    text = table_csv(groups) if form == "csv" else table_latex(groups)
    return _file(
        text, "trials.csv" if form == "csv" else "trials.tex", "text/csv" if form == "csv" else "text/x-tex"
    )


@router.get("/{trial}")
async def read_trial(trial: str, studio: TheStudio) -> Json:
    """A trial's figures, each foot's and each iteration's, beside its plan's."""
    return await run_in_threadpool(studio.trials.summary, trial)


@router.get("/{trial}/paths")
async def read_paths(trial: str, studio: TheStudio) -> Json:
    """The feet's ways, tracked and planned, for a plot; cm in the track's frame."""
    return await run_in_threadpool(studio.trials.paths, trial)


@router.put("/{trial}")
async def change_trial(trial: str, changes: TrialChanges, studio: TheStudio) -> Json:
    """Changes name, note, wanted distance, iterations or their ends; 409 where it was changed meanwhile."""
    given = changes.model_dump(exclude_unset=True, exclude={"revision"})
    kept = {key: value for key, value in given.items() if value is not None or key == "ends"}
    return await run_in_threadpool(studio.trials.change, trial, changes.revision, kept)


@router.delete("/{trial}")
async def delete_trial(trial: str, studio: TheStudio) -> Json:
    """Takes a trial out of the list; it can be restored."""
    await run_in_threadpool(studio.trials.delete, trial)
    return {"id": trial, "deleted": True}


@router.post("/{trial}/restore")
async def restore_trial(trial: str, studio: TheStudio) -> Json:
    """Brings a deleted trial back."""
    return await run_in_threadpool(studio.trials.restore, trial)


@router.get("/{trial}/track.csv", response_class=Response)
async def track_of_trial(trial: str, studio: TheStudio) -> Response:
    """The track in centimetres; what was not seen is empty."""
    return _file(await run_in_threadpool(studio.trials.track, trial), f"track-{trial}.csv", "text/csv")


def _file(text: str, name: str, kind: str) -> Response:
    headers = {"content-disposition": f'attachment; filename="{name}"', "cache-control": "no-cache"}
    return Response(text.encode(), media_type=kind, headers=headers)
