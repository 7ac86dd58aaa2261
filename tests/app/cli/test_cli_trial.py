"""`footfall trial`: figures as published, one JSON object, refusals with a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

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
