"""What was learned, as pages and scripts get it: cm and degrees, as tables of trials are."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from app.common.json import Json, finite
from app.simulation.problem import physics_content
from app.trials.figures import CM
from core.identification.learning import Learned, Prediction
from core.identification.parameters import FitParameter

WAYS = {
    "as planned": "As planned",
    "default": "Physics, usual parameters",
    "fitted": "Physics, fitted",
    "left out": "Physics, gait left out",
    "left out, line": "Physics and a line, gait left out",
    "ratio, left out": "Line, gait left out",
    "kind left out": "Physics, kind left out",
    "kind left out, line": "Physics and a line, kind left out",
    "ratio, kind left out": "Line, kind left out",
}
"""Ways of foretelling in words; a line is measured = a × wanted + b, or a × simulated + b."""


def learned_content(learned: Learned, cuts: Sequence[float]) -> Json:
    """Everything of it as JSON content.

    Args:
        learned: what was learned.
        cuts: (gaits,) most that was cut off a stroke of each, m.
    """
    content: Json = finite(
        {
            "defaults": learned.defaults.name,
            "defaults_title": learned.defaults.title,
            "spread_cm": learned.spread[0] * CM,
            "spread_deg": math.degrees(learned.spread[1]),
            "noise": list(learned.fit.noise),
            "simulations": learned.simulations,
            "parameters": [_parameter(learned, place) for place in range(len(learned.parameters))],
            "gaits": [_gait(learned, gait, cut) for gait, cut in enumerate(cuts)],
            "foretold": [_prediction(learned, way) for way in learned.predicted],
            "physics": physics_content(learned.physics),
        }
    )
    return content


def _parameter(learned: Learned, place: int) -> Json:
    parameter, fit = learned.parameters[place], learned.fit
    told = bool(fit.is_identifiable[place])
    value = parameter.scale * parameter.value(learned.defaults, float(fit.z[place]))
    low, high = _ends(learned, parameter, place)
    return {
        "name": parameter.name,
        "title": parameter.title,
        "unit": parameter.unit,
        "default": parameter.scale * parameter.read(learned.defaults),
        "fitted": value if told else None,
        "low": low if told else None,
        "high": high if told else None,
        "effect": float(fit.effect[place]),
        "left": float(fit.spread[place] / fit.before[place]),
        "is_identifiable": told,
    }


def _ends(learned: Learned, parameter: FitParameter, place: int) -> tuple[float, float]:
    """One spread below and above, within the parameter's range."""
    z, spread = float(learned.fit.z[place]), float(learned.fit.spread[place])
    places = (max(z - spread, parameter.low), min(z + spread, parameter.high))
    low, high = sorted(parameter.scale * parameter.value(learned.defaults, one) for one in places)
    return low, high


def _gait(learned: Learned, gait: int, cut: float) -> Json:
    walk = learned.measured[gait]
    return {
        "name": walk.name,
        "kind": walk.kind,
        "wanted_cm": walk.wanted * CM,
        "distance_cm": walk.displacement.distance * CM,
        "angle_deg": math.degrees(walk.displacement.angle),
        "trials": walk.trials,
        "surface_cm": float(learned.misfit[gait]) * CM,
        "cut_mm": cut * 1000.0,
    }


def _prediction(learned: Learned, way: Prediction) -> Json:
    distance, angle = learned.errors(way)
    return {
        "name": way.name,
        "title": WAYS[way.name],
        "distances_cm": [displacement.distance * CM for displacement in way.displacements],
        "angles_deg": [math.degrees(displacement.angle) for displacement in way.displacements],
        "error_cm": distance * CM,
        "error_deg": math.degrees(angle),
        "angles": way.angles,
        "falls": way.falls,
    }


def learned_sentence(content: Mapping[str, Any]) -> str:
    """The result in a sentence, of its content."""
    errors = {way["name"]: way["error_cm"] for way in content["foretold"]}
    told = [one["title"].lower() for one in content["parameters"] if one["is_identifiable"]]
    what = (
        f"These trials identify {', '.join(told)}." if told else "These trials do not identify any parameter."
    )
    return (
        f"{what} Mean error for gaits left out of the fit: {errors['left out']:.2f} cm; of the plan: "
        f"{errors['as planned']:.2f} cm; of a line through the others: {errors['ratio, left out']:.2f} cm."
    )
