"""`export` and `import` on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from app.documents.gait_json import gait_content, parse_gait
from app.export.trajectory_files import read_trajectory
from core.library.library import library
from tests.support.command import run, run_json
from tests.support.reference import reference_path


@pytest.mark.parametrize("form", ["json", "phases", "svg", "png"])
def test_a_built_in_gait_is_written_in_forms_that_need_no_motion(
    form: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    output = tmp_path / "walk.out"
    status, answer = run_json(capsys, "export", "walk", "--format", form, "-o", str(output))
    assert (status, answer["files"], answer["bytes"]) == (0, [str(output)], output.stat().st_size)


def test_a_trajectory_goes_through_npz_and_back_to_the_last_bit(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    first, arrays, second = (str(tmp_path / name) for name in ("a.csv", "a.npz", "b.csv"))
    assert run(capsys, "export", "walk", "--method", "live", "--format", "csv", "-o", first)[0] == 0
    assert run(capsys, "export", first, "--format", "npz", "-o", arrays)[0] == 0
    assert run(capsys, "export", arrays, "--format", "csv", "-o", second)[0] == 0
    assert Path(first).read_bytes() == Path(second).read_bytes()
    assert read_trajectory(Path(second)).assumptions == ()


def test_a_published_file_keeps_its_layout_and_gets_no_companion_that_it_never_had(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path, output = reference_path("trajectories/direction4/ambl_b.csv"), tmp_path / "again.csv"
    status, answer = run_json(capsys, "export", str(path), "--format", "csv", "-o", str(output))
    assert (status, answer["files"]) == (0, [str(output)])
    both = [np.loadtxt(name, delimiter=",") for name in (path, output)]
    assert both[0].tobytes() == both[1].tobytes()


def test_a_published_file_becomes_a_gait_that_says_what_was_assumed(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path, output = reference_path("trajectories/direction1/mtri_e.csv"), tmp_path / "s-gait.json"
    status, answer = run_json(capsys, "import", str(path), "--name", "Lab's S-Gait", "-o", str(output))
    gait = parse_gait(output.read_bytes())
    assert status == 0
    assert (gait.name, gait.order, gait.iterations) == ("Lab's S-Gait", (1, 2, 4, 3), 3)
    assert "is kept as it stands" in answer["remarks"][0]
    assert all(remark in gait.notes for remark in answer["remarks"])


def test_a_published_file_goes_through_a_document_and_comes_out_to_the_last_byte(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path, document, again = (
        reference_path("trajectories/direction2/walk_c.csv"),
        tmp_path / "walk.json",
        tmp_path / "walk.csv",
    )
    assert run(capsys, "import", str(path), "-o", str(document))[0] == 0
    status, answer = run_json(capsys, "export", str(document), "--format", "csv", "-o", str(again))
    assert (status, answer["files"], again.read_bytes()) == (0, [str(again)], path.read_bytes())


def test_a_trajectory_is_imported_with_the_companion_beside_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    files = [tmp_path / name for name in ("a.csv", "a.footfall.json", "b.csv", "b.footfall.json")]
    first, second, document = str(files[0]), str(files[2]), str(tmp_path / "a.json")
    assert run(capsys, "export", "walk-manual-0", "--format", "csv", "-o", first)[0] == 0
    status, answer = run_json(capsys, "import", first, "-o", document)
    assert (status, len(answer["remarks"])) == (0, 1)
    assert run(capsys, "export", document, "--format", "csv", "-o", second)[0] == 0
    assert [file.read_bytes() for file in files[:2]] == [file.read_bytes() for file in files[2:]]
    both = [run_json(capsys, "check", source) for source in (first, document)]
    rules = [
        {(m["rule"], m["margin"]) for m in answer["margins"] if m["rule"] not in ("travel", "turn")}
        for _, answer in both
    ]
    assert rules[0] == rules[1]


def test_arrays_are_imported_to_the_last_bit(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    arrays, document, again = (str(tmp_path / name) for name in ("a.npz", "a.json", "b.npz"))
    assert run(capsys, "export", "walk", "--method", "live", "--format", "npz", "-o", arrays)[0] == 0
    status, answer = run_json(capsys, "import", arrays, "-o", document)
    assert status == 0
    assert "without contact forces" in answer["remarks"][1]
    assert run(capsys, "export", document, "--format", "npz", "-o", again)[0] == 0
    first, second = np.load(arrays), np.load(again)
    for name in ("times", "body_world", "heading", "feet_world", "contact", "feet_velocity", "strokes"):
        assert first[name].tobytes() == second[name].tobytes(), name


def test_waypoints_are_imported_and_go_out_the_same(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    way, document, again = (tmp_path / name for name in ("way.csv", "way.json", "again.csv"))
    gait = library()["amble"].gait.with_options(merge=0.0, stop_bound=None)
    (tmp_path / "amble.json").write_text(json.dumps(gait_content(gait)))
    words = (
        "export",
        str(tmp_path / "amble.json"),
        "--method",
        "live",
        "--format",
        "waypoints",
        "-o",
        str(way),
    )
    assert run(capsys, *words)[0] == 0
    status, answer = run_json(capsys, "import", str(way), "-o", str(document))
    assert status == 0
    assert any("standing feet slip least" in remark for remark in answer["remarks"])
    assert run(capsys, "export", str(document), "--format", "waypoints", "-o", str(again))[0] == 0
    assert again.read_text() == way.read_text()
    assert run_json(capsys, "check", str(document))[0] == 0


def test_whose_motion_waypoints_are_can_be_said(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    way, document = tmp_path / "way.csv", tmp_path / "way.json"
    words = ("export", "walk", "--method", "live", "--format", "waypoints", "-o", str(way))
    assert run(capsys, *words)[0] == 0
    assert run(capsys, "import", str(way), "--robot", "deltawalker9", "-o", str(document))[0] == 0
    assert parse_gait(document.read_bytes()).robot == "deltawalker9"
    for robot, message in (
        ("hexapod", "has 4 feet; hexapod has 6"),
        ("spider", "There is no robot “spider”"),
    ):
        status, _, err = run(capsys, "import", str(way), "--robot", robot)
        assert status == 2
        assert message in err
    status, _, err = run(capsys, "import", str(document), "--robot", "deltawalker9")
    assert (status, "chosen for trajectories and waypoints only" in err) == (2, True)


def test_phases_go_out_and_come_in_with_a_finer_sample_time(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    phases, output = tmp_path / "walk.phases.json", tmp_path / "finer.json"
    assert run(capsys, "export", "walk", "--format", "phases", "-o", str(phases))[0] == 0
    words = ("import", str(phases), "--sample-time", "0.2", "--name", "Finer", "-o", str(output))
    assert run(capsys, *words)[0] == 0
    gait = parse_gait(output.read_bytes())
    assert gait.timeline.sample_count == 2 * library()["walk"].gait.timeline.sample_count
    assert gait.order == library()["walk"].gait.order
    status, answer = run_json(capsys, "import", str(phases), "--sample-time", "0.3", "-o", str(output))
    assert status == 2
    assert "must be a whole number" in answer["error"]


def test_a_gait_document_is_imported_as_it_is(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(gait_content(library()["amble"].gait)))
    status, out, _ = run(capsys, "import", str(path))
    assert (status, parse_gait(out)) == (0, library()["amble"].gait)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("export", "walk", "--format", "png"), "png goes into a file; name it with -o, such as -o walk.png"),
        (("export", "walk", "--format", "pdf", "-o", "x"), "must be one of json, csv"),
        (("export", "nobody", "--format", "svg"), "There is no gait “nobody”"),
        (("export", "nowhere.csv", "--format", "svg"), "nowhere.csv cannot be read"),
        (("export", "nowhere.npz", "--format", "svg"), "nowhere.npz cannot be read"),
        (("import", "nowhere.json"), "nowhere.json cannot be read"),
        (("import", "nowhere.csv"), "nowhere.csv cannot be read"),
        (("export", "walk", "--format", "svg", "-o", "no/such/folder/x.svg"), "cannot be written"),
    ],
)
def test_what_cannot_be_done_is_said(
    words: tuple[str, ...], message: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, _, err = run(capsys, *words)
    assert status == 2
    assert message in err


def test_a_saved_gait_is_exported_before_a_built_in_one_of_its_name(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "gaits").mkdir()
    content = {**gait_content(library()["walk"].gait), "name": "Mine"}
    (tmp_path / "gaits" / "walk.json").write_text(json.dumps(content))
    status, out, _ = run(capsys, "export", "walk", "--format", "json", "--data", str(tmp_path))
    assert (status, json.loads(out)["name"]) == (0, "Mine")
