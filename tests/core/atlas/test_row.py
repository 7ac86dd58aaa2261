"""Rows of an atlas, and the hash over them."""

from __future__ import annotations

from dataclasses import replace

from core.atlas.row import AtlasRow, RowStatus, results_hash

ROW = AtlasRow(3, RowStatus.SOLVED, "", 16.5, 0.002, 0.0, 0.006, 0.005, 0.8, 1.55)


def test_the_hash_changes_with_a_figure_and_not_with_rounding() -> None:
    first = results_hash([ROW])
    assert results_hash([replace(ROW, speed=0.002 + 1e-9)]) == first
    assert results_hash([replace(ROW, turn_rate=-1e-12)]) == first
    assert results_hash([replace(ROW, speed=0.002002)]) != first
    assert results_hash([replace(ROW, status=RowStatus.FAILED)]) != first
    assert results_hash([]) != first


def test_rows_agree_within_rounding() -> None:
    assert ROW.agrees_with(replace(ROW, speed=0.0020009))
    assert not ROW.agrees_with(replace(ROW, speed=0.002003))
    nothing = AtlasRow(3, RowStatus.INFEASIBLE, "Prevented by: margin.")
    assert nothing.agrees_with(replace(nothing, reason="another"))
    assert not ROW.agrees_with(nothing)
