"""Every route of the application refuses every kind of foreigner, by HTTP and by web socket.

The routes are the application's own, so a new one is tried by itself. Viser's own port has its table in
`tests/app/scene`.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, NoReturn, cast

import fastapi.routing
import pytest
from fastapi import FastAPI
from starlette.types import Message, Scope

from app.scene.registry import Scenes
from app.server.application import make_app
from app.studio.studio import Studio
from app.web import wrong_tokens
from app.web.access import Access
from tests.support.own_loop import run_apart

HOST, TOKEN = "127.0.0.1:8400", "a-token-of-enough-letters"
SHOWN = {"authorization": f"Bearer {TOKEN}"}
OPENED = {"sec-fetch-mode": "navigate", "sec-fetch-dest": "document"}
PAGES = {"/", "/docs"}
"""What a link on another site may open."""


@dataclass(frozen=True)
class Stranger:
    """How a request differs from one that is let in: its headers and its query."""

    headers: dict[str, str] = field(default_factory=lambda: SHOWN)
    query: str = ""
    opens: frozenset[str] = frozenset()
    """Paths that it may GET all the same."""


STRANGERS = {
    "no token": Stranger({}),
    "wrong token in the header": Stranger({"authorization": "Bearer wrong"}),
    "wrong token in the address": Stranger({}, "token=wrong"),
    "wrong token in a cookie": Stranger({"cookie": "footfall_token_8400=wrong"}),
    "foreign Origin": Stranger(SHOWN | {"origin": "http://evil.example"}),
    "Origin on another port": Stranger(SHOWN | {"origin": "http://127.0.0.1:9999"}),
    "null Origin": Stranger(SHOWN | {"origin": "null"}),
    "foreign Host": Stranger(SHOWN | {"host": "evil.example"}),
    "foreign Host, its own Origin": Stranger(
        SHOWN | {"host": "evil.example", "origin": "http://evil.example"}
    ),
    "cross-site": Stranger(SHOWN | {"sec-fetch-site": "cross-site"}),
    "cross-site link": Stranger(SHOWN | {"sec-fetch-site": "cross-site"} | OPENED, opens=frozenset(PAGES)),
    "same-site": Stranger(SHOWN | {"sec-fetch-site": "same-site"}),
    "same-site link": Stranger(SHOWN | {"sec-fetch-site": "same-site"} | OPENED, opens=frozenset(PAGES)),
}


class Reached(Exception):  # noqa: N818
    """A request came as far as the studio."""


class Untouched:
    """Stands for the studio and the scenes; nobody may ask them for anything."""

    def __getattr__(self, name: str) -> NoReturn:
        raise Reached(name)

    def of(self, robot: str) -> NoReturn:
        """No scene."""
        raise Reached(robot)


@dataclass(frozen=True)
class Door:
    """A way into the application."""

    kind: str
    method: str
    path: str


@pytest.fixture
def app(monkeypatch: pytest.MonkeyPatch) -> FastAPI:
    monkeypatch.setattr(wrong_tokens, "FIRST_SECONDS", 0.0)
    nothing: Any = Untouched()
    return make_app(cast(Studio, nothing), cast(Scenes, nothing), Access("127.0.0.1", TOKEN))


def doors(app: FastAPI) -> Iterator[Door]:
    """Each route by each of its methods, by HEAD where it takes GET, and as a web socket too."""
    # Older versions keep their routes flat.
    flat: Callable[[Any], Iterable[Any]] = getattr(fastapi.routing, "iter_route_contexts", list)
    for route in flat(app.routes):
        path = re.sub(r"\{[^}]*\}", "x", route.path)
        methods = set(getattr(route, "methods", None) or {"GET", "POST"})
        for method in sorted(methods | ({"HEAD"} if "GET" in methods else set())):
            yield Door("http", method, path)
        yield Door("websocket", "", path)


async def status(app: FastAPI, door: Door, headers: dict[str, str], query: str) -> int:
    """The status of the answer; 101 for a socket that was accepted.

    Raises:
        Reached: the request came to the studio.
    """
    sent: list[Message] = []
    first = "websocket.connect" if door.kind == "websocket" else "http.request"
    waiting: list[Message] = [{"type": first, "body": b"{}"}]

    async def receive() -> Message:
        return waiting.pop() if waiting else {"type": first.split(".")[0] + ".disconnect", "code": 1000}

    async def send(message: Message) -> None:
        sent.append(message)

    heads = {"host": HOST, "content-type": "application/json", **headers}
    scope: Scope = {
        "type": door.kind,
        "http_version": "1.1",
        "scheme": "http" if door.kind == "http" else "ws",
        "path": door.path,
        "raw_path": door.path.encode(),
        "query_string": query.encode(),
        "headers": [(name.encode(), value.encode()) for name, value in heads.items()],
        "client": ("127.0.0.1", 50000),
        "server": ("127.0.0.1", 8400),
    }
    if door.kind == "http":
        scope["method"] = door.method
    await app(scope, receive, send)
    known = {"websocket.accept": 101, "websocket.close": 403}
    return int(sent[0].get("status") or known[sent[0]["type"]])


def is_of_relay(door: Door) -> bool:
    return door.kind == "websocket" and door.path.startswith("/viser/")


def test_strangers_are_refused_everywhere(app: FastAPI, record_property: Any) -> None:
    async def walk() -> tuple[Counter[str], list[str]]:
        refused: Counter[str] = Counter()
        let_in: list[str] = []
        for door in doors(app):
            for name, stranger in STRANGERS.items():
                answered = await status(app, door, stranger.headers, stranger.query)
                may_open = door.method == "GET" and door.path in stranger.opens
                if answered != (200 if may_open else 403):
                    let_in.append(f"{name}: {door} {answered}")
                kind = "pages opened by links" if may_open else "relay" if is_of_relay(door) else door.kind
                refused[kind] += 1
        return refused, let_in

    counts, let_in = run_apart(walk())
    record_property("requests", dict(counts))
    ways = len(list(doors(app)))
    sys.stdout.write(
        f"{ways} ways in, {len(STRANGERS)} strangers, requests as they should be: {dict(counts)}\n"
    )
    assert let_in == []
    assert counts["pages opened by links"] == 2 * len(PAGES)


def test_who_has_the_token_comes_through_everywhere(app: FastAPI) -> None:
    """Else the walk above would try what is not there."""

    async def walk() -> Counter[str]:
        outcomes: Counter[str] = Counter()
        for door in doors(app):
            try:
                answered = await status(app, door, SHOWN, "")
                outcomes["refused" if answered == 403 and door.kind == "http" else "answered"] += 1
            except Reached:
                outcomes["reached the studio"] += 1
        return outcomes

    outcomes = run_apart(walk())
    assert outcomes["refused"] == 0
    assert outcomes["reached the studio"] > 80


def test_all_kinds_of_routes_are_walked(app: FastAPI) -> None:
    ways = list(doors(app))
    assert {Door("http", "POST", "/api/robot/stop"), Door("websocket", "", "/viser/ws")} <= set(ways)
    assert {"/static", "/static-offline-docs", "/openapi.json", "/docs", "/"} <= {way.path for way in ways}
    documented = {(method.upper(), path) for path, one in app.openapi()["paths"].items() for method in one}
    walked = {(way.method, way.path) for way in ways}
    assert {(method, re.sub(r"\{[^}]*\}", "x", path)) for method, path in documented} <= walked
