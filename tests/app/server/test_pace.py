"""Requests begin one in each turn of the event loop; a Stop begins at once."""

from __future__ import annotations

import asyncio

from starlette.types import Receive, Scope, Send

from app.server.admission import STOP
from app.server.pace import Pace
from tests.support.own_loop import run_apart

METHOD, PATH = STOP


class Crowd:
    """Requests that come at once, and what began in which turn of the loop."""

    def __init__(self) -> None:
        self.turn = 0
        self.begun: list[tuple[int, str]] = []
        self.pace = Pace(self._app)

    async def _app(self, scope: Scope, receive: Receive, send: Send) -> None:
        self.begun.append((self.turn, scope["path"]))

    def ask(self, path: str, method: str = "GET") -> asyncio.Task[None]:
        async def nothing() -> dict[str, str]:
            return {"type": "http.disconnect"}

        async def unsent(message: object) -> None:
            raise AssertionError(message)

        scope = {"type": "http", "method": method, "path": path}
        return asyncio.ensure_future(self.pace(scope, nothing, unsent))

    async def pass_turns(self, count: int) -> None:
        for _ in range(count):
            await asyncio.sleep(0)
            self.turn += 1


def test_a_stop_begins_before_those_that_came_earlier() -> None:
    async def crowd() -> list[tuple[int, str]]:
        one = Crowd()
        tasks = [one.ask(f"/{number}") for number in range(6)]
        tasks.append(one.ask(PATH, METHOD))
        await one.pass_turns(12)
        assert all(task.done() for task in tasks)
        return one.begun

    begun = run_apart(crowd())
    turns = [turn for turn, path in begun if path != PATH]
    assert begun.index((0, PATH)) == 1
    assert [path for _, path in begun if path != PATH] == [f"/{number}" for number in range(6)]
    assert len(set(turns)) == len(turns)


def test_a_request_that_breaks_off_keeps_nobody() -> None:
    async def crowd() -> list[str]:
        one = Crowd()
        tasks = [one.ask(f"/{number}") for number in range(4)]
        await one.pass_turns(1)
        for task in tasks[1:3]:
            task.cancel()
        await one.pass_turns(8)
        last = one.ask("/last")
        await one.pass_turns(2)
        assert last.done()
        return [path for _, path in one.begun]

    assert run_apart(crowd()) == ["/0", "/3", "/last"]
