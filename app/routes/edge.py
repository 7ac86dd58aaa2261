"""What all routes share: reaching the studio, and refusals as status and sentence."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TypeVar

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse

from app.gait_desk import UnknownGaitError, refusal_text
from app.job_desk import UnknownJobError
from app.studio import Studio
from core.errors import CheckError, FootfallError, InfeasibleError, InputError, RobotError, StateError

Result = TypeVar("Result")

_STATUS: tuple[tuple[type[FootfallError], int], ...] = (
    (UnknownGaitError, 404),
    (UnknownJobError, 404),
    (StateError, 409),
    (CheckError, 409),
    (RobotError, 503),
    (InputError, 422),
    (InfeasibleError, 422),
)


def studio_of(request: Request) -> Studio:
    """The studio that this server serves."""
    studio: Studio = request.app.state.studio
    return studio


async def on_session(studio: Studio, action: Callable[[], Result]) -> Result:
    """Does something on the session's thread and waits for it."""
    return await asyncio.wrap_future(studio.call(action))


def install_error_handlers(app: FastAPI) -> None:
    """Turns refusals into `{"error": sentence, "where": …}` with a fitting status."""
    app.add_exception_handler(FootfallError, _refused)
    app.add_exception_handler(RequestValidationError, _invalid)


async def _refused(request: Request, error: Exception) -> JSONResponse:
    del request
    if not isinstance(error, FootfallError):
        raise error
    status = next((code for kind, code in _STATUS if isinstance(error, kind)), 422)
    return JSONResponse(refusal_text(error), status_code=status)


async def _invalid(request: Request, error: Exception) -> JSONResponse:
    del request
    if not isinstance(error, RequestValidationError):
        raise error
    first = error.errors()[0]
    field = ".".join(str(part) for part in first["loc"])
    return JSONResponse({"error": f"{field}: {first['msg']}.", "where": field}, status_code=422)
