"""The benchmark of moves: what is in docs is what the board does now."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest

from app.bench.robot.moves import fastest_walk, published_walk
from app.bench.robot.walked_moves import WalkedMoves, walks_of
from tests.support.reference import reference_path
from tests.support.studio_process import PROJECT

pytestmark = pytest.mark.heavy


def kept(number: int) -> WalkedMoves:
    return walks_of(json.loads((PROJECT / "docs/fastest_moves.json").read_text()))[number]


def test_the_fastest_walk_is_the_one_in_docs() -> None:
    walk, known = fastest_walk(), kept(1)
    assert [move.feet for move in walk.moves] == [move.feet for move in known.moves]
    assert walk.seconds == pytest.approx(known.seconds, rel=0.06)
    assert walk.way == pytest.approx(known.way, rel=0.02)
    for move in walk.moves:
        assert len(move.ramps) in (1, 2)
        ends = [0.0, *(time for ramp in move.ramps for time in ramp), move.seconds]
        assert all(after > before for before, after in pairwise(ends))


def test_the_published_walk_is_the_one_in_docs() -> None:
    walk, known = published_walk(reference_path("")), kept(0)
    assert (len(walk.moves), walk.way) == (40, 10.0)
    assert walk.with_ramps(0) == known.with_ramps(0)
    assert walk.seconds == pytest.approx(known.seconds, abs=0.01)
    assert walk.ramp_seconds == pytest.approx(known.ramp_seconds, abs=0.01)
