"""Verdicts and approvals as JSON."""

from dataclasses import asdict, replace

from app.common.json import Json
from core.findings import Approval, Verdict


def verdict_view(verdict: Verdict) -> Json:
    """A verdict with its findings, errors first; indices count from 0."""
    findings = [{**asdict(one), "overridable": one.is_overridable} for one in verdict.findings]
    judged = {"findings": findings, "passed": verdict.passed, "hash": verdict.content_hash}
    return {**asdict(replace(verdict, findings=())), **judged}


def approval_view(approval: Approval) -> Json:
    """An approval."""
    return asdict(approval)


def override_view(approval: Approval) -> Json | None:
    """The rules that an approval overrides, the reason, and the person; None where no error stood."""
    override = approval.override
    if override is None:
        return None
    return {"rules": list(override.rules), "reason": override.reason, "by": approval.by}


def override_words(view: Json) -> str:
    """An override's view in a line."""
    return f"{', '.join(view['rules'])}, by {view['by']}: {' '.join(view['reason'].split())}"
