"""The web socket that pushes what changes."""

from __future__ import annotations

import asyncio
import contextlib
import json

from fastapi import APIRouter, WebSocket
from starlette.websockets import WebSocketDisconnect

from app.events import Subscriber
from app.routes.edge import on_session
from app.studio import Studio

router = APIRouter()


@router.websocket("/api/events")
async def events(socket: WebSocket) -> None:
    """Sends `hello`, then every change; what a client sends is ignored."""
    studio: Studio = socket.app.state.studio
    await socket.accept()
    subscriber = studio.hub.subscribe()
    listening = asyncio.create_task(_drain(socket))
    try:
        await socket.send_text(json.dumps(await on_session(studio, studio.hello), allow_nan=False))
        while (event := await _next_or_gone(subscriber, listening)) is not None:
            await socket.send_text(event)
        await socket.close()
    except (WebSocketDisconnect, RuntimeError):
        pass  # the page is gone
    finally:
        studio.hub.unsubscribe(subscriber)
        listening.cancel()
        with contextlib.suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
            await listening


async def _next_or_gone(subscriber: Subscriber, listening: asyncio.Task[None]) -> str | None:
    """The next event, or None as soon as the page is gone."""
    event = asyncio.ensure_future(subscriber.next())
    await asyncio.wait({event, listening}, return_when=asyncio.FIRST_COMPLETED)
    if not event.done():
        event.cancel()
        return None
    return event.result()


async def _drain(socket: WebSocket) -> None:
    while True:
        await socket.receive_text()
