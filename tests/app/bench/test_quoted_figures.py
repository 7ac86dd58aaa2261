"""Figures in documents are bound to what their commands print."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.bench.quoted_figures import Kind, agrees, differences, quotations, quoted, selected
from app.common.json import Json
from core.errors import InputError

TEXT = """# Walks

The largest step is **28.5 mm**, and the robot turns by −30.2°
in 1,250 s.

<!-- footfall frontier walk --json
28.5 mm = max_step * 1000
-30.2° = turns[gait=rotate].yaw
1,250 s = max turns[*].seconds
-->

| gait | feet | walks |
|---|---|---|
| walk | 0.17 | yes |
| amble | – | no |

<!-- slow: footfall bench physics --reference FOLDER --json
feet = results.physics[own gait].feet_mm
walks = results.physics[own gait].walks
-->
<!-- machine: footfall bench exact live --markdown -->
"""
FRONTIER: Json = {
    "max_step": 0.02849,
    "turns": [{"gait": "rotate", "yaw": -30.2, "seconds": 1250}, {"gait": "x"}],
}
PHYSICS: Json = {
    "results": {
        "physics": [
            {"by hand": "walk", "feet_mm": 9.0},
            {"own gait": "walk", "feet_mm": 0.172, "walks": True},
            {"own gait": "amble", "feet_mm": None, "walks": "no"},
        ]
    }
}


def test_figures_that_are_printed_again_do_not_differ() -> None:
    step, feet, times = quoted("docs/walks.md", TEXT)
    assert [one.kind for one in (step, feet, times)] == [Kind.QUICK, Kind.SLOW, Kind.MACHINE]
    assert [one.benchmarks for one in (step, feet, times)] == [(), ("physics",), ("exact", "live")]
    assert differences(step, FRONTIER) == []
    assert differences(feet, PHYSICS) == []


def test_a_figure_that_differs_is_named_with_its_line_and_what_is_printed_now() -> None:
    step, _, _ = quoted("docs/walks.md", TEXT)
    (found,) = differences(step, FRONTIER | {"max_step": 0.0214})
    assert (found.file, found.line, found.figure, found.printed) == ("docs/walks.md", 3, "28.5 mm", "21.4")
    assert found.command == "footfall frontier walk --json"


def test_a_cell_that_differs_is_named_with_its_row() -> None:
    _, feet, _ = quoted("docs/walks.md", TEXT)
    rows = PHYSICS["results"]["physics"]
    changed = {"results": {"physics": [rows[0], rows[1], rows[2] | {"feet_mm": 0.3}]}}
    assert [(one.line, one.figure, one.printed) for one in differences(feet, changed)] == [(15, "–", "0.3")]


def test_a_figure_that_is_not_printed_any_more_differs() -> None:
    step, feet, _ = quoted("docs/walks.md", TEXT)
    assert [one.figure for one in differences(step, {"turns": FRONTIER["turns"]})] == ["28.5 mm"]
    fewer = {"results": {"physics": PHYSICS["results"]["physics"][:2]}}
    assert "1 values" in differences(feet, fewer)[0].printed
    (found,) = differences(step, {"error": "There is no gait “walk”."})
    assert (found.line, found.printed) == (6, "There is no gait “walk”.")


@pytest.mark.parametrize(
    ("comment", "sentence"),
    [
        ("<!-- a note -->", "must begin with a command"),
        ("<!-- footfall gaits --json -->", "with 0 figures cannot be quick"),
        ("<!-- slow: footfall gaits --json -->", "with 0 figures cannot be slow"),
        ("<!-- machine: footfall gaits --json\n28.5 mm = x\n-->", "with 1 figures cannot be machine"),
        ("<!-- footfall gaits --json\n28.4 mm = x\n-->", "does not have “28.4 mm”"),
        ("<!-- footfall gaits --json\n8.5 mm = x\n-->", "does not have “8.5 mm”"),
        ("<!-- footfall gaits --json\n28 = x\n-->", "does not have “28”"),
        ("<!-- footfall gaits --json\n28.5 mm: x\n-->", "neither “figure = path” nor"),
    ],
)
def test_a_comment_of_another_form_is_refused_with_its_line(comment: str, sentence: str) -> None:
    with pytest.raises(InputError, match=r"docs/walks\.md, line 3") as refusal:
        list(quoted("docs/walks.md", f"A step of 28.5 mm.\n\n{comment}\n"))
    assert sentence in refusal.value.sentence


@pytest.mark.parametrize(
    ("text", "value", "same"),
    [
        ("28.5 mm", 28.46, True),
        ("28.5 mm", 28.44, False),
        ("0.25", 0.255, True),
        ("−0.8", -0.8, True),
        ("−0.8", 0.8, False),
        ("1,250 s", 1250.4, True),
        ("1e-10", 1.2e-10, True),
        ("1e-10", 1.8e-10, False),
        ("134 solved", 134, True),
        ("134 solved", 133, False),
        ("yes", True, True),
        ("yes", False, False),
        ("7", True, False),
        ("–", None, True),
        ("0.1", None, False),
        ("shoe distance", "shoe distance", True),
        ("shoe distance", "workspace", False),
        ("shoe distance", 3.0, False),
        ("401 solved", "401", True),
        ("401 solved", "40", False),
    ],
)
def test_a_figure_is_a_value_to_its_own_digits(text: str, value: object, same: bool) -> None:
    assert agrees(text.replace("−", "-"), value) is same


def test_a_near_figure_may_be_a_tenth_off() -> None:
    assert agrees("48.0 mm", 52.0, is_near=True)
    assert not agrees("48.0 mm", 53.0, is_near=True)


def test_a_path_leads_to_every_value_that_it_names() -> None:
    assert selected(PHYSICS, "results.physics[own gait].feet_mm") == [0.172, None]
    assert selected(PHYSICS, "results.physics[own gait=amble].walks") == ["no"]
    assert selected(PHYSICS, "results.physics[own gait][0].feet_mm") == [0.172]
    assert selected(PHYSICS, "results.physics[own gait][walks=no].feet_mm") == [None]
    assert selected(PHYSICS, "results.physics[*].feet_mm") == [9.0, 0.172, None]
    assert selected(PHYSICS, "results.speed") == selected(PHYSICS, "results.physics[9]") == []


def test_an_installed_program_has_no_documents(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="do not come with the installed program"):
        quotations(tmp_path)
