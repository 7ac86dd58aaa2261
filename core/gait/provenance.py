"""The provenance of a computed result: hashes of problem and result, the solver and the time."""

import re
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from core.errors import InputError

MOST_WORDS = 80
"""Characters of each word of a provenance."""
_HASH = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True)
class Provenance:
    """What was solved, what came out, and who computed it when.

    Args:
        motion: SHA-256 of everything that the motion was asked for by.
        trajectory: SHA-256 of the result.
        method: how it was computed, such as `nlp`.
        solver: the solver's name and version.
        status: what the independent checker made of it.
        seconds: time in the solver, s.
        made: when, ISO 8601 with its offset from UTC.
        program: version of this program.
    """

    motion: str
    trajectory: str
    method: str
    solver: str
    status: str
    seconds: float
    made: str
    program: str

    def __post_init__(self) -> None:
        for name in ("motion", "trajectory"):
            if not _HASH.fullmatch(getattr(self, name)):
                raise InputError(
                    f"provenance.{name} is no SHA-256: 64 digits 0 to 9, a to f. Optimise the gait again.",
                    f"provenance.{name}",
                )
        for name in ("method", "solver", "status", "program"):
            if not 1 <= len(getattr(self, name)) <= MOST_WORDS or not getattr(self, name).isprintable():
                raise InputError(
                    f"provenance.{name} must be 1 to {MOST_WORDS} printable characters.", f"provenance.{name}"
                )
        if not (np.isfinite(self.seconds) and self.seconds >= 0):
            raise InputError(
                f"provenance.seconds is {self.seconds}; it must be a time of at least 0 s.",
                "provenance.seconds",
            )
        _require_moment(self.made)


def _require_moment(made: str) -> None:
    try:
        moment = datetime.fromisoformat(made)
    except ValueError as error:
        raise InputError(
            f"provenance.made is “{made[:40]}”; it must be a time such as 2026-11-21T18:40:00+00:00.",
            "provenance.made",
        ) from error
    if moment.tzinfo is None or len(made) > MOST_WORDS:
        raise InputError("provenance.made must name its offset from UTC, such as +00:00.", "provenance.made")
