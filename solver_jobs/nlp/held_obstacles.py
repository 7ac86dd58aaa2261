"""What rules a motion out because of the feet that are held up at its ends, each with its sentence."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from core.arrays import Bools, Floats
from core.gait.held_feet import feet_words
from core.motion.support_polygon import stability_margins
from core.problem.initial_guess import problem_swings
from core.problem.motion_problem import (
    CYLINDER,
    Boundary,
    MotionProblem,
    RestPose,
    Workspace,
)
from core.problem.swing_height import rest_heights
from core.robot.kinematics import actuator_plane_pose, feet_in_modules
from core.robot.leg import strokes_from_foot
from solver_jobs.nlp.diagnosis import knot_ranges
from solver_jobs.nlp.variables import MM

SLACK = 1e-9
"""Numbers may differ by this much, m, before something is called impossible."""

LEAST_NAMED = 5e-6
"""Shortfalls are given to 0.01 mm; a smaller one is left to the search."""


def presolve_held_feet(problem: MotionProblem) -> list[str]:
    """Sentences on feet held out of reach, on ends without balance, and on lifts that are too short."""
    ends = (
        ("first", problem.start, problem.held_start, problem.heading[0]),
        ("last", problem.goal, problem.held_end, problem.heading[-1]),
    )
    if not any(held.any() for _, _, held, _ in ends):
        return []
    found: list[str] = []
    for sample, pose, held, heading in ends:
        if held.any():
            found += _out_of_reach(problem, pose, held, sample, float(heading))
            found += _out_of_balance(problem, pose, held, sample)
    return [*found, *_short_lifts(problem)]


def _out_of_reach(
    problem: MotionProblem, pose: RestPose, held: Bools, sample: str, heading: float
) -> Iterator[str]:
    """Where a foot is held it must be within its workspace, whatever happens between the ends."""
    model = problem.model
    plane = actuator_plane_pose(model, pose.body_world, np.asarray(heading))
    feet_module = feet_in_modules(model, pose.feet_world, plane)
    for foot in np.nonzero(held)[0]:
        miss = _miss(problem, feet_module[foot])
        if not miss <= LEAST_NAMED:
            height = (pose.body_world[2] - model.com_height) * MM
            yield (
                f"Foot {foot + 1} is held {pose.feet_world[foot, 2] * MM:.1f} mm up at the {sample} sample, "
                f"which is {miss * MM:.1f} mm more than its leg can draw in with the actuator plane at "
                f"{height:.1f} mm. Raise the body there, or lower the clearance."
            )


def _miss(problem: MotionProblem, foot_module: Floats) -> float:
    """By how much a foot held under its module is too high, m."""
    model = problem.model
    if problem.limits.workspace is Workspace.CYLINDER:
        return float(foot_module[2] + CYLINDER.depth - CYLINDER.above)
    return float((model.stroke.lower - strokes_from_foot(model.leg, foot_module)).max())


def _out_of_balance(problem: MotionProblem, pose: RestPose, held: Bools, sample: str) -> Iterator[str]:
    """A resting body's centre of mass is inside the polygon of the standing feet by the margin."""
    if problem.boundary is Boundary.PERIODIC:
        return
    standing = ~held
    point, feet = pose.body_world[None, :2], pose.feet_world[None]
    margin = float(stability_margins(point, feet, standing[None])[0])
    if margin >= problem.limits.margin - LEAST_NAMED:
        return
    up, down = (
        feet_words(tuple(int(f) + 1 for f in np.nonzero(flags)[0])) if flags.any() else "no foot"
        for flags in (held, standing)
    )
    where = f"{abs(margin) * MM:.1f} mm {'inside' if margin >= 0 else 'outside'}"
    yield (
        f"With {up} held up at the {sample} sample the robot rests on {down}: its centre of mass is {where} "
        f"the edge of the support polygon, and {problem.limits.margin * MM:.1f} mm is asked. Hold fewer feet "
        "up there, or lower the margin."
    )


def _short_lifts(problem: MotionProblem) -> Iterator[str]:
    """A foot rests on both sides of its swing, so it rises or sinks at most v·(time in the air)."""
    for swing in problem_swings(problem):
        before, after = rest_heights(problem, swing)
        first = max(swing.first, 1)
        around = problem.intervals[first - 1 : swing.last + 1]
        highest = float(((around[1:] + around[:-1]) / 2).sum()) * problem.limits.foot_speed
        if abs(after - before) > highest + problem.limits.grounded_height + SLACK:
            yield (
                f"Foot {swing.foot + 1} is in the air at {knot_ranges(tuple(swing.samples))}: too short to "
                f"go {abs(after - before) * MM:.1f} mm {'up' if after > before else 'down'} to where it is "
                f"held or stands (at most {highest * MM:.1f} mm at "
                f"{problem.limits.foot_speed * MM:.0f} mm/s). "
                "Lengthen the swing or lower the clearance."
            )
