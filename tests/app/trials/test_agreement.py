"""A trial has one net movement wherever it stands: list, page, comparisons, reports, tables, command line."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import footfall as ff
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.trials.comparison import TrialComparison
from app.trials.figures import FIGURES, PACE
from app.trials.photos import TrialPhotos
from app.trials.report.page import net_cells, number
from app.trials.report.service import TrialReportService
from app.trials.service import TrialDescription, TrialService, compared
from app.trials.simulated_feet import TrialSimulations
from app.trials.tables import table_csv, table_latex
from app.vision.services import VisionServices
from solver_jobs import Simulator
from tests.support.command import run
from tests.support.trials.tracks import stepping_track
from tests.support.trials.walking import walk_planned

TRACK = stepping_track((-0.008, 0.003), 3, noise=0.0005)
"""Noisy feet that go towards −x, where the largest excursions towards +x and +y are far from net."""
WORDS = TrialDescription("there", "Ada", 3.0, 3, gait="walk", gait_name="Walk")


def row_of(page: str, caption: str, name: str) -> list[str]:
    """The cells of a row of a report's table, by the beginnings of its caption and of the row."""
    table = re.search(rf"<caption>{re.escape(caption)}.*?</table>", page, re.DOTALL)
    assert table is not None, caption
    row = re.search(rf'<th scope="row">{re.escape(name)}.*?</tr>', table[0], re.DOTALL)
    assert row is not None, name
    return re.findall(r"<td>(.*?)</td>", row[0])


def same(found: Mapping[str, Any], wanted: Mapping[str, Any], keys: tuple[str, ...]) -> bool:
    return {key: found[key] for key in keys} == pytest.approx({key: wanted[key] for key in keys})


def test_a_trial_has_the_same_figures_wherever_it_stands(
    database: Database, vision: VisionServices, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    service = TrialService(database)
    comparison = TrialComparison(service, TrialSimulations(TrialReferenceStore(database), Simulator()))
    photos = TrialPhotos(service, database, tmp_path, vision)
    reports = TrialReportService(service, comparison, photos, RunService(database))
    summary = service.add(TRACK, WORDS, walk_planned(3, knows_sent=False))
    figures, pace = summary["figures"], {key: summary[key] for key in PACE}
    assert abs(figures["distance"] - figures["net_distance"]) > 1.0
    cells = net_cells(figures)

    (line,) = service.lines()
    assert same(line, {**figures, **pace}, (*FIGURES, *PACE))
    (group,) = compared([line])
    assert same(group, {**figures, **pace}, (*FIGURES, *PACE))
    assert group["distances"] == pytest.approx([figures["net_distance"]])
    (row,) = [row for row in comparison.figures(summary["id"])["rows"] if row["source"] == "tracked"]
    assert same(row, {**figures, **pace}, (*FIGURES, "seconds"))

    (written,) = csv.DictReader(io.StringIO(table_csv([group])))
    published = {
        "Net distance (cm)": "net_distance",
        "Net angle (deg)": "net_angle_deg",
        "Net error (%)": "net_error_percent",
        "Distance as published (cm)": "distance",
        "Extent distance (cm)": "extent_distance",
    }
    for title, key in published.items():
        assert written[title] == f"{figures[key]:.2f}"
        assert f" {written[title]} &" in table_latex([group])

    page = reports.trial(summary["id"])
    assert row_of(page, "Net movement, mean of the feet", "tracked")[1:4] == cells
    assert row_of(page, "Net movement, from first to last frame", "mean") == cells
    assert row_of(page, "Movement as published", "mean")[3] == number(figures["extent_distance"], 2)
    page = reports.compared()
    assert row_of(page, "Net movement, from first to last frame", "Walk")[2:5] == cells
    assert row_of(page, "Net movement of the trials", "there")[2:] == cells

    path = tmp_path / "there.csv"
    path.write_text(service.track(summary["id"]))
    trial = ff.trial(path, expect=3.0, iterations=3)
    assert same(trial.mean, {**figures, **pace}, (*FIGURES, *PACE))
    assert repr(trial).endswith(f"net {figures['net_distance']:.2f} cm at {figures['net_angle_deg']:.1f}°")
    for step, part in zip(trial.figures["files"][0]["steps"], summary["parts"], strict=True):
        assert step["distance"] == pytest.approx(part["net_distance"])
    _, text, _ = run(capsys, "trial", str(path), "--expect", "3")
    wanted = " ".join(f"{figures[key]:9.2f}" for key in FIGURES)
    assert next(one for one in text.splitlines() if "mean" in one).endswith(wanted)
