"""`footfall gaits` and `footfall manual`: the library on the command line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from app.documents.gait_json import gait_content, gait_from_content
from core.library.library import Group, group_ids, library
from core.robot.model import load_robot
from core.wire.trajectory_csv import parse_trajectory_csv
from tests.support.command import run, run_json
from tests.support.reference import reference_rows

MODEL = load_robot("deltawalker")
PUBLISHED = [
    ("A0", "walk", "0"),
    ("A1", "walk", "1"),
    ("B0", "amble", "0"),
    ("C0", "s-gait", "0"),
    ("C1", "s-gait", "1"),
]


def manual(capsys: pytest.CaptureFixture[str], path: Path, *words: str) -> tuple[int, int]:
    """Exit status and knots of `footfall manual`, which writes its trajectory to a path."""
    status, answer = run_json(capsys, "manual", *words, "-o", str(path))
    return status, answer["knots"]


@pytest.mark.parametrize(("letters", "gait", "version"), PUBLISHED)
def test_manual_writes_the_published_motion(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, letters: str, gait: str, version: str
) -> None:
    published = reference_rows(f"simulation_manual/planned/traj{letters}_o1.csv")[4:].T.reshape(-1, 4, 3)
    path = tmp_path / "manual.csv"
    assert manual(capsys, path, gait, "--version", version) == (0, len(published))
    motion = parse_trajectory_csv(path.read_text(), path.name).trajectory
    plane = motion.body_world - [0.0, 0.0, MODEL.com_height]
    feet = motion.feet_world - plane[:, None, :] - MODEL.module_centres_robot
    assert np.abs(feet - published).max() < 0.0003


@pytest.mark.parametrize("version", ["0", "1", "2"])
@pytest.mark.parametrize(
    ("gait", "segments"), [("walk", (11, 12, 13)), ("amble", (11, 12, 13)), ("s-gait", (11,) * 3)]
)
def test_three_iterations_are_eight_segments_longer_each(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, gait: str, segments: tuple[int, ...], version: str
) -> None:
    words = (gait, "--version", version, "--iterations", "3", "--direction", "4", "--segment-samples", "3")
    path = tmp_path / "manual.csv"
    assert manual(capsys, path, *words) == (0, 3 * (segments[int(version)] + 16))
    motion = parse_trajectory_csv(path.read_text(), path.name).trajectory
    assert motion.body_world[-1, 0] >= -1e-12
    assert motion.body_world[-1, 1] < 0.0


def test_gaits_are_listed_by_group(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, answer = run_json(capsys, "gaits", "--data", str(tmp_path))
    assert status == 0
    assert [gait["id"] for gait in answer["gaits"]] == list(library())
    assert [gait["group"] for gait in answer["gaits"]] == [entry.group for entry in library().values()]
    assert set(answer["gaits"][0]) == {
        "id",
        "name",
        "robot",
        "orientation",
        "order",
        "kind",
        "made",
        "plan_seconds",
        "robot_seconds",
        "speed",
        "turn_rate",
        "group",
    }
    assert answer["gaits"][0]["speed"] == pytest.approx(0.0023, abs=1e-4)
    text = run(capsys, "gaits", "--data", str(tmp_path))[1]
    assert [line[:-1] for line in text.splitlines() if line.endswith(":")] == list(Group)
    turn = next(line for line in text.splitlines() if line.split()[:1] == ["fast-turn"])
    assert "43.8 s    4.48°/s" in turn


@pytest.mark.parametrize("gait_id", group_ids(Group.BY_HAND))
def test_a_file_keeps_how_iterations_follow_one_another(gait_id: str) -> None:
    gait = library()[gait_id].gait
    read = gait_from_content(gait_content(gait))
    assert read.segment_table is not None
    assert gait.segment_table is not None
    assert read.segment_table.repeated(3) == gait.segment_table.repeated(3)


def test_a_table_of_an_older_file_goes_on_after_its_last_segment() -> None:
    content = gait_content(library()["walk-manual-0"].gait)
    for name in ("repeat_to", "link"):
        del content["segment_table"][name]
    content["segment_table"]["repeat_from"] = 3
    table = gait_from_content(content).segment_table
    assert table is not None
    assert table.repeated(2).segment_count == 11 + 9
