"""Runs the studio until a signal ends it."""

import asyncio
import contextlib
import errno
import gc
import os
import secrets
import socket
import sys
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import uvicorn

from app.cameras.address import CameraAddress
from app.scene.registry import Scenes
from app.server.application import make_app
from app.server.bounded_server import BoundedServer
from app.server.connections import limits_for
from app.server.descriptors import raise_limit
from app.server.ending import serve_until_signal
from app.server.freed_memory import give_back_freed_memory
from app.server.protocols import CountedSocket
from app.server.reach import who_can_reach
from app.store.folder_lock import StudioLock
from app.store.gait_files import require_folder
from app.studio.studio import Studio
from app.web.access import LOOPBACK_NAMES, Access
from app.web.socket_limit import MOST_MESSAGE
from core.errors import InputError

GRACE_SECONDS = 3
"""Open connections get this long when the studio ends."""

SWITCH_SECONDS = 0.0005
"""Longest that a thread which computes keeps the others waiting; Python's own 5 ms come before each step of a
Stop."""


@dataclass(frozen=True)
class ServeOptions:
    """How to serve (see `footfall serve --help`)."""

    host: str
    port: int
    device: str
    data: Path
    token: str | None
    """Demanded of every request; one is made where it is empty, or None and the host is not loopback."""
    opens_browser: bool
    cameras: tuple[CameraAddress, ...] = ()
    reference: Path | None = None
    """Folder of the published data; None for the one that the data folder remembers."""


def serve(options: ServeOptions, announce: Callable[[str, str], None]) -> None:
    """Serves until SIGINT, SIGTERM or SIGHUP; then the robot is stopped and everything is closed.

    Args:
        options: how to serve.
        announce: told the URL, and who can reach it, as soon as the studio answers.

    Raises:
        InputError: the port is busy, the data folder cannot be used or is another studio's, or there is no
            published data in its folder.
    """
    give_back_freed_memory()
    sys.setswitchinterval(SWITCH_SECONDS)
    token = options.token
    if token == "" or (token is None and options.host not in LOOPBACK_NAMES):
        token = secrets.token_urlsafe(18)
    scenes = Scenes()
    require_folder(options.data)
    with (
        contextlib.closing(StudioLock(options.data)) as lock,
        contextlib.closing(listen(options.host, options.port)) as listening,
    ):
        lock.tell(_url(options.host, listening.getsockname()[1], None))
        studio = Studio(options.data, options.device, options.cameras)
        try:
            if options.reference is not None:
                studio.published.name_folder(str(options.reference))
            app = make_app(studio, scenes, Access(options.host, token))
            config = uvicorn.Config(
                app,
                log_level="warning",
                log_config=None,
                access_log=False,
                lifespan="off",
                ws=CountedSocket,
                ws_max_size=MOST_MESSAGE,
                ws_per_message_deflate=False,
                timeout_graceful_shutdown=GRACE_SECONDS,
            )
            who = who_can_reach(options.host, token is not None)
            url = _url(options.host, listening.getsockname()[1], token)
            limits = limits_for(raise_limit(), has_token=token is not None)
            server = BoundedServer(
                config, limits, token, lambda: _tell(url, who, announce, options.opens_browser)
            )
            gc.freeze()  # whatever is there now stays: a full collection would look at it for 50 ms and more
            asyncio.run(serve_until_signal(server, listening, studio))
        finally:
            studio.close()
            scenes.stop()


def listen(host: str, port: int) -> socket.socket:
    """Opens the port of the studio.

    Raises:
        InputError: it cannot be used.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # The protocol is named so that asyncio sends each answer's pieces at once (TCP_NODELAY): 40 ms a request.
    listening = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((host, port))
        listening.listen()
    except (OSError, OverflowError, UnicodeError) as error:
        listening.close()
        raise _unusable(host, port, error) from error
    return listening


def _unusable(host: str, port: int, error: Exception) -> InputError:
    """Why the studio cannot listen, and what to do about it."""
    if isinstance(error, socket.gaierror | UnicodeError):
        return InputError(
            f"No address {host} is known. Correct --host: 127.0.0.1 for this computer alone, 0.0.0.0 for all "
            "its networks.",
            "--host",
        )
    number = error.errno if isinstance(error, OSError) else None
    if number in (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT):
        return InputError(
            f"{host} is no address of this computer. Give one of its own with --host: 127.0.0.1 for this "
            "computer alone, 0.0.0.0 for all its networks.",
            "--host",
        )
    reason = error.strerror if isinstance(error, OSError) else "the number is out of range"
    remedy = {
        errno.EADDRINUSE: "End the program that uses it, or choose another with --port.",
        errno.EACCES: "Choose one above 1023 with --port.",
    }.get(number or 0, "Choose another with --port.")
    return InputError(f"Port {port} on {host} cannot be used: {reason}. {remedy}", "--port")


def _url(host: str, port: int, token: str | None) -> str:
    shown = f"[{host}]" if ":" in host else host
    return f"http://{shown}:{port}/" + (f"?token={quote(token, safe='')}" if token else "")


def _tell(url: str, who: str, announce: Callable[[str, str], None], opens_browser: bool) -> None:
    announce(url, who)
    has_screen = sys.platform in ("darwin", "win32") or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )
    if opens_browser and has_screen:
        webbrowser.open(url)
