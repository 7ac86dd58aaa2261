"""`footfall optimise` and `footfall frontier`: both tiers, every option, and what is refused."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.bench.common.random_gaits import grouped_gait
from app.cli import main
from app.cli.gait_options import named_gait
from app.documents.gait_json import gait_content
from app.export.trajectory_files import read_trajectory
from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem
from core.gait.motion_source import MotionSource, motion_source
from core.library.library import library
from core.motion.contact_timeline import timeline_from_rows
from core.robot.kinematics import walker_strokes
from core.robot.model import load_robot
from solver_jobs import Evidence, SolveStatus, solve_exact, solve_live
from tests.support.command import run, run_json

MODEL = load_robot("deltawalker")
STANCE, SWING = "1" * 45, "0" * 5


def gait_file(path: Path, gait: Gait) -> str:
    path.write_text(json.dumps(gait_content(gait)))
    return str(path)


@pytest.mark.parametrize("method", ["live", "nlp"])
@pytest.mark.parametrize("gait", ["walk", "rotate"])
def test_both_methods_solve_and_pass_the_checker(
    capsys: pytest.CaptureFixture[str], gait: str, method: str
) -> None:
    status, answer = run_json(capsys, "optimise", gait, "--method", method, "--margin", "0.003")
    assert (status, answer["status"], answer["method"]) == (0, "solved", method)
    assert answer["max_violation"] <= 1e-6
    assert answer["min_cop_margin"] >= 0.003 - 1e-6
    assert answer["evidence"] is None
    assert answer["explanation"] == []
    assert (answer["iterations"] > 0) == (method == "nlp")


def test_every_limit_can_be_asked(capsys: pytest.CaptureFixture[str]) -> None:
    words = "--friction 0.5 --motor-speed 0.015 --motor-acceleration 0.03 --plane-height 0.055"
    status, answer = run_json(capsys, "optimise", "walk", *words.split(), "--end-plane-height", "0.056")
    assert (status, answer["status"]) == (0, "solved")
    assert {"friction", "motor_speed", "motor_acceleration"} <= set(answer["violations"])


def test_a_cycle_goes_on_at_its_ends(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "cycle.csv"
    words = ["--boundary", "periodic", "--closing-knots", "0", "-o", str(path)]
    assert run_json(capsys, "optimise", "walk", *words)[0] == 0
    velocity = read_trajectory(path).trajectory.body_velocity
    assert velocity is not None
    np.testing.assert_allclose(velocity[-1], velocity[0], atol=1e-9)
    assert np.linalg.norm(velocity[0]) > 1e-5


@pytest.mark.parametrize(("degrees", "knots"), [(15, 45), (20, 45), (30, 47), (-15, 45)])
def test_rotation_turns_the_robot_within_its_motors(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, degrees: float, knots: int
) -> None:
    path = tmp_path / "turn.csv"
    status, answer = run_json(
        capsys, "optimise", "rotate", "--yaw", str(np.radians(degrees)), "--margin", "0", "-o", str(path)
    )
    assert (status, answer["knots"]) == (0, knots)
    motion = read_trajectory(path).trajectory
    assert motion.heading[-1] == pytest.approx(np.radians(degrees))
    np.testing.assert_allclose(motion.body_world[-1, :2], 0.0, atol=1e-9)
    # In the body's frame every foot is back in its place.
    strokes = walker_strokes(MODEL, motion.feet_world, motion.pose(MODEL))
    np.testing.assert_allclose(strokes[-1], strokes[0], atol=1e-9)
    speeds = np.abs(np.diff(strokes, axis=0)) / np.diff(motion.times)[:, None, None]
    assert speeds.max() <= 0.015 + 1e-4


@pytest.mark.heavy
def test_a_closing_stance_that_a_file_sets_is_kept(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    rotate = library()["rotate"].gait
    longer = replace(rotate, options=replace(rotate.options, closing_knots=9))
    longer = replace(longer, timeline=drawn_timeline(longer))
    paths = [gait_file(tmp_path / f"{n}.json", gait) for n, gait in enumerate((rotate, longer))]
    words = ["--method", "live", "--yaw", str(np.radians(27))]
    knots = [run_json(capsys, "optimise", path, *words)[1]["knots"] for path in paths]
    assert knots == [46, 49]


def test_too_large_a_turn_is_proven_without_a_search(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "optimise", "rotate", "--yaw", str(np.radians(40)))
    assert (status, answer["status"], answer["iterations"]) == (3, "infeasible", 0)
    assert answer["explanation"][0].startswith("Reach is")
    assert answer["explanation"][-1] == "This is proven: no motion of the model can do it."


@pytest.mark.heavy
def test_too_large_a_margin_over_two_iterations_is_explained_by_both_tiers(
    capsys: pytest.CaptureFixture[str],
) -> None:
    asked = ("s-gait", "--iterations", "2", "--step", "0.020", "--margin", "0.010")
    status, answer = run_json(capsys, "optimise", *asked)
    assert (status, answer["status"]) == (3, "infeasible")
    told = answer["explanation"]
    assert any("IPOPT" in sentence for sentence in told)
    assert any(sentence.startswith("Balance is") for sentence in told)
    assert len(told) == len(set(told))
    assert sum("roven" in sentence for sentence in told) == 1
    assert told[-1].endswith("not proven.")


def test_the_exact_tier_starts_from_the_live_one() -> None:
    problem = motion_problem(library()["walk"].gait, MODEL)
    answer = solve_exact(problem)
    assert answer.status is SolveStatus.SOLVED
    assert answer.initial.body_world == pytest.approx(solve_live(problem).trajectory.body_world, abs=1e-4)


def test_a_longer_proof_is_not_repeated() -> None:
    gait = library()["walk"].gait
    low = replace(gait, options=replace(gait.options, plane_height=0.050))
    answer = solve_exact(motion_problem(low, MODEL))
    assert (answer.status, answer.evidence) == (SolveStatus.INFEASIBLE, Evidence.PROVEN)
    assert len(answer.explanation) == len(set(answer.explanation))


def test_a_foot_that_must_move_but_never_swings_is_infeasible(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    walk = library()["walk"].gait
    stance = walk.timeline.stance.copy()
    stance[1] = True
    path = gait_file(tmp_path / "still.json", replace(walk, timeline=replace(walk.timeline, stance=stance)))
    for method in ("live", "nlp"):
        status, answer = run_json(capsys, "optimise", path, "--method", method)
        assert (status, answer["evidence"]) == (3, "proven")
        assert any("Foot 2" in s and "never swings" in s for s in answer["explanation"])


def test_two_legs_cannot_keep_a_margin_but_may_balance_without(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    stands, trots = STANCE, "1" * 10 + SWING + "1" * 30
    walk = library()["walk"].gait
    rows = [trots, stands, trots, stands]
    gait = replace(
        walk,
        timeline=timeline_from_rows(rows, 0.4),
        step=heading_step(walk.orientation, 0.0),
    )
    path = gait_file(tmp_path / "trot.json", gait)
    status, answer = run_json(capsys, "optimise", path)
    assert status == 3
    assert any("no area between them" in s or "margin" in s for s in answer["explanation"])
    status, answer = run_json(capsys, "optimise", path, "--margin", "0")
    assert (status, answer["status"]) == (0, "solved")


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["--step", "-0.01"], 2, "--step"),
        (["--step", "0.01", "--goal", "0.01,0"], 2, "not allowed with"),
        (["--goal", "0.01"], 2, "X,Y"),
        (["--method", "guess"], 2, "must be one of live, nlp"),
        (["--workspace", "sphere"], 2, "must be one of cylinder, stroke"),
        (["--boundary", "periodic", "--yaw", "0.1"], 2, "periodic"),
        (["--boundary", "loop"], 2, "must be one of rest, periodic"),
        (["--friction", "0"], 2, "--friction"),
        (["--motor-speed", "nan"], 2, "--motor-speed"),
        (["--motor-acceleration", "-1"], 2, "--motor-acceleration"),
        (["--plane-height", "53.5"], 2, "--plane-height"),
        (["--end-plane-height", "tall"], 2, "--end-plane-height"),
        (["--order", "1,2,2,4"], 2, "order"),
    ],
)
@pytest.mark.parametrize("command", ["optimise", "frontier"])
def test_what_does_not_fit_is_refused(
    capsys: pytest.CaptureFixture[str], command: str, words: list[str], status: int, sentence: str
) -> None:
    code, answer = run_json(capsys, command, "walk", *words)
    assert code == status
    assert sentence in answer["error"]


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--step", "0.1"], "has to travel"),
        (["--plane-height", "0.050"], "The actuator plane"),
        (["--clearance", "0.02", "--phase-knots", "2"], "too short to rise"),
        (["--step", "0.03", "--workspace", "cylinder", "--method", "live"], "Reach is"),
        (["--closing-knots", "0", "--margin", "0.003", "--method", "live"], "Balance is"),
    ],
)
def test_what_no_motion_can_do_is_explained(
    capsys: pytest.CaptureFixture[str], words: list[str], sentence: str
) -> None:
    status, answer = run_json(capsys, "optimise", "c-gait", *words)
    assert (status, answer["status"]) == (3, "infeasible")
    assert any(sentence in told for told in answer["explanation"])
    assert answer["evidence"] in ("proven", "diagnosed")


def test_the_frontier_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "far.csv"
    words = ["frontier", "c-gait", "--workspace", "cylinder", "--margin", "0", "-o", str(path)]
    status, answer = run_json(capsys, *words)
    assert status == 0
    assert answer["gait"] == "c-gait"
    assert 0.015 < answer["live_step"] <= answer["max_step"] < 0.020
    assert answer["confirmed"] is True
    assert answer["limited_by"]
    assert 0.053 <= answer["plane_height"] <= 0.0605
    assert read_trajectory(path).trajectory.body_world[-1, 0] == pytest.approx(answer["max_step"])


def test_the_frontier_of_a_rotation_is_an_angle(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["frontier", "rotate", "--method", "live", "--plane-height", "0.0535", "--margin", "0"]
    status, answer = run_json(capsys, *words)
    assert (status, answer["max_step"], answer["confirmed"]) == (0, None, False)
    assert np.radians(25) < answer["max_yaw"] < np.radians(40)
    status, out, _ = run(capsys, *words, "--workspace", "cylinder")
    assert status == 0
    assert "the largest turn is" in out


def test_a_gait_without_any_step_is_infeasible(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "frontier", "walk", "--margin", "0.02", "--method", "live")
    assert status == 3
    assert "no step is possible" in out
    assert "Balance is" in out


def test_phases_drawn_by_hand_are_not_lengthened(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    walk = library()["walk"].gait
    stance = walk.timeline.stance.copy()
    stance[2, 4] = False
    path = gait_file(tmp_path / "own.json", replace(walk, timeline=replace(walk.timeline, stance=stance)))
    words = ["frontier", path, "--free-phases", "--method", "live", "--plane-height", "0.0535"]
    status, answer = run_json(capsys, *words)
    assert (status, answer["where"]) == (2, "--free-phases")
    assert run_json(capsys, *words, "--order", "3,2,4,1")[0] == 0


def test_a_robot_of_six_legs_has_a_frontier(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = gait_file(tmp_path / "six.json", grouped_gait("hexapod", 2, 5))
    status, answer = run_json(capsys, "frontier", path, "--method", "live")
    assert status == 0
    assert answer["max_step"] > 0.01


def test_the_companion_names_the_robot(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = str(tmp_path / "tripod.csv")
    assert run(capsys, "optimise", "hexapod-tripod", "--method", "live", "-o", path)[0] == 0
    for command in ("check", "waypoints"):
        assert run(capsys, command, path)[0] == 0
    status, answer = run_json(capsys, "check", path, "--robot", "deltawalker")
    assert status == 2
    assert "6 feet" in answer["error"]


def test_margins_below_0_are_refused_and_foot_speed_is_kept(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "optimise", "walk", "--margin", "-0.001")
    assert status == 2
    assert "--margin" in answer["error"]
    status, answer = run_json(capsys, "optimise", "walk", "--method", "live", "--foot-speed", "0.004")
    assert (status, answer["status"]) == (3, "infeasible")


@pytest.mark.heavy
def test_what_would_help_is_a_command_that_can_be_copied(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    out = tmp_path / "motion.csv"
    status, answer = run_json(capsys, "optimise", "walk", "--step", "0.034", "-o", str(out))
    assert (status, answer["trajectory"]) == (3, None)
    assert {"step", "iterations"} <= {remedy["kind"] for remedy in answer["remedies"]}
    for remedy in answer["remedies"]:
        program, *words = shlex.split(remedy["command"])
        assert program == "footfall"
        assert run(capsys, *words)[0] == 0
        assert out.exists()
        out.unlink()
    _, text, _ = run(capsys, "optimise", "walk", "--step", "0.034")
    assert "What would help, best first:" in text
    assert "footfall optimise walk --step 0.034 --remedy 1" in text


def test_the_help_names_the_gaits_that_can_be_optimised(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["optimise", "--help"])
    said = " ".join(capsys.readouterr().out.split())
    assert "another id that `footfall gaits` lists as optimised or drawn" in said
    for name, entry in library().items():
        if motion_source(entry.gait) in (MotionSource.OPTIMISED, MotionSource.DRAWN):
            assert named_gait(name).order == entry.gait.order, name


def test_a_remedy_that_is_not_there_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = run_json(capsys, "optimise", "walk", "--step", "0.034", "--remedy", "4")
    assert status == 2
    assert "There is no remedy 4" in answer["error"]
