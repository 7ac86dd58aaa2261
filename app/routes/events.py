"""The web socket that pushes what changes."""

import asyncio
import contextlib
import json

from fastapi import APIRouter, WebSocket
from starlette.websockets import WebSocketDisconnect

from app.routes.robot.robot import send_stop
from app.session.event_hub import Subscriber
from app.studio.studio import Studio
from app.web.dependencies import is_page, on_command_thread

router = APIRouter()

STOP = "stop"


@router.websocket("/api/events")
async def events(socket: WebSocket) -> None:
    """Sends `hello`, then every change; whatever a client sends is a sign of life of its page.

    What begins with `stop`, a blank and a name after it, stops the robot too: a browser may keep a request
    waiting for others of the page, but not this.
    """
    studio: Studio = socket.app.state.studio
    page = socket.query_params.get("page", "")
    await socket.accept()
    subscriber = studio.hub.subscribe(page if is_page(page) else "")
    listening = asyncio.create_task(_drain(socket, studio, subscriber.page))
    try:
        hello = await on_command_thread(studio, lambda: json.dumps(studio.hello(), allow_nan=False))
        await socket.send_text(hello)
        studio.commands.tell(lambda: studio.page_came_or_went(subscriber.page))
        while (event := await _next_or_gone(subscriber, listening)) is not None:
            await socket.send_text(event)
        await socket.close()
    except (WebSocketDisconnect, RuntimeError):
        pass  # the page is gone
    finally:
        studio.hub.unsubscribe(subscriber)
        studio.commands.tell(lambda: studio.page_came_or_went(subscriber.page))
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


async def _drain(socket: WebSocket, studio: Studio, page: str) -> None:
    while True:
        studio.robot.lease.heard(page)
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", 1000))
        word, _, name = (message.get("text") or "").partition(" ")
        if word == STOP:
            await send_stop(studio, name)
