"""Checks for scripts: every rule that a plan must keep, with its margin."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from app.cli.common.output import verdict_lines
from app.scripting.gaits import Gait
from app.scripting.html import Cell, paragraph, table
from app.scripting.planning import plan
from app.scripting.plans import Plan
from app.simulation.physics_check import checked_in_physics
from core.checks.checked_plan import Beyond, CheckedPlan, checked_plan
from core.findings import Verdict as Content


@dataclass(frozen=True, eq=False, repr=False)
class Verdict:
    """What the rules say of a plan. `footfall.check` gives one.

    Args:
        content: the verdict in full; margins in SI.

    Raises:
        FootfallError: never.

    Example:
        >>> import footfall as ff
        >>> verdict = ff.check("walk-manual-0")
        >>> verdict.passed, verdict.findings[0]["rule"]
        (True, 'balance')
    """

    content: Content

    @property
    def passed(self) -> bool:
        """Whether no error stands; warnings may."""
        return self.content.passed

    @property
    def findings(self) -> list[dict[str, Any]]:
        """What was found, errors first: rule, severity, sentence, value and limit in SI, foot from 0."""
        return [{**asdict(one), "severity": one.severity.value} for one in self.content.findings]

    @property
    def margins(self) -> dict[str, float | None]:
        """How far the worst place of each rule stays from its limit, SI; below 0 where it is broken."""
        return {one.rule: one.margin for one in self.content.margins}

    def __repr__(self) -> str:
        return "\n".join(verdict_lines(self.content))

    def _repr_html_(self) -> str:
        rows: list[list[Cell]] = [
            [one.severity.value, one.rule, one.sentence] for one in self.content.findings
        ]
        said = "Fit to send." if self.passed else "Not fit to send."
        return paragraph([said]) + (table(["", "rule", "what was found"], rows) if rows else "")


def check(source: Plan | Gait | str | Path | ArrayLike, *, within_stroke: str | None = None) -> Verdict:
    """Checks what would be sent of a plan by every rule.

    Args:
        source: a plan, or anything that `footfall.plan` takes, such as an array (lines, legs, 3) of strokes
            in m.
        within_stroke: as for `footfall.plan`.

    Returns:
        The verdict; its margins are in SI.

    Raises:
        InputError: there is no such gait, a file cannot be read, or an array has another shape.
        InfeasibleError: the plan has no motion, for the robot cannot do what is asked.
        CheckError: no motion was confirmed.

    Example:
        >>> import footfall as ff
        >>> ff.check(ff.optimise("walk", method="live")).passed
        True
    """
    return Verdict(verdict_on(plan(source, within_stroke=within_stroke)))


def verdict_on(of: Plan) -> Content:
    """The verdict on a plan: against its document, where it has one."""
    motion, way, beyond = of.need_motion(), of.need_way(), Beyond(of.clipped)
    if of.gait is None:
        return checked_in_physics(CheckedPlan(of.robot.model, motion, way.waypoints, way=way, beyond=beyond))
    return checked_in_physics(checked_plan(of.gait.document, of.robot.model, motion, way, beyond=beyond))
