"""Jobs: start, list, look at, cancel."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends
from pydantic import BaseModel, ConfigDict

from app.routes.edge import on_session, studio_of
from app.studio import Studio

router = APIRouter(prefix="/api/jobs", tags=["jobs"])
TheStudio = Annotated[Studio, Depends(studio_of)]


class JobRequest(BaseModel):
    """What to compute, for which gait."""

    model_config = ConfigDict(extra="forbid")
    kind: Literal["optimise"] = "optimise"
    gait: str


@router.post("", status_code=202)
async def submit(job: JobRequest, studio: TheStudio) -> dict[str, Any]:
    """Starts the optimisation of a gait as it is now."""
    content = await on_session(studio, lambda: studio.submit_job(job.gait))
    return {"id": content["id"]}


@router.get("")
async def list_jobs(studio: TheStudio) -> dict[str, Any]:
    """The newest jobs, newest first."""
    return {"jobs": await on_session(studio, lambda: [studio.job_view(c) for c in studio.jobs.contents()])}


@router.get("/{job_id}")
async def read_job(job_id: str, studio: TheStudio) -> dict[str, Any]:
    """A job with its course so far."""
    return await on_session(studio, lambda: studio.job_view(studio.jobs.content(job_id)))


@router.delete("/{job_id}")
async def cancel(job_id: str, studio: TheStudio) -> dict[str, Any]:
    """Cancels a job; one that has ended stays as it is."""
    return await on_session(studio, lambda: studio.job_view(studio.jobs.cancel(job_id)))
