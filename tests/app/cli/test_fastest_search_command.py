"""`footfall fastest --search` and `--front`: the gait that is taken, the tables, exit status and JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import pytest

from app.cli import commands_fastest
from core.library.library import library
from core.pose_gaits.gait_poses import found_gait
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import load_robot
from solver_jobs import PoseResult, SearchStep, SolveStatus, TriedGait, fastest_of
from tests.support.command import run, run_json

C_GAIT, WALK = (1, 2, 3, 4), (1, 3, 2, 4)
NO = "No motion with this order."


@cache
def library_gait(name: str) -> PoseGait:
    found = found_gait(library()[name].gait, load_robot("deltawalker"))
    assert found is not None
    return found


def words(line: str) -> str:
    """A line without its columns."""
    return " ".join(line.split())


@cache
def solved(gait: PoseGait) -> PoseResult:
    return PoseResult(SolveStatus.SOLVED, gait, check_poses(gait), True, (), 0.1, 0.1)


def without_motion(sentence: str = NO) -> PoseResult:
    return PoseResult(SolveStatus.INFEASIBLE, None, None, False, (sentence,), 0.1, 0.1)


def known_cycle(problem: PoseProblem) -> PoseGait | None:
    """Known gaits stand for what a search finds: the C-gait, slower with an early stop, the walk, a turn."""
    if problem.on_the_spot:
        return library_gait("fast-turn") if problem.order == C_GAIT else None
    bounds, is_diagonal = problem.bounds, problem.heading == math.pi / 4
    if problem.order == C_GAIT and not is_diagonal and bounds.margin <= 0.006:
        return library_gait("fast-c-gait" if bounds.stop_bound >= 1.5 else "fast-amble")
    if problem.order == WALK and is_diagonal and bounds == PoseBounds():
        return library_gait("fast-walk")
    return None


@dataclass
class Solvers:
    """Stands for both kinds of solver.

    Args:
        walking: orders that have a walk from the standard stance to rest.
        cycles: what is found of a problem in mid-walk.
        tried: problems of the searches.
        walked: orders that were tried from stance to rest.
    """

    walking: tuple[tuple[int, ...], ...] = (C_GAIT, WALK)
    cycles: Callable[[PoseProblem], PoseGait | None] = known_cycle
    tried: list[PoseProblem] = field(default_factory=list)
    walked: list[tuple[int, ...]] = field(default_factory=list)

    def solve(
        self,
        problems: Sequence[PoseProblem],
        report: Callable[[SearchStep], object],
        near: Sequence[PoseGait | None] = (),
        ending: object = None,
    ) -> list[TriedGait]:
        assert len(near) in (0, len(problems))
        answers: list[TriedGait] = []
        for number, problem in enumerate(problems):
            assert problem.cycles is None
            gait = self.cycles(problem)
            answers.append(TriedGait(problem, without_motion() if gait is None else solved(gait)))
            report(SearchStep(len(answers), len(problems), number, answers[-1], fastest_of(answers)))
        self.tried += problems
        return answers

    def submit(self, problem: PoseProblem, progress: object) -> Solvers:
        self.walked.append(problem.order)
        self.problem = problem
        return self

    def result(self, timeout: float) -> PoseResult:
        gait = self.cycles(self.problem)
        is_walk = gait is not None and self.problem.order in self.walking
        return solved(gait) if gait is not None and is_walk else without_motion("No walk to rest.")

    def close(self) -> None:
        pass


@pytest.fixture
def solvers(monkeypatch: pytest.MonkeyPatch) -> Solvers:
    made = Solvers()
    for name in ("FastestSearch", "PoseGaitSolver"):
        monkeypatch.setattr(commands_fastest, name, lambda niceness: made)
    return made


def test_the_fastest_choice_is_taken_and_all_are_listed(
    capsys: pytest.CaptureFixture[str], solvers: Solvers, tmp_path: Path
) -> None:
    way = tmp_path / "way.csv"
    status, answer = run_json(capsys, "fastest", "--search", "--cycles", "3", "-o", str(way))
    assert (status, answer["status"], answer["gait"], answer["order"]) == (0, "solved", "c-gait", [*C_GAIT])
    assert (answer["waypoints"], way.exists()) == (str(way), True)
    search = answer["search"]
    assert (search["orders"], search["complete"], len(search["tried"])) == (6, True, 7)
    assert (search["front"], search["front_tried"]) == ([], 0)
    assert sum(one["status"] == "solved" for one in search["tried"]) == 2
    assert solvers.walked == [C_GAIT]
    status, out, _ = run(capsys, "fastest", "--search", "--cycles", "3")
    lines = out.splitlines()
    assert status == 0
    assert lines[0] == "Tried every foot order, 7 gaits that differ, in mid-walk:"
    assert words(lines[1]) == "1-2-3-4 (c-gait), heading 0° 2.28 mm/s 33.6 mm in 26 moves"
    assert words(lines[2]) == "1-3-2-4 (walk), heading 45° 2.11 mm/s 37.0 mm in 31 moves"
    assert all(line.endswith(NO) for line in lines[3:8])
    assert lines[8].startswith("c-gait, feet 1-2-3-4: 2.28 mm/s in mid-walk")
    assert "No gait of" not in out


def test_where_the_fastest_has_no_walk_to_rest_the_next_one_is_taken_and_it_says_so(
    capsys: pytest.CaptureFixture[str], solvers: Solvers
) -> None:
    solvers.walking = (WALK,)
    status, out, error = run(capsys, "fastest", "--search", "--cycles", "3")
    assert status == 0
    assert solvers.walked == [C_GAIT, WALK]
    assert "c-gait has no walk from the standard stance to rest: No walk to rest." in error
    assert "walk, feet 3-2-4-1: 2.11 mm/s in mid-walk" in out


def test_where_none_walks_to_rest_the_fastest_says_why(
    capsys: pytest.CaptureFixture[str], solvers: Solvers, tmp_path: Path
) -> None:
    solvers.walking = ()
    way = tmp_path / "way.csv"
    status, answer = run_json(capsys, "fastest", "--search", "-o", str(way))
    assert (status, answer["status"], answer["gait"]) == (3, "infeasible", "c-gait")
    assert answer["explanation"] == ["No walk to rest."]
    assert (answer["waypoints"], way.exists()) == (None, False)
    assert len(answer["search"]["tried"]) == 7


def test_where_no_choice_has_a_motion_the_gait_that_was_named_says_why(
    capsys: pytest.CaptureFixture[str], solvers: Solvers
) -> None:
    solvers.cycles = lambda problem: None
    status, answer = run_json(capsys, "fastest", "amble", "--search")
    assert (status, answer["status"], answer["gait"]) == (3, "infeasible", "amble")
    assert {one["status"] for one in answer["search"]["tried"]} == {"infeasible"}
    assert len(solvers.walked) == 1


def test_with_an_order_only_that_one_is_tried(capsys: pytest.CaptureFixture[str], solvers: Solvers) -> None:
    status, out, _ = run(capsys, "fastest", "--search", "--order", "3,2,4,1", "--cycles", "3")
    assert status == 0
    assert out.startswith("Tried the foot order, ")
    assert "walk, feet 3-2-4-1: 2.11 mm/s in mid-walk" in out
    assert {problem.order for problem in solvers.tried} == {WALK}


def test_a_search_for_a_turn_says_how_fast_it_turns(
    capsys: pytest.CaptureFixture[str], solvers: Solvers
) -> None:
    status, out, _ = run(capsys, "fastest", "rotate", "--search", "--step", "0", "--turn", "left")
    first = out.splitlines()[1]
    rate = math.degrees(abs(library_gait("fast-turn").turn_rate))
    assert status == 0
    assert first.startswith("  1-2-3-4 (c-gait) ")
    assert f" {rate:.2f}°/s " in first
    assert "heading" not in first


def test_a_front_lists_the_gaits_that_no_other_one_beats(
    capsys: pytest.CaptureFixture[str], solvers: Solvers
) -> None:
    status, out, _ = run(capsys, "fastest", "--front", "--cycles", "3")
    assert status == 0
    assert len(solvers.tried) == 7 + 2 * 15  # both that have a gait, at the other margins and stop bounds
    front = out[out.index("No gait of 37 is faster with as much margin and as early a stop:") :].splitlines()
    assert [words(line) for line in front[1:3]] == [
        "margin 6 mm, stop bound 1.5 s 2.28 mm/s 1-2-3-4 (c-gait), heading 0°",
        "margin 6 mm, stop bound 1 s 1.80 mm/s 1-2-3-4 (c-gait), heading 0°",
    ]
    assert front[3].startswith("c-gait, feet 1-2-3-4")
    status, answer = run_json(capsys, "fastest", "--front", "--cycles", "3")
    assert (status, answer["search"]["front_tried"]) == (0, 37)
    assert [(one["margin"], one["stop_bound"]) for one in answer["search"]["front"]] == [
        (0.006, 1.5),
        (0.006, 1.0),
    ]


@pytest.mark.parametrize("option", ["--search", "--front"])
def test_a_search_chooses_the_direction_itself(
    capsys: pytest.CaptureFixture[str], solvers: Solvers, option: str
) -> None:
    status, answer = run_json(capsys, "fastest", option, "--direction", "2")
    assert (status, answer["where"]) == (2, "--direction")
    assert "leave out --direction" in answer["error"]
    assert solvers.tried == []


@pytest.mark.heavy
def test_a_search_with_a_step_writes_a_walk_that_the_check_confirms(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    way = tmp_path / "way.csv"
    given = ["--search", "--step", "0.02", "--cycles", "2"]  # one cycle from rest to rest goes less far
    status, answer = run_json(capsys, "fastest", *given, "-o", str(way))
    assert (status, answer["status"], answer["step"]) == (0, "solved", pytest.approx(0.02))
    tried = answer["search"]["tried"]
    assert len(tried) == 7
    paces = [one["speed"] for one in tried if one["status"] == "solved"]
    assert answer["speed"] == pytest.approx(max(paces))
    assert all(one["step"] == pytest.approx(0.02) for one in tried if one["status"] == "solved")
    assert answer["margin"] >= 0.00595
    status, verdict = run_json(capsys, "check", str(way))
    assert (status, verdict["passed"]) == (0, True)
