"""Cells of exported tables: nothing begins a formula, numbers and lab files stay as they are."""

from __future__ import annotations

import csv

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.common.table_cell import safe_header, table_cell

DANGEROUS = [
    "=1+1",
    "+cmd",
    "-cmd|x!A0",
    "@SUM(A1)",
    "\t1",
    "\r1",
    "\tx",
    "\rx",
    "\nx",
    " =1",
    "＝1",
    "-",
    "'=1",
]


@pytest.mark.parametrize("text", DANGEROUS)
def test_a_text_that_would_begin_a_formula_is_marked_as_text(text: str) -> None:
    assert table_cell(text) == f"'{text}"


@pytest.mark.parametrize(
    "text", ["", "-1.50", "+3", "-2e-05", ".5", "Walk", "Walk-2", "a=b", "'quoted'", "–5"]
)
def test_numbers_and_other_texts_stay_as_they_are(text: str) -> None:
    assert table_cell(text) == text


@given(st.text(alphabet="'=+-@\t\r 1.ae", max_size=8))
def test_no_two_texts_become_one(text: str) -> None:
    cell = table_cell(text)
    assert cell == text or cell == f"'{text}"
    is_marked = cell.startswith("'") and table_cell(cell) != cell
    assert (cell[1:] if is_marked else cell) == text
    assert not cell.startswith(("=", "@", "\t", "\r"))


@pytest.mark.parametrize("header", ["Column1,Column2", "0,1", "1.0,-2.0", '"a, b",c', "x;=y", ""])
def test_a_header_of_the_lab_stays_to_the_last_byte(header: str) -> None:
    for end in ("\n", "\r\n"):
        text = f"{header}{end}1.0,-2.0{end}"
        assert safe_header(text) == text


def test_a_header_that_holds_formulas_is_marked_and_the_numbers_stay() -> None:
    text = '=HYPERLINK(A1),"=x, ""y""",-z,plain\r\n-1.0,2.0,3.0,4.0\r\n'
    line, rest = safe_header(text).split("\r\n", 1)
    assert next(csv.reader([line])) == ["'=HYPERLINK(A1)", '\'=x, "y"', "'-z", "plain"]
    assert rest == "-1.0,2.0,3.0,4.0\r\n"
    assert safe_header(safe_header(text)) == safe_header(text)
    assert safe_header("a\r=x,b\n1,2\n") == "a =x,b\n1,2\n"
    assert safe_header("\ufeff=x\n1\n") == "'\ufeff=x\n1\n"
