"""Requests begin one after the other, so that a Stop never waits behind a crowd of them."""

import asyncio
from collections import deque

from starlette.types import ASGIApp, Receive, Scope, Send

from app.server.admission import STOP
from app.server.protocols import CONNECTION


class Pace:
    """ASGI middleware: one request begins in each turn of the event loop, and a Stop at once.

    A turn of the loop does everything that is ready. If many requests were ready together, each of the few
    turns that a Stop takes would last as long as all of them.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._waiting: deque[asyncio.Future[None]] = deque()
        self._has_begun = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on when its turn has come; the end of the studio cuts it off."""
        try:
            if (scope.get("method"), scope.get("path")) != STOP:
                await self._turn()
            await self._app(scope, receive, send)
        except asyncio.CancelledError:
            # The server cancels what is not answered in time when it ends: that is no error for the log.
            connection = scope.get("state", {}).get(CONNECTION)
            if connection is None:
                raise
            connection.holder.drop()

    async def _turn(self) -> None:
        loop = asyncio.get_running_loop()
        if not self._has_begun:
            self._has_begun = True
            loop.call_soon(self._next)
            return
        mine = loop.create_future()
        self._waiting.append(mine)
        await mine

    def _next(self) -> None:
        while self._waiting:
            first = self._waiting.popleft()
            if not first.done():  # its request broke off
                first.set_result(None)
                asyncio.get_running_loop().call_soon(self._next)
                return
        self._has_begun = False
