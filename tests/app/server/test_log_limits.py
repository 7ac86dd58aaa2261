"""The log: one line a minute for each kind of message, and nothing forgotten."""

from __future__ import annotations

import logging
from collections.abc import Iterator

import pytest

from app.server.log_limits import MINUTE, MOST_KINDS, LogLimit


class Lines(logging.Handler):
    """Keeps what is written."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(self.format(record))


class Limited:
    """A limited log, and its clock."""

    def __init__(self, logger: logging.Logger) -> None:
        self.now = 0.0
        self.handler = Lines()
        self.limit = LogLimit(self.handler, lambda: self.now)
        self.logger = logger
        logger.addHandler(self.handler)

    @property
    def lines(self) -> list[str]:
        return self.handler.lines


@pytest.fixture
def limited() -> Iterator[Limited]:
    logger = logging.Logger("limited")
    yield Limited(logger)
    logger.handlers.clear()


def test_one_line_a_minute_is_written_and_the_others_are_counted(limited: Limited) -> None:
    for number in range(300):
        limited.now = number * 0.1
        limited.logger.warning("Port %d is gone.", number)
    assert limited.lines == ["Port 0 is gone."]
    limited.now = MINUTE
    limited.limit.flush()
    assert len(limited.lines) == 2
    assert "299 more" in limited.lines[1]
    limited.logger.warning("Port 7 is gone.")
    assert len(limited.lines) == 2


def test_the_first_message_after_the_minute_brings_the_count(limited: Limited) -> None:
    for _ in range(3):
        limited.logger.warning("Gone.")
    limited.now = MINUTE
    limited.logger.warning("Gone.")
    assert ["2 more" in line for line in limited.lines] == [False, True]


def test_a_message_that_stands_for_many_counts_as_many(limited: Limited) -> None:
    limited.logger.warning("Closed.", extra={"times": 40})
    limited.logger.warning("Closed.", extra={"times": 5})
    limited.limit.close()
    assert ["39 more" in limited.lines[0], "5 more" in limited.lines[1]] == [True, True]


def test_kinds_are_told_apart_and_a_quiet_minute_begins_anew(limited: Limited) -> None:
    limited.logger.warning("One kind.")
    limited.logger.warning("Another kind.")
    limited.logger.error("One kind.")
    assert len(limited.lines) == 3
    limited.now = MINUTE
    limited.limit.flush()
    limited.logger.warning("One kind.")
    assert limited.lines[-1] == "One kind."
    assert len(limited.lines) == 4


def test_one_traceback_a_minute_is_written_for_each_error(limited: Limited) -> None:
    for error in (OSError("gone"), OSError("gone"), ValueError("gone")):
        try:
            raise error
        except (OSError, ValueError):
            limited.logger.exception("It went wrong.\nWith details.")
    assert len(limited.lines) == 2
    assert all("Traceback" in line for line in limited.lines)


def test_however_many_kinds_there_are_the_memory_is_bounded(limited: Limited) -> None:
    for number in range(3 * MOST_KINDS):
        limited.logger.warning("".join(chr(97 + int(digit)) for digit in str(number)))
    assert len(limited.lines) == MOST_KINDS + 1
    limited.limit.close()
    assert f"{2 * MOST_KINDS - 1} more" in limited.lines[-1]


def test_two_handlers_write_the_same_line(limited: Limited) -> None:
    other = Lines()
    LogLimit(other, lambda: limited.now)
    limited.logger.addHandler(other)
    limited.logger.warning("Closed.", extra={"times": 3})
    assert limited.lines == other.lines
    assert limited.lines[0].count("more") == 1
