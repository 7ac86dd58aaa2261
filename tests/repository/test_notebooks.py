"""The notebooks of the documentation: kept with what they show, listed, and running."""

from __future__ import annotations

import ast
import re
import sys
from typing import Any

import pytest

from tests.notebooks.__main__ import main
from tests.notebooks.listing import FOLDER, NAMES, Cell, cells_of, kept_content, path_of
from tests.notebooks.running import METADATA, NotebookError, executed, left_on_screen, run
from tests.support.studio_process import PROJECT

PAGE = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
LISTED = re.compile(r"^\| \[[^\]]+\]\(notebooks/(\w+)\.ipynb\) \| [^|]{10,} \|$", re.MULTILINE)
PLACES = re.compile(r"/(?:home|root|tmp|work|Users|var)/|[A-Z]:\\|[0-9]{4}-[0-9]{2}-[0-9]{2}T")
"""Paths of a computer, and times of day."""
MOST_BYTES, CELLS = 150_000, range(6, 16)
COUNT = 11
QUICK = ("06_limbs_held_up", "10_export_for_others")
"""The notebooks that `python -m tests --ci` runs."""
ALL_SECONDS = 300
"""Of all notebooks together, on a machine that does nothing else."""


@pytest.fixture(params=NAMES)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def cells(name: str) -> list[Cell]:
    return cells_of(kept_content(name))


def code_of(cells: list[Cell]) -> list[Cell]:
    """The cells that are run."""
    return [cell for cell in cells if cell.is_code]


def prose_of(cells: list[Cell]) -> str:
    """All that is written between the cells of code."""
    return "\n\n".join(cell.source for cell in cells if not cell.is_code)


def test_each_notebook_is_listed_with_a_line_and_stands_in_the_order_of_the_files() -> None:
    assert tuple(LISTED.findall(PAGE)) == NAMES
    assert len(NAMES) == COUNT
    assert {path.name for path in FOLDER.iterdir()} == {path_of(name).name for name in NAMES}


def test_a_notebook_is_short_and_small(name: str, cells: list[Cell]) -> None:
    assert len(cells) in CELLS
    assert path_of(name).stat().st_size < MOST_BYTES


def test_a_notebook_begins_with_a_heading_and_ends_with_where_to_go_on(cells: list[Cell]) -> None:
    assert re.match(r"# .+\n\n.+", cells[0].source)
    assert not cells[0].is_code
    assert not cells[-1].is_code
    assert LINK.findall(cells[-1].source)
    assert "import footfall as ff" in code_of(cells)[0].source


def test_its_links_lead_to_files(cells: list[Cell]) -> None:
    targets = LINK.findall(prose_of(cells))
    assert [target for target in targets if not (FOLDER / target).exists()] == []


def test_every_cell_was_run_in_order_and_none_failed(cells: list[Cell]) -> None:
    code = code_of(cells)
    assert [cell.number for cell in code] == list(range(1, len(code) + 1))
    kinds = [kind for cell in code for kind in cell.kinds]
    assert "error" not in kinds
    assert sum(bool(cell.outputs) for cell in code) >= len(code) - 2, "what has no output shows nothing"
    assert any("text/html" in kind for kind in kinds)


def test_a_cell_that_ends_with_a_value_shows_it(cells: list[Cell]) -> None:
    for cell in code_of(cells):
        last = ast.parse(cell.source).body[-1]
        is_value = isinstance(last, ast.Expr) and "print(" not in (
            ast.get_source_segment(cell.source, last) or ""
        )
        assert any("text/plain" in kind for kind in cell.kinds) == is_value, cell.id


def test_nothing_is_kept_of_where_and_when_it_was_run(name: str, cells: list[Cell]) -> None:
    assert kept_content(name)["metadata"] == METADATA
    assert [cell.id for cell in cells if cell.metadata] == []
    assert len({cell.id for cell in cells}) == len(cells)
    for cell in cells:
        assert PLACES.findall(cell.shown) == [], cell.id
        assert "%|" not in cell.shown, "a progress bar"


def test_a_number_in_the_prose_is_shown_by_a_cell(cells: list[Cell]) -> None:
    shown = "\n".join(f"{cell.source}\n{cell.shown}" for cell in code_of(cells))
    prose = re.sub(r"`[^`]*`|\]\([^)]*\)", "", prose_of(cells))
    assert [number for number in re.findall(r"\d+\.\d+|\d\d+", prose) if number not in shown] == []


def test_a_name_that_no_notebook_has_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["nothing"]) == 2
    assert NAMES[0] in capsys.readouterr().err


def test_of_a_bar_that_removes_itself_nothing_is_left() -> None:
    text = "Said before.\n\rPhysics:  10%|█ | \rPhysics: 90%|████ | \r" + 30 * " " + "\r"
    assert left_on_screen(text) == "Said before.\n"


WHERE = """
import os, sys, footfall
print(sys.executable, footfall.__file__, os.listdir(), os.listdir(os.environ["XDG_DATA_HOME"]))
"""


def notebook_of(source: str) -> Any:
    """A notebook of one cell."""
    from nbformat.v4 import new_code_cell, new_notebook

    return new_notebook(cells=[new_code_cell(source)])


def test_a_notebook_is_run_by_this_python_on_this_program_in_empty_folders() -> None:
    (cell,) = cells_of(run(notebook_of(WHERE), "where"))
    assert " ".join(cell.shown.split()) == f"{sys.executable} {PROJECT / 'footfall.py'} [] []"


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("1 / 0", "ZeroDivisionError"),
        ("import warnings; warnings.warn('not so')", "cell 1 warns: .*not so"),
        ("import os; os.getcwd()", "names the folder"),
    ],
)
def test_a_notebook_that_fails_warns_or_names_its_folder_is_refused(source: str, words: str) -> None:
    with pytest.raises(NotebookError, match=words):
        run(notebook_of(source), "bad")


def require_same(name: str) -> float:
    """Runs a notebook, and compares the kinds of its outputs with those that are kept; seconds."""
    done = executed(name)
    now, kept = cells_of(done.content), cells_of(kept_content(name))
    assert [(cell.id, cell.kinds) for cell in now] == [(cell.id, cell.kinds) for cell in kept]
    return done.seconds


@pytest.mark.heavy
@pytest.mark.parametrize("quick", QUICK)
def test_a_quick_notebook_runs_and_shows_what_is_kept(quick: str) -> None:
    require_same(quick)


@pytest.mark.soak
def test_every_notebook_runs_and_all_together_take_at_most_five_minutes() -> None:
    seconds = {name: require_same(name) for name in NAMES}
    assert sum(seconds.values()) < ALL_SECONDS, seconds
