"""Remedies for scripts: changed gaits that walk where the asked one has no motion."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.scripting.gaits import Gait
from app.scripting.html import Cell, paragraph, table
from app.scripting.planning import drawn_document
from app.scripting.plans import Plan
from core.errors import InputError
from core.gait.gait import motion_problem
from core.robot.model import load_robot
from solver_jobs import SolveStatus, find_remedies, nothing_words, solve_live

_HAS_MOTION = "This gait has a motion; it needs no remedy."


@dataclass(frozen=True, eq=False, repr=False)
class Remedy:
    """A changed gait that has a motion. `footfall.remedies` gives some.

    Args:
        kind: what it changes, such as `step`, `margin` or `one_by_one`.
        label: what the page calls it.
        sentence: what it does, and what it costs.
        caution: why it comes last; empty where nothing is to be feared.
        gait: the changed gait, for `footfall.optimise`; its step is in m.

    Raises:
        FootfallError: never.

    Example:
        >>> import footfall as ff
        >>> ff.remedies("walk", step=0.05)[0].kind
        'step'
    """

    kind: str
    label: str
    sentence: str
    caution: str
    gait: Gait

    def __repr__(self) -> str:
        return " ".join(filter(None, (f"{self.label}. {self.sentence}", self.caution)))


class Remedies(tuple[Remedy, ...]):
    """Several remedies, best first, which a notebook shows as a table; where there are none, it says why."""

    explanation: str

    def __new__(cls, found: Iterable[Remedy], explanation: str = "") -> Remedies:
        """Remedies, or the sentence why there are none."""
        made = super().__new__(cls, found)
        made.explanation = explanation
        return made

    def __repr__(self) -> str:
        return "\n".join(f"{number}. {one!r}" for number, one in enumerate(self, 1)) or self.explanation

    def _repr_html_(self) -> str:
        rows: list[list[Cell]] = [
            [number, one.label, one.sentence, one.caution] for number, one in enumerate(self, 1)
        ]
        heads = ["", "remedy", "what it does", "caution"]
        return table(heads, rows) if rows else paragraph([self.explanation])


def remedies(source: Plan | Gait | str | Path, **options: Any) -> Remedies:
    """What would help a gait that has no motion: up to four changed gaits, best first.

    Each was solved and held to every limit before it is given.

    Args:
        source: a gait as for `footfall.optimise`, or a plan without a motion.
        options: those of `footfall optimise`, in SI; none with a plan.

    Returns:
        A tuple of remedies; empty where the gait has a motion or nothing helps, and `explanation` says which.

    Raises:
        InputError: there is no such gait or option, a value does not fit, or there is nothing to optimise.

    Example:
        >>> import footfall as ff
        >>> best = ff.remedies("walk", step=0.05)[0]
        >>> ff.optimise(best.gait, method="live").status
        'solved'
    """
    if isinstance(source, Plan):
        if options:
            raise InputError("A plan is made already; options are for gaits.", "source")
        if source.gait is None or source.trajectory is not None:
            return Remedies((), _HAS_MOTION)
        source = source.gait
    document, _ = drawn_document("optimise", source, ("method", "remedy"), options)
    model = load_robot(document.robot)
    if solve_live(motion_problem(document, model)).status is SolveStatus.SOLVED:
        return Remedies((), _HAS_MOTION)
    found = [
        Remedy(one.kind.value, one.label, one.sentence, one.caution, Gait(one.gait))
        for one in find_remedies(document, model).remedies
    ]
    return Remedies(found, "" if found else nothing_words(document))
