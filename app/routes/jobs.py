"""Jobs: start, list, look at, cancel."""

from __future__ import annotations

from typing import Literal

from fastapi import APIRouter
from pydantic import Field, model_validator
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.gaits.views import plan_view
from app.web.dependencies import RequestBody, TheAuthor, TheStudio, on_command_thread, on_planned
from solver_jobs import JobKind

router = APIRouter(prefix="/api/jobs", tags=["jobs"])

MOST_VARIATIONS = 256
"""Of a simulation."""


class JobBody(RequestBody):
    """What to compute, for which gait."""

    kind: Literal["optimise", "timing", "simulate"] = "optimise"
    gait: str
    physics: str | None = Field(default=None, description="of simulate: a set of physics parameters")
    variations: int = Field(default=0, ge=0, le=MOST_VARIATIONS, description="of simulate: how many")

    @model_validator(mode="after")
    def _fits(self) -> JobBody:
        if self.kind != "simulate" and (self.physics is not None or self.variations):
            raise ValueError(f"physics and variations belong to simulate; leave them out of {self.kind}")
        return self


@router.post("", status_code=202)
async def submit(job: JobBody, studio: TheStudio, author: TheAuthor) -> Json:
    """Starts the optimisation of a gait as it is now, the search for its fastest timing, or a simulation."""
    commands = studio.job_commands
    if job.kind == "simulate":
        content = await on_planned(
            studio, job.gait, lambda: commands.submit_simulation(job.gait, job.physics, job.variations)
        )
        return {"id": content["id"]}
    kind = JobKind.TIMING if job.kind == "timing" else JobKind.MOTION
    content = await on_command_thread(studio, lambda: commands.submit_job(job.gait, kind, author))
    return {"id": content["id"]}


@router.get("")
async def list_jobs(studio: TheStudio) -> Json:
    """The newest jobs, newest first."""
    return {
        "jobs": await on_command_thread(studio, studio.publisher.job_views),
        "unreadable": await on_command_thread(studio, studio.job_repository.unreadable),
    }


@router.get("/{job_id}")
async def read_job(job_id: str, studio: TheStudio) -> Json:
    """A job with its course so far."""
    return await on_command_thread(
        studio, lambda: studio.publisher.job_view(studio.job_repository.content(job_id))
    )


@router.delete("/{job_id}")
async def cancel(job_id: str, studio: TheStudio) -> Json:
    """Cancels a job; one that has ended stays as it is."""
    return await on_command_thread(studio, lambda: studio.job_commands.cancel_job(job_id))


@router.get("/{job_id}/course/{number}")
async def iterate(job_id: str, number: int, studio: TheStudio) -> Json:
    """The motion at one of a job's iterations, as a plan to look at; 0 is the start."""
    plan = await on_command_thread(studio, lambda: studio.jobs.iterate(job_id, number))
    return await run_in_threadpool(lambda: plan_view(studio.live.keep(plan)))
