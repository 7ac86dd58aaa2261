"""From a gait to what can be seen, checked and sent."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from app.trajectory_content import trajectory_from_content
from core.arrays import Floats
from core.checks import CheckedPlan, balance_margins, check_plan
from core.draft import initial_motion
from core.errors import CheckError, FootfallError, InputError
from core.findings import Verdict
from core.gait import Gait, motion_problem
from core.kinematics import UnreachableError
from core.manual import manual_motion
from core.motion_check import check_motion
from core.motion_problem import MotionProblem, missing_support
from core.robot import RobotModel, load_robot
from core.support import stability_margins
from core.trajectory import Trajectory
from core.waypoint_path import waypoints_from_trajectory
from core.waypoints import Waypoints


class PlanSource(StrEnum):
    """How a plan came about."""

    MANUAL = "manual"
    OPTIMISED = "optimised"
    DRAFT = "draft"


@dataclass(frozen=True, eq=False)
class Plan:
    """What a gait amounts to now.

    Args:
        source: how it came about.
        note: a sentence on that.
        model: the robot.
        trajectory: in the world frame; None where the document does not make one.
        waypoints: what would be sent; None where a foot is out of reach.
        refusal: why there is no trajectory or no waypoints.
        slip: (legs,) of a manual gait, m.
    """

    source: PlanSource
    note: str
    model: RobotModel
    trajectory: Trajectory | None
    waypoints: Waypoints | None
    refusal: FootfallError | None
    slip: Floats | None = None

    @property
    def hash(self) -> str:
        """SHA-256 that changes with anything that is seen or sent."""
        digest = hashlib.sha256(f"{self.source}{self.model.name}".encode())
        if self.trajectory is not None:
            for values in (self.trajectory.times, self.trajectory.body_world, self.trajectory.feet_world):
                digest.update(values.tobytes())
            digest.update(self.trajectory.contact.tobytes())
        return digest.hexdigest()

    @property
    def balance(self) -> float | None:
        """Smallest margin that the check will find, m; None where there is none."""
        if self.trajectory is None:
            return None
        smallest = float(balance_margins(self.model, self.trajectory)[0].min())
        return smallest if np.isfinite(smallest) else None

    @property
    def margins(self) -> Floats:
        """(n,) static stability margin, m."""
        if self.trajectory is None:
            return np.zeros(0)
        t = self.trajectory
        return stability_margins(t.body_world[:, :2], t.feet_world, t.contact)


def make_plan(gait: Gait, result: dict[str, Any] | None) -> Plan:
    """The plan of a gait: by hand table, by a stored result of the optimiser, or else as drawn.

    Args:
        gait: the document.
        result: the stored result for exactly this document, where there is one.
    """
    model = load_robot(gait.robot)
    slip, shortfall = None, None
    trajectory: Trajectory
    try:
        if gait.segment_table is not None:
            motion = manual_motion(gait, model)
            source, note, slip = PlanSource.MANUAL, _manual_note(float(motion.slip.max())), motion.slip
            trajectory = motion.trajectory
        else:
            problem = motion_problem(gait, model)
            stored = _confirmed(problem, result)
            shortfall = missing_support(gait.timeline, gait.options.margin)
            source, note = PlanSource.DRAFT, shortfall or "Draft: drawn from the timeline, not optimised yet."
            trajectory = initial_motion(problem) if stored is None else stored
            if stored is not None and result is not None:
                source, note = PlanSource.OPTIMISED, _optimised_note(result)
    except FootfallError as refusal:
        return Plan(PlanSource.DRAFT, refusal.sentence, model, None, None, refusal)
    try:
        waypoints = waypoints_from_trajectory(model, trajectory)
    except UnreachableError as unreachable:
        reason = unreachable if shortfall is None else InputError(shortfall, "timeline")
        return Plan(source, note, model, trajectory, None, reason, slip)
    return Plan(source, note, model, trajectory, waypoints, None, slip)


def _confirmed(problem: MotionProblem, result: dict[str, Any] | None) -> Trajectory | None:
    """A stored result's motion, if the checker still confirms it for this problem and this robot."""
    if result is None:
        return None
    try:
        trajectory = trajectory_from_content(result["trajectory"])
        return trajectory if check_motion(problem, trajectory).confirmed else None
    except (KeyError, TypeError, ValueError, InputError):
        return None


def _manual_note(slip: float) -> str:
    return f"Made by hand from its segment table; standing feet slide up to {slip * 1000:.1f} mm."


def _optimised_note(result: dict[str, Any]) -> str:
    return (
        f"Optimised in {result['iterations']} iterations, {result['solve_seconds'] * 1000:.0f} ms; every "
        f"constraint confirmed, largest violation {result['max_violation']:.1e}."
    )


def verdict_of(plan: Plan, gait: Gait) -> Verdict:
    """Checks a plan by every rule.

    Raises:
        CheckError: there is nothing to check.
    """
    if plan.trajectory is None or plan.waypoints is None:
        sentence = "There is no plan to check." if plan.refusal is None else plan.refusal.sentence
        raise CheckError(sentence, "plan")
    travel = gait.step_world * gait.iterations
    return check_plan(
        CheckedPlan(plan.model, plan.trajectory, plan.waypoints, travel, plan.source is PlanSource.DRAFT)
    )
