"""The figures of time and path: merging halves the published walk, and ours takes a third of it."""

from __future__ import annotations

from functools import cache

import pytest

from app.bench.common.measure import Row
from app.bench.robot.walk import bench_walk
from core.wire.robot_time import OVERRUN
from tests.support.reference import REFERENCE, reference_path

pytestmark = pytest.mark.heavy


@cache
def rows() -> list[Row]:
    reference = REFERENCE if REFERENCE.exists() else None
    return bench_walk(reference, [(0.0, None), (0.001, None), (0.001, 1.0)])


def row(walk: str, merge_mm: float, bound: float | None) -> Row:
    return next(
        r for r in rows() if (r["walk"], r.get("merge_mm"), r.get("stop_bound_s")) == (walk, merge_mm, bound)
    )


def test_merging_halves_the_published_walk_and_stays_on_its_path() -> None:
    reference_path("")
    every, merged = row("published", 0.0, None), row("published", 1.0, None)
    assert 29.0 < every["robot_s"] < 30.5
    assert merged["of_published"] <= 0.5
    assert merged["path_off_mm"] <= 1.0
    assert merged["worst_motor_mm"] <= 1.0
    bounded = row("published", 1.0, 1.0)
    assert merged["robot_s"] < bounded["robot_s"] < every["robot_s"]
    assert 1.0 < bounded["stop_s"] <= 1.0 + OVERRUN


def test_a_walk_made_for_the_firmware_takes_a_third_of_the_published_time() -> None:
    ours = row("ours, for the firmware", 1.0, None)
    # The published walk takes 29.6 s in this profile, whether its file is at hand or not.
    assert ours["robot_s"] <= 0.35 * 29.5
    assert ours["checks"] == "passed, 0 findings"
    assert ours["least_rise_mm"] >= 1.0
    assert ours["path_off_mm"] <= 1.0
