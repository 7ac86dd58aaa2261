"""Reports of trials: one HTML file that opens offline, of one trial or of all gaits compared."""

from fastapi import APIRouter, Response
from starlette.concurrency import run_in_threadpool

from app.web.dependencies import TheStudio

router = APIRouter(prefix="/api/trials", tags=["trials"])


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
