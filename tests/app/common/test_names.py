"""Names that are taken get a number."""

from __future__ import annotations

import pytest

from app.common.names import free_name
from core.gait.gait import MOST_NAME


@pytest.mark.parametrize(
    ("name", "taken", "free"),
    [
        ("Walk", set(), "Walk"),
        ("Walk", {"Walk"}, "Walk 2"),
        ("Walk", {"Walk", "Walk 2", "Walk 3"}, "Walk 4"),
        ("Walk", {"Walk", "Walk 3"}, "Walk 2"),
        ("x" * MOST_NAME, {"x" * MOST_NAME}, "x" * (MOST_NAME - 2) + " 2"),
    ],
)
def test_the_first_number_that_is_free_is_taken(name: str, taken: set[str], free: str) -> None:
    assert free_name(name, taken) == free
