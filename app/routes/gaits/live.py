"""Questions about a changed document, while it is edited: its plan, and what would make it walk."""

from functools import partial
from typing import Annotated, TypeVar

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse, StreamingResponse
from pydantic import Field, ValidationError
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.documents.gait_json import MOST_BYTES
from app.gaits.live_plans import changed_gait
from app.studio.studio import Studio
from app.web.dependencies import RequestBody, TheStudio, on_command_thread
from app.web.state_lines import state_lines
from core.errors import InputError
from core.gait.gait import Gait
from core.text.json_size import require_few_values
from solver_jobs import Limit

router = APIRouter(prefix="/api/gaits", tags=["gaits"])


class Live(RequestBody):
    """A document to try; the gait as it is where none is given."""

    document: Json | None = None


class Remedies(Live):
    """A document that cannot walk."""

    tips: Annotated[
        bool, Field(description="Physics said that it tips: then it gets remedies though it has a motion.")
    ] = False


class AskedLimit(Live):
    """A drawing, and the number that is asked about."""

    which: Limit


Asked = TypeVar("Asked", bound=Live)


@router.post("/{gait_id}/live", response_model=Json)
async def live(gait_id: str, request: Request, studio: TheStudio) -> JSONResponse:
    """The plan of the gait, or of a changed document of it; nothing is changed."""
    asked = await _asked(request, Live)
    gait = await _gait(gait_id, studio)
    # As a finished answer: the framework's own way through every number takes longer than all the rest.
    return await run_in_threadpool(
        lambda: JSONResponse(studio.live.answer(changed_gait(gait, asked.document)))
    )


@router.post("/{gait_id}/remedies", response_model=Json)
async def remedies(gait_id: str, request: Request, studio: TheStudio) -> StreamingResponse:
    """What would make a drawing walk, one JSON object a line (NDJSON): each line is all that is known so far.

    `remedies` are at most four, best first, each with its changed document, the margin that it reaches, its
    seconds, and what physics says (`physics`: null until it is known). `searching` and `trying` say whether
    more may come, `sentence` why there is none. The search ends with the request.
    """
    asked = await _asked(request, Remedies)
    gait = await run_in_threadpool(changed_gait, await _gait(gait_id, studio), asked.document)
    return await state_lines(partial(studio.remedies.search, gait, tips=asked.tips))


@router.post("/{gait_id}/limit", response_model=Json)
async def limit(gait_id: str, request: Request, studio: TheStudio) -> Json:
    """How far one number of a drawing can go while everything else stays, SI; null where no value works."""
    asked = await _asked(request, AskedLimit)
    gait = await run_in_threadpool(changed_gait, await _gait(gait_id, studio), asked.document)
    value = await run_in_threadpool(studio.remedies.limit, gait, asked.which)
    return {"which": asked.which.value, "value": value}


async def _gait(gait_id: str, studio: Studio) -> Gait:
    return await on_command_thread(studio, lambda: studio.gaits.open_gait(gait_id).gait)


async def _asked(request: Request, kind: type[Asked]) -> Asked:
    body = await request.body()
    if len(body) > MOST_BYTES:
        raise InputError(f"The gait document has {len(body)} bytes; at most {MOST_BYTES} are read.", "body")
    require_few_values(body, "body")
    try:
        return kind.model_validate_json(body or b"{}")
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise InputError(f"body, field {field}: {first['msg']}.", f"body.{field}") from error
