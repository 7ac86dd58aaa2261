"""HEAD for every address that takes GET: the same status and headers, without the body."""

from starlette.types import ASGIApp, Message, Receive, Scope, Send


class HeadersSentError(Exception):
    """Ends the answer to a HEAD request after its headers, so that no file or stream is read for it."""


class HeadRequests:
    """ASGI middleware that answers HEAD as GET; the guard stands above it and sees the request as it came."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on; of the answer to HEAD, only the headers are sent."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self._app(scope, receive, send)
            return

        async def send_headers(message: Message) -> None:
            if message["type"] != "http.response.start":
                raise HeadersSentError
            await send(message)

        try:
            await self._app({**scope, "method": "GET"}, receive, send_headers)
        except HeadersSentError:
            await send({"type": "http.response.body", "body": b""})
