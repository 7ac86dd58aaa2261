"""`footfall trial VIDEO --setup`: the same figures out of a film; refusals that name what does not fit."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.app.routes.test_videos_http import SETUP, TRACK
from tests.support.command import run, run_json
from tests.support.studio_process import PROJECT
from tests.support.trials.rendered import write_video
from tests.support.trials.tracks import RATE


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every third frame of the walk, which then goes three times as fast."""
    path = tmp_path_factory.mktemp("video") / "walk.avi"
    write_video(path, TRACK.feet[::3], RATE)
    return path


def setup_file(folder: Path, **changes: object) -> str:
    path = folder / "setup.json"
    path.write_text(json.dumps({**SETUP, **changes}))
    return str(path)


@pytest.mark.heavy
def test_a_film_is_tracked_and_its_figures_are_printed(
    capsys: pytest.CaptureFixture[str], film: Path, tmp_path: Path
) -> None:
    words = ("trial", str(film), "--setup", setup_file(tmp_path), "--expect", "1.2")
    status, answer = run_json(capsys, *words)
    assert status == 0
    assert answer["mean"]["net_distance"] == pytest.approx(1.2, abs=0.03)
    assert answer["files"][0]["frames"] == len(TRACK.feet[::3])
    clock = tmp_path / "times.txt"
    clock.write_text("".join(f"{frame * 3 / RATE}\n" for frame in range(len(TRACK.feet[::3]))))
    _, text, said = run(capsys, *words, "--frame-times", str(clock))
    assert f"{len(TRACK.feet[::3])} frames at 13.0 a second" in said
    assert f"whole: {answer['files'][0]['seconds'] * 3:.1f} s" in text


@pytest.mark.heavy
def test_what_libraries_print_while_a_film_is_tracked_is_not_shown(film: Path, tmp_path: Path) -> None:
    script = """
import os, sys
import app.cli.track_video as track_video
from app.cli import main
track = track_video.track_video
def loud(*given):
    os.write(2, b"libpng error: IDAT: CRC error")
    return track(*given)
track_video.track_video = loud
status = main(sys.argv[1:])
os.write(2, b"The end.")
sys.exit(status)
"""
    words = ("trial", str(film), "--setup", setup_file(tmp_path), "--expect", "1.2")
    done = subprocess.run(
        [sys.executable, "-c", script, *words], cwd=PROJECT, capture_output=True, text=True, check=True
    )
    assert done.stderr.endswith("The end.")
    assert "frames at 13.0 a second" in done.stderr
    assert "libpng" not in done.stderr


@pytest.mark.parametrize(
    ("changes", "more", "words"),
    [
        ({"size": [1280, 720]}, (), "1280 × 720 px; these have 640 × 480"),
        ({"points": SETUP["points"][:2]}, (), "2 points are clicked"),
        ({"colours": []}, (), "colours"),
        ({}, ("--frame-rate", "30"), "--frame-rate is for track files"),
    ],
)
def test_a_setup_that_does_not_fit_is_refused(
    capsys: pytest.CaptureFixture[str],
    film: Path,
    tmp_path: Path,
    changes: dict[str, object],
    more: tuple[str, ...],
    words: str,
) -> None:
    setup = setup_file(tmp_path, **changes)
    status, _, said = run(capsys, "trial", str(film), "--setup", setup, "--expect", "1", *more)
    assert status == 2
    assert words in said


def test_a_folder_in_place_of_a_film_is_named(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    folder = tmp_path / "walk.mp4"
    folder.mkdir()
    words = ("trial", str(folder), "--setup", setup_file(tmp_path), "--expect", "1")
    status, _, said = run(capsys, *words)
    assert status == 2
    assert "walk.mp4 is a folder; name a film in it." in said


def test_feet_whose_colours_are_exchanged_stand_elsewhere_than_the_plans() -> None:
    from app.trials.track_source import fit_content
    from core.trials.alignment import align

    feet = TRACK.feet[0]
    assert fit_content((align(TRACK, feet).gaps * 100).tolist())["fits"]
    told = fit_content((align(TRACK, feet[[1, 0, 2, 3]]).gaps * 100).tolist())
    assert not told["fits"]
    assert "colours of two feet exchanged" in told["fit_sentence"]
    assert np.isfinite(told["residual_cm"])
