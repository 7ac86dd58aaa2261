"""The end of the studio by a signal: the robot is stopped first."""

import asyncio
import contextlib
import signal
import socket
from types import FrameType

import uvicorn

from app.common.signals import ending_signals
from app.studio.studio import Studio


async def serve_until_signal(server: uvicorn.Server, listening: socket.socket, studio: Studio) -> None:
    """Serves until SIGINT, SIGTERM, or SIGHUP, unless `nohup` has that ignored.

    The handlers stay after that: a closed terminal sends several signals, and none of them may break off what
    the studio still has to do.
    """
    loop = asyncio.get_running_loop()

    def end() -> None:
        # The robot first: connections that are still open may take their time to close.
        studio.stop_run("the end of the studio")
        server.should_exit = True
        studio.hub.close()
        studio.remedies.close()

    def ask_to_end(number: int, frame: FrameType | None) -> None:
        del number, frame
        with contextlib.suppress(RuntimeError):  # the loop has ended already
            loop.call_soon_threadsafe(end)

    for number in (signal.SIGINT, *ending_signals()):
        signal.signal(number, ask_to_end)
    await server.serve(sockets=[listening])
