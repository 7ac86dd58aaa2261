"""Gaits out and in: every form of a gait as a download, and other people's files as new gaits."""

from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response
from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool

from app.common.names import free_name
from app.export.formats import NEED_NO_MOTION, ExportedFile, ExportFormat, export
from app.export.import_gait import NO_FILE, read_gait
from app.export.source import Exportable, exportable_plan
from app.gaits.open_gait import OpenGait
from app.web.dependencies import RequestBody, TheStudio, changed, on_command_thread, on_planned
from core.errors import InputError
from core.gait.gait import MOST_NAME
from core.gait.recording import MOST_FILE_NAME, RecordingFit, WithinStroke
from core.text.decoding import text_of

router = APIRouter(prefix="/api/gaits", tags=["gaits"])
MOST_BYTES = 20_000_000
"""Largest body of a request; the gait document that it becomes is smaller (`app.documents.gait_json`)."""

_FILE = {
    "requestBody": {
        "required": True,
        "content": {
            "text/csv": {"schema": {"type": "string"}},
            "application/json": {"schema": {"type": "object"}},
        },
    }
}


class TrajectoryPair(RequestBody):
    """A trajectory CSV with its companion, each as text; `csv` comes first."""

    csv: str
    companion: str | None = None


@router.get("/{gait_id}/export/{form}", response_class=Response)
async def export_gait(gait_id: str, form: ExportFormat, studio: TheStudio) -> Response:
    """The gait, its plan or its diagram as a file."""

    def source() -> Exportable:
        gait = studio.gaits.open_gait(gait_id).gait
        if form in NEED_NO_MOTION:
            return Exportable(gait_id, gait, InputError("This form needs no motion.", "plan"))
        return exportable_plan(gait_id, gait, studio.gaits.plan(gait_id))

    needed = (
        on_command_thread(studio, source) if form in NEED_NO_MOTION else on_planned(studio, gait_id, source)
    )
    exportable = await needed
    file: ExportedFile = await run_in_threadpool(export, exportable, form)
    return Response(
        file.content,
        media_type=file.media_type,
        headers={"content-disposition": f'attachment; filename="{file.name}"', "cache-control": "no-cache"},
    )


@router.post("/import", status_code=201, openapi_extra=_FILE)
async def import_gait(
    request: Request,
    studio: TheStudio,
    file: Annotated[str, Query(min_length=1, max_length=MOST_FILE_NAME)] = NO_FILE,
    name: Annotated[str | None, Query(max_length=MOST_NAME)] = None,
    sample_time: Annotated[float | None, Query(gt=0)] = None,
    robot: Annotated[str | None, Query(max_length=80)] = None,
    within_stroke: WithinStroke | None = None,
) -> dict[str, Any]:
    """Saves a new gait from a trajectory CSV, waypoints, a phase list or a gait document.

    `file` is the file's name, for messages and for what the gait says of its origin. `robot` says whose
    motion it is where several have so many feet, `within_stroke` what becomes of strokes beyond the motors'
    range. A name that another gait has already gets a number. The
    answer is the gait's view with `remarks`: what was assumed.
    """
    text, companion = _file(await _body(request, file), file)
    fit = RecordingFit(within_stroke=within_stroke)
    described = await run_in_threadpool(
        lambda: read_gait(
            text, file, name=name, companion=companion, sample_time=sample_time, robot=robot, fit=fit
        )
    )

    def create() -> OpenGait:
        taken = {summary["name"] for summary in studio.publisher.summaries()}
        gait = replace(described.gait, name=free_name(described.gait.name, taken))
        return studio.gaits.create(gait)

    return {**await changed(studio, create), "remarks": list(described.remarks)}


async def _body(request: Request, file: str) -> str:
    return text_of(await request.body(), file, MOST_BYTES)


def _file(text: str, file: str) -> tuple[str, str | None]:
    """The file's text, and its companion's where both were sent as one JSON object."""
    if not text.lstrip().startswith('{"csv"'):
        return text, None
    try:
        pair = TrajectoryPair.model_validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "body"
        raise InputError(f"{file}, field {field}: {first['msg']}.", f"{file}.{field}") from error
    return pair.csv, pair.companion
