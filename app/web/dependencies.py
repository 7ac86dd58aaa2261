"""What all routes share: reaching the studio, and refusals as status and sentence."""

import asyncio
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, TypeVar
from urllib.parse import unquote

import numpy as np
from fastapi import Depends, FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict, Field, field_validator
from pydantic_core import PydanticSerializationError, to_json
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from app.gaits.open_gait import OpenGait
from app.studio.studio import Studio
from app.undo.history import Author
from app.web.access import HEADERS
from app.web.body_limit import BodyTooLargeError, body_refusal
from core.arrays import Floats
from core.errors import (
    CheckError,
    FootfallError,
    InfeasibleError,
    InputError,
    NotFoundError,
    RobotError,
    StateError,
    StorageError,
    StorageFullError,
)
from core.robot.model import RobotModel

Result = TypeVar("Result")

PAGE_HEADER, NAME_HEADER = "x-footfall-page", "x-footfall-name"
"""Which page asks (one tab of a browser), and the percent-encoded name of who sits there."""

MOST_NAME = 80
"""Characters of a person's name."""

MOST_QUOTED = 200
"""Characters of an address that a refusal repeats."""

MOST_NUMBER = 2**53 - 1
"""Largest whole number that is counted with: JSON and the database keep it exactly."""

MOST_PLACE = 1000.0
"""How far from its middle something in a scene may stand, m; also the largest heading, rad."""

MOST_MOTORS = 36
"""Motors of the largest robot."""

Revision = Annotated[int, Field(ge=1, le=MOST_NUMBER)]
"""A revision or a version of something that is kept."""

_UNREADABLE = (
    "The body cannot be read. Send JSON in UTF-8, without thousands of brackets within each other or numbers "
    "of thousands of digits."
)

_PAGE = re.compile(r"[A-Za-z0-9-]{1,64}")

_STATUS: tuple[tuple[type[FootfallError], int], ...] = (
    (NotFoundError, 404),
    (StateError, 409),
    (CheckError, 409),
    (RobotError, 503),
    (InputError, 422),
    (InfeasibleError, 422),
    (StorageFullError, 507),
    (StorageError, 503),
)


class RequestBody(BaseModel):
    """A request's body; unknown fields are refused, and texts that cannot be kept or answered whole."""

    model_config = ConfigDict(extra="forbid")

    @field_validator("*")
    @classmethod
    def _without_nul(cls, value: Any) -> Any:
        if isinstance(value, str) and "\0" in value:
            raise ValueError("The character U+0000 cannot be kept; leave it out")
        return value

    @field_validator("*")
    @classmethod
    def _without_half_characters(cls, value: Any) -> Any:
        # A gait document is looked at where it is read, which names the place.
        if not isinstance(value, dict):
            try:
                to_json(value, fallback=str)
            except PydanticSerializationError:
                raise ValueError("A text holds half a character (a lone surrogate); type it again") from None
        return value


class FiniteBody(RequestBody):
    """A body whose numbers are finite."""

    model_config = ConfigDict(allow_inf_nan=False)


async def studio_of(request: Request) -> Studio:
    """The studio that this server serves; not a plain function, which would cost each request a thread."""
    studio: Studio = request.app.state.studio
    return studio


TheStudio = Annotated[Studio, Depends(studio_of)]
"""The studio, for a route."""


def is_page(text: str) -> bool:
    """Whether a text can be a page's id."""
    return _PAGE.fullmatch(text) is not None


async def author_of(request: Request) -> Author:
    """Who edits; a script where no page is named.

    Raises:
        InputError: the page's id or the name cannot be one.
    """
    page, name = request.headers.get(PAGE_HEADER), unquote(request.headers.get(NAME_HEADER, ""))
    if page is not None and not is_page(page):
        raise InputError(f"{PAGE_HEADER} takes up to 64 letters, digits and hyphens.", PAGE_HEADER)
    if "\0" in name:
        raise InputError(
            "The name has the character U+0000, which cannot be kept; leave it out.", NAME_HEADER
        )
    if len(name) > MOST_NAME:
        raise InputError(f"The name has {len(name)} characters; at most {MOST_NAME} are kept.", NAME_HEADER)
    return Author(name=name) if page is None else Author(page, name)


TheAuthor = Annotated[Author, Depends(author_of)]
"""Who edits, for a route."""


async def on_command_thread(studio: Studio, action: Callable[[], Result]) -> Result:
    """Does something on the command queue's thread and waits for it."""
    return await asyncio.wrap_future(studio.call(action))


async def on_planned(studio: Studio, gait_id: str, action: Callable[[], Result]) -> Result:
    """Does something on the command queue's thread that finds the plan of a gait made, and waits for it."""
    return await asyncio.wrap_future(studio.call_planned(gait_id, action))


async def changed(studio: Studio, action: Callable[[], OpenGait]) -> dict[str, Any]:
    """Stores a change of a gait, shows it to every page, and waits for its view."""
    return await asyncio.wrap_future(studio.change(action))


def strokes_from_mm(model: RobotModel, strokes_mm: Sequence[float], field: str) -> Floats:
    """The strokes of a robot's motors out of a request.

    Args:
        model: the robot.
        strokes_mm: one for each motor, mm.
        field: where they stand in the request.

    Returns:
        (legs, 3) m.

    Raises:
        InputError: too few, too many, or one outside the motors' travel.
    """
    if len(strokes_mm) != model.motor_count:
        raise InputError(
            f"{len(strokes_mm)} strokes are given; {model.title} has {model.motor_count}.", field
        )
    strokes = np.array(strokes_mm, dtype=np.float64).reshape(model.leg_count, 3) / 1000.0
    travel = model.stroke.travel
    if strokes.min() < 0.0 or strokes.max() > travel:
        raise InputError(f"Strokes lie in 0 to {travel * 1000:g} mm; correct the others.", field)
    return strokes


def install_error_handlers(app: FastAPI) -> None:
    """Turns refusals into `{"error": sentence, "where": …}` with a fitting status."""
    app.add_exception_handler(FootfallError, _refused)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _unanswerable)
    app.add_exception_handler(BodyTooLargeError, _too_large)
    app.add_exception_handler(ClientDisconnect, _broken_off)
    app.add_exception_handler(Exception, _defect)


async def _refused(request: Request, error: Exception) -> JSONResponse:
    del request
    if not isinstance(error, FootfallError):
        raise error
    status = next((code for kind, code in _STATUS if isinstance(error, kind)), 422)
    return _refusal(error.sentence, error.where, status)


async def _invalid(request: Request, error: Exception) -> JSONResponse:
    del request
    if not isinstance(error, RequestValidationError):
        raise error
    first = error.errors()[0]
    field = ".".join(str(part) for part in first["loc"])
    return _refusal(f"{field}: {first['msg']}.", field, 422)


async def _unanswerable(request: Request, error: Exception) -> JSONResponse:
    """What no route was asked: an unknown address, a method that is not taken, a body that is no JSON."""
    if not isinstance(error, HTTPException):
        raise error
    path, headers = request.url.path[:MOST_QUOTED], error.headers
    if error.status_code == 404:
        return _refusal(f"There is nothing at {path}. /docs lists every address.", "path", 404)
    if error.status_code == 405:
        taken = (headers or {}).get("Allow", "other methods")
        sentence = f"{path} does not take {request.method}; it takes {taken}. /docs lists every address."
        return _refusal(sentence, "method", 405, headers)
    if error.status_code == 400:
        return _refusal(_UNREADABLE, "body", 422)
    return _refusal(f"{error.detail}.", None, error.status_code, headers)


async def _broken_off(request: Request, error: Exception) -> JSONResponse:
    """An answer that nobody reads, so that a body that breaks off is no error of the program."""
    del request, error
    return _refusal("The request broke off before its end; send it again.", "body", 400)


async def _defect(request: Request, error: Exception) -> JSONResponse:
    """The answer to an error of the program, which the log describes; it passes no middleware any more."""
    del request, error
    sentence = "The studio met an error of its own, which its log describes. Try again, and please report it."
    headers = {name.decode(): text.decode() for name, text in HEADERS.items()}
    return _refusal(sentence, None, 500, headers)


async def _too_large(request: Request, error: Exception) -> JSONResponse:
    del request
    if not isinstance(error, BodyTooLargeError):
        raise error
    return body_refusal(error)


def _refusal(
    sentence: str, where: str | None, status: int, headers: Mapping[str, str] | None = None
) -> JSONResponse:
    """The answer; what a refusal quotes may hold halves of characters."""
    words = {"error": sentence, "where": where}
    whole = {key: text and text.encode(errors="backslashreplace").decode() for key, text in words.items()}
    return JSONResponse(whole, status_code=status, headers=headers)
