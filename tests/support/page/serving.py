"""A web server in a thread, for tests that need real sockets."""

from __future__ import annotations

import gc
import socket
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Thread

import uvicorn
from starlette.types import ASGIApp

from app.scene import Scenes
from app.server.web_sockets import BoundedSocket
from app.web.socket_limit import MOST_MESSAGE

DEADLINE = 10.0


class _Server(uvicorn.Server):
    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self.ready = Event()

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self.ready.set()


@contextmanager
def serving(app: ASGIApp, sockets: type[BoundedSocket] = BoundedSocket) -> Iterator[str]:
    """Serves an application on a free loopback port as the studio does; yields "127.0.0.1:PORT"."""
    listener = socket.create_server(("127.0.0.1", 0))
    config = uvicorn.Config(
        app,
        log_level="error",
        lifespan="off",
        ws=sockets,
        ws_max_size=MOST_MESSAGE,
        ws_per_message_deflate=False,
    )
    server = _Server(config)
    thread = Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        if not server.ready.wait(DEADLINE):
            raise TimeoutError(f"The test server did not start within {DEADLINE:.0f} s.")
        yield f"127.0.0.1:{listener.getsockname()[1]}"
    finally:
        server.should_exit = True
        thread.join(DEADLINE)
        listener.close()


def stop_under_clients(scenes: Scenes) -> None:
    """Stops scenes that browsers are connected to.

    Viser closes its event loop before the last callbacks of these connections have run; their remains warn
    when they are collected, which would fail whatever test runs then.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        scenes.stop()
        gc.collect()
