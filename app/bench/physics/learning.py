"""How well physics that was fitted to the published trials predicts gaits that were left out."""

import math
from pathlib import Path

from app.bench.common.measure import Row
from app.common.json import Json
from app.export.trajectory_files import read_text
from app.learning.published_trials import walks_of_table
from app.learning.runner import WalkRunner
from app.learning.views import learned_content
from app.published.reference import open_reference
from app.trials.figures import ROBOT
from core.errors import InputError
from core.identification.learning import POINTS, learn
from core.physics.masses import default_physics
from core.robot.model import load_robot
from solver_jobs import BatchSimulator

PROCESSES = 2
"""In which gaits are simulated."""
SHOWN = ("as planned", "default", "fitted", "left out", "left out, line", "ratio, left out", "kind left out")
"""Ways of foretelling whose every gait is printed."""


def bench_learning(reference: Path | None = None, points: int = POINTS) -> list[Row]:
    """Learns from the sixteen published gaits.

    Args:
        reference: folder with the published data.
        points: sets of parameters at which every gait is simulated.

    Raises:
        InputError: the data is not in the folder.
    """
    if reference is None:
        raise InputError(
            "Learning needs the published trials; name their folder after --reference.",
            "--reference",
        )
    model, data = load_robot(ROBOT), open_reference(reference)
    table = data.folder / "robot_trials" / "trajectory_averages.csv"
    folder = data.folder / "trajectories" / "direction1"
    trajectories = {path.name: read_text(path) for path in sorted(folder.glob("*.csv"))}
    walks = walks_of_table(read_text(table), trajectories, model)
    tiers = [BatchSimulator() for _ in range(PROCESSES)]
    try:
        runner = WalkRunner(tiers, walks, lambda done: None)
        learned = learn(walks, default_physics(model), runner, points)
        content = learned_content(learned, [walk.cut for walk in walks])
    finally:
        for tier in tiers:
            tier.close()
    return [*_ways(content), *_parameters(content), *_gaits(content), _conditions(content, points)]


def _ways(content: Json) -> list[Row]:
    return [
        {
            "predicted by": way["title"],
            "distance_off_cm": round(way["error_cm"], 2),
            "angle_off_deg": None if way["error_deg"] is None else round(way["error_deg"], 1),
            "angles": way["angles"],
            "falls": way["falls"],
        }
        for way in content["foretold"]
    ]


def _parameters(content: Json) -> list[Row]:
    return [
        {
            "parameter": one["title"],
            "unit": one["unit"],
            "default": _figure(one["default"]),
            "fitted": _figure(one["fitted"]),
            "from": _figure(one["low"]),
            "to": _figure(one["high"]),
            "effect": round(one["effect"], 1),
            "spread_left": f"{one['left'] * 100:.0f} %",
            "identifiable": "yes" if one["is_identifiable"] else "no",
        }
        for one in content["parameters"]
    ]


def _gaits(content: Json) -> list[Row]:
    return [
        {
            "gait": gait["name"],
            "measured_cm": round(gait["distance_cm"], 1),
            **{
                f"{way['name']}_cm": round(way["distances_cm"][place], 1)
                for way in content["foretold"]
                if way["name"] in SHOWN
            },
            "cut_mm": round(gait["cut_mm"], 1),
            "measured_deg": round(gait["angle_deg"]),
            "default_deg": _degrees(content, "default", place),
            "left out_deg": _degrees(content, "left out", place),
        }
        for place, gait in enumerate(content["gaits"])
    ]


def _degrees(content: Json, name: str, place: int) -> int | None:
    way = next(way for way in content["foretold"] if way["name"] == name)
    angle = way["angles_deg"][place]
    return None if angle is None else round(float(angle))


def _conditions(content: Json, points: int) -> Row:
    return {
        "simulations": content["simulations"],
        "points": points,
        "trial_spread_cm": round(content["spread_cm"], 2),
        "trial_spread_deg": round(content["spread_deg"], 1),
        "noise_factor_cm": content["noise"][0],
        "noise_factor_deg": content["noise"][1],
        "surface_misfit_cm": round(
            math.sqrt(sum(gait["surface_cm"] ** 2 for gait in content["gaits"]) / len(content["gaits"])), 2
        ),
    }


def _figure(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.3g}")
