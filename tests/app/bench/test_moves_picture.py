"""The picture of moves over time: the one in docs is what is drawn now, and shows what was measured."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.bench.common.measure import Row
from app.bench.robot.moves import moves_svg, require_picture
from app.bench.robot.moves_picture import moves_picture
from app.bench.robot.walked_moves import Move, WalkedMoves, walks_content, walks_of
from app.export.drawing import Box, Words
from core.errors import InputError
from core.robot.model import load_robot
from core.wire.robot_time import PUBLISHED
from tests.support.command import run
from tests.support.studio_process import PROJECT

DATA = PROJECT / "docs/fastest_moves.json"
PICTURE = PROJECT / "docs/fastest_moves.svg"


def test_the_picture_in_docs_is_drawn_from_the_data_beside_it() -> None:
    walks = walks_of(json.loads(DATA.read_text()))
    assert moves_svg(walks) == PICTURE.read_text()
    assert json.loads(json.dumps(walks_content(walks))) == json.loads(DATA.read_text())


def test_the_figures_of_the_page_are_those_of_the_data() -> None:
    page = (PROJECT / "docs/fastest.md").read_text()
    published, fastest = walks = walks_of(json.loads(DATA.read_text()))
    for walk in walks:
        count = len(walk.moves)
        cells = (
            f"{walk.way:.1f} mm",
            count,
            walk.with_ramps(0),
            walk.with_ramps(2),
            f"{walk.seconds:.1f}",
            f"{walk.ramp_seconds:.1f} s",
            f"{walk.way / count:.2g} mm",
            f"{walk.way / walk.seconds:.2f} mm/s",
        )
        assert f" | {' | '.join(map(str, cells))} |" in page
    idle = [move.seconds for move in published.moves if not move.ramps]
    moved, still = f"{PUBLISHED.message:.2f} s", f"{PUBLISHED.arrived:.2f} s"
    assert (
        f"A message with a ramp takes {moved} besides the ramp; one that moves nothing takes {still}." in page
    )
    beside = [move.seconds - move.ramp_seconds for move in fastest.moves]
    assert sum(beside) / len(beside) == pytest.approx(PUBLISHED.message - 0.1, abs=0.01)
    assert sum(idle) / len(idle) == pytest.approx(PUBLISHED.arrived, abs=0.005)
    assert f"At {len(idle)} of its messages every motor" in page
    assert f"stays, {still} each" in page


def test_the_title_counts_the_messages() -> None:
    moves = tuple(Move(0.3, (), (2,), 0.0) for _ in range(4))
    colours = load_robot("deltawalker").colours
    walk, longer = WalkedMoves("Walk", 5.0, moves[:3]), WalkedMoves("Longer", 5.0, moves)
    assert moves_picture((longer, walk), colours).title == "3 messages a cycle instead of 4"
    assert moves_picture((walk,), colours).title == "3 messages a cycle"


def test_each_ramp_is_a_bar_of_the_body_and_of_the_feet_in_the_air() -> None:
    still = Move(0.3, (), (2,), 0.0)
    lifts = Move(1.7, ((0.3, 1.3),), (2,), 5.0)
    twice = Move(2.0, ((0.3, 0.9), (1.2, 1.5)), (1, 3), 0.0)
    walk = WalkedMoves("Walk", 5.0, (still, lifts, twice))
    colours = load_robot("deltawalker").colours
    drawing = moves_picture((walk,), colours)
    bars = [shape for shape in drawing.shapes if isinstance(shape, Box) and shape.radius]
    assert [bar.fill for bar in bars] == [
        "#475467",
        colours[1],
        colours[0],
        colours[2],
        colours[0],
        colours[2],
    ]
    assert bars[0].width == pytest.approx(bars[2].width / 0.6)
    words = [shape.text for shape in drawing.shapes if isinstance(shape, Words)]
    assert (
        "5.0 mm in 3 messages, 1 of them move nothing  ·  4.0 s, motors move 1.9 s of them  ·  1.25 mm/s"
        in words
    )


def test_a_picture_needs_the_name_of_one(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, _, error = run(capsys, "bench", "moves", "--report", str(tmp_path / "moves.html"))
    assert status == 2
    assert "end its name in .svg" in error


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("kinematics moves --report moves.html", "end its name in .svg"),
        ("kinematics moves --report no/moves.svg", "no is no folder"),
        ("kinematics physics --report no/page.html", "no is no folder"),
        ("physics moves --report moves.svg", "physics and moves would both write moves.svg"),
        ("moves physics --report page.html", "physics and moves would both write page.html"),
    ],
)
def test_a_report_that_cannot_be_written_is_refused_before_anything_is_measured(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    words: str,
    sentence: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, error = run(capsys, "bench", *words.split())
    assert status == 2
    assert sentence in error
    assert "Measuring" not in error
    assert list(tmp_path.iterdir()) == []


def test_a_picture_needs_the_published_walk(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="--reference"):
        require_picture(tmp_path / "moves.svg", None)


@pytest.mark.parametrize(
    ("names", "pages", "pictures"),
    [
        ("", ["report.svg"], [None]),
        ("physics", ["report.svg"], []),
        ("moves", [], ["report.svg"]),
        ("kinematics", [], []),
    ],
)
def test_a_report_is_written_by_moves_only_where_they_are_named(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    names: str,
    pages: list[str],
    pictures: list[str | None],
) -> None:
    written: dict[str, list[str | None]] = {"physics": [], "moves": []}

    def measured(name: str, *arguments: Path | None) -> list[Row]:
        if name in written:
            written[name].append(None if arguments[-1] is None else str(arguments[-1]))
        return [{"figure": 1}]

    monkeypatch.setattr("app.cli.commands_bench.measured", measured)
    monkeypatch.chdir(tmp_path)
    assert run(capsys, "bench", *names.split(), "--reference", ".", "--report", "report.svg")[0] == 0
    assert written == {"physics": pages, "moves": pictures}
