"""The largest message that each web socket takes, so that nobody can fill the server's memory with one."""

import contextlib

from starlette.types import ASGIApp, Message, Receive, Scope, Send

MOST_MESSAGE = 262_144
"""Bytes that any socket takes in one message; the server reads no more of it."""

MOST_SIGNAL = 4_096
"""Bytes of a message on sockets that take signs of life and `stop` with a name."""

SCENE = "/viser/"
"""Sockets whose messages hold poses of all nodes, or what the 3D client reports."""

TOO_BIG = 1009
"""Close code of a message that is too long."""


class SocketLimit:
    """ASGI middleware that closes web sockets on which too long a message comes."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a connection on; the messages of a web socket are measured as they are read."""
        if scope["type"] != "websocket":
            await self._app(scope, receive, send)
            return
        most = MOST_MESSAGE if scope["path"].startswith(SCENE) else MOST_SIGNAL
        is_cut = False

        async def receiving() -> Message:
            nonlocal is_cut
            message = await receive()
            size = len(message.get("bytes") or (message.get("text") or "").encode())
            if is_cut or size <= most:
                return message
            is_cut = True
            with contextlib.suppress(OSError):  # the connection has ended meanwhile
                await send({"type": "websocket.close", "code": TOO_BIG, "reason": f"At most {most} bytes."})
            return {"type": "websocket.disconnect", "code": TOO_BIG}

        async def sending(message: Message) -> None:
            if not is_cut:
                await send(message)

        await self._app(scope, receiving, sending)
