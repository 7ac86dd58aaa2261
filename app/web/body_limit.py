"""The largest body of a request, so that nobody can fill the server's memory."""

import asyncio
import time

from fastapi.responses import JSONResponse
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from core.text.json_size import MOST_VALUES, JsonSize

MOST_BODY = 32_000_000
"""Bytes; the largest file that is taken has 30 MB, and a file in JSON grows by its marks of escape."""

LARGE_BYTES = 65_536
"""Reading a body of more bytes takes longer than the other work of a turn of the event loop."""

REST_SECONDS = 0.1
"""Between two large bodies, s."""

TURN_SECONDS = 1.0
"""A large body is read by then; a request that works on goes on beside others, s."""

STREAMED = frozenset({("POST", "/api/videos")})
"""Requests whose bodies go to the disk as they come, and have a limit of their own."""


class BodyTooLargeError(HTTPException):
    """More is sent than is taken.

    Args:
        sentence: the limit, and what to do.
    """

    def __init__(self, sentence: str) -> None:
        super().__init__(413, sentence)


def _too_many_bytes() -> BodyTooLargeError:
    return BodyTooLargeError(f"The request has more than {MOST_BODY // 1_000_000} MB. Send less at a time.")


class BodyLimit:
    """ASGI middleware that refuses bodies over the limit, those that do not tell their size too.

    Large bodies are worked at one at a time, with a rest between two: Python does nothing else while it
    reads one, and a Stop would wait for all of them.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._turn = asyncio.Lock()
        self._rest_ends = 0.0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on; its body is counted as it is read."""
        if scope["type"] != "http" or (scope["method"], scope["path"]) in STREAMED:
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        said = headers.get("content-length", "")
        if said.isdecimal() and int(said) > MOST_BODY:
            await body_refusal(_too_many_bytes())(scope, receive, send)
            return
        size = _BodySize(is_json="json" in headers.get("content-type", "").lower())
        has_turn = False

        async def receiving() -> Message:
            nonlocal has_turn
            message = await receive()
            size.add(message.get("body", b""))
            is_whole = message["type"] == "http.request" and not message.get("more_body", False)
            if is_whole and size.bytes > LARGE_BYTES and not has_turn:
                await self._turn.acquire()
                has_turn = True
                asyncio.get_running_loop().call_later(TURN_SECONDS, end_turn)
                await asyncio.sleep(max(0.0, self._rest_ends - time.monotonic()))
            return message

        async def sending(message: Message) -> None:
            end_turn()
            await send(message)

        def end_turn() -> None:
            nonlocal has_turn
            if has_turn:
                has_turn = False
                self._rest_ends = time.monotonic() + REST_SECONDS
                self._turn.release()

        try:
            await self._app(scope, receiving, sending)
        finally:
            end_turn()


class _BodySize:
    """Counts what has come of a body.

    Args:
        is_json: whether it is said to be JSON.

    Attributes:
        bytes: so many.
    """

    def __init__(self, *, is_json: bool) -> None:
        self.bytes = 0
        self._json = JsonSize() if is_json else None

    def add(self, piece: bytes) -> None:
        """Counts the next piece.

        Raises:
            BodyTooLargeError: more has come than is taken.
        """
        self.bytes += len(piece)
        if self.bytes > MOST_BODY:
            raise _too_many_bytes()
        if self._json is not None:
            self._json.add(piece)
            if self._json.is_too_large:
                raise BodyTooLargeError(
                    f"The JSON of the request has more than {MOST_VALUES:,} values. Send less at a time."
                )


def body_refusal(error: HTTPException) -> JSONResponse:
    """A refusal as status and sentence."""
    return JSONResponse({"error": error.detail, "where": "body"}, status_code=error.status_code)
