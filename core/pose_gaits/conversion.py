"""A drawn gait as a gait for the robot's clock, and back, where the one can express the other."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline, is_drawn
from core.gait.options import GaitOptions
from core.gait.poses import Poses
from core.motion.contact_timeline import DRAWN_SAMPLE_TIME, Swing
from core.motion.heading_profile import HeadingProfile
from core.pose_gaits.gait_poses import found_gait, new_pose_gait
from core.pose_gaits.pose_problem import MOST_TURN, POSE_BOUNDS
from core.problem.motion_problem import Boundary
from core.robot.model import RobotModel

MOST_NAMED = 12
"""Steps that a sentence names one by one."""
UNUSED_OPTIONS = (
    "plane_height",
    "end_plane_height",
    "workspace",
    "friction",
    "body_speed",
    "foot_speed",
    "motor_speed",
    "motor_acceleration",
)
"""Options of a drawn gait that a gait for the robot's clock does not use, but for those of its drawing."""
UNDO_BRINGS_BACK = "Undo brings it back."
CURVE = (
    "With step and turn, a drawn gait goes straight on while it turns, and a gait for the robot's clock goes "
    "in a curve; over more than one iteration these differ. Set Iterations to 1, or Turn to 0."
)


def as_pose_gait(gait: Gait, model: RobotModel) -> Gait:
    """A drawn gait as a gait for the robot's clock, without poses yet.

    It has the same foot order, direction, step, number of cycles and options; the step is fixed. The order of
    a timeline that was painted by hand, or that follows from a table or a recording, is read from it. Options
    that such a gait does not use stay in the document, so that the way back gives the same gait.

    Args:
        gait: a gait without poses.
        model: its robot.

    Raises:
        InputError: a gait for the robot's clock cannot express it; the sentence says why, `where` the field.
    """
    asked = _readable_as_poses(gait, model)
    return replace(new_pose_gait(gait.name, asked, Poses(free_step=False), model), options=gait.options)


def as_drawn_gait(gait: Gait, model: RobotModel) -> Gait:
    """A gait for the robot's clock as a drawn gait; its timeline follows from order and phase lengths.

    Foot order, direction, number of cycles and options stay, and a step that was free is the one that was
    found. A merge tolerance of 0 becomes the usual one: the poses were sent as they are, but a drawn motion
    would be sent with a waypoint at every knot, which is slow.

    Args:
        gait: a gait with poses.
        model: its robot.

    Raises:
        InputError: a drawing cannot express it; the sentence says why, `where` the field.
    """
    _require_drawable(gait, model)
    options = replace(gait.options, merge=gait.options.merge or GaitOptions.merge)
    timeline = replace(gait.timeline, sample_time=DRAWN_SAMPLE_TIME)
    bare = replace(gait, poses=None, options=options, provenance=None, timeline=timeline)
    return replace(bare, timeline=drawn_timeline(bare))


def conversion_refusal(gait: Gait, model: RobotModel) -> str | None:
    """Why a gait cannot be converted into the other kind, in a sentence; None where it can.

    Args:
        gait: of either kind.
        model: its robot.
    """
    try:
        if gait.poses is None:
            _readable_as_poses(gait, model)
        else:
            _require_drawable(gait, model)
    except InputError as error:
        return error.sentence
    return None


def conversion_notice(before: Gait, after: Gait) -> str | None:
    """What a conversion leaves behind, in sentences; None where that is nothing.

    Args:
        before: the gait.
        after: the same, converted.
    """
    if (before.poses is None) == (after.poses is None):
        return None
    sentences = _left_by_poses(before) if before.poses is None else _left_by_drawing(before.poses)
    return " ".join(sentences) or None


def step_order(gait: Gait) -> tuple[int, ...]:
    """Feet in the order of their steps at direction 1, counted from 1, as the timeline has them.

    Raises:
        InputError: two feet are in the air together, or the feet do not take turns.
    """
    if is_drawn(gait):
        return gait.order
    legs = gait.timeline.leg_count
    swings = sorted(gait.timeline.swings(), key=lambda swing: swing.first)
    _require_one_by_one(swings)
    feet = [swing.foot for swing in swings]
    cycle = feet[:legs]
    if feet != cycle * gait.iterations or len(set(cycle)) != legs:
        named = ", ".join(str(foot + 1) for foot in feet[:MOST_NAMED])
        steps = f"in the order {named}{', …' if len(feet) > MOST_NAMED else ''}" if feet else "not at all"
        iterations = f"{gait.iterations} iterations" if gait.iterations > 1 else "one iteration"
        raise InputError(
            f"In this timeline the feet step {steps}, in {iterations}. In a gait for the robot's clock every "
            "foot steps once an iteration, always in the same order.",
            "timeline",
        )
    shift = gait.quarter_turns * legs // 4
    return tuple((foot - shift) % legs + 1 for foot in cycle)


def _require_one_by_one(swings: list[Swing]) -> None:
    """No foot is lifted before the one before it stands.

    Args:
        swings: in the order of their first samples.
    """
    for before, after in pairwise(swings):
        if after.first <= before.last:
            pair = sorted((before.foot + 1, after.foot + 1))
            raise InputError(
                f"Feet {pair[0]} and {pair[1]} are in the air together at sample {after.first + 1}. A gait "
                "for the robot's clock lifts one foot after the other.",
                "timeline",
            )


def _readable_as_poses(gait: Gait, model: RobotModel) -> Gait:
    """The gait with the foot order of its timeline, which a gait for the robot's clock can have.

    Raises:
        InputError: it cannot have it.
    """
    if gait.poses is not None:
        raise InputError(f"“{gait.name}” is a gait for the robot's clock already.", "poses")
    if gait.sequence:
        raise InputError("A sequence has several gaits. Convert the gait that a part comes from.", "sequence")
    if model.leg_count == 3:
        raise InputError(
            "With three legs none can be lifted; a gait for the robot's clock needs at least four.", "robot"
        )
    if gait.held.any:
        raise InputError(
            "Feet are held up at the start or the end. In a gait for the robot's clock every foot steps.",
            "held",
        )
    if gait.timeline.locked.any():
        raise InputError("The timeline has locked cells. Unlock them first.", "timeline")
    if gait.options.boundary is not Boundary.REST:
        raise InputError(
            "A gait for the robot's clock begins and ends at rest. Set Ends to “at rest” first.", "boundary"
        )
    _require_numbers(gait)
    return replace(gait, order=step_order(gait))


def _require_numbers(gait: Gait) -> None:
    """Step, turn and clearance are some that a gait for the robot's clock can have.

    Raises:
        InputError: naming the number and its bounds.
    """
    length, turn = float(np.hypot(*gait.step[:2])), gait.step[2]
    if not length and not turn:
        raise InputError(
            "Step and turn are 0; a gait for the robot's clock has to go somewhere or to turn.", "step"
        )
    if abs(turn) > MOST_TURN:
        raise InputError(
            f"The turn is {np.degrees(turn):.1f}° an iteration; a gait for the robot's clock turns by at "
            f"most {np.degrees(MOST_TURN):.0f}°.",
            "step",
        )
    if _is_curve(gait):
        raise InputError(CURVE, "iterations")
    least, most = POSE_BOUNDS["clearance"]
    if not least <= gait.options.clearance <= most:
        raise InputError(
            f"The clearance is {gait.options.clearance * 1000:g} mm; in a gait for the robot's clock it must "
            f"lie between {least * 1000:g} and {most * 1000:g} mm.",
            "clearance",
        )


def _require_drawable(gait: Gait, model: RobotModel) -> None:
    """A drawing can express a gait with poses.

    Raises:
        InputError: it cannot.
    """
    poses = gait.poses
    if poses is None:
        raise InputError(f"“{gait.name}” is no gait for the robot's clock.", "poses")
    if poses.pinned:
        raise InputError(
            f"Pose {poses.pinned[0].pose} is pinned, and a drawing has no poses. Unpin it first.",
            "poses.pinned",
        )
    if poses.sway:
        raise InputError("A drawn gait cannot sway. Set Sway to 0 first.", "poses.sway")
    if poses.overlap:
        raise InputError(
            "The swings overlap: a foot is lifted while the one before it is lowered. A timeline that is "
            "drawn from a foot order has every foot down between two steps. Set Swings to “apart” first.",
            "poses.overlap",
        )
    if _is_curve(gait):
        raise InputError(CURVE, "iterations")
    if poses.free_step and found_gait(gait, model) is None:
        raise InputError(
            "The fastest step is not known yet. Wait for the search, or set Step length to “as set”.",
            "poses.free_step",
        )


def _is_curve(gait: Gait) -> bool:
    """Whether the two kinds of gaits understand its step differently."""
    return gait.iterations > 1 and any(gait.step[:2]) and gait.step[2] != 0.0


def _left_by_poses(gait: Gait) -> list[str]:
    """Sentences on what a gait for the robot's clock does not keep or use of a drawn gait."""
    sentences = []
    if gait.segment_table is not None:
        sentences.append("The segment table is set aside.")
    elif gait.recorded is not None:
        sentences.append(f"The recorded motion of {gait.recorded.file} is set aside.")
    elif not is_drawn(gait):
        sentences.append("The painted timeline is set aside; only its foot order counts.")
    if sentences:
        sentences.append(UNDO_BRINGS_BACK)
    options, usual = gait.options, GaitOptions()
    unused = [
        name.replace("_", " ").replace("plane height", "body height")
        for name in UNUSED_OPTIONS
        if getattr(options, name) != getattr(usual, name)
    ]
    if options.turning is HeadingProfile.RETURN and gait.step[2]:
        unused.append("turning at the end")
    if unused:
        sentences.append(f"Not used here: {', '.join(unused)}.")
    return sentences


def _left_by_drawing(poses: Poses) -> list[str]:
    """Sentences on limits of a gait for the robot's clock that a drawn gait does not have."""
    usual = Poses()
    unused = [
        name.replace("_", " ")
        for name in ("slip", "shoe_distance", "arm_distance")
        if getattr(poses, name) != getattr(usual, name)
    ]
    return [f"A drawn gait does not use: {', '.join(unused)}. Undo brings them back."] if unused else []
