"""The comparison of a drawn gait with one for the robot's clock: states, kept results, cancellation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import pytest

from app.common.json import Json
from app.documents.gait_json import gait_from_content, motion_hash
from app.gaits.faster import FasterGaits
from app.plans.make_plan import make_plan
from app.plans.plan import Plan
from app.plans.walk_figures import plan_figures, pose_figures
from core.errors import InputError, StateError
from core.gait.gait import Gait, with_iterations
from core.library.library import library
from core.pose_gaits.conversion import as_drawn_gait, as_pose_gait
from core.pose_gaits.gait_poses import found_gait, pose_problem
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.robot.model import load_robot
from core.wire.robot_time import estimate_seconds
from solver_jobs import PoseGaitSolver, PoseProgress, PoseResult, SolveStatus, solve_live

MODEL = load_robot("deltawalker")
FAST = library()["fast-c-gait"].gait
DRAWN = as_drawn_gait(FAST, MODEL)
"""Its poses are known, so that no test has to look for them."""


class Search:
    """A search that ends when a test says so."""

    def __init__(self, progress: Callable[[PoseProgress], object]) -> None:
        self.tell = progress
        self.is_cancelled = False
        self._done: list[Callable[[], None]] = []
        self._result: PoseResult | StateError | None = None

    def when_done(self, call: Callable[[], None]) -> None:
        self._done.append(call)

    def cancel(self) -> None:
        self.is_cancelled = True

    def result(self) -> PoseResult:
        assert self._result is not None
        if isinstance(self._result, StateError):
            raise self._result
        return self._result

    def end(self, result: PoseResult | StateError) -> None:
        self._result = result
        for call in self._done:
            call()


class Solver:
    """Keeps what was submitted."""

    def __init__(self) -> None:
        self.searches: list[Search] = []

    def submit(self, problem: Any, progress: Any, explain: bool = True) -> Search:
        self.searches.append(Search(progress))
        return self.searches[-1]


class Studio:
    """A service with what it was given and what it told."""

    def __init__(self) -> None:
        self.solver = Solver()
        self.kept: list[str] = []
        self.states: list[Json | None] = []
        self.faster = FasterGaits(
            cast("PoseGaitSolver", self.solver), lambda motion, content: self.kept.append(motion)
        )

    def search(self, gait: Gait = DRAWN) -> Callable[[], None]:
        return self.faster.search(gait, plan_of(gait), self.states.append)


def plan_of(gait: Gait) -> Plan:
    """A plan without waypoints: these tests are about the search."""
    drawn = make_plan(replace(gait, step=(0.15, 0.0, 0.0)), None, solve_live)
    assert drawn.is_draft
    return drawn


def known_poses() -> PoseGait:
    wanted = as_pose_gait(DRAWN, MODEL)
    assert FAST.poses is not None
    found = found_gait(FAST, MODEL)
    assert found is not None
    return replace(found, problem=replace(pose_problem(wanted, MODEL), parts=found.problem.parts))


def solved() -> PoseResult:
    gait = known_poses()
    return PoseResult(SolveStatus.SOLVED, gait, check_poses(gait), True, (), 0.1, 0.1)


def without(status: SolveStatus, sentence: str) -> PoseResult:
    return PoseResult(status, None, None, False, (sentence,), 0.1, 0.1)


@pytest.fixture
def studio() -> Studio:
    return Studio()


def test_what_was_found_is_kept_shown_and_remembered(studio: Studio) -> None:
    studio.search()
    walk, cycle = studio.solver.searches
    walk.tell(PoseProgress("Start 2 of 3", 0.5))
    assert studio.states[-1] is not None
    assert studio.states[-1]["stage"] == "from rest to rest, start 2 of 3"
    walk.end(solved())
    assert not cycle.is_cancelled
    cycle.end(without(SolveStatus.INFEASIBLE, "No."))
    *_, last, nothing = studio.states
    assert nothing is None
    assert last is not None
    assert (last["state"], last["now"]) == ("solved", None)
    assert last["faster"]["cycle_speed"] is None  # the walk counts without one
    assert last["faster"]["distance"] == pytest.approx(3 * 0.0336, abs=1e-3)
    document = gait_from_content(last["document"], "document")
    assert studio.kept == [motion_hash(document)]
    assert found_gait(document, MODEL) is not None

    studio.states.clear()
    studio.search()
    assert len(studio.solver.searches) == 2
    assert studio.states == [last, None]


def test_where_there_is_no_walk_nothing_else_is_searched_and_it_says_why(studio: Studio) -> None:
    studio.search()
    walk, cycle = studio.solver.searches
    walk.end(without(SolveStatus.INFEASIBLE, "The margin (--margin) would have to be 2 mm."))
    assert cycle.is_cancelled
    cycle.end(without(SolveStatus.CANCELLED, "The search was cancelled."))
    last = studio.states[-2]
    assert last is not None
    assert (last["state"], last["document"]) == ("infeasible", None)
    assert last["sentence"] == "The margin would have to be 2 mm."


def test_a_cancelled_search_is_begun_anew(studio: Studio) -> None:
    end = studio.search()
    end()
    assert all(search.is_cancelled for search in studio.solver.searches)
    for search in studio.solver.searches:
        search.end(without(SolveStatus.CANCELLED, "The search was cancelled."))
    *_, last, nothing = studio.states
    assert nothing is None
    assert last is not None
    assert (last["state"], last["document"]) == ("failed", None)
    assert last["sentence"] == "The search was cancelled."
    assert studio.kept == []
    studio.search()
    assert len(studio.solver.searches) == 4


def test_a_search_that_breaks_off_says_so(studio: Studio) -> None:
    studio.search()
    walk, cycle = studio.solver.searches
    walk.end(StateError("The pose gait solver's process ended twice.", "search"))
    assert cycle.is_cancelled
    cycle.end(without(SolveStatus.CANCELLED, "The search was cancelled."))
    last = studio.states[-2]
    assert last is not None
    assert (last["state"], last["sentence"]) == ("failed", "The pose gait solver's process ended twice.")
    assert studio.states[-1] is None


@pytest.mark.parametrize("broken", ["search", "keeping"])
def test_an_error_of_the_studios_own_ends_the_states_too(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, broken: str
) -> None:
    def fail(*given: object) -> None:
        raise ZeroDivisionError

    studio.search()
    walk, cycle = studio.solver.searches
    if broken == "keeping":
        monkeypatch.setattr(studio.faster, "_keep", fail)
    else:
        monkeypatch.setattr(cycle, "result", fail)
    walk.end(solved())
    cycle.end(without(SolveStatus.INFEASIBLE, "No."))
    *_, last, nothing = studio.states
    assert nothing is None
    assert last is not None
    assert (last["state"], last["document"]) == ("failed", None)
    assert "an error of its own" in last["sentence"]
    assert [record.exc_info is not None for record in caplog.records] == [True]


def test_a_gait_that_cannot_be_one_is_refused(studio: Studio) -> None:
    with pytest.raises(InputError, match="A sequence has several gaits"):
        studio.faster.search(library()["walk-turn-s-gait"].gait, plan_of(DRAWN), studio.states.append)
    assert studio.states == []


def test_figures_of_a_plan_are_of_what_is_sent() -> None:
    gait = with_iterations(library()["c-gait"].gait, 3)
    plan = make_plan(gait, None, solve_live)
    figures, alone = plan_figures(gait, plan), make_plan(library()["c-gait"].gait, None, solve_live)
    once = plan_figures(library()["c-gait"].gait, alone)
    assert plan.way is not None
    assert figures is not None
    assert once is not None
    assert figures.seconds == estimate_seconds(plan.way.waypoints)
    assert figures.moves == plan.way.waypoints.count - 1
    assert figures.distance == pytest.approx(0.030)
    assert figures.speed == pytest.approx(0.030 / figures.seconds)
    assert figures.cycle_seconds is not None
    assert 0.25 < figures.cycle_seconds / figures.seconds < 0.4  # the middle one of three
    assert figures.cycle_speed == pytest.approx(0.010 / figures.cycle_seconds)
    assert once.cycle_moves == once.moves  # no iteration of one is in mid-walk
    draft = make_plan(replace(gait, step=(0.15, 0.0, 0.0)), None, solve_live)
    assert plan_figures(gait, draft) is None


def test_figures_of_poses_are_those_of_their_plan() -> None:
    found = found_gait(FAST, MODEL)
    assert found is not None
    figures = pose_figures(found, check_poses(found), None)
    plan = make_plan(FAST, None, solve_live)
    assert plan.way is not None
    assert figures.seconds == pytest.approx(estimate_seconds(plan.way.waypoints))
    assert figures.moves == 26
    assert figures.cycle_seconds is None
