"""All benchmarks by name; they print the figures that the documentation quotes."""

from collections.abc import Callable

from app.bench.common.measure import Row, conditions
from app.bench.page.advice import bench_advice
from app.bench.page.atlas import bench_atlas
from app.bench.page.edits import bench_page
from app.bench.page.gait_list import bench_gait_list
from app.bench.page.scene import bench_scene
from app.bench.page.video import bench_video
from app.bench.patterns.search import bench_patterns
from app.bench.patterns.transitions import bench_transitions
from app.bench.physics.fastest import bench_fastest
from app.bench.physics.learning import bench_learning
from app.bench.physics.tables import bench_physics
from app.bench.robot.all import bench_bridge
from app.bench.robot.flooded_stop import bench_floods
from app.bench.robot.law import bench_law
from app.bench.robot.moves import bench_moves
from app.bench.robot.telemetry import bench_telemetry
from app.bench.solvers.edits import bench_edits
from app.bench.solvers.exact import bench_exact, bench_growth
from app.bench.solvers.frontier import bench_frontier
from app.bench.solvers.gentle import bench_gentle
from app.bench.solvers.kinematics import bench_kinematics
from app.bench.solvers.live import bench_live
from app.bench.solvers.remedies import bench_remedies
from app.bench.solvers.timing import bench_timing
from app.bench.solvers.trajectories import bench_trajectories

__all__ = ["BENCHMARKS", "BY_NAME_ONLY", "Benchmark", "Row", "conditions"]

Benchmark = Callable[[], list[Row]]
"""Measures, and gives back the rows of its tables."""

BENCHMARKS: dict[str, Benchmark] = {
    "kinematics": bench_kinematics,
    "live": bench_live,
    "exact": bench_exact,
    "growth": bench_growth,
    "gentle": bench_gentle,
    "trajectories": bench_trajectories,
    "frontier": bench_frontier,
    "timing": bench_timing,
    "transitions": bench_transitions,
    "edits": bench_edits,
    "remedies": bench_remedies,
    "patterns": bench_patterns,
    "physics": bench_physics,
    "learning": bench_learning,
    "bridge": bench_bridge,
    "law": bench_law,
    "fastest": bench_fastest,
    "moves": bench_moves,
    "telemetry": bench_telemetry,
    "floods": bench_floods,
    "video": bench_video,
    "page": bench_page,
    "advice": bench_advice,
    "atlas": bench_atlas,
    "gaits": bench_gait_list,
    "scene": bench_scene,
}
"""Every benchmark by its name."""

BY_NAME_ONLY = frozenset({"page", "advice", "atlas", "gaits", "scene", "learning"})
"""Those that need what is not installed with the program."""
