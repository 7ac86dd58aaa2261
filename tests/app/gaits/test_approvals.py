"""Approvals in the service: of the current verdict, revoked with a reason, recorded, compared."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from app.gaits.approvals import ApprovalRequest, approval_difference
from app.gaits.service import GaitService
from app.plans.plan import Plan
from app.simulation.problem import simulation_problem
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import EditHistoryStore
from core.checks.simulation import NOT_SIMULATED, Simulated
from core.errors import InputError, NotFoundError, StateError, StorageFullError
from core.physics.metrics import report
from core.physics.parameters import physics_set
from core.robot.model import RobotModel
from tests.support.simulated_walk import followed, no_solver

GAIT = "walk-manual-0"
ADA = ApprovalRequest("Ada", accept_warnings=True)
Opened = Callable[[], GaitService]


@pytest.fixture
def simulations() -> list[Simulated]:
    """Those that the service knows; the last one counts."""
    return []


@pytest.fixture
def opened(tmp_path: Path, database: Database, simulations: list[Simulated]) -> Opened:
    def simulated(plan: Plan) -> Simulated | None:
        return simulations[-1] if simulations else None

    def open_service() -> GaitService:
        files = GaitFiles(tmp_path)
        return GaitService(files, database, lambda gait: no_solver, simulated_for=simulated)

    return open_service


def approved(service: GaitService, word: ApprovalRequest = ADA) -> None:
    service.check(GAIT)
    assert service.approve(GAIT, word).approval is not None


def simulate(service: GaitService, simulations: list[Simulated]) -> str:
    plan = service.plan(GAIT)
    problem = simulation_problem(plan, physics_set())
    simulations.append(Simulated(report(problem, followed(problem)), problem))
    return problem.waypoints.content_hash


def test_warnings_that_were_not_accepted_block_and_accepted_ones_are_recorded(opened: Opened) -> None:
    service = opened()
    verdict = service.check(GAIT).verdict
    assert verdict is not None
    with pytest.raises(StateError, match="warnings are not accepted yet, the first: "):
        service.approve(GAIT, ApprovalRequest("Ada"))
    approved(service)
    [record] = service.approvals.all(GAIT).rows
    assert record.approval.warnings == tuple(finding.sentence for finding in verdict.warnings)
    assert record.version == service.versions.newest_number(GAIT)
    assert record.figures["simulated"] is False


def test_a_newer_simulation_takes_verdict_and_approval_away_and_is_part_of_the_next(
    opened: Opened, simulations: list[Simulated]
) -> None:
    service = opened()
    approved(service)
    [gone] = service.on_simulated(simulate(service, simulations))
    assert (gone.verdict, gone.approval) == (None, None)
    assert gone.revoked == "It was simulated since, so it is no longer approved."
    verdict = service.check(GAIT).verdict
    assert verdict is not None
    assert NOT_SIMULATED not in verdict.notes
    assert "simulated_slip" in {margin.rule for margin in verdict.margins}


def test_the_same_simulation_again_leaves_the_approval_alone(
    opened: Opened, simulations: list[Simulated]
) -> None:
    service = opened()
    waypoints = simulate(service, simulations)
    approved(service)
    assert service.on_simulated(waypoints) == ()
    simulate(service, simulations)
    assert service.on_simulated(waypoints) == (), "such as one for another gait with the same waypoints"
    assert service.open_gait(GAIT).approval is not None


def test_a_verdict_that_a_simulation_overtook_cannot_be_approved_nor_sent(
    opened: Opened, simulations: list[Simulated]
) -> None:
    service = opened()
    approved(service)
    simulate(service, simulations)
    with pytest.raises(StateError, match="The verdict is out of date"):
        service.approve(GAIT, ADA)
    assert service.confirmed(GAIT).approval is None


def test_other_parameters_of_the_robot_take_the_approval_for_good(
    opened: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    approved(opened())
    with monkeypatch.context() as other:
        other.setattr(RobotModel, "parameters_hash", property(lambda model: "0" * 64))
        service = opened()
        service.plan(GAIT)
        said = service.open_gait(GAIT).revoked
        assert said is not None
        assert said.startswith(
            "The robot's parameters are not those that were approved, so the approval by Ada"
        )
    again = opened()
    again.plan(GAIT)
    assert again.open_gait(GAIT).approval is None


def test_a_full_disk_keeps_nobody_from_looking_at_a_gait_whose_approval_lapsed(
    opened: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise StorageFullError("The disk is full.", "studio.sqlite3")

    approved(opened())
    monkeypatch.setattr(RobotModel, "parameters_hash", property(lambda model: "0" * 64))
    monkeypatch.setattr(EditHistoryStore, "put", full)
    service = opened()
    service.plan(GAIT)
    gait = service.open_gait(GAIT)
    assert (gait.approval, gait.kept_approval) == (None, None)
    assert gait.revoked is not None


def test_approvals_are_compared_in_sentences(opened: Opened) -> None:
    service = opened()
    approved(service)
    service.edit(GAIT, service.document(GAIT).with_options(stop_bound=0.9), "Stop bound", None)
    assert service.open_gait(GAIT).revoked == "The gait changed (“Stop bound”), so it is no longer approved."
    approved(service, ApprovalRequest("Grace", accept_warnings=True))
    after, before = service.approvals.all(GAIT).rows
    documents = (service.approvals.document(GAIT, before), service.approvals.document(GAIT, after))
    sides = [
        {
            "waypoints_hash": one.approval.waypoints_hash,
            "robot_hash": one.approval.robot_hash,
            "figures": one.figures,
        }
        for one in (before, after)
    ]
    groups = {group.title: group.sentences for group in approval_difference(documents, sides[0], sides[1])}
    assert groups["Options"] == ("Stop bound 1.0 s → 0.9 s",)
    assert groups["What is sent"][0] == "Other waypoints"
    assert "simulated" not in " ".join(groups["What is sent"])
    unkept = approval_difference((None, documents[1]), sides[0], sides[1])
    assert "first release" in unkept[0].sentences[0]
    with pytest.raises(NotFoundError, match="has no approval 99"):
        service.approvals.get(GAIT, 99)
    assert issubclass(NotFoundError, InputError)


@pytest.mark.parametrize("is_reopened", [False, True])
def test_a_gait_that_was_deleted_and_brought_back_needs_a_new_approval(
    opened: Opened, is_reopened: bool
) -> None:
    service = opened()
    for gait_id in (service.create(service.document(GAIT)).id, GAIT):
        service.save(gait_id)
        service.check(gait_id)
        service.approve(gait_id, ADA)
        service.delete(gait_id)
        if is_reopened:
            service = opened()
        restored = service.restore(gait_id)
        assert (restored.approval, restored.kept_approval) == (None, None)
        assert restored.revoked is not None
        assert "deleted" in restored.revoked
        service.plan(gait_id)
        assert service.confirmed(gait_id).approval is None
        again = opened()
        again.plan(gait_id)
        assert again.open_gait(gait_id).approval is None
        assert len(service.approvals.all(gait_id).rows) == 1
        service.check(gait_id)
        assert service.approve(gait_id, ADA).approval is not None


def test_a_restore_of_what_was_not_deleted_takes_no_approval_away(opened: Opened) -> None:
    service = opened()
    approved(service)
    with pytest.raises(InputError, match="no deleted gait"):
        service.restore(GAIT)
    service.save(GAIT)
    service.delete(GAIT)
    service.save(GAIT)
    service.check(GAIT)
    service.approve(GAIT, ADA)
    assert service.restore(GAIT).id == f"{GAIT}-2"
    assert service.confirmed(GAIT).approval is not None
    again = opened()
    again.plan(GAIT)
    assert again.open_gait(GAIT).approval is not None
