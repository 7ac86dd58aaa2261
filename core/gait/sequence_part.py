"""A gait within a sequence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from core.errors import InputError

if TYPE_CHECKING:
    from core.gait.gait import Gait

MOST_TIMES = 20
"""How often a part may run."""
MOST_PARTS = 40
"""How many parts a sequence may have."""


@dataclass(frozen=True)
class SequencePart:
    """A gait and how often it runs.

    Args:
        gait: a copy of it, so that the sequence is complete by itself.
        times: how often it runs.
        source: id of the gait that it was copied from; None where that is not known.
    """

    gait: Gait
    times: int = 1
    source: str | None = None

    def __post_init__(self) -> None:
        if not 1 <= self.times <= MOST_TIMES:
            raise InputError(
                f"“{self.gait.name}” runs {self.times} times in the sequence; it must be 1 to {MOST_TIMES}.",
                "times",
            )
        if self.gait.sequence:
            raise InputError(
                f"“{self.gait.name}” is a sequence; a part must be a single gait. Add its parts instead.",
                "sequence",
            )
