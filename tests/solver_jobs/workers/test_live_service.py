"""The live tier's process, and the remedies that it tries."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.gait.gait import Gait, heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot
from solver_jobs import Limit, LiveSolver, Remedy, RemedyKind, SolveStatus
from solver_jobs.live.solve import solve_live
from solver_jobs.remedies.limit import largest_value
from solver_jobs.remedies.search import find_remedies
from solver_jobs.workers import worker_process
from solver_jobs.workers.spawning import start_process
from tests.support.solvers.cases import gait_problem

MODEL = load_robot("deltawalker")
PROBLEM = gait_problem("walk", 0.010, Workspace.STROKE)


def gait_of(name: str, step: float, **options: Any) -> Gait:
    chosen = library()[name].gait
    wanted = replace(GaitOptions(), **options)
    return replace(chosen, step=heading_step(chosen.orientation, step), options=wanted)


@pytest.fixture(scope="module")
def solver() -> Iterator[LiveSolver]:
    live = LiveSolver(PROBLEM)
    live.start()
    yield live
    live.close()


def test_it_answers_as_the_function_does(solver: LiveSolver) -> None:
    result = solver.solve(PROBLEM, 30.0)
    assert result.status is SolveStatus.SOLVED
    wanted = solve_live(PROBLEM).trajectory
    assert (result.trajectory.body_world == wanted.body_world).all()
    assert check_motion(PROBLEM, result.trajectory).confirmed


def test_a_process_that_is_killed_is_replaced(solver: LiveSolver) -> None:
    solver.solve(PROBLEM, 30.0)
    first = solver.process_id
    assert first is not None
    os.kill(first, signal.SIGKILL)
    assert [solver.solve(PROBLEM, 30.0).status for _ in range(2)] == [SolveStatus.SOLVED] * 2
    assert solver.process_id not in (None, first)


def test_no_answer_in_time_is_failed_with_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[str] = []

    def start(body: Any, warm_up: None, name: str, niceness: int) -> Any:
        started.append(name)
        return start_process(body, warm_up, name, niceness)

    monkeypatch.setattr(worker_process, "start_process", start)
    live = LiveSolver()
    result = live.solve(PROBLEM, 0.001)
    live.close()
    assert result.status is SolveStatus.FAILED
    assert started == ["footfall-live"], "it is not asked twice, and waited for twice as long"
    assert "gave no answer" in result.explanation[0]


def test_a_closed_solver_says_so() -> None:
    live = LiveSolver()
    live.close()
    assert live.solve(PROBLEM).status is SolveStatus.FAILED
    search = live.remedies(gait_of("walk", 0.030))
    assert (search.remedies, search.complete) == ((), False)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("gait", "kinds"),
    [
        (gait_of("amble", 0.020, workspace=Workspace.CYLINDER), {RemedyKind.STEP, RemedyKind.WORKSPACE}),
        (gait_of("walk", 0.020, margin=0.018), {RemedyKind.MARGIN}),
        (gait_of("walk", 0.030), {RemedyKind.STEP, RemedyKind.ITERATIONS}),
        (gait_of("walk", 0.010, plane_height=0.045), {RemedyKind.HEIGHT}),
        (gait_of("walk", 0.010, clearance=0.014), {RemedyKind.CLEARANCE}),
    ],
)
def test_every_remedy_works(gait: Gait, kinds: set[RemedyKind], solver: LiveSolver) -> None:
    assert solve_live(motion_problem(gait, MODEL)).status is SolveStatus.INFEASIBLE
    told: list[Remedy] = []
    search = solver.remedies(gait, told.append, timeout=60.0)
    assert search.complete
    assert {remedy.label for remedy in told} == {remedy.label for remedy in search.found}
    remedies = search.remedies
    assert kinds <= {remedy.kind for remedy in remedies}
    for remedy in remedies:
        problem = motion_problem(remedy.gait, MODEL)
        result = solve_live(problem)
        assert result.status is SolveStatus.SOLVED, remedy.label
        assert check_motion(problem, result.trajectory).confirmed
        assert remedy.sentence


def test_plans_come_before_a_limit_and_do_not_end_it(solver: LiveSolver) -> None:
    wanted = largest_value(gait_of("walk", 0.010, margin=0.006), MODEL, Limit.STEP, lambda: True)
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(solver.limit, gait_of("walk", 0.010, margin=0.006), Limit.STEP, 60.0)
        plans = [solver.solve(PROBLEM, 30.0) for _ in range(4)]
        assert asked.result(60.0) == wanted
    assert {plan.status for plan in plans} == {SolveStatus.SOLVED}


def test_remedies_come_before_a_limit_that_was_asked_first(solver: LiveSolver) -> None:
    gait, stuck = gait_of("walk", 0.010, margin=0.006), gait_of("walk", 0.050, margin=0.006)
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(solver.limit, gait, Limit.STEP, 60.0)
        told: list[Remedy] = []
        solver.remedies(stuck, told.append, go_on=lambda: not told)
        assert told
        assert not asked.done()
        assert asked.result(60.0) == largest_value(gait, MODEL, Limit.STEP, lambda: True)


def test_plans_come_before_remedies_and_do_not_end_their_search(solver: LiveSolver) -> None:
    with ThreadPoolExecutor(1) as pool:
        search = pool.submit(solver.remedies, gait_of("walk", 0.030), timeout=60.0)
        plans = [solver.solve(PROBLEM, 30.0) for _ in range(4)]
        assert search.result(60.0).complete
    assert {plan.status for plan in plans} == {SolveStatus.SOLVED}


def test_a_search_that_is_ended_or_lasts_too_long_gives_what_it_has_and_keeps_the_process(
    solver: LiveSolver,
) -> None:
    solver.solve(PROBLEM, 30.0)
    process = solver.process_id
    found: list[Remedy] = []
    search = solver.remedies(gait_of("walk", 0.030), found.append, go_on=lambda: not found, timeout=60.0)
    assert not search.complete
    assert search.found
    assert solver.remedies(gait_of("walk", 0.030), timeout=0.0).complete is False
    assert solver.limit(gait_of("walk", 0.010), Limit.STEP, timeout=0.0) is None
    assert solver.solve(PROBLEM, 30.0).status is SolveStatus.SOLVED
    assert solver.process_id == process


def test_the_search_for_remedies_can_be_interrupted() -> None:
    asked = 0

    def go_on() -> bool:
        nonlocal asked
        asked += 1
        return asked < 2

    search = find_remedies(gait_of("walk", 0.030), MODEL, go_on)
    assert (search.remedies, search.complete) == ((), False)
    assert asked == 2


@pytest.mark.parametrize("knots", [1, 2])
def test_a_swing_that_is_too_short_is_placed_and_can_be_lengthened(knots: int) -> None:
    walk = gait_of("walk", 0.010)
    stance = np.array(walk.timeline.stance)
    stance[2, 5 + knots : 10] = True
    short = replace(walk, timeline=replace(walk.timeline, stance=stance))
    result = solve_live(motion_problem(short, MODEL))
    assert result.status is SolveStatus.INFEASIBLE
    search = find_remedies(short, MODEL, lambda: True)
    assert search.complete
    assert search.remedies[0].kind is RemedyKind.ONE_BY_ONE
    assert solve_live(motion_problem(search.remedies[0].gait, MODEL)).status is SolveStatus.SOLVED
    if knots == 1:
        assert (result.lacks[0].family, result.lacks[0].feet) == ("clearance", (2,))
        assert "at sample 6" in result.lacks[0].sentence
