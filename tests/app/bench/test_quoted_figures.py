"""Figures in documents are bound to what their commands print."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.bench.printed_figures import agrees, differences, lost_figures, selected
from app.bench.quoted_figures import Kind, Quotation, read_document, read_documents
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


def quoted(text: str) -> tuple[Quotation, ...]:
    """The commands of a page."""
    return read_document("docs/walks.md", text).quotations


def shown(text: str, rules: str, content: Json) -> list[tuple[str, str]]:
    """Figures that differ, and what is printed in place of each, of a text with one quick command."""
    (quotation,) = quoted(f"{text}\n\n<!-- footfall gaits --json\n{rules}\n-->\n")
    return [(one.figure, one.printed) for one in [*lost_figures(quotation), *differences(quotation, content)]]


def test_figures_that_are_printed_again_do_not_differ() -> None:
    step, feet, times = quoted(TEXT)
    assert [one.kind for one in (step, feet, times)] == [Kind.QUICK, Kind.SLOW, Kind.MACHINE]
    assert [one.benchmarks for one in (step, feet, times)] == [(), ("physics",), ("exact", "live")]
    assert differences(step, FRONTIER) == []
    assert differences(feet, PHYSICS) == []


def test_a_figure_that_differs_is_named_with_its_line_and_what_is_printed_now() -> None:
    step, _, _ = quoted(TEXT)
    (found,) = differences(step, FRONTIER | {"max_step": 0.0214})
    assert (found.file, found.line, found.figure, found.printed) == ("docs/walks.md", 3, "28.5 mm", "21.4")
    assert found.command == "footfall frontier walk --json"


def test_a_cell_that_differs_is_named_with_its_row() -> None:
    _, feet, _ = quoted(TEXT)
    rows = PHYSICS["results"]["physics"]
    changed = {"results": {"physics": [rows[0], rows[1], rows[2] | {"feet_mm": 0.3}]}}
    assert [(one.line, one.figure, one.printed) for one in differences(feet, changed)] == [(15, "–", "0.3")]


def test_a_figure_that_is_not_printed_any_more_differs() -> None:
    step, feet, _ = quoted(TEXT)
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
        ("<!-- footfall gaits --json\n28.5 mm: x\n-->", "neither “figure = path” nor"),
    ],
)
def test_a_comment_of_another_form_is_refused_with_its_line(comment: str, sentence: str) -> None:
    with pytest.raises(InputError, match=r"docs/walks\.md, line 3") as refusal:
        quoted(f"A step of 28.5 mm.\n\n{comment}\n")
    assert sentence in refusal.value.sentence


@pytest.mark.parametrize(
    "table", ["| gait | feet |\n|---|---|", "| gait | feet |\n|---|---|\n| walk | 1 | 2 |"]
)
def test_a_column_without_cells_is_refused(table: str) -> None:
    with pytest.raises(InputError, match="no whole column “feet”"):
        quoted(f"{table}\n\n<!-- footfall gaits --json\nfeet = x\n-->\n")


@pytest.mark.parametrize("figure", ["28.4 mm", "8.5 mm", "28", "28.5 m", "feet"])
def test_a_figure_that_left_the_text_differs_beside_the_others(figure: str) -> None:
    found = shown("A step of 28.5 mm.", f"{figure} = x\n28.5 mm = x", {"x": 1})
    assert found == [(figure, "not in the text above"), ("28.5 mm", "1.0")]


def test_rules_take_the_places_of_a_text_in_order() -> None:
    text, rules = "From 3.0 to 3.0 mm.", "3.0 = a\n3.0 = b"
    assert shown(text, rules, {"a": 3, "b": 3}) == []
    assert shown(text, rules, {"a": 3, "b": 4}) == [("3.0", "4.0")]
    assert shown(text, f"{rules}\n3.0 mm = a", {"a": 3, "b": 3}) == [("3.0 mm", "not in the text above")]


def test_two_comments_below_a_text_share_its_places() -> None:
    first, second = quoted(
        "A walk of 3 mm takes 3 s.\n\n  <!-- footfall gaits --json\n  3 = a\n  -->\n"
        "  <!-- footfall gaits --json\n  3 = b\n  -->\n"
    )
    assert [figure.places[0].begin for one in (first, second) for figure in one.figures] == [10, 21]


def test_numbers_that_no_rule_takes_are_listed_with_their_line() -> None:
    assert [(one.line, one.numbers) for one in read_document("docs/walks.md", TEXT).uncompared] == []
    text = TEXT.replace("| walk | 0.17", "| walk, 10 mm | 0.17").replace(
        "in 1,250 s", "in 1,250 s (2026-11-22: 1e-10)"
    )
    found = read_document("docs/walks.md", text).uncompared
    assert [(one.line, one.numbers) for one in found] == [(4, ("2026-11-22", "1e-10")), (14, ("10",))]
    steps = "1. Lift 2 feet.\n2. Go 3 mm.\n\n<!-- footfall gaits --json\n3 mm = x\n-->\n"
    assert [one.numbers for one in read_document("docs/walks.md", steps).uncompared] == [("2",)]


@pytest.mark.parametrize(
    ("rule", "content", "printed"),
    [
        ("3 to 9 mm = x", {"x": 3}, "3.0"),
        ("3 = max x", {"x": None}, "not numbers alone at x"),
        ("3 = max x[*].y", {"x": [{"y": 3}, {"y": None}]}, "not numbers alone at x[*].y"),
        ("3 = x", {"x": [3]}, "[3]"),
        ("3 = x", {"x": {"y": 3}}, "{'y': 3}"),
        ("3 = x", {"x": True}, "True"),
        ("3 = x", {"x": float("nan")}, "nan"),
    ],
)
def test_a_value_of_another_kind_differs(rule: str, content: Json, printed: str) -> None:
    (found,) = shown("From 3 to 9 mm.", rule, content)
    assert found[1] == printed


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
        ("yes", 1, False),
        ("16 of 16", "16 of 16", True),
        ("16 of 99", "16 of 16", False),
        ("3.00 (8)", 3.0, False),
        ("7", True, False),
        ("–", None, True),
        ("–", "", True),
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
    assert selected(PHYSICS, "results.physics[1:3].feet_mm") == [0.172, None]
    assert selected(PHYSICS, "results.speed") == selected(PHYSICS, "results.physics[9]") == []


def test_an_installed_program_has_no_documents(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="do not come with the installed program"):
        read_documents(tmp_path)
