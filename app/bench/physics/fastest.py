"""The fastest walks: their speed by the law, on the emulated board and in physics."""

from dataclasses import dataclass, field

import numpy as np

from app.bench.common.measure import Row
from app.bench.robot.timed_board import timed_moves
from app.bench.solvers.fastest_times import solve_times
from app.emulator.profiles import ProfileName
from core.gait.gait import heading_angle
from core.library.library import library
from core.physics.metrics import report
from core.physics.pose_gait_problem import pose_gait_problem
from core.pose_gaits.motion_in_move import least_arm_distance
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.pose_gaits.start_motion import TURN_GUESS
from core.robot.model import load_robot
from solver_jobs import PoseResult, simulate, simulate_variations, solve_poses

BOARD_CYCLES = 4
"""Cycles in mid-walk whose mean is the speed on the board; one more runs before."""
VARIATIONS = 64
MM, MM_S = 1000.0, 1000.0


@dataclass(frozen=True)
class FastCase:
    """A walk that is measured.

    Args:
        gait: of the library: foot order and direction.
        cycles: from the standard stance to rest; None in mid-walk.
        step: m a cycle; None where it is free, 0 for a turn on the spot.
        turn: ° a cycle; None for the fastest on the spot, to the left.
        sway: how far the heading may leave an even turn, °.
        bounds: the limits.
        varied: whether it runs under variations too.
    """

    gait: str
    cycles: int | None = None
    step: float | None = None
    turn: float | None = 0.0
    sway: float = 0.0
    bounds: PoseBounds = field(default_factory=PoseBounds)
    varied: bool = False


_GAITS = ("c-gait", "walk", "amble")
_TURNS = (10.0, -10.0, 30.0, -30.0)
CASES = (
    *(FastCase(gait) for gait in ("c-gait", "walk", "amble", "s-gait")),
    *(FastCase(gait, bounds=PoseBounds(stop_bound=bound)) for bound in (1.3, 1.0) for gait in _GAITS),
    *(FastCase(gait, cycles, varied=cycles == 3) for cycles in (3, 5) for gait in _GAITS),
    *(FastCase(gait, 1, 0.010, bounds=PoseBounds(margin=0.003)) for gait in ("c-gait", "walk")),
    *(
        FastCase(gait, 1, 0.010, bounds=PoseBounds(margin=0.001, clearance=0.0015, stop_bound=2.5))
        for gait in ("c-gait", "walk")
    ),
    FastCase("c-gait", step=0.0, turn=None),
    FastCase("c-gait", step=0.0, turn=None, bounds=PoseBounds(arm_distance=0.0)),
    FastCase("c-gait", 3, step=0.0, turn=None, varied=True),
    *(FastCase("c-gait", turn=turn) for turn in _TURNS),
    *(FastCase("c-gait", 3, turn=turn, varied=True) for turn in _TURNS),
    FastCase("c-gait", sway=5.0),
    FastCase("c-gait", 3, sway=5.0, varied=True),
)
"""Every walk that is measured, the mid-walk ones first."""


def bench_fastest() -> list[Row]:
    """The published walk, every fastest walk, and how long searches take."""
    return [*bench_walks(), *solve_times()]


def bench_walks(cases: tuple[FastCase, ...] = CASES, variations: int = VARIATIONS) -> list[Row]:
    """Finds each walk, lets the emulated board time it, and walks it in physics.

    Args:
        cases: the walks.
        variations: seeded variations of the parameters that those marked for them run under.
    """
    return [_row(case, solve_poses(_problem(case)), variations) for case in cases]


def _problem(case: FastCase) -> PoseProblem:
    gait = library()[case.gait].gait
    heading = heading_angle(gait.orientation)
    model = load_robot(gait.robot)
    turn = TURN_GUESS if case.turn is None else float(np.radians(case.turn))
    return PoseProblem(
        model,
        gait.order,
        heading - (0.0 if case.step == 0.0 else turn / 2.0),
        case.step,
        turn=turn,
        free_turn=case.turn is None,
        sway=float(np.radians(case.sway)),
        cycles=case.cycles,
        bounds=case.bounds,
    )


def _row(case: FastCase, result: PoseResult, variations: int) -> Row:
    bounds = case.bounds
    row: Row = {
        "gait": case.gait,
        "order": "-".join(map(str, library()[case.gait].gait.order)),
        "cycles": "mid-walk" if case.cycles is None else str(case.cycles),
        "margin_mm": bounds.margin * MM,
        "clearance_mm": bounds.clearance * MM,
        "stop_bound_s": bounds.stop_bound,
        "arms_asked_mm": bounds.arm_distance * MM,
        "sway_deg": case.sway,
        "status": result.status.value,
        "solve_s": round(result.solve_seconds, 2),
        "search_s": round(result.seconds, 2),
    }
    gait = result.gait
    if gait is None:
        return row
    row |= {
        "moves": gait.problem.move_count,
        "way_mm": round(gait.distance * MM, 1),
        "law_s": round(gait.seconds, 2),
        "turn_deg": round(float(np.degrees(gait.headings[-1] - gait.headings[0])), 1),
        "law_mm_s": round(gait.speed * MM_S, 2),
        "law_deg_s": round(float(np.degrees(gait.turn_rate)), 2),
    }
    for profile in ProfileName:
        row[f"{profile.value}_s"] = round(board_seconds(gait, profile), 2)
    row["board_mm_s"] = round(gait.distance / row["published_s"] * MM_S, 2)
    row["board_deg_s"] = round(row["turn_deg"] / row["published_s"], 2)
    return row | _physics(gait, variations if case.varied else 0)


def board_seconds(gait: PoseGait, profile: ProfileName) -> float:
    """Seconds that the emulated board takes: of a cycle in mid-walk the mean of four, else of all cycles."""
    if gait.problem.cycles is not None:
        return float(timed_moves(profile, gait.strokes).seconds.sum())
    moves = gait.problem.move_count
    strokes = np.concatenate([gait.strokes[:1], *[gait.strokes[1:]] * (BOARD_CYCLES + 1)])
    return float(timed_moves(profile, strokes).seconds[moves:].sum() / BOARD_CYCLES)


def _physics(gait: PoseGait, variations: int) -> Row:
    problem = pose_gait_problem(gait)
    figures = report(problem, simulate(problem))
    row: Row = {
        "physics_way_%": None if figures.way.share is None else round(100.0 * figures.way.share, 1),
        "physics_heading_deg": round(float(np.degrees(figures.heading)), 2),
        "physics_tilt_deg": round(float(np.degrees(figures.max_tilt)), 2),
        "physics_swing_load": round(float(figures.swing_load.max()), 3),
        "arms_mm": round(least_arm_distance(gait) * MM, 1),
        "slip_in_a_move_mm": round(float(figures.slip_samples.max()) * MM, 2),
        "physics_fell": figures.fell,
    }
    if variations:
        runs = simulate_variations(problem, variations)
        row["variations"] = f"{sum(run.walks for run in runs)} of {variations} walk"
        row["variations_fell"] = sum(run.fell for run in runs)
    return row
