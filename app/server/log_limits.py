"""A log that stays short: one line a minute for each kind of message, with how many more there were."""

import logging
import re
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

MINUTE = 60.0

MOST_KINDS = 200
"""Kinds that are told apart; further ones count as one."""

COUNTED = "has_count"
"""Attribute of a record whose message holds a count already."""

_NUMBERS = re.compile(r"0x[0-9a-fA-F]+|\d+")

_Kind = tuple[str, int, str, str]


@dataclass
class _Held:
    """What is held back of one kind."""

    until: float
    first_line: str
    more: int = 0


class LogLimit(logging.Filter):
    """Lets the first message of each kind pass, and counts the others for a minute.

    Messages are of one kind if logger, level, exception and the first line without its numbers agree. An
    `extra` of `times` says how often a message stands for what happened.

    Args:
        handler: where the counts are written; the filter is put on it.
        clock: seconds.
    """

    def __init__(self, handler: logging.Handler, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._handler, self._clock = handler, clock
        self._held: dict[_Kind, _Held] = {}
        self._lock = threading.Lock()
        handler.addFilter(self)

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a message is written."""
        times, now = getattr(record, "times", 1), self._clock()
        first_line = record.getMessage().partition("\n")[0]
        with self._lock:
            kind = self._kind(record, first_line)
            held = self._held.get(kind)
            if held is not None and now < held.until:
                held.more += times
                return False
            more = times - 1 + (held.more if held is not None else 0)
            self._held[kind] = _Held(now + MINUTE, first_line)
        if more and not hasattr(record, COUNTED):
            # Other handlers get the same record.
            record.msg, record.args = _with_count(record.getMessage(), more), ()
            setattr(record, COUNTED, True)
        return True

    def flush(self, *, is_end: bool = False) -> None:
        """Writes the counts whose minute is over, or all of them at the end."""
        now = self._clock()
        with self._lock:
            over = {kind: held for kind, held in self._held.items() if is_end or now >= held.until}
            for kind, held in over.items():
                if held.more and not is_end:
                    self._held[kind] = _Held(now + MINUTE, held.first_line)
                else:
                    del self._held[kind]
        for (name, level, _, _), held in over.items():
            if held.more:
                line = _with_count(held.first_line, held.more)
                words = {"name": name, "levelno": level, "levelname": logging.getLevelName(level)}
                self._write(logging.makeLogRecord(words | {"msg": line}))

    def close(self) -> None:
        """Writes what was counted, and lets every message pass from now on."""
        self._handler.removeFilter(self)
        self.flush(is_end=True)

    def _write(self, record: logging.LogRecord) -> None:
        """Writes a message past the filter."""
        self._handler.acquire()
        try:
            self._handler.emit(record)
        finally:
            self._handler.release()

    def _kind(self, record: logging.LogRecord, first_line: str) -> _Kind:
        error = record.exc_info[0] if record.exc_info else None
        kind = (record.name, record.levelno, _NUMBERS.sub("#", first_line), error.__name__ if error else "")
        if kind in self._held or len(self._held) < MOST_KINDS:
            return kind
        return ("other", record.levelno, "", "")


def _with_count(line: str, more: int) -> str:
    return f"{line} (and {more:,} more within a minute)"
