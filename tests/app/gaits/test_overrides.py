"""Approvals in spite of errors: kept over a restart, and taken away by an error that did not stand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.gaits.approvals import ApprovalRequest
from app.gaits.open_gait import OpenGait
from app.gaits.service import GaitService
from app.gaits.verdict_views import approval_view, override_view, override_words, verdict_view
from app.plans.plan import Plan, verdict_of
from app.simulation.problem import simulation_problem
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.checks.simulation import Simulated
from core.errors import StateError
from core.findings import Finding, Severity, Verdict
from core.overrides import OverrideRequest
from core.physics.metrics import report
from core.physics.parameters import physics_set
from tests.support.simulated_walk import followed, no_solver

GAIT = "walk-manual-2"
RULES = ("balance", "path_balance")
REASON = "It walked on\nthe real robot."
ADA = ApprovalRequest("Ada", accept_warnings=True, override=OverrideRequest(RULES, REASON))
Opened = Callable[[], GaitService]


@pytest.fixture
def simulations() -> list[Simulated]:
    """Those that the service knows; the last one counts."""
    return []


@pytest.fixture
def opened(tmp_path: Path, database: Database, simulations: list[Simulated]) -> Opened:
    """Opens the data folder as a program does that was just started."""

    def open_service() -> GaitService:
        files = GaitFiles(tmp_path)
        return GaitService(files, database, lambda gait: no_solver, simulated_for=last)

    def last(plan: Plan) -> Simulated | None:
        return simulations[-1] if simulations else None

    return open_service


@pytest.fixture
def approved(opened: Opened) -> Opened:
    """The same, where Ada has approved the gait before, in spite of its errors."""
    service = opened()
    service.check(GAIT)
    service.approve(GAIT, ADA)
    return opened


def seen(service: GaitService) -> OpenGait:
    service.plan(GAIT)
    return service.open_gait(GAIT)


def simulate(service: GaitService, simulations: list[Simulated], **other: Any) -> str:
    plan: Plan = service.plan(GAIT)
    problem = simulation_problem(plan, physics_set())
    figures = replace(report(problem, followed(problem)), **other)
    simulations.append(Simulated(figures, problem, f"simulation {len(simulations)}"))
    return problem.waypoints.content_hash


def judge(monkeypatch: pytest.MonkeyPatch, change: Callable[[Verdict], Verdict]) -> None:
    """Lets the check say something else from now on."""
    monkeypatch.setattr("app.gaits.service.verdict_of", lambda *given: change(verdict_of(*given)))


def with_finding(severity: Severity) -> Callable[[Verdict], Verdict]:
    added = Finding("contact", severity, "Foot 1 is in the air.", 0.004, 0.001, 7, 0)
    return lambda verdict: replace(verdict, findings=(*verdict.findings, added))


def test_errors_block_without_an_override_and_say_so_in_the_view(opened: Opened) -> None:
    service = opened()
    verdict = service.check(GAIT).verdict
    assert verdict is not None
    with pytest.raises(StateError, match=r"Errors block approval \(2\)"):
        service.approve(GAIT, ApprovalRequest("Ada", accept_warnings=True))
    shown = verdict_view(verdict)["findings"]
    assert {one["rule"] for one in shown if one["overridable"]} == set(RULES)
    assert not any(one["overridable"] for one in shown if one["severity"] == "warning")


def test_rules_and_reason_stand_in_approval_record_and_view(approved: Opened) -> None:
    service = approved()
    approval = seen(service).approval
    assert approval is not None
    assert approval_view(approval)["override"]["rules"] == RULES
    view = override_view(approval)
    assert view == {"rules": list(RULES), "reason": REASON, "by": "Ada"}
    assert override_words(view) == "balance, path_balance, by Ada: It walked on the real robot."
    [record] = service.approvals.all(GAIT).rows
    assert record.approval == approval


def test_it_survives_restarts_and_a_check(approved: Opened) -> None:
    first = seen(approved()).approval
    for _ in range(2):
        service = approved()
        assert seen(service).approval == first
        assert service.confirmed(GAIT).approval == first
        assert service.check(GAIT).approval == first


def test_an_edit_takes_it_away(approved: Opened) -> None:
    service = approved()
    seen(service)
    service.edit(GAIT, service.document(GAIT).with_options(stop_bound=0.9), "Stop bound", None)
    gone = service.open_gait(GAIT)
    assert gone.approval is None
    assert gone.revoked == "The gait changed (“Stop bound”), so it is no longer approved."
    with pytest.raises(StateError, match="Check this gait first"):
        service.approve(GAIT, ADA)


@pytest.mark.parametrize("is_restarted", [False, True])
def test_a_new_error_takes_it_away_with_a_sentence(
    approved: Opened, monkeypatch: pytest.MonkeyPatch, is_restarted: bool
) -> None:
    service = approved()
    seen(service)
    judge(monkeypatch, with_finding(Severity.ERROR))
    service = approved() if is_restarted else service
    seen(service)
    gone = service.confirmed(GAIT)
    assert gone.approval is None
    assert gone.revoked is not None
    assert gone.revoked.startswith(
        "The check has a new error, of the rule “contact”, so the approval by Ada of "
    )


@pytest.mark.parametrize(
    "change",
    [
        with_finding(Severity.WARNING),
        lambda verdict: replace(verdict, findings=verdict.warnings),
        lambda verdict: replace(verdict, findings=verdict.errors[:1]),
    ],
    ids=["a warning", "no error is left", "one error is left"],
)
def test_a_warning_and_a_vanished_error_do_not(
    approved: Opened, monkeypatch: pytest.MonkeyPatch, change: Callable[[Verdict], Verdict]
) -> None:
    judge(monkeypatch, change)
    for _ in range(2):
        service = approved()
        assert seen(service).approval is not None
        assert service.confirmed(GAIT).approval is not None


def test_a_simulation_that_falls_takes_it_away(approved: Opened, simulations: list[Simulated]) -> None:
    service = approved()
    seen(service)
    [gone] = service.on_simulated(simulate(service, simulations, fell=True, fell_time=6.0, max_tilt=0.6))
    assert (gone.approval, gone.verdict) == (None, None)
    assert gone.revoked is not None
    assert gone.revoked.startswith("The check has a new error, of the rule “simulated_fall”")


def test_a_simulation_that_does_not_fall_leaves_it_and_gives_the_new_verdict(
    approved: Opened, simulations: list[Simulated]
) -> None:
    service = approved()
    seen(service)
    lean = float(np.radians(6.0))
    [stays] = service.on_simulated(simulate(service, simulations, max_tilt=lean, max_tilt_time=6.0))
    assert stays.approval is not None
    assert stays.verdict is not None
    assert stays.verdict.passed
    assert stays.verdict.simulation == "simulation 0"
    assert service.check(GAIT).approval is not None
    with pytest.raises(StateError, match="No error of the rule “balance” stands"):
        service.approve(GAIT, ADA)
