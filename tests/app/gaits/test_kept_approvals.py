"""Approvals that outlive the program: they hold by content, and where they lapse the gait says why."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.gaits import plan_cache
from app.gaits.approvals import ApprovalRequest
from app.gaits.open_gait import OpenGait
from app.gaits.service import GaitService
from app.plans.plan import Plan, verdict_of
from app.plans.sequence_plan import plan_of
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.findings import VERDICT_FORM, Finding, RuleMargin, Severity, Verdict
from core.robot.model import RobotModel
from tests.support.simulated_walk import no_solver

GAIT = "walk-manual-0"
ADA = ApprovalRequest("Ada", accept_warnings=True)
A_RULE = RuleMargin("new_rule", 0.1, "m")
Changed = Callable[[Verdict], Verdict]


@pytest.fixture
def opened(tmp_path: Path, database: Database) -> Callable[[], GaitService]:
    """Opens the data folder as a program does that was just started."""

    def open_service() -> GaitService:
        return GaitService(GaitFiles(tmp_path), database, lambda gait: no_solver)

    return open_service


@pytest.fixture
def approved(opened: Callable[[], GaitService]) -> Callable[[], GaitService]:
    """The same, where Ada has approved the gait before."""
    service = opened()
    service.check(GAIT)
    service.approve(GAIT, ADA)
    return opened


def seen(service: GaitService) -> OpenGait:
    """The gait as somebody sees who looks at it."""
    service.plan(GAIT)
    return service.open_gait(GAIT)


def judge(monkeypatch: pytest.MonkeyPatch, change: Changed) -> None:
    """Lets the check say something else from now on."""
    monkeypatch.setattr("app.gaits.service.verdict_of", lambda *given: change(verdict_of(*given)))


def send(monkeypatch: pytest.MonkeyPatch, distance: float) -> None:
    """Lets the program make strokes from now on that are longer, m; the times differ by 1e-12 s."""

    def planned(*given: Any) -> Plan:
        return with_longer_strokes(plan_of(*given), distance)

    monkeypatch.setattr(plan_cache, "plan_of", planned)


def with_longer_strokes(plan: Plan, distance: float) -> Plan:
    assert plan.way is not None
    assert plan.trajectory is not None
    strokes = np.array(plan.way.waypoints.strokes)
    strokes[3, 0, 0] += distance
    way = replace(plan.way, waypoints=replace(plan.way.waypoints, strokes=strokes))
    times = plan.trajectory.times + 1e-12 * np.arange(plan.trajectory.knot_count)
    return replace(plan, way=way, trajectory=replace(plan.trajectory, times=times))


def with_warnings(change: Callable[[Finding], Finding]) -> Changed:
    return lambda verdict: replace(verdict, findings=tuple(change(one) for one in verdict.findings))


def keep_as_of_first_form(database: Database, change: Callable[[tuple[str, ...]], list[str]] = list) -> None:
    """Makes the kept approval one that an earlier program kept: no form, a hash of digits and sentences."""
    [(text,)] = database.rows("SELECT approval FROM open_gait WHERE gait=?", GAIT)
    content = json.loads(text)
    del content["form"]
    content |= {"verdict_hash": "0" * 64, "warnings": change(tuple(content["warnings"]))}
    with database.writing() as connection:
        for table, column in (("open_gait", "approval"), ("approval", "content")):
            connection.execute(f"UPDATE {table} SET {column}=? WHERE gait=?", (json.dumps(content), GAIT))


def test_an_approval_survives_last_digits_and_other_words(
    approved: Callable[[], GaitService], monkeypatch: pytest.MonkeyPatch
) -> None:
    def reworded(verdict: Verdict) -> Verdict:
        margins = tuple(replace(one, margin=(one.margin or 0.0) + 1e-12) for one in verdict.margins)
        findings = tuple(replace(one, sentence="Said otherwise.", remedy="") for one in verdict.findings)
        return replace(verdict, margins=margins, findings=findings, notes=())

    judge(monkeypatch, reworded)
    send(monkeypatch, 1e-12)
    for _ in range(2):
        service = approved()
        assert seen(service).approval is not None
        assert service.confirmed(GAIT).approval is not None


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda patch: send(patch, 1e-7), "The gait's waypoints are not the approved ones"),
        (
            lambda patch: patch.setattr(RobotModel, "parameters_hash", property(lambda model: "0" * 64)),
            "The robot's parameters are not those that were approved",
        ),
        (
            lambda patch: judge(patch, lambda one: replace(one, findings=(*one.findings, another(one)))),
            "The check has other findings or rules",
        ),
        (
            lambda patch: judge(patch, with_warnings(lambda one: replace(one, severity=Severity.ERROR))),
            "The check has other findings or rules",
        ),
        (
            lambda patch: judge(patch, lambda one: replace(one, margins=(*one.margins, A_RULE))),
            "The check has other findings or rules",
        ),
    ],
    ids=["0.0001 mm", "robot", "new finding", "severity", "new rule"],
)
def test_an_approval_lapses_with_what_it_is_bound_to_and_the_gait_says_whose_and_why(
    approved: Callable[[], GaitService],
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[pytest.MonkeyPatch], None],
    why: str,
) -> None:
    with monkeypatch.context() as after_an_update:
        change(after_an_update)
        gone = seen(approved())
    assert (gone.approval, gone.verdict) == (None, None)
    assert gone.revoked is not None
    assert gone.revoked.startswith(why)
    assert re.search(r", so the approval by Ada of \d{4}-\d\d-\d\d is no longer valid\.$", gone.revoked)
    later = seen(approved())
    assert (later.approval, later.revoked) == (None, gone.revoked)


def another(verdict: Verdict) -> Finding:
    return replace(verdict.warnings[0], foot=3, rule="new_rule")


FIGURE = re.compile(r"\d+\.\d+")


def off_by(amount: float) -> Callable[[re.Match[str]], str]:
    return lambda found: f"{float(found[0]) + amount:.1f}"


def test_an_approval_of_the_first_form_holds_and_is_kept_in_todays(
    approved: Callable[[], GaitService], database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep_as_of_first_form(database, lambda warnings: [FIGURE.sub(off_by(0.1), one) for one in warnings])
    holds = seen(approved())
    assert holds.verdict is not None
    assert holds.approval is not None
    assert (holds.approval.form, holds.approval.by) == (VERDICT_FORM, "Ada")
    assert holds.approval.verdict_hash == holds.verdict.content_hash
    judge(monkeypatch, with_warnings(lambda one: replace(one, sentence="Said otherwise.")))
    again = approved()
    assert seen(again).approval == holds.approval
    assert again.approvals.all(GAIT).rows[0].approval.verdict_hash == "0" * 64


@pytest.mark.parametrize(
    "change",
    [
        lambda warnings: list(warnings[1:]),
        lambda warnings: [FIGURE.sub(off_by(5.0), one) for one in warnings],
        lambda warnings: [*warnings, warnings[0]],
        lambda warnings: [one.replace("oot ", "oot 9") for one in warnings],
        lambda warnings: ["Said otherwise.", *warnings[1:]],
    ],
    ids=["one was not seen", "other figures", "one is gone", "another foot", "other words"],
)
def test_an_approval_of_the_first_form_never_stands_over_a_warning_that_nobody_saw(
    approved: Callable[[], GaitService],
    database: Database,
    change: Callable[[tuple[str, ...]], list[str]],
) -> None:
    keep_as_of_first_form(database, change)
    gone = seen(approved())
    assert gone.approval is None
    assert gone.revoked is not None
    assert gone.revoked.startswith("The check has other findings or rules")


def test_an_approval_of_the_first_form_does_not_stand_over_an_error(
    approved: Callable[[], GaitService], database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep_as_of_first_form(database)
    error = Finding("balance", Severity.ERROR, "It tips.", None, 0.0)
    judge(monkeypatch, lambda verdict: replace(verdict, findings=(error, *verdict.findings)))
    assert seen(approved()).approval is None


@pytest.mark.parametrize(("distance", "stands"), [(1e-12, True), (1e-7, False)])
def test_a_plan_made_again_takes_the_approval_only_where_it_sends_something_else(
    approved: Callable[[], GaitService], distance: float, stands: bool
) -> None:
    service = approved()
    asked = plan_cache.PlanRequest(seen(service), 0)
    again = with_longer_strokes(service.plan(GAIT), distance)
    service.open_gaits.on_plan(asked, again)
    assert service.plan(GAIT) is again
    assert (service.open_gait(GAIT).approval is not None) is stands
