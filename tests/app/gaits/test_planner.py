"""Plans are made beside the session: whatever is asked, its thread never waits for the solver."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.gaits.approvals import ApprovalRequest
from app.gaits.live_plans import LivePlans
from app.gaits.planner import Planner
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.session.command_queue import CommandQueue
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.errors import InputError
from core.problem.motion_problem import MotionProblem
from solver_jobs import MotionResult, SolveStatus, solve_live
from tests.support.live_tiers import FixedTier
from tests.support.studio_process import wait_for

WALK = "walk"
DEADLINE = 30


class WatchedTier(FixedTier):
    """The live tier itself, which notes the threads that wait for it, and can be held up."""

    def __init__(self) -> None:
        super().__init__(SolveStatus.SOLVED)
        self.threads: list[str] = []
        self.go_on = threading.Event()
        self.go_on.set()

    def solve(self, problem: MotionProblem, timeout: float) -> MotionResult:
        self.threads.append(threading.current_thread().name)
        assert self.go_on.wait(DEADLINE)
        return solve_live(problem)


class Bench:
    """A session with a service, as the studio has them."""

    def __init__(self, folder: Path, database: Database) -> None:
        self.tier = WatchedTier()
        self.commands = CommandQueue()
        self.service = GaitService(GaitFiles(folder), database, LivePlans(self.tier).solve_for)
        self.plans = Planner(self.commands, self.service.open_gaits)

    def planned(self, action: Any, gait_id: str = WALK) -> Any:
        return self.plans.after(gait_id, action).result(DEADLINE)

    def close(self) -> None:
        self.plans.close()
        self.commands.close()


@pytest.fixture
def bench(tmp_path: Path, database: Database) -> Iterator[Bench]:
    opened = Bench(tmp_path, database)
    yield opened
    opened.tier.go_on.set()
    opened.close()


def shorter(bench: Bench) -> Any:
    gait = bench.service.document(WALK)
    return bench.service.edit(WALK, replace(gait, step=(0.005, 0.005, 0.0)), "Step", None)


def test_opening_checking_approving_and_opening_again_never_solve_on_the_session(
    bench: Bench, tmp_path: Path, database: Database
) -> None:
    assert bench.planned(lambda: bench.service.plan(WALK)).live.status is SolveStatus.SOLVED
    bench.commands.submit(lambda: shorter(bench)).result(DEADLINE)
    bench.planned(lambda: bench.service.check(WALK))
    approval = bench.planned(
        lambda: bench.service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    ).approval
    again = Bench(tmp_path, database)
    opened = again.commands.submit(lambda: again.service.open_gait(WALK)).result(DEADLINE)
    assert (opened.approval, again.tier.threads) == (None, [])
    assert again.planned(lambda: again.service.open_gait(WALK)).approval == approval
    again.close()
    for threads in (bench.tier.threads, again.tier.threads):
        assert threads
        assert all(name.startswith("plans") for name in threads)


def test_the_session_does_other_things_while_a_plan_is_made(bench: Bench) -> None:
    bench.tier.go_on.clear()
    shown = bench.plans.after(WALK, lambda: bench.service.plan(WALK))
    wait_for(lambda: bool(bench.tier.threads), "the plan is being made")
    assert bench.commands.submit(lambda: 7).result(DEADLINE) == 7
    assert not shown.done()
    bench.tier.go_on.set()
    assert shown.result(DEADLINE).source is PlanSource.LIVE


def test_a_plan_of_a_document_that_changed_meanwhile_is_not_taken_for_the_new_one(bench: Bench) -> None:
    bench.tier.go_on.clear()
    shown = bench.plans.after(WALK, lambda: bench.service.plan(WALK))
    wait_for(lambda: bool(bench.tier.threads), "the plan is being made")
    bench.commands.submit(lambda: shorter(bench)).result(DEADLINE)
    bench.tier.go_on.set()
    motion = shown.result(DEADLINE).trajectory
    assert motion is not None
    assert motion.body_world[-1, :2] == pytest.approx([0.005, 0.005])
    assert len(bench.tier.threads) == 2


def test_a_kept_approval_is_not_lost_by_saving_before_its_plan_is_made(
    bench: Bench, tmp_path: Path, database: Database
) -> None:
    bench.planned(lambda: bench.service.check(WALK))
    approval = bench.planned(
        lambda: bench.service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    ).approval
    again = Bench(tmp_path, database)
    again.service.save(WALK)
    assert again.planned(lambda: again.service.open_gait(WALK)).approval == approval
    again.close()


def test_what_an_unknown_gait_or_an_action_raises_goes_to_who_waits(bench: Bench) -> None:
    with pytest.raises(InputError, match="There is no gait"):
        bench.planned(lambda: None, "no-such-gait")
    failed: Future[Any] = bench.plans.after(WALK, lambda: 1 / 0)
    assert isinstance(failed.exception(DEADLINE), ZeroDivisionError)


def test_approval_record_version_and_state_are_one_transaction(
    bench: Bench, database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.planned(lambda: bench.service.check(WALK))
    written = []
    begin = database.writing

    def counted() -> Any:
        written.append(1)
        return begin()

    monkeypatch.setattr(database, "writing", counted)
    bench.planned(lambda: bench.service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True)))
    assert len(written) == 1
    assert [row[0] for row in database.rows("SELECT gait FROM approval")] == [WALK]
    assert bench.service.versions.all(WALK).rows[0].kind == "approved"
