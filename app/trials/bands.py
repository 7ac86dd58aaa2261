"""Several trials over each other as JSON content, in the frame of their plans; cm."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from app.common.json import Json
from app.trials.figures import CM
from app.trials.record import TrialRecord
from core.arrays import Floats, interpolated
from core.trials.alignment import track_of_motion
from core.trials.band import TrialBand, trial_band


def band_content(records: Sequence[TrialRecord]) -> Json:
    """The trials' mean way, how far they lie apart, each of them, and the first plan that one has.

    `place` is from above; `way` is along the direction of the plan, or else of the trials.

    Args:
        records: trials of as many feet and iterations each.

    Raises:
        InputError: they are not.
    """
    tracks = [track_of_motion(record.track, record.alignment) for record in records]
    band = trial_band(tracks, [record.ends for record in records])
    plans = (_plan_ways(record, band.iterations) for record in records)
    plan = next((way for way in plans if way is not None), None)
    begin = np.mean([track.feet[0] for track in tracks], axis=0)
    return {
        "trials": [{"id": r.content["id"], "name": r.content["name"]} for r in records],
        "iterations": np.round(band.iterations, 4).tolist(),
        "has_plan": plan is not None,
        "feet": _feet(band, plan, begin),
    }


def _plan_ways(record: TrialRecord, iterations: Floats) -> Floats | None:
    """(m, feet, 2) the plan's feet less their first, at iterations of the walk, m."""
    planned = record.planned
    if planned is None:
        return None
    share = iterations / iterations[-1]
    times = planned.times[0] + share * (planned.times[-1] - planned.times[0])
    return interpolated(times, planned.times, planned.feet - planned.feet[0])


def _feet(band: TrialBand, plan: Floats | None, begin: Floats) -> list[Json]:
    mean = band.mean
    direction = (mean if plan is None else plan)[-1].mean(axis=0)
    along = band.along(direction if np.hypot(*direction) > 0 else np.array([1.0, 0.0]))
    planned = None if plan is None else TrialBand(band.iterations, plan[None]).along(direction)[0]
    return [
        {
            "place": {
                "mean": _places(begin[foot] + mean[:, foot]),
                "low": _places(begin[foot] + band.low[:, foot]),
                "high": _places(begin[foot] + band.high[:, foot]),
                "trials": [_places(begin[foot] + way[:, foot]) for way in band.ways],
                "plan": None if plan is None else _places(begin[foot] + plan[:, foot]),
            },
            "way": {
                "mean": _cm(along[..., foot].mean(axis=0)),
                "low": _cm(along[..., foot].min(axis=0)),
                "high": _cm(along[..., foot].max(axis=0)),
                "trials": [_cm(one) for one in along[..., foot]],
                "plan": None if planned is None else _cm(planned[:, foot]),
            },
            "end_spread_cm": float(band.end_spread[foot]) * CM,
        }
        for foot in range(mean.shape[1])
    ]


def _places(way: Floats) -> Json:
    return {"x": _cm(way[:, 0]), "y": _cm(way[:, 1])}


def _cm(values: Floats) -> Any:
    return np.round(values * CM, 3).tolist()
