"""Answers that grow: one JSON object a line (NDJSON), until the work ends or the client goes."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import suppress

from fastapi.responses import StreamingResponse
from starlette.concurrency import run_in_threadpool

from app.common.json import Json

Tell = Callable[[Json | None], None]
"""Takes the next line, and None at the end; any thread may call it."""


async def state_stream(begin: Callable[[Tell], Callable[[], None]]) -> StreamingResponse:
    """Streams what some work tells.

    Args:
        begin: begins the work, in a thread of the pool, and returns what ends it; it ends with the request.
    """
    loop, states = asyncio.get_running_loop(), asyncio.Queue[Json | None]()

    def tell(state: Json | None) -> None:
        # The server may have ended meanwhile.
        with suppress(RuntimeError):
            loop.call_soon_threadsafe(states.put_nowait, state)

    end = await run_in_threadpool(begin, tell)

    async def lines() -> AsyncIterator[bytes]:
        try:
            while (state := await states.get()) is not None:
                yield json.dumps(state, allow_nan=False).encode() + b"\n"
        finally:
            end()

    return StreamingResponse(lines(), media_type="application/x-ndjson")
