"""What comes late: requests, answers and events that are held back until a test lets them go."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import partial

from playwright.sync_api import Page, Route, WebSocketRoute


class Late:
    """What is held back of a page."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._held: list[Callable[[], None]] = []

    @property
    def count(self) -> int:
        """How much is held back now; Playwright hears of requests only while it is asked something."""
        self._page.evaluate("null")
        return len(self._held)

    def let_go(self) -> None:
        """Passes on what was held back, in its order."""
        held, self._held = self._held, []
        for pass_on in held:
            pass_on()


class LateRequests(Late):
    """The first request of a kind reaches the studio only when it is let go; later ones go through.

    Args:
        page: whose request.
        method: of the request.
        address: what its address contains, as a regular expression.
    """

    def __init__(self, page: Page, method: str, address: str) -> None:
        super().__init__(page)
        self._method = method
        self._address = re.compile(address)
        self._holds = True
        page.route(self._address, self._take)

    def _take(self, route: Route) -> None:
        if route.request.method == self._method and self._holds and not self._held:
            self._held.append(self._later(route))
        else:
            route.fallback()

    def let_go(self) -> None:
        """Passes on what was held back; what comes later is no longer looked at."""
        self._holds = False
        super().let_go()
        # Not before: Playwright itself lets requests go that no route handles any more.
        self._page.unroute(self._address)

    def _later(self, route: Route) -> Callable[[], None]:
        return route.continue_


class LateAnswers(LateRequests):
    """The studio answers the first request of a kind at once; the page hears of it when it is let go."""

    def _later(self, route: Route) -> Callable[[], None]:
        return partial(route.fulfill, response=route.fetch())


class LateEvents(Late):
    """The studio's events of a kind come late; to be made before the page is opened.

    Args:
        page: whose events.
        kind: their type.
    """

    def __init__(self, page: Page, kind: str) -> None:
        super().__init__(page)
        self._kind = kind
        self._holds = True
        page.route_web_socket("**/api/events*", self._connect)

    def let_go(self) -> None:
        """Passes on what was held back; what comes later goes through."""
        self._holds = False
        super().let_go()

    def _connect(self, socket: WebSocketRoute) -> None:
        server = socket.connect_to_server()

        def take(message: str | bytes) -> None:
            if self._holds and json.loads(message)["type"] == self._kind:
                self._held.append(partial(socket.send, message))
            else:
                socket.send(message)

        server.on_message(take)
