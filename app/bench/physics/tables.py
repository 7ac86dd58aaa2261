"""The physics beside what was published: thesis Tables 4.1 and 4.2, the paper's Table I, and the bars."""

import time
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from app.bench.common.measure import Row
from app.bench.physics.page import physics_page
from app.bench.physics.runs import (
    ManualCase,
    OptimisedCase,
    manual_cases,
    optimised_cases,
    paper_cases,
    tipped,
    walked,
)
from app.published.reference import PublishedRun, open_reference
from app.published.walked import Walked
from app.store.named_file import write_named
from core.errors import InputError
from core.physics.findings import TILT_LIMIT
from core.physics.parameters import physics_set
from core.published.tables import published_table
from solver_jobs import simulate_variations

FALL_MARGIN = 0.003
"""Our own gaits with at least this margin must not fall, m."""
MOST_WALK_SECONDS = 2.0
LEAST_REALTIME = 15.0
MOST_VARIATION_SECONDS = 60.0
VARIATIONS = 64
CORES = 2
"""On which the variations are computed."""


def bench_physics(reference: Path | None = None, page: Path | None = None) -> list[Row]:
    """Runs every case and prints the tables.

    Args:
        reference: folder with the published data; without it only the printed figures stand beside ours.
        page: where a printable page with plots goes; None for none.

    Raises:
        InputError: the data is not in the folder, or the page has nowhere to go.
    """
    data = None if reference is None else open_reference(reference)
    if page is not None:
        require_page(page)
    optimised = list(optimised_cases(data))
    manual = list(manual_cases(data))
    if page is not None:
        write_named(page, physics_page(optimised, manual))
    return [
        *published_rows(optimised),
        *(own_row(case) for case in optimised),
        *(manual_row(case) for case in manual),
        *(row for label, run in paper_cases() for row in paper_rows(label, run)),
        *_bars(optimised),
    ]


def require_page(page: Path) -> None:
    """Makes sure that the page has somewhere to go.

    Raises:
        InputError: its folder is not there.
    """
    if not page.parent.is_dir():
        raise InputError(f"{page.parent} is no folder; name a file in one that exists.", "--report")


def published_rows(cases: Sequence[OptimisedCase]) -> list[Row]:
    """Table 4.2: the published trajectories, in their physics and in ours; none without the data."""
    return [_again_row(case, case.again, case.theirs) for case in cases if case.again and case.theirs]


def _again_row(case: OptimisedCase, ours: Walked, theirs: PublishedRun) -> Row:
    return {
        "published trajectory": f"{case.gait} {case.step * 1000:.0f} mm",
        "thesis_mm": _mm(case.thesis),
        "their_body_mm": _mm(theirs.body_error),
        "their_lean_deg": _deg(float(theirs.tilts.max())),
        "cut_mm": _mm(case.cut),
        **_figures(ours),
    }


def own_row(case: OptimisedCase) -> Row:
    """Table 4.2: our own gait of the same step."""
    return {
        "own gait": f"{case.gait} {case.step * 1000:.0f} mm",
        "thesis_mm": _mm(case.thesis),
        "asked_margin_mm": _mm(case.margin),
        **_figures(case.own),
        "robot_s": round(case.own.robot_seconds, 1),
        "is_at_most_thesis": _yes(_reaches(case)),
    }


def manual_row(case: ManualCase) -> Row:
    """Table 4.1, by its own definition and as an error of the way."""
    return {
        "by hand": f"{case.family} {case.version}",
        "thesis_mm": _mm(case.thesis),
        "their_lean_deg": None if case.theirs is None else _deg(float(case.theirs.tilts.max())),
        "ours_their_way_mm": _mm(case.own.standing_error),
        **_figures(case.own),
    }


def paper_rows(label: str, run: Walked) -> list[Row]:
    """Table I: body and feet 1 to 4."""
    ours = (run.report.body_error, *run.report.feet_error)
    lean = {"lean_deg": _deg(run.report.max_tilt), "falls": _yes(run.report.fell)}
    theirs = [None if error is None else error / 1000.0 for error in _printed(label)]
    rows: list[Row] = []
    for who, errors, rest in (
        ("paper", theirs, {"lean_deg": None, "falls": None}),
        ("ours", ours, lean),
    ):
        cells = {name: _mm(error) for name, error in zip(("body", "1", "2", "3", "4"), errors, strict=True)}
        rows.append({"paper Table I, mm": label, "who": who, **cells, **rest})
    return rows


def _printed(label: str) -> Iterable[float | None]:
    """Errors of body and feet in a row of the paper's table, mm."""
    return published_table("p-1").row(label).printed.values()


def _figures(run: Walked) -> Row:
    figures = run.report
    return {
        "feet_mm": _mm(figures.feet_mean_error),
        "body_mm": _mm(figures.body_error),
        "lean_deg": _deg(figures.max_tilt),
        "falls": _yes(figures.fell),
        "slide_mm": _mm(run.longest_slide),
        "margin_mm": _mm(figures.min_margin),
        "goes_mm": _mm(figures.distance),
        "planned_mm": _mm(figures.planned_distance),
        "at_force_limit": f"{figures.saturation.max() * 100:.0f} %",
    }


def _reaches(case: OptimisedCase) -> bool:
    return case.own.report.feet_mean_error <= case.thesis


def _bars(cases: Sequence[OptimisedCase]) -> list[Row]:
    """The figures to reach."""
    reached = sum(_reaches(case) for case in cases)
    safe = [case for case in cases if case.margin >= FALL_MARGIN]
    runs = [run for case in safe for run in (case.own, case.own_scales)]
    falls = sum(run.report.fell for run in runs)
    leans = sum(run.report.max_tilt > TILT_LIMIT for run in runs)
    out = [
        run for case in cases for name in ("published", "scales") if (run := tipped(case, physics_set(name)))
    ]
    seen = sum(run.report.fell or run.report.max_tilt > TILT_LIMIT for run in out)
    walk = next(case.own_scales for case in cases if case.gait == "walk")
    return [
        _bar("own gaits at or below thesis Table 4.2", f"{len(cases)} of {len(cases)}", reached, len(cases)),
        _bar(
            f"own gaits with {FALL_MARGIN * 1000:.0f} mm margin that do not fall",
            "all",
            len(runs) - falls,
            len(runs),
        ),
        _bar(
            f"of them that lean by at most {np.degrees(TILT_LIMIT):.0f}°", "–", len(runs) - leans, len(runs)
        ),
        _bar("gaits of −5 mm margin that fall or lean", "all", seen, len(out)),
        *_speed(walk),
    ]


def _bar(what: str, bar: str, count: int, of: int) -> Row:
    return _limit(what, bar, f"{count} of {of}", count == of)


def _speed(walk: Walked) -> list[Row]:
    """Computing time of one walk, and of its variations, in seconds of processor time."""
    what = f"walk of {walk.problem.waypoints.count} knots, {walk.robot_seconds:.0f} s on the robot, one core"
    begin = time.process_time()
    alone = walked(walk.problem)
    seconds = time.process_time() - begin
    realtime = alone.robot_seconds / seconds
    begin = time.process_time()
    varied = simulate_variations(walk.problem, count=VARIATIONS)
    whole = (time.process_time() - begin) / CORES
    walks = f"{sum(run.walks for run in varied)} of {VARIATIONS} walk"
    return [
        _limit(
            what,
            f"≤ {MOST_WALK_SECONDS:.0f} s",
            f"{seconds:.2f} s",
            seconds <= MOST_WALK_SECONDS,
        ),
        _limit(
            "the same", f"≥ {LEAST_REALTIME:.0f} × real time", f"{realtime:.0f}", realtime >= LEAST_REALTIME
        ),
        _limit(
            f"{VARIATIONS} variations of it, {CORES} cores",
            f"≤ {MOST_VARIATION_SECONDS:.0f} s",
            f"{whole:.0f} s, {walks}",
            whole <= MOST_VARIATION_SECONDS,
        ),
    ]


def _limit(what: str, bar: str, measured: str, holds: bool) -> Row:
    return {"what": what, "bar": bar, "measured": measured, "holds": _yes(holds)}


def _mm(value: float | None) -> float | None:
    # Adding 0 turns −0.0 into 0.0.
    return None if value is None else round(value * 1000, 2) + 0.0


def _deg(value: float) -> float:
    return round(float(np.degrees(value)), 2)


def _yes(value: bool) -> str:
    return "yes" if value else "no"
