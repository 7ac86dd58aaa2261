"""Figures of the documents: bound to commands that there are, and printed again by the quick ones."""

from __future__ import annotations

import shlex

import pytest

from app.bench.printed_figures import lost_figures
from app.bench.quoted_figures import Kind, Quotation, read_documents
from app.cli.parser import make_parser
from tests.support.command import run_json
from tests.support.studio_process import PROJECT

FOUND = [quotation for document in read_documents(PROJECT) for quotation in document.quotations]


def commands(quotation: Quotation) -> list[list[str]]:
    """Words of each command of a line, without the program's name."""
    parts = [shlex.split(part) for part in quotation.command.split("&&")]
    return [part[1:] for part in parts if part[0] == "footfall"]


def test_documents_name_their_commands() -> None:
    assert len(FOUND) > 20
    assert {quotation.kind for quotation in FOUND} == set(Kind)
    assert {"README.md", "docs/figures.md", "docs/physics.md"} <= {quotation.file for quotation in FOUND}


def test_documents_have_the_figures_that_their_comments_name() -> None:
    assert [one for quotation in FOUND for one in lost_figures(quotation)] == []


def test_every_command_beside_a_figure_is_one_that_the_program_takes(
    capsys: pytest.CaptureFixture[str],
) -> None:
    parser = make_parser()
    for words in {tuple(words) for quotation in FOUND for words in commands(quotation)}:
        try:
            parser.parse_args(words)
        except SystemExit:
            pytest.fail(f"footfall {shlex.join(words)}: {capsys.readouterr().err}")


def test_a_command_whose_figures_are_compared_prints_json() -> None:
    for quotation in FOUND:
        if quotation.kind is not Kind.MACHINE:
            assert commands(quotation)[-1][-1] == "--json", quotation


@pytest.mark.heavy
def test_quick_commands_print_the_figures_of_the_documents_again(capsys: pytest.CaptureFixture[str]) -> None:
    status, content = run_json(capsys, "bench", "--docs")
    assert content["differ"] == []
    assert status == 0
    assert content["compared"] > 20
