"""`bench --docs`: what is run, what is only listed, and with which status it ends."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from app.cli.bench_documents import content_of
from app.common.json import Json
from tests.support.command import run, run_json

README = """A walk of 10 mm takes 21.4 s.

<!-- footfall gaits --json
21.4 s = gaits[id=walk].robot_seconds
-->
"""
FIGURES = """Its feet are 0.17 mm off, and the published ones 1.2 mm.

<!-- slow: footfall bench physics --json
0.17 mm = results.physics[0].feet_mm
-->
<!-- footfall bench walk --reference FOLDER --json
1.2 mm = results.walk[0].feet_mm
-->
<!-- machine: footfall bench exact -->
"""
ANSWERS: dict[str, Json] = {
    "footfall gaits --json": {"gaits": [{"id": "walk", "robot_seconds": 21.42}]},
    "footfall bench physics --json": {"results": {"physics": [{"feet_mm": 0.17}]}},
    "footfall bench walk --reference FOLDER --json": {"results": {"walk": [{"feet_mm": 1.3}]}},
}


@pytest.fixture
def documents(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text(README)
    (tmp_path / "docs" / "figures.md").write_text(FIGURES)
    monkeypatch.setattr("app.cli.bench_documents.ROOT", tmp_path)
    monkeypatch.setattr("app.cli.bench_documents.content_of", lambda command, _: ANSWERS[command])


@pytest.mark.usefixtures("documents")
def test_the_quick_commands_are_run_and_the_others_listed(capsys: pytest.CaptureFixture[str]) -> None:
    status, content = run_json(capsys, "bench", "--docs")
    assert status == 0
    assert (content["compared"], content["differ"]) == (1, [])
    assert [(one["line"], one["why"]) for one in content["not_run"]] == [
        (3, "slow"),
        (6, "needs --reference"),
        (9, "machine"),
    ]


@pytest.mark.usefixtures("documents")
def test_what_differs_is_named_with_status_4(capsys: pytest.CaptureFixture[str]) -> None:
    status, text, _ = run(capsys, "bench", "--docs", "--reference", ".")
    assert status == 4
    command = "footfall bench walk --reference FOLDER --json"
    assert f"docs/figures.md:1: “1.2 mm”, now 1.3: {command}" in text
    assert "2 figures of 2 commands were compared; 1 differ" in text


@pytest.mark.usefixtures("documents")
def test_numbers_without_a_rule_and_figures_that_are_gone_are_named(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "README.md").write_text(README.replace("10 mm", "15 mm"))
    (tmp_path / "docs" / "figures.md").write_text(FIGURES.replace("0.17 mm off", "0.18 mm off"))
    status, text, _ = run(capsys, "bench", "--docs")
    assert status == 4
    assert "docs/figures.md:3: “0.17 mm”, now not in the text above: footfall bench physics --json" in text
    assert "  README.md:1: 15\n  docs/figures.md:1: 0.18" in text


@pytest.mark.usefixtures("documents")
def test_a_named_benchmark_is_run_however_long_it_takes(capsys: pytest.CaptureFixture[str]) -> None:
    status, content = run_json(capsys, "bench", "physics", "--docs")
    assert (status, content["compared"], content["differ"]) == (0, 1, [])


@pytest.mark.usefixtures("documents")
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("exact --docs", "No figure of exact can be compared: it measures times"),
        ("frontier --docs", "no document names this command"),
        ("walk --docs", "name its folder after --reference"),
        ("nothing --docs", "There is no benchmark “nothing”"),
        ("--docs --reference nowhere", "There is no folder"),
        (f"--docs --reference /{'a' * 300}", "File name too long"),
        ("--docs --markdown", "--markdown does not go with --docs"),
        ("--docs --report page.html", "--report does not go with --docs"),
        ("fastest --docs --grid", "--grid does not go with --docs"),
    ],
)
def test_what_cannot_be_compared_is_refused(
    capsys: pytest.CaptureFixture[str], words: str, sentence: str
) -> None:
    status, _, error = run(capsys, "bench", *words.split())
    assert status == 2
    assert sentence in error


@pytest.mark.usefixtures("documents")
def test_an_installed_program_says_where_the_documents_are(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "docs" / "figures.md").unlink()
    status, _, error = run(capsys, "bench", "--docs")
    assert status == 2
    assert "in its source tree" in error


PRINTED = (
    "import json, os, sys; print(json.dumps({'words': sys.argv[1:], 'files': os.listdir()})); "
    "open('made', 'w').close()"
)


def replace_commands(monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    """Has every command be another Python program."""
    monkeypatch.setattr(
        "app.cli.bench_documents.own_command", lambda *words: [sys.executable, "-c", program, *words]
    )


def test_commands_run_in_one_empty_folder_and_the_last_one_is_read(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    replace_commands(monkeypatch, PRINTED)
    command = "footfall optimise walk -o w.csv && footfall bench walk --reference FOLDER 'two words' --json"
    content = content_of(command, Path("."))
    words = ["bench", "walk", "--reference", str(tmp_path), "two words", "--json"]
    assert content == {"words": words, "files": ["made"]}


def test_a_command_that_prints_no_json_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    replace_commands(monkeypatch, "import sys; sys.exit('No such gait.')")
    assert content_of("footfall gaits --json", None) == {"error": "status 1, No such gait."}
    replace_commands(monkeypatch, "print(5)")
    assert content_of("footfall gaits --json", None) == {"error": "status 0, no JSON"}
