"""Comparisons of trials: with plan and physics, tracks in 3D, bands over several, and HTML reports."""

from typing import Annotated

from fastapi import APIRouter, Query, Response
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.web.dependencies import TheStudio

router = APIRouter(prefix="/api/trials", tags=["trials"])


@router.get("/band")
async def read_band(trial: Annotated[list[str], Query()], studio: TheStudio) -> Json:
    """Trials over each other in the plan's frame, by iteration: mean, spread, each trial and the plan; cm."""
    return await run_in_threadpool(studio.comparison.band, trial)


@router.get("/{trial}/beside")
async def read_beside(trial: str, studio: TheStudio) -> Json:
    """Figures of planned, simulated and tracked feet; how the simulation stands; its ways for a plot, cm."""
    return await run_in_threadpool(studio.comparison.figures, trial)


@router.post("/{trial}/simulation", status_code=202)
async def simulate_trial(trial: str, studio: TheStudio) -> Json:
    """Begins to simulate what the robot was sent, unless that is done or on; tells how it stands."""
    return await run_in_threadpool(studio.comparison.simulate, trial)


@router.get("/{trial}/scene")
async def read_scene(trial: str, studio: TheStudio, lap: Annotated[int, Query(ge=1, le=1000)] = 1) -> Json:
    """The track over a lap of the plan by shares of the whole walk, its gaps, and how the robot stood; m."""
    return await run_in_threadpool(lambda: studio.comparison.scene(trial, lap))


@router.get("/report", response_class=Response)
async def report_of_all(studio: TheStudio) -> Response:
    """Gaits by steps compared, each with its trials over each other and over the plan."""
    return _file(await run_in_threadpool(studio.reports.compared), "trials.html")


@router.get("/{trial}/report", response_class=Response)
async def report_of_trial(trial: str, studio: TheStudio) -> Response:
    """A trial with its figures beside plan and physics, its plots, note, photos and origin."""
    return _file(await run_in_threadpool(lambda: studio.reports.trial(trial)), f"trial-{trial}.html")


def _file(text: str, name: str) -> Response:
    headers = {"content-disposition": f'attachment; filename="{name}"', "cache-control": "no-cache"}
    return Response(text.encode(errors="replace"), media_type="text/html", headers=headers)
