"""Makes the plan of a gait."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np

from app.common.json import Json
from app.documents.trajectory_json import content_sha256, trajectory_from_content
from app.plans.plan import AS_PLANNED, Plan, PlanSource, with_waypoints
from app.plans.verified_result import VerifiedResult, verify
from core.errors import FootfallError, InputError
from core.gait.gait import Gait, motion_problem, resting_poses
from core.gait.held_feet import HeldFeet, held_sentence
from core.gait.manual_motion import manual_motion, stance_slip
from core.gait.poses import FoundPoses
from core.gait.recording import AS_RECORDED, Recording, RecordingForm
from core.pose_gaits.gait_poses import asked_of, confirmed_gait, drawn_poses, gait_of_poses, pose_problem
from core.pose_gaits.pace import motion_words
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.problem.initial_guess import initial_guess
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem, missing_support
from core.recorded.frame_offsets import frame_offsets
from core.recorded.recorded_motion import fit_words, gait_motion
from core.robot.model import RobotModel, load_robot
from core.wire.robot_time import estimate_seconds
from solver_jobs import MotionResult, SolveStatus

ADAPTED_NOTE = "The last poses, adapted to the new values: they are not solved, and cannot be sent."
_OPTION_NAME = re.compile(r" \(--[a-z-]+\)")
"""What the command line calls an option, in a reason; a document has no such names."""
PIN_SEEN = 1e-6
"""A pinned pose that is drawn this far from its place is drawn nearer, m."""
Solve = Callable[[MotionProblem], MotionResult]
"""Asks the live tier."""


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
        stored = _optimised_plan(problem, result)
        if stored is not None:
            note = " ".join(filter(None, (stored.note, _held_note(gait, model))))
            return with_waypoints(replace(stored, note=note), gait.options)
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
    found = confirmed_gait(gait, model)
    kept = None if result is None else result.get("found")
    problem = pose_problem(gait, model)
    if found is None and kept is not None and kept["answers"] == asked_of(problem):
        solved = gait_of_poses(problem, FoundPoses(**kept))
        found = solved if check_poses(solved).confirmed else None
    if found is not None:
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


def _recorded_plan(gait: Gait, recording: Recording, model: RobotModel) -> Plan:
    """The recorded motion, changed as the document says.

    Raises:
        InputError: it cannot be read, or the document says another motion.
    """
    motion = gait_motion(gait, recording, model)
    trajectory = motion.trajectory
    slip = stance_slip(trajectory.feet_world, trajectory.contact)
    how = fit_words(recording.fit, motion.clipped)
    note = f"The recorded motion of {recording.file}, {how or 'as it stands'}."
    if recording.form is RecordingForm.WAYPOINTS:
        slides = f"standing feet slide up to {slip.max() * 1000:.1f} mm"
        note = f"The waypoints of {'; '.join(filter(None, (recording.file, how, slides)))}."
    offsets = frame_offsets(model, trajectory) if recording.fit == AS_RECORDED else None
    plan = Plan(PlanSource.RECORDED, note, model, trajectory, None, None, slip, clipped=motion.clipped)
    return plan if offsets is None else replace(plan, doubt=offsets.sentence)


def _live_plan(problem: MotionProblem, answer: VerifiedResult) -> Plan:
    """The live tier's motion where it is confirmed, its nearest one where there is none, else a drawing."""
    model, seconds = problem.model, answer.result.solve_seconds
    if answer.has_motion:
        note = _live_note(answer)
        return Plan(PlanSource.LIVE, note, model, answer.trajectory, None, None, None, answer, seconds)
    nearest = answer.trajectory if answer.status is SolveStatus.INFEASIBLE else initial_guess(problem)
    note = missing_support(problem.timeline, problem.limits.margin) or " ".join(answer.explanation)
    return Plan(PlanSource.DRAFT, note, model, nearest, None, None, None, answer, seconds)


def _optimised_plan(problem: MotionProblem, result: Json | None) -> Plan | None:
    """The plan of a stored result, if the checker confirms its motion for this problem and robot."""
    if result is None:
        return None
    try:
        trajectory = trajectory_from_content(result["trajectory"])
        if not check_motion(problem, trajectory).confirmed:
            return None
        plan = Plan(PlanSource.OPTIMISED, _optimised_note(result), problem.model, trajectory, None, None)
        seconds, key = float(result["solve_seconds"]), content_sha256(result["trajectory"])
        return replace(plan, seconds=seconds, result=key)
    except (KeyError, TypeError, ValueError, InputError):
        return None


def _manual_note(slip: float) -> str:
    return f"Made by hand from its segment table; standing feet slide up to {slip * 1000:.1f} mm."


def _live_note(answer: VerifiedResult) -> str:
    met = ", all limits met" if answer.status is SolveStatus.SOLVED else ""
    return f"Live plan, {answer.result.solve_seconds * 1000:.0f} ms{met}."


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
