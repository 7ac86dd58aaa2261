"""uvicorn's server, with our own listener, whose connections and log are limited."""

import contextlib
import logging
import socket
from collections.abc import Callable, Generator

import uvicorn

from app.server.connections import Connection, Connections, Limits
from app.server.listener import Listener
from app.server.log_limits import LogLimit
from app.server.protocols import BoundedHttp


class BoundedServer(uvicorn.Server):
    """A server whose signals are ours: ending by a signal is a normal end.

    Args:
        config: uvicorn's.
        limits: how many connections may be open.
        token: requests must show it; None where none is demanded.
        ready: called when it listens.
    """

    def __init__(
        self, config: uvicorn.Config, limits: Limits, token: str | None, ready: Callable[[], None]
    ) -> None:
        super().__init__(config)
        self._register = Connections(limits)
        self._token = token
        self._ready = ready
        self._log_limits = [LogLimit(handler) for handler in logging.getLogger().handlers]
        self._listeners: list[Listener] = []

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts listening, then says so."""
        await super().startup([])
        for listening in sockets or []:
            listener = Listener(listening, self._register, self._http, self._token, self._flush_log)
            listener.open()
            self._listeners.append(listener)
        self._ready()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Takes no more connections, and ends those that are open."""
        for listener in self._listeners:
            listener.close()
        await super().shutdown(sockets)
        for limit in self._log_limits:
            limit.close()

    @contextlib.contextmanager
    def capture_signals(self) -> Generator[None, None, None]:
        """Leaves signals to `serve`."""
        yield

    def _http(self, connection: Connection, first: bytes) -> BoundedHttp:
        return BoundedHttp(self.config, self.server_state, self.lifespan.state, connection, first)

    def _flush_log(self) -> None:
        for limit in self._log_limits:
            limit.flush()
