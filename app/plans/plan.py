"""The plan of a gait: the motion that is shown, checked and sent."""

import hashlib
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from app.documents.gait_json import sent_hash
from app.plans.planned_part import PlannedPart
from app.plans.verified_result import VerifiedResult
from core.arrays import Floats
from core.checks.beyond_range import beyond_range_plan
from core.checks.checked_plan import Beyond, checked_plan
from core.checks.made_plan import MadePlan, is_made, made_plan, other_motion_words
from core.checks.rules import check_plan
from core.checks.simulation import Simulated
from core.errors import CheckError, FootfallError, InputError
from core.findings import Verdict
from core.gait.gait import Gait
from core.gait.options import GaitOptions
from core.motion.balance import balance_margins
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.pose_gaits.motion_in_move import motion_along
from core.pose_gaits.pose_gait import PoseGait
from core.robot.kinematics import UnreachableError, free_strokes
from core.robot.model import RobotModel
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import SolveStatus

KEEPS = "Clip its strokes, raise or lower the body, or make the motion smaller to keep the recording."
"""Remedy for a recorded motion that leaves the motors' range."""
AS_PLANNED = GaitOptions(merge=0.0, stop_bound=None)
"""One waypoint a sample."""


class PlanSource(StrEnum):
    """How a plan came about."""

    MANUAL = "manual"
    OPTIMISED = "optimised"
    LIVE = "live"
    RECORDED = "recorded"
    """The motion of a file, as it stands."""
    POSES = "poses"
    """Poses for the robot's clock, as a solver has found them."""
    ADAPTED = "adapted"
    """The last poses, adapted to what is asked now; to be looked at until the solver has answered."""
    SEQUENCE = "sequence"
    """The parts of a sequence, each in its own way."""
    DRAFT = "draft"
    ITERATE = "iterate"
    """A motion on the solver's way to its answer; to be looked at only."""


@dataclass(frozen=True, eq=False)
class Plan:
    """What a gait becomes: its trajectory, its waypoints, and how they were found.

    Args:
        source: how it came about.
        note: a sentence on that.
        model: the robot.
        trajectory: in the world frame; None where the document does not make one.
        way: what would be sent, and where in the plan it is; None where a foot is out of reach.
        refusal: why there is no trajectory or no waypoints.
        slip: (legs,) of a manual gait or a recorded motion, m.
        live: the live tier's answer, where it was asked.
        seconds: time in the solver; None where none was asked.
        result: SHA-256 of the stored result that it is; None for every other plan.
        parts: of a sequence, and the moves between them; empty for a gait of its own.
        made_of: hash of the document that it was made of; None where it is of none.
        poses: of a gait for the robot's clock; adapted ones are not confirmed.
        infeasible: sentences on why a search found no poses; empty where none has failed.
        clipped: (n, legs, 3) how far each stroke of a recorded motion was beyond the motors' range and was
            clipped, m; None where strokes are left as they are.
        doubt: why the heights of a recorded motion seem to be in another frame; empty where they do not, or
            where it was said already how the motion is changed.
    """

    source: PlanSource
    note: str
    model: RobotModel
    trajectory: Trajectory | None
    way: WaypointPlan | None
    refusal: FootfallError | None
    slip: Floats | None = None
    live: VerifiedResult | None = None
    seconds: float | None = None
    result: str | None = None
    parts: tuple[PlannedPart, ...] = ()
    made_of: str | None = None
    poses: PoseGait | None = None
    infeasible: tuple[str, ...] = ()
    clipped: Floats | None = None
    doubt: str = ""

    @property
    def is_draft(self) -> bool:
        """Whether it is only drawn, so that it is never sent."""
        return self.source in (PlanSource.DRAFT, PlanSource.ITERATE, PlanSource.ADAPTED)

    @property
    def is_out_of_range(self) -> bool:
        """Whether there is a motion that the motors cannot make."""
        return self.trajectory is not None and isinstance(self.refusal, UnreachableError)

    @property
    def misfit(self) -> str | None:
        """Why a recorded motion does not fit the robot, or seems to be in another frame; else None."""
        if self.source is not PlanSource.RECORDED or self.trajectory is None:
            return None
        return self.doubt or (None if self.refusal is None else self.refusal.sentence)

    @cached_property
    def moved(self) -> Trajectory | None:
        """The motion between its knots: of poses as the motors take it, straight in motor space."""
        if self.poses is None or self.source is not PlanSource.POSES:
            return self.trajectory
        return motion_along(self.poses)

    @property
    def waypoints(self) -> Waypoints | None:
        """What would be sent; None where a foot is out of reach."""
        return None if self.way is None else self.way.waypoints

    @property
    def broke_off(self) -> bool:
        """Whether a solver gave no answer, so that it is worth asking again."""
        live = self.live
        failed = live is not None and live.status is SolveStatus.FAILED and not live.has_motion
        return failed or any(part.broke_off for part in self.parts)

    @cached_property
    def session_hash(self) -> str:
        """SHA-256 that changes with anything that is seen or sent, of this process only and never stored.

        It covers raw numbers, and their last digits differ between processors.
        """
        digest = hashlib.sha256(f"{self.source}{self.model.name}".encode())
        if self.trajectory is not None:
            t = self.trajectory
            for values in (t.times, t.body_world, t.heading, t.feet_world, t.contact):
                digest.update(values.tobytes())
        if self.way is not None:
            digest.update(self.way.waypoints.strokes.tobytes())
        return digest.hexdigest()

    @property
    def approvable(self) -> tuple[bool, str, str | None]:
        """What decides whether an approval still fits: draft or not, and hashes of robot and waypoints."""
        waypoints = None if self.waypoints is None else self.waypoints.content_hash
        return self.is_draft, self.model.parameters_hash, waypoints

    @property
    def balance(self) -> float | None:
        """Smallest margin that the check will find, m; None where there is none."""
        if self.trajectory is None:
            return None
        made = self.made
        margins = (
            balance_margins(self.model, self.trajectory)[0] if made is None else made.poses.motion.margins
        )
        smallest = float(margins.min())
        return smallest if np.isfinite(smallest) else None

    @property
    def free_strokes(self) -> Floats:
        """(n, 3·legs) strokes that the motion needs, limits left aside, m; nan where no rod is that long."""
        t = self.trajectory
        if t is None:
            return np.zeros((0, 3 * self.model.leg_count))
        return free_strokes(self.model, t.feet_world, t.pose(self.model)).reshape(t.knot_count, -1)

    @cached_property
    def made(self) -> MadePlan | None:
        """What shared motors make of what would be sent; None where each has its own."""
        if self.trajectory is None or self.way is None or not self.model.is_coupled:
            return None
        return made_plan(self.model, self.trajectory, self.way)

    @property
    def makes_planned(self) -> bool:
        """Whether the robot makes the motion that is planned."""
        return self.made is None or is_made(self.model, self.made.trajectory)

    @property
    def advance(self) -> tuple[float, float]:
        """How far the robot goes, m, and turns, rad, as far as that is known without physics."""
        t = self.trajectory
        if t is None:
            return 0.0, 0.0
        if self.made is not None and not self.makes_planned:
            way = self.made.way
            return way.made, float(self.made.poses.motion.headings[-1])
        distance = float(np.linalg.norm(t.body_world[-1, :2] - t.body_world[0, :2]))
        return distance, float(t.heading[-1] - t.heading[0])

    @property
    def margins(self) -> Floats:
        """(n,) static stability margin, m."""
        if self.trajectory is None:
            return np.zeros(0)
        t = self.trajectory
        if self.made is not None:
            return self.made.poses.at(t.times, self.made.poses.motion.margins)
        return stability_margins(t.body_world[:, :2], t.feet_world, t.contact)


def iterate_plan(model: RobotModel, trajectory: Trajectory, number: int, last: int) -> Plan:
    """A plan of one of the solver's iterates; it is shown and never sent.

    Args:
        model: the robot.
        trajectory: the motion at that iteration.
        number: of the iteration, 0 for the start.
        last: number of the last iteration.
    """
    note = f"Iteration {number} of {last}: a motion on the solver's way, not the plan."
    return with_waypoints(Plan(PlanSource.ITERATE, note, model, trajectory, None, None), AS_PLANNED)


def with_waypoints(plan: Plan, options: GaitOptions) -> Plan:
    """The plan with what would be sent, merged and cut, or with the reason why nothing can be.

    Args:
        plan: with its motion.
        options: of the document, for merging and stop bound.
    """
    if plan.trajectory is None:
        return plan
    try:
        way = plan_waypoints(plan.model, plan.trajectory, options.merge, options.stop_bound)
    except UnreachableError as unreachable:
        return replace(plan, refusal=_refusal(plan, unreachable))
    sent = replace(plan, way=way)
    if sent.makes_planned or sent.made is None:
        return sent
    return replace(sent, note=f"{sent.note} {other_motion_words(sent.made)}".strip())


def _refusal(plan: Plan, unreachable: UnreachableError) -> FootfallError:
    """Why nothing can be sent, with what helps a plan of this kind."""
    if plan.source is PlanSource.DRAFT:
        return InputError(plan.note, "timeline")
    if plan.source is PlanSource.RECORDED:
        return unreachable.with_remedy(KEEPS)
    return unreachable


def sending_of(gait: Gait) -> tuple[float, float | None]:
    """Tolerance, m, and stop bound, s, by which waypoints are merged and cut; poses stay as they are."""
    return (0.0, None) if gait.poses is not None else (gait.options.merge, gait.options.stop_bound)


def verdict_of(plan: Plan, gait: Gait, simulated: Simulated | None = None) -> Verdict:
    """Checks a plan by every rule.

    Args:
        plan: what the gait amounts to.
        gait: the document that it is checked against.
        simulated: a simulation of exactly these waypoints, where there is one.

    Raises:
        CheckError: there is nothing to check.
    """
    way, beyond = plan.way, Beyond(plan.clipped)
    if plan.trajectory is not None and plan.is_out_of_range:
        whole = beyond_range_plan(plan.model, plan.trajectory)
        way, beyond = whole.way, Beyond(plan.clipped, whole.unreached)
    if plan.trajectory is None or way is None:
        sentence = "There is no plan to check." if plan.refusal is None else plan.refusal.sentence
        raise CheckError(sentence, "plan")
    is_fresh = plan.made_of is None or plan.made_of == sent_hash(gait)
    checked = checked_plan(
        gait, plan.model, plan.trajectory, way, is_draft=plan.is_draft, is_fresh=is_fresh, beyond=beyond
    )
    return check_plan(checked, simulated)
