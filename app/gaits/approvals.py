"""Approvals: a person approves a verdict that is still valid; their record, and what changed since."""

from dataclasses import asdict, dataclass
from datetime import UTC, datetime

from app.common.json import Json
from app.documents.stored_gait import stored_gait
from app.gaits.kept_approval import approval_of
from app.gaits.open_gait import OpenGait, VerdictOf
from app.plans.plan import Plan
from app.store.tables.edit_history_store import ApprovalRow, EditHistoryStore
from app.store.tables.table import Selection
from core.errors import NotFoundError, StateError
from core.findings import Approval, Verdict, approve, is_simulated
from core.gait.gait import Gait
from core.gait.gait_difference import DifferenceGroup, gait_difference
from core.overrides import OverrideRequest
from core.wire.robot_time import estimate_seconds, stop_time

_UNITS = {"m": (1000.0, "mm"), "m/s": (1000.0, "mm/s"), "m/s²": (1000.0, "mm/s²")}


@dataclass(frozen=True)
class ApprovalRecord:
    """An approval as it is kept.

    Args:
        number: grows with every approval of any gait.
        approval: what was approved by whom.
        version: of the document; None in records of the first release.
        figures: of what was approved; nothing in records of the first release.
    """

    number: int
    approval: Approval
    version: int | None
    figures: Json


@dataclass(frozen=True)
class ApprovalRequest:
    """A request to approve a verdict.

    Args:
        by: their name.
        verdict_hash: of the verdict that they saw, where it is known.
        accept_warnings: whether they have seen its warnings and accept them.
        override: of the errors in spite of which they approve.
    """

    by: str
    verdict_hash: str | None = None
    accept_warnings: bool = False
    override: OverrideRequest | None = None


def approved(
    open_gait: OpenGait, plan: Plan, verdict_of: VerdictOf, request: ApprovalRequest
) -> tuple[Approval, Verdict]:
    """Approves the verdict that the person saw, if checking the gait again still gives that verdict.

    Args:
        open_gait: the gait with the verdict that it was given.
        plan: what it amounts to.
        verdict_of: checks it as everything stands now, which may have changed without an edit.
        request: what the person says.

    Raises:
        StateError: there is no verdict, another one stands by now, an error stands that is not overridden, a
            warning is not accepted, or there is no name.
        InputError: the override has no reason, or is of a rule that may not be overridden.
    """
    if open_gait.verdict is None:
        raise StateError(
            "Check this gait first: it changed since the last check, or was never checked.", "check"
        )
    seen, now = open_gait.verdict.content_hash, verdict_of(plan, open_gait.gait)
    if request.verdict_hash not in (None, seen):
        raise StateError("The verdict has changed; look at it and approve again.", "verdict_hash")
    if now.content_hash != seen:
        raise StateError(
            "The verdict is out of date: something that it rests on changed, such as the simulation. Check "
            "this gait again.",
            "check",
        )
    accepted, when = request.accept_warnings, datetime.now(UTC)
    return approve(now, request.by, when, accept_warnings=accepted, override=request.override), now


def approval_record(approval: Approval, version: int, plan: Plan, verdict: Verdict) -> Json:
    """What is kept of an approval, as JSON content."""
    return {**asdict(approval), "version": version, "figures": approval_figures(plan, verdict)}


def approval_figures(plan: Plan, verdict: Verdict) -> Json:
    """Figures of a plan by which two approvals are told apart, SI."""
    if plan.waypoints is None:
        return {}
    return {
        "waypoints": plan.waypoints.count,
        "seconds": round(estimate_seconds(plan.waypoints), 1),
        "stop_seconds": round(stop_time(plan.waypoints), 2),
        "simulated": any(is_simulated(margin.rule) for margin in verdict.margins),
        "margins": {m.rule: [m.margin, m.unit] for m in verdict.margins if m.margin is not None},
    }


class Approvals:
    """The record of every gait's approvals.

    Args:
        log: where they and the versions of documents are kept.
    """

    def __init__(self, log: EditHistoryStore) -> None:
        self._log = log

    def all(self, gait_id: str) -> Selection[ApprovalRecord]:
        """A gait's approvals, the newest first."""
        return self._log.approvals(gait_id, _record)

    def get(self, gait_id: str, number: int) -> ApprovalRecord:
        """One approval.

        Raises:
            NotFoundError: there is none of that number.
        """
        record = next((record for record in self.all(gait_id).rows if record.number == number), None)
        if record is None:
            raise NotFoundError(
                f"“{gait_id}” has no approval {number}; look at its list of approvals.", "number"
            )
        return record

    def document(self, gait_id: str, record: ApprovalRecord) -> Gait | None:
        """The document that was approved; None where it is not kept."""
        row = None if record.version is None else self._log.version(gait_id, record.version)
        return None if row is None else stored_gait(row.document, f"version {row.number}").gait


def _record(row: ApprovalRow) -> ApprovalRecord:
    content = row.content
    datetime.fromisoformat(content["when"])
    return ApprovalRecord(
        row.number, approval_of(content), content.get("version"), content.get("figures") or {}
    )


def approval_difference(
    documents: tuple[Gait | None, Gait | None], before: Json, after: Json
) -> tuple[DifferenceGroup, ...]:
    """What changed from one approval to another, or to the gait as it is: document, way, margins, parameters.

    Args:
        documents: both documents; None where one is not kept.
        before: figures and hashes that the sentences start from.
        after: figures and hashes that they lead to; empty figures where nothing was checked.
    """
    old, new = documents
    groups = [] if old is None or new is None else list(gait_difference(old, new))
    if old is None or new is None:
        unkept = "The document of an approval of the first release is not kept."
        groups.append(DifferenceGroup("Gait", (unkept,)))
    sides = {
        "What is sent": _sent(before, after),
        "Margin to limits": _margins(before["figures"], after["figures"]),
    }
    return (*groups, *(DifferenceGroup(title, said) for title, said in sides.items() if said))


def _sent(before: Json, after: Json) -> tuple[str, ...]:
    said = []
    if after["waypoints_hash"] is not None and before["waypoints_hash"] != after["waypoints_hash"]:
        said.append("Other waypoints")
    if before["robot_hash"] and after["robot_hash"] and before["robot_hash"] != after["robot_hash"]:
        said.append("Other parameters of the robot")
    words = {"waypoints": ("Waypoints", ""), "seconds": ("Robot time", " s"), "stop_seconds": ("Stop", " s")}
    for key, (name, unit) in words.items():
        old, new = before["figures"].get(key), after["figures"].get(key)
        if old is not None and new is not None and old != new:
            said.append(f"{name} {old} → {new}{unit}")
    old, new = before["figures"].get("simulated"), after["figures"].get("simulated")
    if old is not None and new is not None and old != new:
        said.append("Simulated" if new else "No longer simulated")
    return tuple(said)


def _margins(before: Json, after: Json) -> tuple[str, ...]:
    old, new = before.get("margins", {}), after.get("margins", {})
    said = []
    for rule in (rule for rule in new if rule in old):
        texts = [_readable(*side[rule]) for side in (old, new)]
        if texts[0] != texts[1]:
            words = rule.replace("_", " ")
            said.append(f"{words[0].upper()}{words[1:]} {texts[0]} → {texts[1]}")
    return tuple(said)


def _readable(value: float, unit: str) -> str:
    factor, shown = _UNITS.get(unit, (1.0, unit))
    return f"{value * factor:.2f} {shown}".strip()
