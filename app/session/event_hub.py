"""Pushing what changes to every open page."""

import asyncio
import json
import threading
from typing import Any

MOST_WAITING = 400
"""A page that lags further behind than this many events is cut off; it reconnects and starts anew."""


class Subscriber:
    """One page's queue of events, filled from any thread and read on the server's loop.

    Args:
        loop: the server's.
        page: the page's id; empty where it gave none.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, page: str = "") -> None:
        self.page = page
        self._loop = loop
        self._queue: asyncio.Queue[str | None] = asyncio.Queue()
        self._latest_robot: str | None = None

    async def next(self) -> str | None:
        """The next event's text; None when the page lagged too far behind or the studio ends."""
        text = await self._queue.get()
        if text == "":
            text, self._latest_robot = self._latest_robot, None
        return text

    def put(self, text: str | None, *, is_robot: bool = False) -> None:
        """Adds an event; several robot states that wait become one, the newest."""
        self._loop.call_soon_threadsafe(self._put, text, is_robot)

    def _put(self, text: str | None, is_robot: bool) -> None:
        if is_robot:
            waiting = self._latest_robot is not None
            self._latest_robot = text
            if not waiting:
                self._queue.put_nowait("")
        elif self._queue.qsize() > MOST_WAITING:
            self._queue.put_nowait(None)
        else:
            self._queue.put_nowait(text)


class EventHub:
    """All subscribers; publishing is safe from any thread.

    Attributes:
        is_closed: whether the studio ends.
    """

    def __init__(self) -> None:
        self.is_closed = False
        self._lock = threading.Lock()
        self._subscribers: set[Subscriber] = set()

    def subscribe(self, page: str = "") -> Subscriber:
        """A new queue on the running loop.

        Args:
            page: id of the page that asks; empty for none.
        """
        subscriber = Subscriber(asyncio.get_running_loop(), page)
        with self._lock:
            self._subscribers.add(subscriber)
        return subscriber

    def unsubscribe(self, subscriber: Subscriber) -> None:
        """Forgets a queue."""
        with self._lock:
            self._subscribers.discard(subscriber)

    def pages(self) -> frozenset[str]:
        """Ids of the pages that are connected."""
        with self._lock:
            return frozenset(subscriber.page for subscriber in self._subscribers if subscriber.page)

    def publish(self, event: dict[str, Any], page: str | None = None) -> None:
        """Sends an event to every page, or to one alone."""
        text = json.dumps(event, allow_nan=False)
        is_robot = event["type"] == "robot"
        with self._lock:
            subscribers = tuple(one for one in self._subscribers if page in (None, one.page))
        for subscriber in subscribers:
            subscriber.put(text, is_robot=is_robot)

    def close(self) -> None:
        """Ends every subscription."""
        self.is_closed = True
        with self._lock:
            subscribers = tuple(self._subscribers)
        for subscriber in subscribers:
            subscriber.put(None)
