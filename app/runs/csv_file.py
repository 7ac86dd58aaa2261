"""A run as CSV: a row a telemetry, with what was commanded then, in mm."""

from __future__ import annotations

import math

from app.runs.record import RunRecord
from core.wire.messages import MOTORS


def run_csv(record: RunRecord) -> str:
    """Time in s since the run began, the robot's state, commanded and measured strokes in mm.

    What was commanded is empty before the first message.
    """
    names = [f"{kind}_h{motor + 1}" for kind in ("commanded", "measured") for motor in range(MOTORS)]
    lines = [",".join(["t", "state", *names])]
    series = record.series
    rows = zip(series.times, record.states_told, record.commanded_mm, series.measured_mm, strict=True)
    for time, state, commanded, measured in rows:
        numbers = ["" if math.isnan(value) else f"{value:.4f}" for value in (*commanded, *measured)]
        lines.append(",".join([f"{time:.4f}", state, *numbers]))
    return "\n".join(lines) + "\n"
