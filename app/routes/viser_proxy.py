"""The embedded Viser client and its web socket, behind our own port.

The client is the installed package's one HTML file, with our head script and style put in; the socket is
relayed, message by message, to Viser on loopback; `?robot=NAME` says whose scene. `/viser/poses` is the slow
way for pages that can't reach into the client: names of nodes as a JSON text, then one binary of float32 a
pose, each answered by a text.
"""

import asyncio
import contextlib
import hashlib
import importlib.util
import json
from collections.abc import Callable, Coroutine, Mapping, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import websockets
from fastapi import APIRouter, Request, Response, WebSocket
from numpy.typing import NDArray
from starlette.websockets import WebSocketDisconnect, WebSocketState
from websockets.asyncio.client import ClientConnection, connect
from websockets.typing import Subprotocol

from app.scene.registry import FIRST_ROBOT
from core.data.tables import package_files
from core.errors import FootfallError, InputError, StateError

CONTENT_SECURITY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'",
        "worker-src blob:",
        "connect-src 'self' blob: data:",
        "img-src 'self' data: blob:",
        "style-src 'self' 'unsafe-inline'",
        "font-src 'self' data:",
        "frame-ancestors 'self'",
        "base-uri 'none'",
        "form-action 'none'",
    ]
)
"""For the client's page only; the rest of the studio can be strict."""

REFUSED_MESSAGES = (b"ShareUrlRequest", b"ShareUrlDisconnect")
"""Client messages that would open the scene to the outside world; they are dropped."""

TRY_AGAIN_LATER = 1013
UNSUPPORTED_DATA = 1003
LONGEST_REASON = 100
"""Characters of a close reason; the protocol allows 123 bytes."""

POSE_BYTES = 7 * 4
"""A node's pose: quaternion wxyz and position xyz as float32."""

MOST_RELAYS = 64
"""Browsers whose 3D client is relayed at a time; each takes three connections of this process."""

WAITING_MESSAGES = 8
"""Messages from Viser that may wait for a slow browser before Viser itself is held up."""


class ViserScene(Protocol):
    """What the relay needs to know of the scene."""

    @property
    def port(self) -> int:
        """Port of Viser on loopback."""

    @property
    def relay_headers(self) -> Mapping[str, str]:
        """What a request to that port must carry."""

    def place(self, names: Sequence[str], poses: NDArray[np.float32]) -> None:
        """Moves nodes to (nodes, 7) poses."""


def make_viser_router(scene_of: Callable[[str], ViserScene]) -> APIRouter:
    """Serves the client at `/viser/` and relays its web socket at `/viser/ws`.

    Args:
        scene_of: gives the running scene of a robot by its name; asked at each connection.
    """
    router = APIRouter()
    page = client_page()
    tag = f'"{hashlib.sha256(page).hexdigest()[:16]}"'
    headers = {
        "Content-Security-Policy": CONTENT_SECURITY,
        "Cache-Control": "no-cache",
        "X-Content-Type-Options": "nosniff",
        "ETag": tag,
    }

    @router.get("/viser/", include_in_schema=False)
    async def client(request: Request) -> Response:
        if request.headers.get("if-none-match") == tag:
            return Response(status_code=304, headers=headers)
        return Response(page, media_type="text/html; charset=utf-8", headers=headers)

    relayed: set[WebSocket] = set()

    @router.websocket("/viser/ws")
    async def socket(browser: WebSocket, robot: str = FIRST_ROBOT) -> None:
        if len(relayed) >= MOST_RELAYS:
            await browser.close(
                TRY_AGAIN_LATER, "Too many 3D views are open. Close one, then reload this page."
            )
            return
        relayed.add(browser)
        try:
            scene = await _opened(browser, scene_of, robot)
            if scene is not None:
                await relay(browser, scene)
        finally:
            relayed.discard(browser)

    @router.websocket("/viser/poses")
    async def poses(browser: WebSocket, robot: str = FIRST_ROBOT) -> None:
        scene = await _opened(browser, scene_of, robot)
        if scene is not None:
            await browser.accept()
            with contextlib.suppress(WebSocketDisconnect):
                await take_poses(browser, scene)

    return router


async def _opened(browser: WebSocket, scene_of: Callable[[str], ViserScene], robot: str) -> ViserScene | None:
    """The robot's scene; None, with the socket closed, where there is none."""
    try:
        # The first page on a robot waits for its scene to be built.
        return await asyncio.to_thread(scene_of, robot)
    except FootfallError as error:
        await browser.close(UNSUPPORTED_DATA, str(error)[:LONGEST_REASON])
        return None


async def take_poses(browser: WebSocket, scene: ViserScene) -> None:
    """Shows the poses that a page sends until it goes; what doesn't fit closes the socket with a sentence."""
    names: list[str] = []
    while True:
        message = await browser.receive()
        if message["type"] == "websocket.disconnect":
            return
        try:
            text = message.get("text")
            if text is not None:
                names = node_names(text)
                continue
            await asyncio.to_thread(scene.place, names, poses_of(message.get("bytes") or b""))
        except FootfallError as error:
            await browser.close(UNSUPPORTED_DATA, error.sentence[:LONGEST_REASON])
            return
        await browser.send_text("shown")


def node_names(text: str) -> list[str]:
    """Names of nodes out of a page's message.

    Raises:
        InputError: the text is no JSON list of texts.
    """
    try:
        names = json.loads(text)
    except (ValueError, RecursionError):
        names = None
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise InputError("The names cannot be read. Send a JSON list of texts, one for each node.", "names")
    return names


def poses_of(data: bytes) -> NDArray[np.float32]:
    """Poses, (nodes, 7), out of a page's message.

    Raises:
        InputError: the bytes are no whole poses.
    """
    if len(data) % POSE_BYTES:
        raise InputError(f"{len(data)} bytes are no whole poses. Send seven float32 for each node.", "poses")
    return np.frombuffer(data, dtype="<f4").reshape(-1, 7)


def client_page() -> bytes:
    """The installed client's page with our script and style first in its head."""
    built = _viser_folder().joinpath("client", "build", "index.html").read_text("utf-8")
    ours = package_files("app").joinpath("static", "preview")
    script = ours.joinpath("viser_frame.js").read_text("utf-8")
    style = ours.joinpath("viser_frame.css").read_text("utf-8")
    addition = f"<script>{script}</script><style>{style}</style>"
    return built.replace("<head>", f"<head>{addition}", 1).encode()


def _viser_folder() -> Path:
    """Where Viser is installed, without loading it."""
    found = importlib.util.find_spec("viser")
    if found is None or found.origin is None:
        raise StateError(
            "Viser is not installed, which draws in 3D; install the studio's packages again.", "viser"
        )
    return Path(found.origin).parent


async def relay(browser: WebSocket, scene: ViserScene) -> None:
    """Passes messages between a browser and Viser until either closes; each side holds up the other."""
    offered = [Subprotocol(name) for name in browser.scope.get("subprotocols", [])]
    try:
        viser = await connect(
            f"ws://127.0.0.1:{scene.port}",
            additional_headers=scene.relay_headers,
            subprotocols=offered or None,
            max_size=None,
            max_queue=WAITING_MESSAGES,
            compression=None,
            ping_interval=None,
            proxy=None,
        )
    except (OSError, websockets.WebSocketException):
        await browser.close(TRY_AGAIN_LATER, "The 3D scene does not answer.")
        return
    async with viser:
        await browser.accept(viser.subprotocol)
        await _run_both(_to_viser(browser, viser), _to_browser(viser, browser))
    if browser.application_state is not WebSocketState.DISCONNECTED:
        with contextlib.suppress(RuntimeError, WebSocketDisconnect):
            # A reason stands with the code of what Viser could not take; without one it simply went.
            await browser.close(
                (viser.close_code if viser.close_reason else None) or 1000, viser.close_reason
            )


async def _run_both(*directions: Coroutine[None, None, None]) -> None:
    tasks = [asyncio.ensure_future(direction) for direction in directions]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _to_viser(browser: WebSocket, viser: ClientConnection) -> None:
    while True:
        message = await browser.receive()
        if message["type"] == "websocket.disconnect":
            return
        data = message.get("bytes") or message.get("text")
        if data is not None and not is_refused(data):
            await viser.send(data)


async def _to_browser(viser: ClientConnection, browser: WebSocket) -> None:
    async for data in viser:
        if isinstance(data, bytes):
            await browser.send_bytes(data)
        else:
            await browser.send_text(data)


def is_refused(data: bytes | str) -> bool:
    """Whether a client's message must not reach Viser (the names stand as they are in its MessagePack)."""
    raw = data.encode() if isinstance(data, str) else data
    return any(name in raw for name in REFUSED_MESSAGES)
