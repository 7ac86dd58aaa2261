"""Makes the plan of a gait: the motion that is shown, checked and sent."""

import hashlib
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from app.common.json import Json
from app.documents.gait_json import sent_hash
from app.documents.trajectory_json import content_sha256, trajectory_from_content
from app.plans.planned_part import PlannedPart
from app.plans.verified_result import VerifiedResult, verify
from core.arrays import Floats
from core.checks.checked_plan import checked_plan
from core.checks.coupling import coupling_note
from core.checks.rules import check_plan
from core.checks.simulation import Simulated
from core.errors import CheckError, FootfallError, InputError
from core.findings import Verdict
from core.gait.gait import Gait, motion_problem, resting_poses
from core.gait.held_feet import HeldFeet, held_sentence
from core.gait.manual_motion import manual_motion, stance_slip
from core.gait.options import GaitOptions
from core.gait.poses import FoundPoses
from core.gait.recording import Recording, RecordingForm
from core.motion.balance import balance_margins
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.pose_gaits.gait_poses import asked_of, drawn_poses, found_gait, gait_of_poses, pose_problem
from core.pose_gaits.motion_in_move import motion_along
from core.pose_gaits.pace import motion_words
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.problem.initial_guess import initial_guess
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem, missing_support
from core.recorded.recorded_motion import gait_trajectory
from core.robot.kinematics import UnreachableError, free_strokes
from core.robot.model import RobotModel, load_robot
from core.wire.robot_time import estimate_seconds
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import MotionResult, SolveStatus

ADAPTED_NOTE = "The last poses, adapted to the new values: they are not solved, and cannot be sent."
_OPTION_NAME = re.compile(r" \(--[a-z-]+\)")
"""What the command line calls an option, in a reason; a document has no such names."""
PIN_SEEN = 1e-6
"""A pinned pose that is drawn this far from its place is drawn nearer, m."""
AS_PLANNED = GaitOptions(merge=0.0, stop_bound=None)
"""One waypoint a sample."""

Solve = Callable[[MotionProblem], MotionResult]
"""Asks the live tier."""


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

    @property
    def is_draft(self) -> bool:
        """Whether it is only drawn, so that it is never sent."""
        return self.source in (PlanSource.DRAFT, PlanSource.ITERATE, PlanSource.ADAPTED)

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
        failed = self.live is not None and self.live.status is SolveStatus.FAILED
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
        smallest = float(balance_margins(self.model, self.trajectory)[0].min())
        return smallest if np.isfinite(smallest) else None

    @property
    def free_strokes(self) -> Floats:
        """(n, 3·legs) strokes that the motion needs, limits left aside, m; nan where no rod is that long."""
        t = self.trajectory
        if t is None:
            return np.zeros((0, 3 * self.model.leg_count))
        return free_strokes(self.model, t.feet_world, t.pose(self.model)).reshape(t.knot_count, -1)

    @property
    def margins(self) -> Floats:
        """(n,) static stability margin, m."""
        if self.trajectory is None:
            return np.zeros(0)
        t = self.trajectory
        return stability_margins(t.body_world[:, :2], t.feet_world, t.contact)


def make_plan(gait: Gait, result: Json | None, solve: Solve) -> Plan:
    """Makes a gait's plan from a recording, a segment table, a stored exact result, or the live tier.

    Args:
        gait: the document.
        result: the stored result that this document has, where there is one.
        solve: asks the live tier; called only where nothing else makes the plan.
    """
    model = load_robot(gait.robot)
    try:
        if gait.poses is not None:
            return pose_plan(gait, model, result)
        if gait.recorded is not None:
            return with_waypoints(_recorded_plan(gait, gait.recorded, model), gait.options)
        if gait.segment_table is not None:
            motion = manual_motion(gait, model)
            note = _manual_note(float(motion.slip.max()))
            return with_waypoints(
                Plan(PlanSource.MANUAL, note, model, motion.trajectory, None, None, motion.slip), gait.options
            )
        problem = motion_problem(gait, model)
        stored = _confirmed(problem, result)
        if stored is not None and result is not None:
            note = " ".join(filter(None, (_optimised_note(result), _held_note(gait, model))))
            plan = Plan(PlanSource.OPTIMISED, note, model, stored, None, None)
            seconds, trajectory = result["solve_seconds"], content_sha256(result["trajectory"])
            return with_waypoints(replace(plan, seconds=seconds, result=trajectory), gait.options)
        plan = _live_plan(problem, verify(problem, solve(problem)))
        if plan.source is PlanSource.LIVE:
            plan = replace(plan, note=" ".join(filter(None, (plan.note, _held_note(gait, model)))))
        return with_waypoints(plan, gait.options)
    except FootfallError as refusal:
        return Plan(PlanSource.DRAFT, refusal.sentence, model, None, None, refusal)


def pose_plan(gait: Gait, model: RobotModel, result: Json | None) -> Plan:
    """The plan of a gait for the robot's clock: its poses where they answer what is asked, else adapted ones.

    Args:
        gait: the document.
        model: its robot.
        result: what a search for exactly this gait ended with, where there was one.

    Raises:
        FootfallError: the gait asks for what it cannot have, or adapted poses are out of reach.
    """
    found = found_gait(gait, model)
    kept = None if result is None else result.get("found")
    problem = pose_problem(gait, model)
    if found is None and kept is not None and kept["answers"] == asked_of(problem):
        found = gait_of_poses(problem, FoundPoses(**kept))
    if found is not None and check_poses(found).confirmed:
        return _of_poses(PlanSource.POSES, _poses_note(found), found)
    is_infeasible = result is not None and result.get("status") == SolveStatus.INFEASIBLE
    told = result.get("explanation", ()) if result is not None and is_infeasible else ()
    why = without_option_names(told)
    drawn = drawn_poses(gait, model)
    note = " ".join(why) or " ".join((ADAPTED_NOTE, *_pins_out_of_reach(drawn)))
    return replace(_of_poses(PlanSource.ADAPTED, note, drawn), infeasible=why)


def without_option_names(sentences: Iterable[str]) -> tuple[str, ...]:
    """Reasons of a search without what the command line calls an option."""
    return tuple(_OPTION_NAME.sub("", sentence) for sentence in sentences)


def _pins_out_of_reach(drawn: PoseGait) -> Iterator[str]:
    for pin in drawn.problem.pinned:
        away = drawn.bodies[pin.pose - 1, :2] - drawn.bodies[0, :2]
        if np.abs(away - drawn.problem.pinned_place(pin, drawn.step)).max() > PIN_SEEN:
            yield f"No rod is long enough for where pose {pin.pose} is pinned; it is drawn nearer."


def _of_poses(source: PlanSource, note: str, poses: PoseGait) -> Plan:
    """Every pose is a waypoint, and nothing is merged or cut: the poses are made for the motors' way."""
    plan = Plan(source, note, poses.problem.model, poses.trajectory, None, None, poses=poses)
    return with_waypoints(plan, AS_PLANNED)


def _poses_note(poses: PoseGait) -> str:
    moves, seconds = poses.problem.move_count, estimate_seconds(poses.waypoints)
    turned = float(poses.headings[-1] - poses.headings[0])
    pace = motion_words(poses.distance / seconds, turned / seconds)
    pivots = (
        " Soles pivot on the ground; how flat shoes do that is not known yet."
        if poses.problem.is_turned
        else ""
    )
    return (
        f"Made for the robot's clock: {moves} moves in {seconds:.1f} s on the robot, {pace}; every limit is "
        f"confirmed along every move.{pivots}"
    )


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


def _recorded_plan(gait: Gait, recording: Recording, model: RobotModel) -> Plan:
    """The recorded motion, as it stands.

    Raises:
        InputError: it cannot be read, or the document says another motion.
    """
    trajectory = gait_trajectory(gait, recording, model)
    slip = stance_slip(trajectory.feet_world, trajectory.contact)
    note = f"The recorded motion of {recording.file}, as it stands."
    if recording.form is RecordingForm.WAYPOINTS:
        note = f"The waypoints of {recording.file}; standing feet slide up to {slip.max() * 1000:.1f} mm."
    return Plan(PlanSource.RECORDED, note, model, trajectory, None, None, slip)


def _live_plan(problem: MotionProblem, answer: VerifiedResult) -> Plan:
    """The live tier's motion where it is confirmed, its nearest one where there is none, else a drawing."""
    model, seconds = problem.model, answer.result.solve_seconds
    if answer.status is SolveStatus.SOLVED:
        note = _live_note(answer)
        return Plan(PlanSource.LIVE, note, model, answer.trajectory, None, None, None, answer, seconds)
    nearest = answer.trajectory if answer.status is SolveStatus.INFEASIBLE else initial_guess(problem)
    note = missing_support(problem.timeline, problem.limits.margin) or " ".join(answer.explanation)
    return Plan(PlanSource.DRAFT, note, model, nearest, None, None, None, answer, seconds)


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
        draft = plan.source is PlanSource.DRAFT
        return replace(plan, refusal=InputError(plan.note, "timeline") if draft else unreachable)
    words = (plan.note, coupling_note(plan.model, plan.trajectory))
    return replace(plan, way=way, note=" ".join(filter(None, words)))


def _confirmed(problem: MotionProblem, result: Json | None) -> Trajectory | None:
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


def _live_note(answer: VerifiedResult) -> str:
    return f"Live plan, {answer.result.solve_seconds * 1000:.0f} ms, all limits met."


def _held_note(gait: Gait, model: RobotModel) -> str:
    """Which feet are held up, and where the body rests aside for it; nothing where none is."""
    if not gait.held.any:
        return ""
    natural = resting_poses(replace(gait, held=HeldFeet()), model)
    words = [held_sentence(gait.held)]
    for pose, middle, end in zip(resting_poses(gait, model), natural, ("start", "end"), strict=True):
        aside = float(np.linalg.norm(pose.body_world - middle.body_world))
        if aside > 0.0:
            words.append(
                f"At the {end} the body rests {aside * 1000:.1f} mm aside, over the feet that stand."
            )
    return " ".join(filter(None, words))


def _optimised_note(result: Json) -> str:
    # Results of earlier versions do not say it; all of them are optimal.
    if not result.get("optimal", True):
        return " ".join(result["explanation"])
    return (
        f"Optimised in {result['iterations']} iterations, {result['solve_seconds'] * 1000:.0f} ms; every "
        f"constraint confirmed, largest violation {result['max_violation']:.1e}."
    )


def verdict_of(plan: Plan, gait: Gait, simulated: Simulated | None = None) -> Verdict:
    """Checks a plan by every rule.

    Args:
        plan: what the gait amounts to.
        gait: the document that it is checked against.
        simulated: a simulation of exactly these waypoints, where there is one.

    Raises:
        CheckError: there is nothing to check.
    """
    if plan.trajectory is None or plan.way is None:
        sentence = "There is no plan to check." if plan.refusal is None else plan.refusal.sentence
        raise CheckError(sentence, "plan")
    is_fresh = plan.made_of is None or plan.made_of == sent_hash(gait)
    checked = checked_plan(
        gait, plan.model, plan.trajectory, plan.way, is_draft=plan.is_draft, is_fresh=is_fresh
    )
    return check_plan(checked, simulated)
