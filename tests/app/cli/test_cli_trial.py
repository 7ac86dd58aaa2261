"""`footfall trial`: figures as published, one JSON object, refusals with a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from core.robot.model import load_robot
from core.vision.track_csv import format_track_csv
from tests.support.command import run, run_json
from tests.support.reference import reference_path
from tests.support.trials.tracks import stepping_track


def track_file(folder: Path, step_cm: float, name: str = "track.csv") -> str:
    path = folder / name
    path.write_text(format_track_csv(stepping_track((step_cm / 100, 0.0), 3)))
    return str(path)


def test_a_published_trial_prints_its_published_figures(capsys: pytest.CaptureFixture[str]) -> None:
    track = reference_path("robot_trials/tracks_cm/trajAa_t1_o1_3x.csv")
    status, answer = run_json(capsys, "trial", str(track), "--expect", "3")
    assert status == 0
    figures = answer["files"][0]
    shown = [round(figures[key], 2) for key in ("distance", "angle_deg", "error_percent")]
    assert shown == [3.62, 11.95, 20.69]
    assert answer["mean"]["distance"] == figures["distance"]


def test_several_trials_have_a_mean_and_a_spread(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    files = [track_file(tmp_path, 1.0), track_file(tmp_path, 1.2, "other.csv")]
    _, answer = run_json(capsys, "trial", *files, "--expect", "3", "--iterations", "3")
    assert answer["mean"]["distance"] == pytest.approx(3.3, abs=1e-3)
    assert answer["spread"]["distance"] == pytest.approx(0.6 / 2**0.5, abs=1e-3)
    assert [part["net_distance"] for part in answer["files"][0]["iterations"]] == pytest.approx([1.0] * 3)


def test_people_read_a_table_a_foot_and_each_iteration(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, text, _ = run(capsys, "trial", track_file(tmp_path, 1.0), "--expect", "3", "--iterations", "3")
    assert status == 0
    assert "foot 4" in text
    assert "iteration 3: 1.00 cm" in text


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--expect", "0"], "must lie between"),
        (["--expect", "3", "--pixels-per-cm", "40"], "both --pixels-per-cm and --origin"),
        (["--expect", "3", "--iterations", "50"], "too few for 50 iterations"),
    ],
)
def test_what_cannot_be_used_is_refused_with_a_sentence(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, words: list[str], reason: str
) -> None:
    status, answer = run_json(capsys, "trial", track_file(tmp_path, 1.0), *words)
    assert status == 2
    assert reason in answer["error"]


def test_steps_have_the_net_figures_of_each_iteration_and_their_mean(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = track_file(tmp_path, 1.0)
    _, answer = run_json(capsys, "trial", file, "--expect", "3", "--iterations", "3")
    trial = answer["files"][0]
    for step, part in zip(trial["steps"], trial["iterations"], strict=True):
        assert step["distance"] == part["net_distance"]
        assert step["angle_deg"] == part["net_angle_deg"]
        assert step["seconds"] == part["seconds"]
    assert trial["step_mean"]["distance"] == pytest.approx(1.0)
    assert answer["mean"]["step_mean"] == trial["step_mean"]
    length = load_robot("deltawalker").shape.plate_across * 1000.0
    speed = trial["net_distance"] * 10.0 / trial["seconds"]
    assert trial["body_lengths_s"] == pytest.approx(speed / length)
    assert answer["mean"]["body_lengths_s"] == trial["body_lengths_s"]
    _, answer = run_json(capsys, "trial", file, "--expect", "3")
    assert (answer["files"][0]["steps"], answer["files"][0]["step_mean"]) == ([], None)
    assert answer["mean"]["body_lengths_s"] == trial["body_lengths_s"]


def test_frame_times_time_each_file(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    files = [track_file(tmp_path, 1.0), track_file(tmp_path, 1.2, "other.csv")]
    clocks = []
    for index, rate in enumerate((10.0, 20.0)):
        path = tmp_path / f"times{index}.txt"
        path.write_text("".join(f"{frame / rate}\n" for frame in range(1248)))
        clocks += ["--frame-times", str(path)]
    words = [*files, "--expect", "3", "--iterations", "3"]
    _, answer = run_json(capsys, "trial", *words, *clocks)
    assert [one["seconds"] for one in answer["files"]] == pytest.approx([124.7, 62.35])
    assert sum(step["seconds"] for step in answer["files"][1]["steps"]) == pytest.approx(62.35)
    refusals = {
        "1 files of frame times for 2 tracks": clocks[:2],
        "Give either": [*clocks, "--frame-rate", "13"],
        "gone.txt cannot be read": [*clocks[:2], "--frame-times", str(tmp_path / "gone.txt")],
    }
    for sentence, more in refusals.items():
        status, answer = run_json(capsys, "trial", *words, *more)
        assert status == 2
        assert sentence in answer["error"]
