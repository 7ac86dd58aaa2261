"""The page with the map of an atlas: what it says, and that its columns hold the atlas's numbers."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.atlas.atlas_file import AtlasFile
from app.atlas.export import export_atlas
from app.atlas.included import INCLUDED
from app.atlas.map_columns import DIGITS, choice_column, figure_column, number_column, range_column
from app.atlas.map_page import MOST_REASONS, map_page
from app.common.version import VERSION
from core.atlas.row import FIGURES, AtlasRow, RowStatus
from core.atlas.space import space_from_table
from core.errors import InputError
from solver_jobs import drawn_points
from tests.app.atlas.map_atlas import SPACE, invented_atlas

BYTES_A_GAIT = 60


@pytest.fixture(scope="module")
def atlas(tmp_path_factory: pytest.TempPathFactory) -> Iterator[AtlasFile]:
    made = invented_atlas(tmp_path_factory.mktemp("map") / "all & <b>.sqlite")
    yield made
    made.close()


def data(page: str) -> dict[str, Any]:
    found = re.search(r'<script type="application/json" id="atlas">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    content: dict[str, Any] = json.loads(found[1])
    return content


def codes(column: dict[str, Any], count: int) -> list[int]:
    digits, packed = column["digits"], column["packed"]
    assert len(packed) == digits * count
    read = []
    for gait in range(count):
        code = 0
        for digit in packed[gait * digits : (gait + 1) * digits]:
            code = code * 64 + DIGITS.index(digit)
        read.append(code)
    return read


def values(column: dict[str, Any], count: int) -> list[Any]:
    if "values" in column:
        return [column["values"][code] for code in codes(column, count)]
    missing = 64 ** column["digits"] - 1
    return [
        float("nan") if code == missing else (column["low"] + code) * column["step"]
        for code in codes(column, count)
    ]


def test_it_says_how_many_gaits_came_to_what_and_of_what_it_was_made(atlas: AtlasFile) -> None:
    page = map_page(atlas)
    assert "263 gaits drawn: 200 solved, 60 infeasible, 3 failed" in page
    for text in (VERSION, atlas.robot_hash, atlas.space.hash, atlas.hash, "deltawalker"):
        assert text in page
    assert "is the result of a search and no proof" in page
    assert "one cycle in mid-walk" in page
    assert '<th scope="row">Margin</th><td>40</td>' in page
    assert '<th scope="row">Clearance and &lt;stop&gt;</th><td>20</td>' in page


def test_its_columns_hold_every_solved_gait_with_the_figures_of_the_atlas(atlas: AtlasFile) -> None:
    content = data(map_page(atlas))
    entries = list(atlas.entries(RowStatus.SOLVED))
    columns = {column["name"]: values(column, 200) for column in content["columns"]}
    assert values(content["ids"], 200) == [row.number for row, _ in entries]
    for name in FIGURES:
        assert columns[name] == pytest.approx([getattr(row, name) for row, _ in entries], abs=1e-9)
    for name in set(columns) - set(FIGURES):
        written = [parameters[name] for _, parameters in entries]
        if isinstance(written[0], float):
            assert columns[name] == pytest.approx(written, abs=1e-7)
        else:
            assert columns[name] == written


def test_a_gait_takes_few_bytes(atlas: AtlasFile) -> None:
    content = data(map_page(atlas))
    packed = sum(len(column["packed"]) for column in (content["ids"], *content["columns"]))
    assert packed <= BYTES_A_GAIT * 200


def test_texts_of_an_atlas_cannot_end_the_script(atlas: AtlasFile) -> None:
    page = map_page(atlas)
    assert page.count("</script>") == 2
    assert "all &amp; &lt;b&gt;.sqlite" in page
    assert "<b>" not in page
    assert data(page)["open"] == [f"footfall atlas open '{atlas.path}' ", " -o gait.json"]


def test_the_command_of_the_included_atlas_names_it_as_commands_do() -> None:
    (name,) = INCLUDED
    with closing(AtlasFile(INCLUDED[name])) as included:
        assert data(map_page(included))["open"][0] == f"footfall atlas open {name} "


def test_nothing_is_fetched_from_elsewhere(atlas: AtlasFile) -> None:
    assert not re.search(r"https?://|@import|url\(|\ssrc=", map_page(atlas))


def test_an_atlas_without_a_solved_gait_has_a_page(tmp_path: Path) -> None:
    content = data(map_page(invented_atlas(tmp_path / "none.sqlite", solved=0, infeasible=4, failed=0)))
    assert (content["count"], content["columns"]) == (0, [])
    assert "No gait is infeasible" in map_page(invented_atlas(tmp_path / "empty.sqlite", 0, 0, 0))


def test_rare_reasons_are_counted_together(tmp_path: Path) -> None:
    atlas = AtlasFile(tmp_path / "reasons.sqlite", SPACE)
    rows = [AtlasRow(k, RowStatus.INFEASIBLE, f"Reason {k % 15}.") for k in range(40)]
    atlas.add(list(zip(drawn_points(SPACE, 0, 40), rows, strict=True)))
    page = map_page(atlas)
    assert page.count('<th scope="row">') == MOST_REASONS + 1
    assert '<th scope="row">3 other reasons</th><td>6</td>' in page


def test_numbers_of_the_robot_are_keys_and_its_gaits_make_no_file(tmp_path: Path) -> None:
    table = {"vary": {"step_x": [0.01, 0.03], "robot": {"leg": {"link_length": [0.048, 0.052]}}}}
    content = data(
        map_page(invented_atlas(tmp_path / "robot.sqlite", space=space_from_table(table, "a file")))
    )
    column = next(one for one in content["columns"] if one["name"] == "robot.leg.link_length")
    assert column["is_number"]
    assert min(values(column, 200)) == pytest.approx(0.048, abs=1e-4)
    assert content["open"][1] == ""


def test_an_atlas_of_drawn_gaits_says_that_its_figures_are_of_an_iteration(tmp_path: Path) -> None:
    table = {"kind": "drawn", "vary": {"step_x": [0.01, 0.03], "lost": ["", "2"]}}
    page = map_page(invented_atlas(tmp_path / "drawn.sqlite", space=space_from_table(table, "a file")))
    assert "one iteration of a drawn gait" in page
    lost = next(column for column in data(page)["columns"] if column["name"] == "lost")
    assert lost["values"] == ["", "2"]


def test_it_is_an_export_like_the_others(atlas: AtlasFile, tmp_path: Path) -> None:
    assert export_atlas(atlas, tmp_path / "map.html") == 263
    assert (tmp_path / "map.html").read_text() == map_page(atlas)
    with pytest.raises(InputError, match=r"must end in \.csv, \.parquet or \.html"):
        export_atlas(atlas, tmp_path / "map.htm")


@given(st.lists(st.floats(-1e3, 1e3) | st.just(float("nan")), min_size=1, max_size=30))
def test_figures_come_back_to_their_last_decimal(numbers: list[float]) -> None:
    read = values(figure_column(np.array(numbers)), len(numbers))
    assert read == pytest.approx(numbers, abs=0.6e-6, nan_ok=True)


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=30))
def test_numbers_of_a_range_come_back_to_a_millionth_of_it(numbers: list[float]) -> None:
    read = values(range_column(np.array(numbers)), len(numbers))
    assert read == pytest.approx(numbers, abs=max(1e-6 * np.ptp(numbers), 1e-9), rel=1e-12)


@given(st.lists(st.sampled_from(["1,2,3,4", "1,3,2,4", ""]), max_size=20))
def test_choices_come_back(choices: list[str]) -> None:
    if len(set(choices)) > 1:
        assert values(choice_column(choices), len(choices)) == choices
    else:
        assert choice_column(choices)["packed"] == ""


def test_a_single_number_takes_one_digit() -> None:
    assert number_column(np.full(5, 7.0), 1.0) == {"low": 7, "step": 1.0, "digits": 1, "packed": "AAAAA"}
