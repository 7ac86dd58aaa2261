"""The benchmark of Stop under floods: every flood has its row, and what is cut off is counted."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.bench.robot import flooded_stop
from app.bench.robot.crowd import NOBODY, Crowd
from app.bench.robot.flooded_stop import NO_FLOOD, FloodedStudio, all_attacks, bench_floods
from app.bench.robot.floods import Attack, Flood
from app.bench.robot.processes import Studio, emulator_process

CONNECTIONS = 60
MOST_P99_MS = 100.0
"""What people are promised of Stop (docs/network.md)."""
STOP_MS = 500.0
"""The longest that any Stop takes, beside pages and programs with the token too."""


def test_every_kind_of_flood_is_measured_from_one_address_and_from_many() -> None:
    attacks = all_attacks()
    assert {kind for attack in attacks.values() for kind in attack.kinds} == set(Flood)
    assert {len(attack.sources) for attack in attacks.values()} == {1, flooded_stop.ADDRESSES}
    assert all(
        attack.connections > 1024
        for name, attack in attacks.items()
        if name != NO_FLOOD and attack.crowd == NOBODY
    )
    assert {attack.crowd.pages for attack in attacks.values()} == {0, 20}


@pytest.mark.soak
def test_each_flood_has_a_row_and_the_last_one_is_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    half = Attack((Flood.HALF_HEADS,), CONNECTIONS, crowd=Crowd(1, 1, 1, 1, 1))
    attacks = {NO_FLOOD: Attack((), 0), "half": half}
    monkeypatch.setattr(flooded_stop, "all_attacks", lambda: attacks)
    rows = bench_floods(2)
    assert [row["flood"] for row in rows] == [NO_FLOOD, "half", "every flood"]
    assert [row["stops"] for row in rows] == [2, 2, 2]
    assert rows[0]["connections_per_s"] == 0 < rows[1]["connections_per_s"]
    assert all(0 < row["median_ms"] <= row["p99_ms"] <= row["max_ms"] for row in rows)


@pytest.mark.heavy
def test_a_stop_that_is_cut_off_is_asked_again_and_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with emulator_process() as robot:
        flooded = FloodedStudio(tmp_path, robot)
        try:
            asked, ask = [], Studio.ask

            def cut_off_once(studio: Studio, method: str, path: str, content: None = None) -> object:
                asked.append(path)
                if len(asked) == 1:
                    raise ConnectionResetError
                return ask(studio, method, path, content)

            monkeypatch.setattr(Studio, "ask", cut_off_once)
            assert flooded.under(Attack((), 0), 2).repeated == 1
        finally:
            flooded.close()


@pytest.mark.soak
def test_stop_is_on_the_line_in_time_under_every_flood() -> None:
    rows = bench_floods()
    assert len(rows) == len(all_attacks()) + 1
    limits = {name: MOST_P99_MS if one.crowd == NOBODY else STOP_MS for name, one in all_attacks().items()}
    limits["every flood"] = STOP_MS
    late = {row["flood"]: row["p99_ms"] for row in rows if row["p99_ms"] > limits[str(row["flood"])]}
    assert late == {}
    assert max(row["max_ms"] for row in rows) <= STOP_MS
    assert [row["repeated"] for row in rows] == [0] * len(rows)
