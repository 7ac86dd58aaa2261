"""How long the robot walks: waypoints merged and cut, one a knot, and a walk made for the firmware's law."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from app.bench.common.measure import Row
from app.bench.robot.timed_board import TimedBoard
from app.export.trajectory_files import read_trajectory
from core.arrays import Floats
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan
from core.errors import CheckError, InputError
from core.gait.gait import Gait, motion_problem, travel_world
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Cost
from core.robot.kinematics import feet_in_robot, free_strokes
from core.robot.model import RobotModel, load_robot
from core.wire.messages import HIGHEST_MM, LOWEST_MM
from core.wire.robot_time import stop_time
from core.wire.waypoint_merging import WaypointPlan, plan_of_knots, plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import SolveStatus, solve_live

PUBLISHED = Path("trajectories") / "direction1" / "walk_a.csv"
"""The published walk of 10 mm, in the folder of the published data."""

WAYS: tuple[tuple[float, float | None], ...] = ((0.0, None), (0.001, None), (0.001, 1.0), (0.001, 0.8))
"""Merging tolerance in m and stop bound in s of each row."""

SWING_SAMPLES, BETWEEN_SAMPLES, SAMPLE_TIME = 3, 1, 0.4
"""The walk for the firmware: a swing goes up and down in one move each, the body goes along."""
MARGIN, CLEARANCE = 0.001, 0.0015
"""What that walk is asked for, m: as little height and sway as the checks allow, since both are way to go."""


@dataclass(frozen=True)
class Walked:
    """What the emulated robot made of a plan.

    Args:
        seconds: from the first waypoint's sending, where it stands at it already, to the last one's end line.
        worst: largest distance of a motor from its waypoint on arrival, m.
        rise: least height to which a foot really came in its swing, over the standing feet's mean, m.
    """

    seconds: float
    worst: float
    rise: float


def bench_walk(reference: Path | None = None, ways: Sequence[tuple[float, float | None]] = WAYS) -> list[Row]:
    """The published walk and ours of 10 mm in the emulator's published profile, in virtual time.

    Args:
        reference: folder with the published data; without it only our own walks are measured.
        ways: merging tolerance in m and stop bound in s of each row; the first sends one waypoint a sample.

    Raises:
        InputError: the published walk is not in the folder.
    """
    model = load_robot("deltawalker")
    ordinary = library()["walk"].gait
    published: float | None = None
    rows: list[Row] = []
    if reference is not None:
        read = read_trajectory(published_path(reference)).trajectory
        knots = as_published(model, read)
        plans = [plan_of_knots(model, read, knots, *way) for way in ways]
        published = walked(model, plans[0]).seconds
        rows += [_row("published", model, plan, published, "not judged") for plan in plans]
    for name, gait in (("ours, as built in", ordinary), ("ours, for the firmware", firmware_walk(ordinary))):
        motion = live_motion(model, gait)
        for way in ways:
            plan = plan_waypoints(model, motion, *way)
            rows.append(_row(name, model, plan, published, _judged(model, gait, motion, plan)))
    return rows


def published_path(reference: Path) -> Path:
    """The published walk of 10 mm.

    Args:
        reference: folder with the published data.

    Raises:
        InputError: it is not there.
    """
    path = reference / PUBLISHED
    if not path.exists():
        raise InputError(
            f"{reference} holds no {PUBLISHED}; name the published data's folder after --reference.",
            "--reference",
        )
    return path


def firmware_walk(gait: Gait) -> Gait:
    """A walk of few, long, synchronised moves: swings one after the other, one sample between them.

    Every waypoint costs the robot two scans, so what counts is how many there are: up and down of each foot,
    and nothing between.

    Args:
        gait: whose order and step it takes over.
    """
    standing = np.ones((gait.timeline.leg_count, 1), dtype=np.bool_)
    columns = [standing]
    for foot in gait.order:
        swing = np.repeat(standing, SWING_SAMPLES, axis=1)
        swing[foot - 1] = False
        columns += [swing, np.repeat(standing, BETWEEN_SAMPLES, axis=1)]
    stance = np.concatenate(columns, axis=1)
    timeline = ContactTimeline(stance, np.zeros_like(stance), SAMPLE_TIME)
    options = replace(gait.options, margin=MARGIN, clearance=CLEARANCE, body_speed=0.03, cost=Cost.GOAL)
    return replace(gait, timeline=timeline, options=options)


def walked(model: RobotModel, plan: WaypointPlan) -> Walked:
    """Sends a plan to the emulated firmware, each waypoint after the end line of the one before."""
    waypoints = plan.waypoints
    board, seconds, reached = TimedBoard(waypoints.strokes[0]), 0.0, []
    for strokes, duration in zip(waypoints.strokes, waypoints.durations, strict=True):
        seconds += board.send(strokes, float(duration))[0]
        reached.append(board.strokes)
    stood = np.array(reached)
    worst = float(np.abs(stood - waypoints.strokes).max())
    return Walked(seconds, worst, _least_rise(feet_in_robot(model, stood), plan))


def _least_rise(feet: Floats, plan: WaypointPlan) -> float:
    rises: list[float] = []
    for foot in range(feet.shape[1]):
        up = ~plan.contact[:, foot]
        if up.any():
            ground = np.where(plan.contact, feet[..., 2], np.nan)
            rises.append(float((feet[:, foot, 2] - np.nanmean(ground, axis=1))[up].max()))
    return min(rises)


def as_published(model: RobotModel, motion: Trajectory) -> Waypoints:
    """The strokes that the published host sent: wherever they are out of range, at its edge."""
    strokes = free_strokes(model, motion.feet_world, motion.pose(model))
    kept = np.clip(strokes, LOWEST_MM / 1000.0, HIGHEST_MM / 1000.0)
    return Waypoints(kept, np.full(motion.knot_count, float(motion.times[1] - motion.times[0])))


def live_motion(model: RobotModel, gait: Gait) -> Trajectory:
    """The live tier's motion of a gait.

    Raises:
        CheckError: there is none.
    """
    result = solve_live(motion_problem(gait, model))
    if result.status is not SolveStatus.SOLVED:
        raise CheckError(f"The live tier finds no motion for “{gait.name}”: {result.status.value}.", "walk")
    return result.trajectory


def _judged(model: RobotModel, gait: Gait, motion: Trajectory, plan: WaypointPlan) -> str:
    verdict = check_plan(CheckedPlan(model, motion, plan.waypoints, travel_world(gait, model), way=plan))
    return f"{'passed' if verdict.passed else 'failed'}, {len(verdict.findings)} findings"


def _row(name: str, model: RobotModel, plan: WaypointPlan, published: float | None, checks: str) -> Row:
    found = walked(model, plan)
    return {
        "walk": name,
        "merge_mm": round(plan.merge * 1000, 2),
        "stop_bound_s": plan.stop_bound,
        "waypoints": plan.waypoints.count,
        "robot_s": round(found.seconds, 2),
        "of_published": None if published is None else round(found.seconds / published, 3),
        "path_off_mm": round(path_off(plan) * 1000, 2),
        "worst_motor_mm": round(found.worst * 1000, 2),
        "least_rise_mm": round(found.rise * 1000, 2),
        "stop_s": round(stop_time(plan.waypoints), 2),
        "checks": checks,
    }


def path_off(plan: WaypointPlan) -> float:
    """Largest distance of a knot from the path over the waypoints that are sent, of any motor, m."""
    rows = plan.knots.strokes.reshape(plan.knots.count, -1)
    ends = sorted(set(plan.kept))
    gaps = [0.0]
    for first, last in pairwise(ends):
        way, inner = rows[last] - rows[first], rows[first : last + 1] - rows[first]
        share = np.clip(inner @ way / max(float(way @ way), 1e-18), 0.0, 1.0)
        gaps.append(float(np.abs(inner - share[:, None] * way).max()))
    return max(gaps)
