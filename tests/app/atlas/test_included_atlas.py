"""The included atlas: small, as this program solves it, with the gaits *For this robot*."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing

import pytest

from app.atlas.atlas_file import AtlasFile
from app.atlas.included import COUNT, INCLUDED, included_space
from app.atlas.opening import opened_point
from app.common.version import VERSION
from core.atlas.row import RowStatus
from core.data.tables import data_table
from core.library.for_robot import ATLAS
from core.library.library import Group, group_ids, library

ENTRIES = {item["id"]: item for item in data_table("for_robot.toml")["gait"]}
NEAR_TURN = 0.03
"""By what share the fastest turn of the atlas may be smaller than that of the library."""


@pytest.fixture(scope="module")
def atlas() -> Iterator[AtlasFile]:
    with closing(AtlasFile(INCLUDED[ATLAS])) as opened:
        yield opened


def test_it_is_of_this_program_and_small(atlas: AtlasFile) -> None:
    assert atlas.path.stat().st_size < 2_000_000
    assert sum(atlas.counts().values()) == COUNT
    assert atlas.counts()[RowStatus.SOLVED] > COUNT / 10
    assert atlas.version == VERSION
    assert atlas.robot_hash == atlas.space.robot_hash
    assert atlas.space.hash == included_space().hash


def test_every_gait_for_this_robot_but_one_turn_has_a_number_in_it(atlas: AtlasFile) -> None:
    assert list(ENTRIES) == list(group_ids(Group.FOR_ROBOT))
    # The only turns on the spot in the atlas are the fastest ones.
    assert [gait_id for gait_id, item in ENTRIES.items() if "atlas" not in item] == ["rotate-45"]
    for gait_id, item in ENTRIES.items():
        if "atlas" not in item:
            continue
        gait, (row, has) = library()[gait_id].gait, atlas.entry(item["atlas"])
        assert gait.notes.endswith(f"Atlas gait {item['atlas']}.")
        first = gait.order.index(1)
        assert has["order"] == ",".join(map(str, gait.order[first:] + gait.order[:first]))
        assert (has["margin"], has["clearance"]) == (gait.options.margin, gait.options.clearance)
        assert has["stop_bound"] == gait.options.stop_bound
        assert (has["step_x"], has["step_y"]) == pytest.approx(gait.step[:2], abs=1e-6)
        off = 1.0 - has["turn"] / gait.step[2] if gait.step[2] else has["turn"]
        assert (0.0 <= off < NEAR_TURN) if gait_id == "fast-turn" else abs(off) < 1e-5
        assert row.status is RowStatus.SOLVED


@pytest.mark.parametrize("gait_id", ["fast-c-gait", "fast-turn", "soft-walk"])
def test_its_gaits_are_solved_again_alike(atlas: AtlasFile, gait_id: str) -> None:
    opened = opened_point(atlas, ENTRIES[gait_id]["atlas"])
    assert opened.row.status is RowStatus.SOLVED
    assert opened.row.seconds == pytest.approx(opened.stored.seconds, rel=0.02)
