"""Whether a kept approval still matches today's verdict, and if not, why."""

import re
from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

from core.findings import VERDICT_FORM, Approval, Finding, Override, Severity, Verdict

_FIGURE = re.compile(r"[-−]?\d+\.\d+")
"""A measured figure in a sentence; numbers of feet, motors and samples have no decimals."""

OTHER_VERDICT = (
    "The check has other findings or rules than the approved one, or a simulation was added or is gone"
)

LAST_DIGIT = 0.1 + 1e-9
"""Most by which rounding changes a figure in a sentence."""


def approval_of(content: dict[str, Any]) -> Approval:
    """An approval out of its JSON content, whatever else stands beside it."""
    values = _known(Approval, content) | {"warnings": tuple(content.get("warnings", ()))}
    override = content.get("override")
    return Approval(**values | {"override": None if override is None else _override_of(override)})


def _override_of(content: dict[str, Any]) -> Override:
    errors = [_known(Finding, one) | {"severity": Severity(one["severity"])} for one in content["errors"]]
    return Override(tuple(content["rules"]), content["reason"], tuple(Finding(**one) for one in errors))


def _known(kind: type[Approval | Finding], content: dict[str, Any]) -> dict[str, Any]:
    names = {field.name for field in fields(kind)}
    return {name: value for name, value in content.items() if name in names}


def in_todays_form(approval: Approval, verdict: Verdict) -> Approval:
    """An approval of the first form, bound to today's verdict; as it is where that may be another one.

    Its hash cannot be compared. It shows waypoints, robot and the sentences of the warnings that its person
    has seen: these have to be today's, but for the last digit of figures, and no error may stand.
    """
    if approval.form != 1 or _other_bound(approval, verdict) is not None or not verdict.passed:
        return approval
    if not _read_alike(sorted(approval.warnings), sorted(f.sentence for f in verdict.warnings)):
        return approval
    return replace(approval, verdict_hash=verdict.content_hash, form=VERDICT_FORM)


def what_changed(approval: Approval, verdict: Verdict) -> str | None:
    """Why an approval is not of a verdict, as the beginning of a sentence; None where it is.

    One that overrides errors covers these alone; what else the check finds, or no longer finds, is no error.
    """
    if approval.verdict_hash == verdict.content_hash:
        return None
    why = _other_bound(approval, verdict)
    if why is not None:
        return why
    if approval.override is None:
        return OTHER_VERDICT
    error = approval.override.new_error(verdict)
    return None if error is None else f"The check has a new error, of the rule “{error.rule}”"


def _other_bound(approval: Approval, verdict: Verdict) -> str | None:
    if not approval.robot_hash:
        return "The approval does not record the robot's parameters"
    if approval.robot_hash != verdict.robot_hash:
        return "The robot's parameters are not those that were approved"
    if approval.waypoints_hash != verdict.waypoints_hash:
        return "The gait's waypoints are not the approved ones any more, as after an update of the program"
    return None


def _read_alike(seen: Sequence[str], today: Sequence[str]) -> bool:
    """Whether sentences have the same words, and figures that differ by a last digit at most."""
    if [_FIGURE.sub("#", one) for one in seen] != [_FIGURE.sub("#", one) for one in today]:
        return False
    pairs = zip(_figures(seen), _figures(today), strict=True)
    return all(abs(one - other) <= LAST_DIGIT for one, other in pairs)


def _figures(sentences: Sequence[str]) -> list[float]:
    return [float(text.replace("−", "-")) for one in sentences for text in _FIGURE.findall(one)]
