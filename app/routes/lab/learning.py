"""Learning parameters of the physics from trials: start, look at, cancel, keep as a named set."""

from typing import Annotated

from fastapi import APIRouter
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.learning.published_trials import ITERATIONS, walks_of_table
from app.learning.service import MOST_SET_NAME
from app.learning.walks import SentTrial, walks_of
from app.studio.studio import Studio
from app.trials.figures import ROBOT
from app.web.dependencies import RequestBody, Revision, TheAuthor, TheStudio
from core.errors import InputError
from core.identification.learning import Walk
from core.physics.masses import default_physics
from core.robot.model import load_robot

router = APIRouter(prefix="/api/learning", tags=["learning"])

MOST_TRIALS = 200
MOST_TEXT = 2_000_000
"""Characters of a file."""
File = Annotated[str, Field(max_length=MOST_TEXT)]


class PublishedTable(RequestBody):
    """A table like `trajectory_averages.csv`, and the trajectories that were walked, by file name."""

    csv: File
    trajectories: dict[Annotated[str, Field(max_length=200)], File] = Field(max_length=64)
    iterations: int = Field(default=ITERATIONS, ge=1, le=50)


class NewLearning(RequestBody):
    """From what is learned: kept trials by id, or a published table."""

    trials: list[Annotated[str, Field(max_length=64)]] = Field(default=[], max_length=MOST_TRIALS)
    table: PublishedTable | None = None


class SetName(RequestBody):
    """What a set is to be called; a name that is there gets a new version."""

    name: str = Field(min_length=1, max_length=MOST_SET_NAME)


class SetVersion(SetName):
    """One version of a set."""

    version: Revision


@router.post("", status_code=202)
async def start(wanted: NewLearning, studio: TheStudio, author: TheAuthor) -> Json:
    """Begins to learn, in the background; one course at a time."""

    def begin() -> Json:
        walks, source = _walks(wanted, studio)
        physics = default_physics(walks[0].problem.model) if walks else default_physics(load_robot(ROBOT))
        return studio.learning.start(walks, physics, author.name, source)

    return await run_in_threadpool(begin)


def _walks(wanted: NewLearning, studio: Studio) -> tuple[tuple[Walk, ...], str]:
    if (wanted.table is None) == (not wanted.trials):
        raise InputError("Give either trials or a table to learn from.", "trials")
    if wanted.table is not None:
        table = wanted.table
        walks = walks_of_table(table.csv, table.trajectories, load_robot(ROBOT), table.iterations)
        return walks, f"a table of {len(walks)} gaits"
    chosen = tuple(dict.fromkeys(wanted.trials))
    walks = walks_of([SentTrial(studio.trials.record(one), studio.trials.sent(one)) for one in chosen])
    return walks, f"{len(chosen)} trials of {len(walks)} gaits"


@router.get("")
async def list_courses(studio: TheStudio) -> Json:
    """The newest courses of learning without their results, the newest first."""
    return {
        "courses": await run_in_threadpool(studio.learning.found),
        "unreadable": await run_in_threadpool(studio.learning.unreadable),
    }


@router.get("/sets")
async def list_sets(studio: TheStudio) -> Json:
    """The sets of parameters that were learned, the newest first; parameters are SI."""
    found = await run_in_threadpool(studio.learning.sets.found)
    unreadable = await run_in_threadpool(studio.learning.sets.unreadable)
    return {"sets": [one.line for one in found], "unreadable": unreadable}


@router.post("/sets/delete")
async def delete_set(which: SetVersion, studio: TheStudio) -> Json:
    """Takes a set out of the list; it can be restored. Simulations with it count as stale meanwhile."""
    await run_in_threadpool(studio.learning.sets.delete, which.name, which.version)
    return {"name": which.name, "version": which.version, "deleted": True}


@router.post("/sets/restore")
async def restore_set(which: SetVersion, studio: TheStudio) -> Json:
    """Brings a deleted set back."""
    restored = await run_in_threadpool(studio.learning.sets.restore, which.name, which.version)
    return restored.line


@router.get("/{learning}")
async def read_course(learning: str, studio: TheStudio) -> Json:
    """A course of learning: how far it is, and its result in cm and degrees."""
    return await run_in_threadpool(studio.learning.content, learning)


@router.delete("/{learning}")
async def cancel(learning: str, studio: TheStudio) -> Json:
    """Cancels a course; one that has ended stays as it is."""
    return await run_in_threadpool(studio.learning.cancel, learning)


@router.post("/{learning}/set", status_code=201)
async def keep(learning: str, wanted: SetName, studio: TheStudio, author: TheAuthor) -> Json:
    """Keeps what was learned as a named set of physics parameters, in its next version."""
    kept = await run_in_threadpool(studio.learning.save, learning, wanted.name, author.name)
    return kept.line
