"""Which accepted requests find a place while many connections are open."""

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from app.server.protocols import CONNECTION

STOP = ("POST", "/api/robot/stop")
"""Needs no place."""

TRY_AGAIN_LATER = 1013
RETRY_SECONDS = 5
SENTENCE = "Too many connections are open. Close pages or programs that use this studio, then try again."


class Admission:
    """ASGI middleware below the guard: a connection whose request came this far is no stranger any more."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on, or refuses it with a sentence where the places are taken."""
        connection = scope.get("state", {}).get(CONNECTION)
        is_socket = scope["type"] == "websocket"
        if (
            connection is None
            or connection.accept_request(is_socket=is_socket)
            or (scope.get("method"), scope["path"]) == STOP
        ):
            await self._app(scope, receive, send)
        elif is_socket:
            await WebSocketClose(TRY_AGAIN_LATER, SENTENCE)(scope, receive, send)
        else:
            headers = {"connection": "close", "retry-after": str(RETRY_SECONDS)}
            answer = JSONResponse({"error": SENTENCE, "where": "connections"}, 503, headers)
            await answer(scope, receive, send)
