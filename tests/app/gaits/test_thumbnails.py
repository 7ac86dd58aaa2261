"""The footfalls of a gait as text for the small picture in its line of the list."""

from __future__ import annotations

import pytest

from app.gaits.thumbnails import COLUMNS, footfall_columns
from core.library.library import library
from core.motion.contact_timeline import timeline_from_rows


def columns(row: str) -> str:
    (digits,) = footfall_columns(timeline_from_rows([row], 0.4))
    return f"{int(digits, 16):0{COLUMNS}b}"


def test_a_sample_is_stretched_to_its_columns() -> None:
    assert columns("1011") == "1" * 11 + "0" * 11 + "1" * 22


def test_a_sample_a_column_stays_as_it_is() -> None:
    row = "1" * 20 + "0" * 4 + "1" * 20
    assert columns(row) == row


@pytest.mark.parametrize("samples", [45, 130, 2000])
def test_the_shortest_swing_of_a_long_gait_is_seen(samples: int) -> None:
    for at in (0, samples // 2, samples - 1):
        row = ["1"] * samples
        row[at] = "0"
        assert columns("".join(row)).count("0") == 1


def test_every_gait_of_the_library_has_a_short_text_for_each_foot() -> None:
    for entry in library().values():
        digits = footfall_columns(entry.gait.timeline)
        assert [len(foot) for foot in digits] == [COLUMNS // 4] * entry.gait.timeline.leg_count
