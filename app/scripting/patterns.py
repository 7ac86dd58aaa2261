"""Footfall patterns for scripts: proven best by the solver, and confirmed by the checker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.cli.commands_pattern import pattern_content, solved_pattern
from app.cli.pattern_text import drawn_pattern
from app.scripting.html import paragraph
from app.scripting.options import command_options
from core.arrays import Bools
from core.errors import InfeasibleError


@dataclass(frozen=True, eq=False, repr=False)
class Pattern:
    """A footfall pattern, or why there is none. `footfall.pattern` gives one.

    Args:
        status: `optimal`, `feasible`, `infeasible` or `failed`.
        explanation: sentences on why there is none; empty where there is one.
        figures: what `footfall pattern --json` prints; counts of samples, times in s.
        is_cyclic: whether the first sample follows the last.

    Raises:
        InfeasibleError: `stance`, where there is no pattern.

    Example:
        >>> import footfall as ff
        >>> found = ff.pattern(legs=4, samples=12, periodic=True)
        >>> found.status, found.stance.shape
        ('optimal', (4, 12))
    """

    status: str
    explanation: tuple[str, ...]
    figures: dict[str, Any]
    is_cyclic: bool

    @property
    def pattern(self) -> list[str]:
        """A text a foot: 1 for stance, 0 for swing, a sample a character; empty where there is none."""
        return list(self.figures["pattern"])

    @property
    def objective(self) -> int | None:
        """Number of samples at which feet change; None where there is no pattern."""
        value: int | None = self.figures["objective"]
        return value

    @property
    def stance(self) -> Bools:
        """(legs, samples) which feet stand."""
        if not self.pattern:
            raise InfeasibleError(f"There is no pattern: {' '.join(self.explanation)}", "pattern")
        return np.array([[cell == "1" for cell in row] for row in self.pattern])

    def __repr__(self) -> str:
        if not self.pattern:
            return f"Pattern: {self.status}. {' '.join(self.explanation)}"
        marks = [str(foot + 1) for foot in range(len(self.pattern))]
        return "\n".join(
            [f"Pattern: {self.status}", *drawn_pattern(self.stance, marks, cyclic=self.is_cyclic)]
        )

    def _repr_html_(self) -> str:
        if not self.pattern:
            return paragraph([f"{self.status.capitalize()}.", *self.explanation])
        return f"<pre>{self!r}</pre>"


def pattern(
    *, legs: int, samples: int, start: str | None = None, end: str | None = None, **options: Any
) -> Pattern:
    """The best footfall pattern: a transition between two states, or a periodic gait.

    Args:
        legs: number of legs, in a ring.
        samples: how many, both ends of a transition included.
        start: first state of a transition, foot 1 first: 1 for stance, 0 for swing.
        end: last state of a transition.
        options: those of `footfall pattern`: periodic, locked, shortest, best and the rules; no units but
            seconds, s.

    Returns:
        The pattern; `status` says whether it is proven the best.

    Raises:
        InputError: there is no such option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.pattern(legs=6, samples=20, start="111001", end="011011").objective
        3
    """
    asked = command_options(
        "pattern", [], legs=legs, samples=samples, **{"from": start, "to": end, **options}
    )
    problem, result, failure = solved_pattern(asked)
    content = pattern_content(problem, result, failure, [])
    return Pattern(content["status"], tuple(content["explanation"]), content, bool(asked.periodic))
