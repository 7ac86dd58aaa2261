"""Two runs, aligned by waypoint, as JSON content."""

from app.common.json import Json
from app.runs.figures import run_figures
from app.runs.record import RunRecord
from core.runs.comparison import AlignedRun, compare_runs


def comparison_content(one: RunRecord, other: RunRecord) -> Json:
    """Two runs at the waypoints that both reached.

    Args:
        one: the run that is looked at.
        other: the one beside it.

    Returns:
        `waypoints` and `laps`, 0-based, and how far the commanded strokes of both are apart at most; `runs`
        with the times, s, and strokes, mm, of each, and its figures up to there.
    """
    both = compare_runs(one.series, other.series)
    apart = abs(both.one.target_mm - both.other.target_mm).max(initial=0.0)
    return {
        "waypoints": both.indices.tolist(),
        "laps": both.laps.tolist(),
        "apart_mm": round(float(apart), 4),
        "runs": [_run(record, run) for record, run in ((one, both.one), (other, both.other))],
    }


def _run(record: RunRecord, run: AlignedRun) -> Json:
    figures = run_figures(record.plan, run.series)
    return {
        "id": record.content["id"],
        "state": record.content["state"],
        "reached": record.content.get("reached"),
        "count": record.content.get("count"),
        "seconds": run.seconds.round(3).tolist(),
        "move_seconds": run.move_seconds.round(3).tolist(),
        "error_mm": run.error_mm.round(4).tolist(),
        "measured_mm": run.measured_mm.round(4).tolist(),
        "commanded_mm": run.target_mm.round(4).tolist(),
        "figures": {**figures, "start_seconds": run_figures(record.plan, record.series)["start_seconds"]},
    }
