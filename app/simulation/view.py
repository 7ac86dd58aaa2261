"""What pages are shown of a simulated motion: thinned, on the plan's time axis."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from app.common.json import Json, finite
from core.arrays import Floats
from core.motion.support_polygon import stability_margins
from core.physics.findings import SWING_LIMIT, TILT_LIMIT
from core.physics.metrics import bearing, carrying, rotations, soles
from core.physics.motion import SimulatedMotion, plan_times
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport
from core.physics.variations import VariedRun

SHOWN_A_SECOND = 20.0
"""Samples a simulated second that are kept and shown; arrivals come on top."""

SHOWN_SLIP = 0.0003
"""A move in which a standing foot slid further leaves a mark, m."""


def motion_content(problem: SimulationProblem, motion: SimulatedMotion, report: SimulationReport) -> Json:
    """A simulated motion for 3D and plots, thinned, on the plan's time axis; SI but for strokes."""
    kept = shown_samples(motion)
    times = plan_times(problem, motion)
    carries = carrying(motion)[kept]
    bears = bearing(motion)[kept]
    margins = stability_margins(motion.centre_world[kept, :2], motion.feet_world[kept], bears)
    margins = np.where(bears.sum(axis=1) >= 3, margins, np.nan)
    content: Json = finite(
        {
            "times": _rounded(times[kept], 5),
            "robot_times": _rounded(motion.times[kept], 4),
            "body": _rounded(motion.body_world[kept], 6),
            "attitude": _rounded(motion.attitude[kept], 6),
            "feet": _rounded(motion.feet_world[kept], 6),
            "contact": carries.tolist(),
            "strokes_mm": _rounded(motion.strokes[kept].reshape(len(kept), -1) * 1000.0, 3),
            "margins_mm": _rounded(margins * 1000.0, 3),
            "slips": _slips(problem, motion, report),
        }
    )
    return content


def shown_samples(motion: SimulatedMotion) -> list[int]:
    """Samples that are shown: evenly in simulated time, the last one, and every arrival."""
    begin, end = float(motion.times[0]), float(motion.times[-1])
    even = np.arange(begin, end, 1.0 / SHOWN_A_SECOND)
    found = np.searchsorted(motion.times, even - 1e-9)
    return sorted({*found.tolist(), *motion.arrivals.tolist(), len(motion.times) - 1})


def _slips(problem: SimulationProblem, motion: SimulatedMotion, report: SimulationReport) -> list[Json]:
    """Where soles slid that should have stood: from and to on the ground, of each move, m."""
    marks = []
    places = soles(problem, motion, rotations(motion.attitude))
    for move, foot in np.argwhere(report.slip_samples > SHOWN_SLIP):
        ends = motion.arrivals[move - 1], motion.arrivals[move]
        marks.append(
            {
                "foot": int(foot),
                "waypoint": int(move),
                "plan_time": float(problem.times[move]),
                "length": float(report.slip_samples[move, foot]),
                "way": [_rounded(places[at, foot], 6) for at in ends],
            }
        )
    return marks


def _rounded(values: Floats, digits: int) -> list[Any]:
    rounded: list[Any] = np.round(values, digits).tolist()
    return rounded


def way_words(way: Json) -> str:
    """How much of way and turn is made, in words, of a report's content."""
    parts = []
    if way["asked"]:
        parts.append(f"goes {way['made'] * 1000:.1f} of {way['asked'] * 1000:.1f} mm")
    if way["asked_turn"]:
        made, asked = np.degrees([way["made_turn"], way["asked_turn"]])
        parts.append(f"turns {made:.1f} of {asked:.1f}°")
    return " and ".join(parts) or f"ends {way['gap'] * 1000:.1f} mm from where the plan ends"


def report_sentence(figures: Json) -> str:
    """How a simulated run came out, in words, of its report's content."""
    if figures["fell"]:
        return f"The robot falls over at {figures['fell_time']:.1f} s."
    if figures["ended_early"]:
        return str(figures["ended_early"])
    tilt = np.degrees(figures["max_tilt"])
    way = way_words(figures["way"])
    if figures["max_tilt"] > TILT_LIMIT:
        return f"The robot tips: it leans by {tilt:.1f}° at {figures['max_tilt_time']:.1f} s, and {way}."
    if max(figures["swing_load"]) > SWING_LIMIT:
        return f"The robot rocks onto feet that should be in the air, and {way}."
    return f"The robot stays on its feet, leans by {tilt:.1f}° at most and {way}."


def variations_content(runs: Sequence[VariedRun]) -> Json:
    """What came of each variation, and the share that walks; SI."""
    content: Json = finite(
        {
            "count": len(runs),
            "share": sum(run.walks for run in runs) / len(runs),
            "runs": [
                {
                    "name": run.variation.words,
                    "walks": run.walks,
                    "fell": run.fell,
                    "max_tilt": run.max_tilt,
                    "swing_load": run.swing_load,
                    "distance": run.distance,
                    "way_share": run.way_share,
                    "turn_share": run.turn_share,
                    "feet_error": run.feet_error,
                    "ended_early": run.ended_early,
                }
                for run in runs
            ],
        }
    )
    return content
