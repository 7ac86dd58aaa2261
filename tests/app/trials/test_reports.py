"""Reports of trials: one file without scripts that needs nothing from elsewhere, with everything in it."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from app.export.drawing import dashed
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.trials import comparison as limits
from app.trials.comparison import TrialComparison
from app.trials.photos import TrialPhotos
from app.trials.report.page import number
from app.trials.report.plots import ways_from_above
from app.trials.report.service import TrialReportService
from app.trials.service import TrialDescription, TrialService
from app.trials.simulated_feet import TrialSimulations
from app.vision.services import VisionServices
from core.arrays import FARTHEST
from core.errors import NotFoundError
from core.vision.track import FootTrack
from solver_jobs import Simulator
from tests.core.vision.test_image_header import picture
from tests.support.simulated_walk import walk_problem
from tests.support.trials.tracks import stepping_track
from tests.support.trials.walking import walk_planned, walked

WORDS = TrialDescription(
    "on <glass>", "Ada", 1.0, 1, note="new tape & a cable", gait="walk", gait_name="Walk"
)


@pytest.fixture
def service(database: Database) -> TrialService:
    return TrialService(database)


@pytest.fixture
def photos(service: TrialService, database: Database, tmp_path: Path, vision: VisionServices) -> TrialPhotos:
    return TrialPhotos(service, database, tmp_path, vision)


@pytest.fixture
def reports(service: TrialService, photos: TrialPhotos, database: Database) -> TrialReportService:
    comparison = TrialComparison(service, TrialSimulations(TrialReferenceStore(database), Simulator()))
    return TrialReportService(service, comparison, photos, RunService(database))


class Whole(HTMLParser):
    """Takes a page apart; what is opened must be closed in order."""

    BARE = frozenset({"meta", "img", "br", "rect", "line", "polyline", "circle"})

    def __init__(self, page: str) -> None:
        super().__init__()
        self.opened: list[str] = []
        self.tags: list[str] = []
        self.words = ""
        self.feed(page)
        assert self.opened == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        if tag not in self.BARE:
            self.opened.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.opened.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words += data + " "


def whole(page: str) -> Whole:
    """The page, which must need nothing from elsewhere."""
    found = Whole(page)
    assert "script" not in found.tags
    assert not re.search(r"https?://(?!www.w3.org/2000/svg)|url\(|@import|<link", page)
    return found


def test_a_trials_report_has_figures_plots_note_photos_and_origin(
    service: TrialService, photos: TrialPhotos, reports: TrialReportService
) -> None:
    track = walked()
    filled = track.filled.copy()
    filled[100:140, 2] = True
    trial = service.add(replace(track, filled=filled), WORDS, walk_planned())["id"]
    photo = photos.add(trial, picture("PNG", (60, 40)), "tape.png", "Ada")["id"]
    photos.caption(trial, photo, "the <new> tape")
    report = whole(reports.trial(trial))
    for words in (
        "on <glass>",
        "new tape & a cable",
        "the <new> tape",
        "Placement",
        "Walk (walk)",
        "1, 40 places",
        "found from the steps of the tracked feet",
        "x right, y up on the platform, cm",
        "10 s",
    ):
        assert words in report.words
    assert walk_problem().waypoints.content_hash in report.words
    assert re.search(r"Gaps, filled by straight lines.*foot 3 *7\.\d\d *10\.\d\d", report.words, re.DOTALL)
    assert (report.tags.count("svg"), report.tags.count("img")) == (2, 1)
    assert report.tags.count("polyline") > 100


def test_a_report_says_that_ends_were_moved_by_hand_and_that_a_walk_went_astray(
    service: TrialService, reports: TrialReportService
) -> None:
    track = stepping_track((0.0, 0.01), 2)
    trial = service.add(track, TrialDescription("by hand", "Ada", 2.0, 2), walk_planned())
    ends = [trial["found_ends"][0] - 20, trial["found_ends"][1]]
    assert "moved by hand" not in whole(reports.trial(trial["id"])).words
    service.change(trial["id"], 1, {"ends": ends})
    report = whole(reports.trial(trial["id"])).words
    assert "moved by hand" in report
    assert "of the plan. Did a foot slip" in report


def test_a_trial_without_plan_photos_or_note_has_a_shorter_report(
    service: TrialService, reports: TrialReportService
) -> None:
    trial = service.add(
        stepping_track((0.01, 0.0), 1), TrialDescription("bare", "", 1.0, 1, run="gone"), None
    )["id"]
    report = whole(reports.trial(trial))
    assert "There is no run “gone”" in report.words
    assert not {"Photos", "Placement", "planned", "Waypoints"} & set(report.words.split())
    with pytest.raises(NotFoundError):
        reports.trial("none")


def test_gaits_compared_come_with_their_trials_over_each_other(
    service: TrialService, reports: TrialReportService, monkeypatch: pytest.MonkeyPatch
) -> None:
    for _ in range(2):
        service.add(walked(), WORDS, walk_planned())
    service.add(
        stepping_track((0.01, 0.0), 2), TrialDescription("two", "Eve", 2.0, 2, gait_name="Amble"), None
    )
    report = whole(reports.compared())
    assert report.words.index("Amble, 1.0 cm a step") < report.words.index("Walk, 1.0 cm a step")
    assert "Their ends lie apart by foot 1 0.00" in report.words
    assert report.tags.count("svg") == 2
    assert report.words.count("on <glass>") == 2
    monkeypatch.setattr(limits, "MOST_TOGETHER", 1)
    report = whole(reports.compared())
    assert "Choose 1 to 1 different trials." in report.words
    assert report.tags.count("svg") == 1


def test_no_trials_make_an_empty_comparison(reports: TrialReportService) -> None:
    assert whole(reports.compared()).tags.count("table") == 1


@pytest.mark.parametrize(
    ("value", "decimals", "words"), [(None, 1, "–"), (-0.04, 1, "0.0"), (-1.25, 1, "−1.2"), (3, 2, "3.00")]
)
def test_a_number_is_written_as_people_read_it(value: float | None, decimals: int, words: str) -> None:
    assert number(value, decimals) == words


def test_a_broken_line_has_pieces_and_gaps_of_their_lengths_round_corners() -> None:
    corner = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]
    pieces = list(dashed(corner, "#000000", 1.0, 4.0, 2.0))
    lengths = [
        sum(float(np.hypot(x2 - x1, y2 - y1)) for (x1, y1), (x2, y2) in pairwise(piece.points))
        for piece in pieces
    ]
    assert lengths == pytest.approx([4.0, 4.0, 4.0, 2.0])
    assert (pieces[1].points[0], pieces[1].points[-1]) == ((6.0, 0.0), (10.0, 0.0))
    assert pieces[-1].points == ((10.0, 8.0), (10.0, 10.0))


def test_ways_that_go_far_have_a_wider_grid() -> None:
    counts = []
    for metres in (0.1, FARTHEST):
        feet = np.zeros((2, 4, 2))
        feet[1, :, 0] = metres
        track = FootTrack(np.array([0.0, 1.0]), feet, np.zeros((2, 4), dtype=np.bool_))
        counts.append(len(ways_from_above({"tracked": track}, ["#2e9e5b"] * 4).shapes))
    assert counts[0] < 120
    assert counts[1] < 500
