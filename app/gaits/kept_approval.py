"""A kept approval beside the verdict of today: whether it is of it, and if not, what is different."""

import re
from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any

from core.findings import VERDICT_FORM, Approval, Verdict

_FIGURE = re.compile(r"[-−]?\d+\.\d+")
"""A measured figure in a sentence; numbers of feet, motors and samples have no decimals."""


def approval_of(content: dict[str, Any]) -> Approval:
    """An approval out of its JSON content, whatever else stands beside it."""
    known = {field.name for field in fields(Approval)}
    values = {name: value for name, value in content.items() if name in known}
    return Approval(**values | {"warnings": tuple(content.get("warnings", ()))})


def in_todays_form(approval: Approval, verdict: Verdict) -> Approval:
    """An approval of the first form, bound to today's verdict; as it is where that may be another one.

    Its hash cannot be compared. It shows waypoints, robot and the sentences of the warnings that its person
    has seen: these have to be today's, but for decimals in them, and no error may stand.
    """
    if approval.form != 1 or _other_bound(approval, verdict) is not None or not verdict.passed:
        return approval
    if _without_figures(approval.warnings) != _without_figures(f.sentence for f in verdict.warnings):
        return approval
    return replace(approval, verdict_hash=verdict.content_hash, form=VERDICT_FORM)


def what_changed(approval: Approval, verdict: Verdict) -> str | None:
    """Why an approval is not of a verdict, as the beginning of a sentence; None where it is."""
    if approval.verdict_hash == verdict.content_hash:
        return None
    return _other_bound(approval, verdict) or (
        "The check gives another result than the approved one (other findings, other rules, or no simulation "
        "any more)"
    )


def _other_bound(approval: Approval, verdict: Verdict) -> str | None:
    if not approval.robot_hash:
        return "It is not known which parameters of the robot were approved"
    if approval.robot_hash != verdict.robot_hash:
        return "The robot's parameters are not those that were approved"
    if approval.waypoints_hash != verdict.waypoints_hash:
        return "This version of the program makes other waypoints from the gait than those that were approved"
    return None


def _without_figures(sentences: Iterable[str]) -> list[str]:
    return sorted(_FIGURE.sub("#", sentence) for sentence in sentences)
