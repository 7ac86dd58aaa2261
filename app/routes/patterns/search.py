"""Footfall patterns found by a solver: searches, and what becomes of a pattern."""

import asyncio
from dataclasses import replace
from typing import Annotated

from fastapi import APIRouter, Body
from fastapi.responses import JSONResponse
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.common.names import free_name
from app.documents.gait_json import gait_content
from app.gaits.open_gait import OpenGait
from app.gaits.views import plan_view
from app.pattern_search.service import PatternRequest, Search
from app.routes.patterns.problems import AnyQuestion, Posed, posed
from app.routes.patterns.schema import PatternUse
from app.studio.studio import Studio
from app.undo.history import SCRIPT, Author
from app.web.dependencies import TheAuthor, TheStudio, changed, on_command_thread
from core.gait.gait import Gait

router = APIRouter(prefix="/api/patterns", tags=["patterns"])

WAIT_SECONDS = 0.2
"""How long a question waits for its answer before it becomes a search that goes on by itself."""


async def _posed(studio: Studio, question: AnyQuestion) -> Posed:
    return await on_command_thread(studio, lambda: posed(question, studio.gaits.document))


async def _answered(studio: Studio, search: Search) -> bool:
    """Whether the answer comes soon; a search that goes on tells its page by events from then on."""
    await asyncio.wait({asyncio.wrap_future(search.future)}, timeout=WAIT_SECONDS)
    return not studio.patterns.detach(search)


@router.post("", response_model=Json, responses={202: {"description": "The search goes on."}})
async def search(
    question: Annotated[AnyQuestion, Body(discriminator="kind")], studio: TheStudio, author: TheAuthor
) -> JSONResponse:
    """Searches for the best patterns, in the place of the page's last search.

    Answers with the result, or with 202 and the search's id where it takes longer: a page then hears of it by
    events of type `pattern`, a script asks for it.
    """
    asked = await _posed(studio, question)
    what = PatternRequest(asked.problem, asked.lengths, question.count, question.seconds, asked.too_few)
    begun = await run_in_threadpool(studio.patterns.ask, _page(author), what)
    is_answered = await _answered(studio, begun)
    return JSONResponse(begun.content(), status_code=200 if is_answered else 202)


def _page(author: Author) -> str:
    """The page that asks; a script's searches belong to none."""
    return "" if author.page == SCRIPT else author.page


@router.get("/{number}")
async def read_search(number: int, studio: TheStudio) -> Json:
    """A search: how far it is, or its answer."""
    return studio.patterns.search(number).content()


@router.delete("/{number}")
async def cancel_search(number: int, studio: TheStudio) -> Json:
    """Ends a search; one that is answered stays as it is."""
    return await run_in_threadpool(studio.patterns.cancel, number)


@router.post("/{number}/use")
async def use_now(number: int, studio: TheStudio) -> Json:
    """Ends a search with the best pattern that it has found so far."""
    return await run_in_threadpool(studio.patterns.use_now, number)


async def _gait(studio: Studio, use: PatternUse) -> Gait:
    asked = await _posed(studio, use.question)
    return await run_in_threadpool(asked.gait, use.feet, use.name)


@router.post("/gait", status_code=201)
async def create_gait(use: PatternUse, studio: TheStudio) -> Json:
    """Saves a new gait that a pattern makes, and gives its view; a name that is taken gets a number."""
    gait = await _gait(studio, use)

    def create() -> OpenGait:
        taken = {summary["name"] for summary in studio.publisher.summaries()}
        return studio.gaits.create(replace(gait, name=free_name(gait.name, taken)))

    return await changed(studio, create)


@router.post("/document")
async def read_document(use: PatternUse, studio: TheStudio) -> Json:
    """The document of the gait that a pattern makes; nothing is saved."""
    return {"document": gait_content(await _gait(studio, use))}


@router.post("/plan", response_model=Json)
async def read_plan(use: PatternUse, studio: TheStudio) -> JSONResponse:
    """The plan of the gait that a pattern makes, by the live tier, to be looked at; nothing is saved."""
    gait = await _gait(studio, use)
    # As a finished answer: the framework's own way through every number takes longer than all the rest.
    return await run_in_threadpool(lambda: JSONResponse(plan_view(studio.live.plan(gait))))
