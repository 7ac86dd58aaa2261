"""Answers that go on for a while: one JSON object a line (NDJSON), each with all that is known so far."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import suppress

from fastapi.responses import StreamingResponse
from starlette.concurrency import run_in_threadpool

from app.common.json import Json

Show = Callable[[Json | None], object]


async def state_lines(begin: Callable[[Show], Callable[[], None]]) -> StreamingResponse:
    """Begins a search, which ends with the request, and answers with its states.

    Args:
        begin: begins it, given a function that takes each state, from any thread, and None at the end;
            returns what ends the search.

    Raises:
        FootfallError: what `begin` refuses.
    """
    loop, states = asyncio.get_running_loop(), asyncio.Queue[Json | None]()

    def show(state: Json | None) -> None:
        # The server may have ended meanwhile.
        with suppress(RuntimeError):
            loop.call_soon_threadsafe(states.put_nowait, state)

    end = await run_in_threadpool(begin, show)

    async def lines() -> AsyncIterator[bytes]:
        try:
            while (state := await states.get()) is not None:
                yield json.dumps(state, allow_nan=False).encode() + b"\n"
        finally:
            end()

    return StreamingResponse(lines(), media_type="application/x-ndjson")
