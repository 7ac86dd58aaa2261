"""The benchmarks: their cases are all there, and what they report is what was measured."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from app.bench import BENCHMARKS
from app.bench.common.cases import Case, all_cases
from app.bench.common.edited_gaits import edited_gait
from app.bench.common.random_drawings import Family, random_drawing
from app.bench.common.random_gaits import grouped_gait
from app.bench.solvers.edits import Outcome, answers, bench_edits
from app.bench.solvers.frontier import bench_frontier
from app.bench.solvers.gentle import bench_gentle
from app.bench.solvers.live import bench_live
from app.bench.solvers.remedies import bench_remedies, family_rows, why_none
from app.bench.solvers.timing import bench_timing
from app.bench.solvers.trajectories import bench_trajectories, row_of
from app.documents.gait_json import gait_content
from core.gait.gait import motion_problem
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot
from tests.support.command import run, run_json

pytestmark = pytest.mark.heavy


def case(name: str, workspace: str = "stroke", closing: int = 5) -> Case:
    return next(
        c
        for c in all_cases()
        if c.name == name
        and c.gait.options.workspace == workspace
        and c.gait.options.closing_knots == closing
    )


def test_every_published_case_is_there() -> None:
    groups = Counter(c.group for c in all_cases())
    assert groups == {"steps": 64, "orders": 64, "iterations": 8, "paper": 12, "rotation": 10}
    assert {c.gait.timeline.sample_count for c in all_cases() if c.name.startswith("paper C")} == {80, 85}
    travel = {
        c.name: np.array(c.gait.step[:2]) * c.gait.iterations for c in all_cases() if c.group == "paper"
    }
    assert {name[6]: value.round(9).tolist() for name, value in travel.items()} == {
        "A": [0.02, 0.02],
        "B": [0.01, 0.01],
        "C": [0.02, 0.02],
    }


def test_directions_give_the_same_motion() -> None:
    *rows, costs = bench_trajectories([case("s-gait 15 mm"), case("rotate 15°")])
    assert costs["case"] == "cost (3.3) against (3.4), 1 of 1 cases"
    assert float(str(costs["exact"]).split()[0]) > 0
    assert costs["published"] == "2.5 times longer"
    assert [row["exact"] for row in rows] == ["solved", "solved"]
    assert all(float(row["directions_differ_m"]) <= 1e-9 for row in rows)
    assert all(float(row["violation"]) <= 1e-6 for row in rows)
    assert all(row["lacks"] == "" for row in rows)


def test_an_infeasible_case_says_what_is_lacking() -> None:
    row = row_of(case("walk 25 mm", closing=0))
    assert (row["live"], row["exact"], row["evidence"]) == ("infeasible", "infeasible", "proven")
    assert "foot speed" in row["lacks"]
    assert row["margin_mm"] is None


def test_a_gentle_body_never_rushes() -> None:
    (row,) = bench_gentle(("walk",), (0.010,), (0.003,))
    assert row["confirmed"] == "4 of 4"
    assert float(row["gentle_mm"]) < 1.2 < 2.5 < float(row["goal_mm"])
    assert float(row["gentle_live_mm"]) < 1.2


def test_the_frontier_is_confirmed_and_free_phases_get_no_less_far() -> None:
    rows = bench_frontier(["c-gait"], [Workspace.CYLINDER], [0.003])
    assert [row["phases"] for row in rows] == ["5 knots", "free"]
    assert {row["confirmed"] for row in rows} == {"yes"}
    reaches = [float(row["largest"].removesuffix(" mm")) for row in rows]
    assert all(free >= drawn for drawn, free in zip(reaches[::2], reaches[1::2], strict=True))


@pytest.mark.soak
def test_random_drawings_have_remedies_that_walk() -> None:
    rows = family_rows(Family.PLAIN, count=2, seed=4)
    figures = {row["drawing"]: row["remedies"] for row in rows}
    assert figures["with a remedy that walks"] == "2 of 2"
    assert figures["whose first remedy walks"] == "2 of 2"
    assert figures["without any remedy"] == "0 of 2"


@pytest.mark.soak
def test_both_families_of_drawings_are_measured() -> None:
    rows = bench_remedies(count=1, seed=2)
    told = {row["family"]: row["remedies"] for row in rows if row["drawing"] == "with a remedy that walks"}
    assert told == {"plain": "1 of 1", "special": "1 of 1"}


def test_a_drawing_without_a_remedy_says_why() -> None:
    walk = library()["walk"].gait
    stance = walk.timeline.stance.copy()
    stance[:, 10:20] = [[False], [False], [True], [True]]
    locked = ContactTimeline(stance, np.ones_like(stance), walk.timeline.sample_time)
    why = why_none(replace(walk, timeline=locked))
    assert why.startswith("No change was found that makes it walk. Locked cells were not changed")
    assert "no footfalls near it were found" in why


def test_a_drawing_that_the_pattern_search_finishes_says_so() -> None:
    overlap = random_drawing(4, 1).gait
    assert why_none(overlap).endswith("(finished by the pattern search it walks)")


def test_an_edit_is_made_again_from_its_seed() -> None:
    contents = [json.dumps(gait_content(edited_gait(7, number).gait)) for number in (3, 3, 4)]
    assert contents[0] == contents[1] != contents[2]


def test_edits_end_solved_or_explained() -> None:
    rows = bench_edits(count=6, seed=11)
    counts = {row["edit"]: row for row in rows[: len(Outcome) + 2]}
    assert sum(int(counts[outcome]["live"]) for outcome in Outcome) == 6
    assert counts[Outcome.FAILED] == {"edit": "failed", "live": "0", "exact": "0", "reason": ""}
    assert counts["infeasible, and another search has a motion"]["exact"] == "0"


def test_a_foot_that_would_rise_into_its_motors_is_no_motion_of_the_live_tier() -> None:
    # 7.1 mm of clearance under a plane at 55 mm would push every motor of the foot below its stroke.
    found = answers(edited_gait(3, 401))
    assert Outcome.FAILED not in (found.live, found.exact)


def test_edits_can_be_few_and_others(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "bench", "edits", "--count", "1", "--seed", "9")
    assert status == 0
    rows = {row["edit"]: row for row in answer["results"]["edits"]}
    assert sum(int(rows[outcome]["exact"]) for outcome in Outcome) == 1


def test_the_fastest_timing_stands_beside_the_drawn_one() -> None:
    limited, free = bench_timing(["walk"], [5])
    assert (limited["status"], free["status"]) == ("solved", "solved")
    assert free["fastest_s"] < limited["fastest_s"] <= 6.5 < limited["drawn_s"]
    assert float(limited["violation"]) <= 1e-6


def test_an_edit_that_is_no_problem_is_refused_with_its_sentence() -> None:
    found = answers(edited_gait(3, 163))
    assert (found.live, found.exact, found.disagree) == (Outcome.REFUSED, Outcome.REFUSED, False)
    assert "needs at least 3" in found.reason


@pytest.mark.parametrize(("robot", "group", "knots"), [("hexapod", 2, 42), ("dodecapod", 3, 40)])
def test_other_robots_step_in_groups(robot: str, group: int, knots: int) -> None:
    gait = grouped_gait(robot, group, knots // (2 * load_robot(robot).leg_count // group))
    assert gait.timeline.sample_count == knots
    floating = (~gait.timeline.stance).sum(axis=0)
    assert set(floating) == {0, group}
    assert motion_problem(gait, load_robot(robot)).knot_count == knots


def test_the_live_tier_is_timed_in_its_parts() -> None:
    rows = bench_live(changes=2)
    assert rows[0]["shape"] == "4 legs, 40 knots"
    for row in rows:
        parts = sum(row[key] for key in ("problem_ms", "qp_ms", "rows_and_pipe_ms", "check_ms"))
        assert 0 < row["median_ms"] <= row["p95_ms"] <= row["max_ms"]
        assert parts <= row["max_ms"] * 1.5


@pytest.fixture
def few_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.bench.solvers.kinematics.POSES", 3000)


@pytest.mark.usefixtures("few_poses")
@pytest.mark.parametrize("markdown", [False, True])
def test_benchmarks_print_their_conditions(capsys: pytest.CaptureFixture[str], markdown: bool) -> None:
    status, out, _ = run(capsys, "bench", "kinematics", *(["--markdown"] if markdown else []))
    assert status == 0
    assert "cores: " in out
    assert ("| robot | poses |" in out) == markdown


@pytest.mark.usefixtures("few_poses")
def test_benchmarks_are_one_json_object(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "bench", "kinematics")
    assert status == 0
    assert {"cores", "load", "python", "casadi", "processor"} <= set(answer["conditions"])
    assert [row["robot"] for row in answer["results"]["kinematics"]] == [
        "deltawalker",
        "hexapod",
        "dodecapod",
    ]


def test_an_unknown_benchmark_is_refused_with_those_that_are(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "bench", "speed")
    assert status == 2
    assert all(name in answer["error"] for name in BENCHMARKS)
