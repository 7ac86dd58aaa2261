"""All benchmarks by name; they print the figures that the documentation quotes."""

from typing import Any

from app.bench.common.measure import Row
from app.common.named import named

BENCHMARKS = {
    "kinematics": "solvers.kinematics:bench_kinematics",
    "live": "solvers.live:bench_live",
    "exact": "solvers.exact:bench_exact",
    "growth": "solvers.exact:bench_growth",
    "gentle": "solvers.gentle:bench_gentle",
    "trajectories": "solvers.trajectories:bench_trajectories",
    "frontier": "solvers.frontier:bench_frontier",
    "timing": "solvers.timing:bench_timing",
    "transitions": "patterns.transitions:bench_transitions",
    "edits": "solvers.edits:bench_edits",
    "remedies": "solvers.remedies:bench_remedies",
    "patterns": "patterns.search:bench_patterns",
    "physics": "physics.tables:bench_physics",
    "published": "physics.published:bench_published",
    "learning": "physics.learning:bench_learning",
    "bridge": "robot.all:bench_bridge",
    "walk": "robot.walk:bench_walk",
    "law": "robot.law:bench_law",
    "fastest": "physics.fastest:bench_fastest",
    "moves": "robot.moves:bench_moves",
    "telemetry": "robot.telemetry:bench_telemetry",
    "floods": "robot.flooded_stop:bench_floods",
    "video": "page.video:bench_video",
    "page": "page.edits:bench_page",
    "advice": "page.advice:bench_advice",
    "atlas": "page.atlas:bench_atlas",
    "gaits": "page.gait_list:bench_gait_list",
    "scene": "page.scene:bench_scene",
}
"""The function of every benchmark by its name, as `module:function` of this folder."""

BY_NAME_ONLY = frozenset({"page", "advice", "atlas", "gaits", "scene", "learning", "published"})
"""Those that need what is not installed with the program, and the published tables, which take minutes."""


def measured(name: str, *arguments: Any) -> list[Row]:
    """Loads a benchmark, runs it and returns the rows of its tables."""
    rows: list[Row] = named(BENCHMARKS[name], __package__)(*arguments)
    return rows
