"""Figures of published rows as they are computed and kept: by definition, and by name."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from app.common.json import Json, finite
from app.plans.make_plan import Solve
from app.published.problems import walker
from app.published.walked import Walked
from core.arrays import Floats
from core.physics.masses import default_physics
from core.physics.motion import SimulatedMotion
from core.physics.parameters import PhysicsSet, physics_set
from core.physics.problem import SimulationProblem
from core.published.tables import Kind, Movement, PublishedRow, PublishedTable

SIMULATED = (Kind.STANDING, Kind.TRACKING, Kind.PAPER)
"""Tables of simulations: one waypoint a sample, masses of the published model."""

STANDING, TRACKING, TOTAL, STEP, EXTENTS, PACE = "standing", "tracking", "total", "step", "extents", "pace"
"""Definitions of figures; one computation may give several."""


@dataclass(frozen=True, eq=False)
class Tools:
    """The solver and the physics that figures are computed with.

    Args:
        solve: the live tier.
        simulate: the physics; waits for its answer.
    """

    solve: Solve
    simulate: Callable[[SimulationProblem], SimulatedMotion]


def physics_of(kind: Kind) -> PhysicsSet:
    """Our physics beside a kind of table: the published model's masses, or the robot's usual parameters."""
    return physics_set("published") if kind in SIMULATED else default_physics(walker())


def definition_of(table: PublishedTable, row: PublishedRow) -> str:
    """The definition of a row's figures."""
    if table.kind is Kind.WALKED:
        return STEP if row.movement is Movement.STEP else TOTAL
    return _DEFINITIONS[table.kind]


_DEFINITIONS = {
    Kind.STANDING: STANDING,
    Kind.TRACKING: TRACKING,
    Kind.PAPER: TRACKING,
    Kind.EXTENTS: EXTENTS,
    Kind.PACE: PACE,
}


def figures_content(
    figures: Mapping[str, Mapping[str, float | None]],
    sentence: str = "",
    ways: Json | None = None,
    *,
    is_refused: bool = False,
) -> Json:
    """Computed figures as they are kept.

    Args:
        figures: by definition, and by name.
        sentence: a remark, or why there are none.
        ways: for the plot; None where there are none.
        is_refused: whether there is no such gait, so that nothing is left to compute.
    """
    content: Json = finite({"figures": figures, "sentence": sentence, "ways": ways, "is_refused": is_refused})
    return content


def tracking_figures(walk: Walked) -> dict[str, dict[str, float | None]]:
    """Errors of a simulated walk by both definitions of the simulated tables."""
    report = walk.report
    shared = {"lean_deg": float(np.degrees(report.max_tilt)), "goes_mm": report.distance * 1000}
    feet = {f"foot{foot}_mm": float(error) * 1000 for foot, error in enumerate(report.feet_error, 1)}
    mean = report.feet_mean_error * 1000
    planned = report.planned_distance * 1000
    standing = {"feet_mm": walk.standing_error * 1000, "way_mm": mean, "planned_mm": planned}
    return {
        TRACKING: {"feet_mm": mean, "body_mm": report.body_error * 1000, **feet, **shared},
        STANDING: {**standing, **shared},
    }


def walk_ways(walk: Walked) -> Json:
    """Planned and simulated ways of a walk from above, m."""
    return ways_content(*walk.planned, walk.body, walk.feet)


def ways_content(planned_body: Floats, planned_feet: Floats, body: Floats, feet: Floats) -> Json:
    """Ways from above as JSON content, m.

    Args:
        planned_body: (n, 2 or 3).
        planned_feet: (n, legs, 2 or 3).
        body: (n, 2 or 3) simulated.
        feet: (n, legs, 2 or 3) simulated.
    """
    values = {"planned_body": planned_body, "planned_feet": planned_feet, "body": body, "feet": feet}
    return {name: np.round(value[..., :2], 6).tolist() for name, value in values.items()}


def joined(*sentences: str) -> str:
    """Sentences one after the other; empty ones are left out."""
    return " ".join(filter(None, sentences))


def fall_sentence(whose: str, walk: Walked) -> str:
    """The time of a fall, or why a simulation ended early; empty where it reached its end."""
    report = walk.report
    if report.fell_time is not None:
        return f"{whose} falls at {report.fell_time:.1f} s."
    return f"{whose} ends early: {report.ended_early}" if report.ended_early else ""
