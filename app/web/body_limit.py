"""The largest body of a request, so that nobody can fill the server's memory."""

from fastapi.responses import JSONResponse
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

MOST_BODY = 32_000_000
"""Bytes; the largest file that is taken has 30 MB, and a file in JSON grows by its marks of escape."""

STREAMED = frozenset({("POST", "/api/videos")})
"""Requests whose bodies go to the disk as they come, and have a limit of their own."""


class BodyTooLargeError(HTTPException):
    """More is sent than is taken."""

    def __init__(self) -> None:
        super().__init__(413, f"The request has more than {MOST_BODY // 1_000_000} MB. Send less at a time.")


class BodyLimit:
    """ASGI middleware that refuses bodies over the limit, those that do not tell their size too."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on; its body is counted as it is read."""
        if scope["type"] != "http" or (scope["method"], scope["path"]) in STREAMED:
            await self._app(scope, receive, send)
            return
        said = Headers(scope=scope).get("content-length", "")
        if said.isdecimal() and int(said) > MOST_BODY:
            await body_refusal(BodyTooLargeError())(scope, receive, send)
            return
        await self._app(scope, _counted(receive), send)


def _counted(receive: Receive) -> Receive:
    taken = 0

    async def receiving() -> Message:
        nonlocal taken
        message = await receive()
        taken += len(message.get("body", b""))
        if taken > MOST_BODY:
            raise BodyTooLargeError
        return message

    return receiving


def body_refusal(error: HTTPException) -> JSONResponse:
    """A refusal as status and sentence."""
    return JSONResponse({"error": error.detail, "where": "body"}, status_code=error.status_code)
