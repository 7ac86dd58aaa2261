"""Printing results, for people or as one JSON object."""

import json
import signal
import sys
from argparse import Namespace
from collections.abc import Sequence
from types import FrameType
from typing import Any

from app.common.json import finite
from core.findings import SendCost, Severity, Verdict

INFEASIBLE, NOT_FIT = 3, 4
"""Exit status of a command that found no motion or pattern, and of one whose check failed."""
INTERRUPTED = 130
"""Exit status of a command that Ctrl-C or SIGTERM ended."""


class Interrupted(Exception):  # noqa: N818 - it is no error
    """SIGTERM arrived; commands end as by Ctrl-C."""


def end_on_sigterm() -> None:
    """Makes SIGTERM unwind the command as Ctrl-C does."""

    def raise_interrupted(number: int, frame: FrameType | None) -> None:
        del number, frame
        raise Interrupted

    signal.signal(signal.SIGTERM, raise_interrupted)


def ignore_interrupts() -> None:
    """Lets a command that has been interrupted end what it does without being broken off again."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def show(options: Namespace, content: dict[str, Any], lines: Sequence[str]) -> None:
    """Prints content as JSON, or lines for people."""
    text = json.dumps(finite(content), allow_nan=False) if options.json else "\n".join(lines)
    sys.stdout.write(text + "\n")


def note(text: str) -> None:
    """Says something beside the result, on standard error."""
    sys.stderr.write(text + "\n")


def tally(errors: int, warnings: int) -> str:
    """How many findings of each kind, in words."""
    counts = ((errors, "error"), (warnings, "warning"))
    return ", ".join(f"{count} {name}{'' if count == 1 else 's'}" for count, name in counts)


def verdict_lines(verdict: Verdict) -> list[str]:
    """A verdict for people: findings, then margins."""
    errors = sum(f.severity is Severity.ERROR for f in verdict.findings)
    warnings = len(verdict.findings) - errors
    lines = [f"{'Passed' if verdict.passed else 'Not fit'}: {tally(errors, warnings)}."]
    lines += [f"  {f.severity.value}: {f.rule}: {f.sentence}" for f in verdict.findings]
    lines += [f"  margin {m.rule:<12} {_in_unit(m.margin, m.unit)}" for m in verdict.margins]
    lines += [_cost_line(cost) for cost in verdict.costs]
    lines += [f"  {sentence}" for sentence in verdict.notes]
    return lines


def _cost_line(cost: SendCost) -> str:
    bound = "none" if cost.stop_bound is None else f"{cost.stop_bound:g} s"
    chosen = " (chosen)" if cost.is_chosen else ""
    return (
        f"  stop bound {bound}{chosen}: {cost.merged_seconds:.1f} s merged within "
        f"{cost.merge * 1000:g} mm, {cost.every_seconds:.1f} s with one waypoint a knot"
    )


def _in_unit(value: float | None, unit: str) -> str:
    if value is None:
        return "         – (no number)"
    return f"{value * 1000:10.3f} mm{unit[1:]}" if unit.startswith("m") else f"{value:10.3f} {unit}"
