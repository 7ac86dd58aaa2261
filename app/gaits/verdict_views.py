"""Verdicts and approvals as JSON."""

from dataclasses import asdict

from app.common.json import Json
from core.findings import Approval, Verdict


def verdict_view(verdict: Verdict) -> Json:
    """A verdict with its findings, errors first; indices count from 0."""
    return {**asdict(verdict), "passed": verdict.passed, "hash": verdict.content_hash}


def approval_view(approval: Approval) -> Json:
    """An approval."""
    return asdict(approval)
