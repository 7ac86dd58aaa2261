"""The session's thread goes on, whatever becomes of one command."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from app.session.command_queue import CommandQueue


@pytest.fixture
def commands() -> Iterator[CommandQueue]:
    opened = CommandQueue()
    yield opened
    opened.close()


def test_a_command_that_fails_says_so_to_whoever_waits_and_the_next_is_done(commands: CommandQueue) -> None:
    failed = commands.submit(lambda: 1 // 0)
    with pytest.raises(ZeroDivisionError):
        failed.result(10)
    assert commands.submit(lambda: 2).result(10) == 2


def test_a_command_that_nobody_waits_for_any_more_is_left_out_and_the_next_is_done(
    commands: CommandQueue,
) -> None:
    free, done = threading.Event(), []
    commands.submit(lambda: free.wait(60))
    dropped = commands.submit(lambda: done.append("dropped"))
    after = commands.submit(lambda: done.append("after"))
    assert dropped.cancel()
    free.set()
    after.result(10)
    assert done == ["after"]
