"""Files and options take plain numbers alone; text in unambiguous forms is read, and the form is said."""

from __future__ import annotations

import json
from argparse import ArgumentTypeError
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.cli.common.argument_types import foot_order, number, pair, pixel, whole, zero_or
from app.documents.gait_json import gait_content
from core.library.library import library
from tests.support.command import run, run_json

TRACK = "X_D1, Y_D1, X_D2, Y_D2\n0.5,0.25,1.5,1.25\n1.5,0.25,2.5,1.25\n2.5,0.5,3.5,1.5\n"
SPACE = 'robot = "deltawalker"\nkind = "fast"\nseed = 3\n[vary]\nstep_x = [0.01, 0.02]\n'
GAIT = json.dumps(gait_content(library()["walk"].gait), indent=2)
SETUP = '{\n"name": "lab",\n"size": [640, 480]\n}\n'
NO_NUMBERS = ["1_0", "１", "nan", "-inf", "1e999", "\u00a01", "0x1", "−1", "0,1"]


@pytest.mark.parametrize("text", NO_NUMBERS)
@pytest.mark.parametrize(
    "convert",
    [number(-1e9, 1e9, "m"), zero_or(number(-1e9, 1e9, "m")), whole(-100, 100)],
    ids=["number", "zero or", "whole"],
)
def test_an_option_takes_plain_numbers_alone(convert: Callable[[str], object], text: str) -> None:
    with pytest.raises(ArgumentTypeError, match=r"is not a (finite |whole )?number"):
        convert(text)


@pytest.mark.parametrize("text", NO_NUMBERS)
@pytest.mark.parametrize(
    ("convert", "form"),
    [(pair, "{},1"), (pixel, "1,{}"), (foot_order, "3,{},4")],
    ids=["pair", "pixel", "order"],
)
def test_a_list_of_numbers_takes_plain_ones_alone(
    convert: Callable[[str], object], form: str, text: str
) -> None:
    if (form, text) == ("3,{},4", "0,1"):
        assert foot_order("3,0,1,4") == (3, 0, 1, 4)
        return
    with pytest.raises(ArgumentTypeError, match=r"is not a|must be (two numbers|feet)"):
        convert(form.format(text))


@pytest.mark.parametrize("word", NO_NUMBERS)
def test_a_command_ends_with_2_and_the_sentence(word: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, errors = run(capsys, "manual", "walk", f"--step={word}")
    assert (status, out) == (2, "")
    assert "argument --step: " in errors
    assert "number" in errors


FORMS: dict[str, tuple[Callable[[str], str], str]] = {
    "decimal commas": (
        lambda t: t.replace(",", ";").replace(".", ","),
        "Read with ; between the numbers and a decimal comma.",
    ),
    "tabs": (lambda t: t.replace(",", "\t"), "Read with tabs between the numbers."),
    "sep": (lambda t: "sep=;\n" + t.replace(",", ";"), "Read with ; between the numbers."),
    "count": (
        lambda t: "".join(
            f"{at - 1},{line}\n" if at else f",{line}\n" for at, line in enumerate(t.splitlines())
        ),
        "The first column counts the rows and was left out.",
    ),
    "returns": (lambda t: t.replace("\n", "\r"), "Read with carriage returns as the ends of lines."),
}


@pytest.mark.parametrize("form", FORMS)
def test_a_track_in_another_form_has_the_same_figures_and_says_so(
    form: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    change, sentence = FORMS[form]
    path = tmp_path / "track.csv"
    path.write_text(TRACK)
    plain = run_json(capsys, "trial", str(path), "--expect", "3")
    path.write_text(change(TRACK), newline="")
    status, out, errors = run(capsys, "trial", str(path), "--expect", "3", "--json")
    assert (status, json.loads(out)) == plain
    form_note, rate_note = errors.splitlines()
    assert form_note == f"{path}: {sentence}"
    assert "13 frames a second" in rate_note


def command_on(path: Path) -> tuple[str, ...]:
    """The command that reads a file, by its ending."""
    return {
        ".csv": ("trial", str(path), "--expect", "3"),
        ".toml": (
            "atlas",
            "run",
            "--space",
            str(path),
            "--count",
            "1",
            "-o",
            str(path.with_suffix(".sqlite")),
        ),
        ".json": ("check", str(path)),
        ".setup": ("trial", str(path), "--expect", "3", "--setup", str(path)),
    }[path.suffix]


def put(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new, 1)


REFUSED: list[tuple[str, str | bytes, str]] = [
    ("a.csv", put(TRACK, "1.5,", "1_0.0,"), ":2, column 3: “1_0.0” is not a number; write it without _."),
    (
        "a.csv",
        TRACK.replace(".", ","),
        ", line 2: 8 numbers; a row has 4. Write decimal points, or ; between",
    ),
    ("a.csv", TRACK.encode("utf-16"), " is not text in UTF-8: it is text in UTF-16. Save it as UTF-8"),
    ("a.csv", TRACK.partition("\n")[2], "the header must read X_D1, Y_D1, X_D2, Y_D2, …; it reads “0.5, "),
    ("a.csv", GAIT, " holds JSON; a table of numbers is wanted here."),
    ("a.toml", put(SPACE, "= 3", "= 1_0"), ", line 3, column 8 (seed): “1_0” is not a number; write it"),
    ("a.toml", put(SPACE, "0.02", "inf"), ", line 5, column 17 (step_x): inf is not a finite number."),
    ("a.toml", put(SPACE, "0.02", "0,02"), " Write decimal points, not commas."),
    ("a.toml", SPACE.encode("utf-16"), " is not text in UTF-8: it is text in UTF-16. Save it as UTF-8"),
    ("a.toml", ("# ä\n" + SPACE).encode("latin-1"), "the byte 0xE4 (“ä” in Latin-1 or Windows-1252)"),
    ("a.toml", put(SPACE, "= 3", "= " + "9" * 5000), ", line 3, column 8 (seed): 9"),
    ("a.json", put(GAIT, '"sample_time": 0.4', '"sample_time": NaN'), " (sample_time): NaN is not a finite"),
    (
        "a.json",
        put(GAIT, '"sample_time": 0.4', '"sample_time": 1e999'),
        "(sample_time): 1e999 is not a finite",
    ),
    (
        "a.json",
        put(GAIT, '"sample_time": 0.4', '"sample_time": "0.4"'),
        "timeline.sample_time: Input should be a",
    ),
    (
        "a.json",
        put(GAIT, '"iterations": 1', '"iterations": "1_0"'),
        "iterations: Input should be a whole number",
    ),
    ("a.json", put(GAIT, '"iterations": 1', '"iterations": 1_0'), " Write numbers without _."),
    (
        "a.json",
        put(GAIT, '"iterations": 1', '"iterations": true'),
        "iterations: Input should be a whole number",
    ),
    ("a.json", GAIT.encode("utf-16"), " is not text in UTF-8: it is text in UTF-16. Save it as UTF-8"),
    ("a.json", TRACK, "is not JSON: Expecting value: line 1 column 1. It begins “X_D1"),
    ("a.setup", put(SETUP, "640", "NaN"), ", line 3, column 10 (size): NaN is not a finite number."),
    ("a.setup", put(SETUP, "640", '"640"'), "size.0: Input should be a valid integer."),
    ("a.setup", put(SETUP, "640", "6_40"), " Write numbers without _."),
    ("a.setup", SETUP.encode("utf-16"), " is not text in UTF-8: it is text in UTF-16. Save it as UTF-8"),
    ("a.setup", TRACK, "is not JSON: Expecting value"),
]


@pytest.mark.parametrize(("name", "content", "words"), REFUSED)
def test_a_file_that_is_not_plain_ends_with_2_and_its_place(
    name: str, content: str | bytes, words: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    status, out, errors = run(capsys, *command_on(path))
    assert (status, out) == (2, "")
    assert words in errors
    assert sorted(one.name for one in tmp_path.iterdir()) == [name]


@pytest.mark.parametrize("edit", [lambda t: "\ufeff" + t, lambda t: t.replace("\n", "\r"), str])
def test_a_mark_and_ends_of_lines_of_other_systems_are_read_in_toml_and_json(
    edit: Any, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    space, gait = tmp_path / "a.toml", tmp_path / "a.json"
    space.write_bytes(edit(put(SPACE, "= 3", "= -3")).encode())
    assert "seed is -3; it must be" in run(capsys, *command_on(space))[2]
    gait.write_bytes(edit(put(GAIT, '"version": ', '"version": 99')).encode())
    assert "version 99" in run(capsys, *command_on(gait))[2]
