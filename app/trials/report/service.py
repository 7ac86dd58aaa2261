"""Reports of trials as one HTML file: a trial with plan, physics, photos and origin, and gaits compared."""

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from app.gaits.verdict_views import override_words
from app.runs.plan_json import ran_plan
from app.runs.service import RunService
from app.trials.comparison import TrialComparison
from app.trials.figures import ROBOT
from app.trials.photos import TrialPhotos
from app.trials.record import TrialRecord
from app.trials.report.comparison import compared_parts
from app.trials.report.page import (
    NET_HEAD,
    facts,
    foot_name,
    footer,
    moment,
    net_cells,
    number,
    page,
    photo,
    plot,
    table,
    text,
)
from app.trials.report.plots import ways_from_above, ways_over_time
from app.trials.service import TrialService
from core.arrays import Floats
from core.errors import FootfallError
from core.robot.model import load_robot
from core.vision.track import FootTrack

_PUBLISHED = (
    "Movement as published: largest excursions (thesis chapter 5) and extents (Tables A.1 to A.4), angles on "
    "the platform"
)
_PUBLISHED_HEAD = ("cm", "angle °", "error %", "extent cm")

_LINES = {"tracked": "solid", "simulated": "dashed", "planned": "dotted"}


EXAMPLE = "Example, made by simulation: no robot did this."

_ENDS = {
    "hand": "moved by hand",
    "run": "by the log of the run",
    "tracks": "found from the steps of the tracked feet",
}


class TrialReportService:
    """Writes reports; every method may be called from any thread.

    Args:
        service: the trials.
        comparison: their plans and physics.
        photos: their photos.
        runs: the runs that they are of.
    """

    def __init__(
        self, service: TrialService, comparison: TrialComparison, photos: TrialPhotos, runs: RunService
    ) -> None:
        self._service = service
        self._comparison = comparison
        self._photos = photos
        self._runs = runs
        self._colours = load_robot(ROBOT).colours

    def trial(self, trial: str) -> str:
        """One trial; its simulation only where it is there already."""
        record, summary = self._service.record(trial), self._service.summary(trial)
        comparison, sources = self._comparison.figures(trial), self._comparison.sources(record)
        key = _key(record, sources)
        parts = [
            f'<p class="note">{text(EXAMPLE)}</p>' if summary["is_example"] else "",
            facts(_words(summary)),
            f'<p class="note">{text(summary["note"])}</p>' if summary["note"] else "",
            _beside_table(comparison["rows"]),
            f'<p class="quiet">{text(comparison["simulation"]["remark"])}</p>',
            *_astray(summary),
            plot(
                ways_from_above(sources, self._colours),
                "above",
                f"From above, in the platform's frame, cm. {key}",
            ),
            plot(
                ways_over_time(_along(record, sources), self._colours, "s"),
                "time",
                f"Ways over time, along the direction in which the tracked feet went. {key}",
            ),
            _iterations(summary),
            self._movements(
                "Net movement, from first to last frame, angles on the platform", NET_HEAD, summary, net_cells
            ),
            self._movements(_PUBLISHED, _PUBLISHED_HEAD, summary, _published_cells),
            self._slips(summary["slip"]),
            *self._gaps(summary, record),
            *self._pictures(trial),
            "<h2>Origin</h2>",
            facts(self._origin(trial, summary)),
        ]
        return page(summary["name"], parts, footer())

    def compared(self) -> str:
        """All gaits by steps compared, with the trials of each over each other."""
        lines = self._service.lines()
        return page("Gaits compared", compared_parts(lines, self._comparison.band, self._colours), footer())

    def _movements(
        self,
        caption: str,
        head: Sequence[str],
        summary: Mapping[str, Any],
        cells: Callable[[Mapping[str, float]], list[str]],
    ) -> str:
        figures = summary["figures"]
        rows = [(foot_name(i, self._colours), cells(foot)) for i, foot in enumerate(figures["feet"])]
        rows.append(("mean", cells(figures)))
        if summary["plan"] is not None:
            rows.append(("planned", cells(summary["plan"]["figures"])))
        return table(caption, ["", *head], rows)

    def _slips(self, slip: Sequence[Sequence[float]]) -> str:
        rows = [
            (foot_name(i, self._colours), [number(max(stands), 2), number(sum(stands) / len(stands), 2)])
            for i, stands in enumerate(slip)
        ]
        return table("Slip of standing feet, cm", ["", "largest", "mean"], rows)

    def _gaps(self, summary: Mapping[str, Any], record: TrialRecord) -> Iterator[str]:
        times = record.track.times
        rows = [
            (
                foot_name(gap["foot"] - 1, self._colours),
                [number(times[gap[end]], 2) for end in ("first", "last")],
            )
            for gap in summary["gaps"]
        ]
        if rows:
            yield table("Gaps, filled by straight lines", ["", "from s", "to s"], rows)

    def _pictures(self, trial: str) -> Iterator[str]:
        photos = self._photos.photos(trial)
        if photos:
            pictures = [photo(self._photos.picture(trial, one["id"]), one["caption"]) for one in photos]
            yield f'<h2>Photos</h2><div class="pictures">{"".join(pictures)}</div>'

    def _origin(self, trial: str, summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
        """Where everything comes from."""
        yield "Trial", trial
        yield "Track, SHA-256", hashlib.sha256(self._service.track(trial).encode()).hexdigest()
        yield "Gait", f"{summary['gait_name'] or '–'} ({summary['gait'] or 'no id'})"
        sent = self._service.sent(trial)
        if sent is not None:
            yield "Waypoints, SHA-256", ran_plan(sent).waypoints.content_hash
        if summary["run"]:
            yield from self._run_words(summary["run"])
        source = summary["source"]
        if source is not None:
            yield "Camera setup", f"{source['setup_name']}, revision {source['setup_revision']}"
            yield "Video", source["video"] or source["camera"] or "–"

    def _run_words(self, run: str) -> Iterator[tuple[str, str]]:
        yield "Run", run
        try:
            content = self._runs.summary(run)
        except FootfallError as error:
            yield "", error.sentence
            return
        yield "Robot held by", content["by"] or "–"
        if content["override"] is not None:
            yield "Approved in spite of", override_words(content["override"])
        yield "Started", content["started"]
        yield "Ended", content["ended"] or "–"
        yield "Result", content["sentence"] or content["state"]


def _words(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    yield "By", summary["by"] or "–"
    yield "Added", moment(summary["made"])
    yield "Gait", summary["gait_name"] or "–"
    yield "Wanted", f"{number(summary['expected_cm'], 2)} cm in {summary['iterations']} iterations"
    lengths = number(summary["body_lengths_s"], 4)
    yield "Speed", f"{number(summary['speed_mm_s'], 2)} mm/s, {lengths} body lengths/s"
    yield "Ends of iterations", _ENDS[summary["ends_from"]]
    yield "Frames", f"{summary['frames']}, {number(summary['frame_rate'], 1)} a second"
    yield (
        "Gaps",
        f"{len(summary['gaps'])}, {summary['filled']} places filled" if summary["filled"] else "none",
    )
    plan = summary["plan"]
    if plan is not None:
        apart = number(max(plan["gaps_cm"]) * 10.0, 1)
        yield (
            "Placement",
            f"plan turned by {number(plan['turn_deg'], 1)}°, feet of the first frame ± {apart} mm",
        )


def _beside_table(rows: Sequence[Mapping[str, Any]]) -> str:
    cells = [
        (
            row["source"],
            [number(row["seconds"], 1), *net_cells(row), number(row["gap_mm"], 1)],
        )
        for row in rows
    ]
    head = ["", "s", *NET_HEAD, "feet from tracked, mm"]
    return table("Net movement, mean of the feet, angles on the platform", head, cells)


def _published_cells(movement: Mapping[str, float]) -> list[str]:
    keys = {"distance": 2, "angle_deg": 1, "error_percent": 0, "extent_distance": 2}
    return [number(movement[key], decimals) for key, decimals in keys.items()]


def _iterations(summary: Mapping[str, Any]) -> str:
    def pace(part: Mapping[str, float]) -> list[str]:
        return [number(part["seconds"], 1), number(part["speed_mm_s"], 2)]

    rows = [
        (f"iteration {index}", [*net_cells(part)[:2], *pace(part)])
        for index, part in enumerate(summary["parts"], 1)
    ]
    step = summary["step_mean"]
    rows.append(("mean", [number(step["distance"], 2), number(step["angle_deg"], 1), *pace(step)]))
    return table("Net movement in each iteration", ["", "net cm", "angle °", "s", "mm/s"], rows)


def _astray(summary: Mapping[str, Any]) -> Iterator[str]:
    if summary["plan"] is not None and summary["plan"]["astray_sentence"]:
        yield f"<p>{text(summary['plan']['astray_sentence'])}</p>"


def _key(record: TrialRecord, sources: Mapping[str, FootTrack]) -> str:
    """What the lines of the plots mean."""
    lines = ", ".join(f"{source} {line}" for source, line in _LINES.items() if source in sources)
    unseen = "; grey where a foot was not seen" if record.track.filled.any() else ""
    return f"{lines.capitalize()}{unseen}."


def _along(record: TrialRecord, sources: Mapping[str, FootTrack]) -> dict[str, tuple[Floats, Floats]]:
    """Ways of the feet along the tracked direction, cm, at times of the trial from its begin."""
    net = (record.track.feet[-1] - record.track.feet[0]).mean(axis=0)
    direction = net / max(math.hypot(*net), 1e-9)
    clock, count = record.track.times - record.track.times[0], len(record.ends)
    lines = {}
    for source, motion in sources.items():
        times = clock
        if motion is not record.track:
            shares = (motion.times - motion.times[0]) / (motion.times[-1] - motion.times[0])
            frames = np.interp(shares * count, np.arange(count + 1), [0, *record.ends])
            times = np.interp(frames, np.arange(clock.size), clock)
        lines[source] = times, (motion.feet - motion.feet[0]) @ direction * 100.0
    return lines
