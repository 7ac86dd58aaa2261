"""Between a gait document with poses and the problem that it asks, and what was found for it."""

import hashlib
import json
import math
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait, heading_angle, heading_step
from core.gait.poses import FoundPoses, Poses
from core.motion.contact_timeline import ContactTimeline
from core.motion.trajectory import quarter_turn
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.pose_gaits.start_motion import MM, StartMotion
from core.robot.kinematics import BodyPose, free_strokes, walker_strokes
from core.robot.model import RobotModel

POSE_SAMPLE_TIME = 1.6
"""Sample time of such a gait's timeline, s: about what a move takes. Its real times follow from its poses."""
LONGEST_STOP = 10.0
"""Stop bound where the document has none, s."""
ROUNDED = 9
"""Decimals of a metre with which poses are kept."""
DRAWN_SHARES = 101
"""Places on the way to a pinned pose that are tried where no rod is long enough for it."""
USUAL_STEP = 0.030
"""Step of a drawing where none is known, m."""
_Drawn = tuple[Floats, Floats, Floats]
"""Bodies (poses, 3), headings (poses,) and feet (poses, legs, 3), m and rad."""


def pose_problem(gait: Gait, model: RobotModel) -> PoseProblem:
    """What a gait with poses asks.

    Args:
        gait: the document.
        model: its robot.

    Raises:
        InputError: it asks for what such a gait cannot have.
    """
    if gait.poses is None:
        raise InputError(f"“{gait.name}” is no gait for the robot's clock.", "poses")
    if gait.held.any:
        raise InputError("A gait for the robot's clock has every foot step; none can be held up.", "held")
    if model.leg_count == 3:
        raise InputError("With three legs none can be lifted; choose a robot with at least four.", "robot")
    options, poses, legs = gait.options, gait.poses, model.leg_count
    length, turn = float(np.hypot(*gait.step[:2])), gait.step[2]
    if not length and not turn and not poses.free_step:
        raise InputError(
            "Step and turn are 0; a gait for the robot's clock has to go somewhere or to turn.", "step"
        )
    along = np.arctan2(gait.step[1], gait.step[0]) if length else heading_angle(gait.orientation)
    on_the_spot = not length and turn != 0.0
    return PoseProblem(
        model=model,
        order=tuple((foot - 1 + gait.quarter_turns * legs // 4) % legs + 1 for foot in gait.order),
        # The first cycle goes along the document's step, with half of its turn done in the middle.
        heading=float(along) + gait.quarter_turns * np.pi / 2 - (0.0 if on_the_spot else turn / 2.0),
        step=None if poses.free_step and not on_the_spot else length,
        turn=turn,
        free_turn=poses.free_step and on_the_spot,
        sway=poses.sway,
        overlap=poses.overlap,
        cycles=gait.iterations,
        bounds=PoseBounds(
            margin=options.margin,
            clearance=options.clearance,
            slip=poses.slip,
            shoe_distance=poses.shoe_distance,
            arm_distance=poses.arm_distance,
            stop_bound=LONGEST_STOP if options.stop_bound is None else options.stop_bound,
        ),
        pinned=poses.pinned,
    )


def asked_of(problem: PoseProblem) -> str:
    """SHA-256 of what a problem asks; poses that name it were found for exactly this."""
    asked = {
        "robot": problem.model.name,
        "order": problem.order,
        "heading": round(problem.heading, 9),
        "step": problem.step,
        "turn": math.copysign(1.0, problem.turn) if problem.free_turn else problem.turn,
        "cycles": problem.cycles,
        **vars(problem.bounds),
    }
    if problem.free_turn:
        asked["free_turn"] = True
    if problem.overlap:
        asked["overlap"] = True
    if problem.sway:
        asked["sway"] = problem.sway
    if problem.pinned:
        asked["pinned"] = [vars(pin) for pin in problem.pinned]
    return hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()


def found_gait(gait: Gait, model: RobotModel) -> PoseGait | None:
    """The poses that were found for exactly what a gait asks; None where there are none.

    Whether they keep every limit is for `check_poses` to say.

    Raises:
        InputError: the gait asks for what it cannot have, or its poses are of no such gait.
    """
    problem = pose_problem(gait, model)
    found = None if gait.poses is None else gait.poses.found
    if found is None or found.answers != asked_of(problem):
        return None
    return gait_of_poses(problem, found)


def confirmed_gait(gait: Gait, model: RobotModel) -> PoseGait | None:
    """The poses that were found for exactly what a gait asks, where the check confirms them; else None.

    Raises:
        InputError: as in `found_gait`, or the document's timeline says other feet in the air than its poses.
    """
    found = found_gait(gait, model)
    if found is None or not check_poses(found).confirmed:
        return None
    if not np.array_equal(gait.timeline.stance, ~found.problem.airborne.T):
        raise InputError(
            f"The timeline of “{gait.name}” has other feet in the air than its poses. Solve the gait again.",
            "timeline",
        )
    return found


def gait_of_poses(problem: PoseProblem, found: FoundPoses) -> PoseGait:
    """Poses with their strokes.

    Raises:
        InputError: their number is not that of the problem's moves, or a foot is out of reach.
    """
    for parts in problem.parts_to_try:
        divided = replace(problem, parts=parts)
        shape = (*divided.airborne.shape, 3)
        if shape == found.feet.shape:
            strokes = walker_strokes(problem.model, found.feet, BodyPose(found.bodies, found.turns))
            return PoseGait(divided, found.step, found.bodies, found.turns, found.feet, strokes)
    poses, legs, _ = found.feet.shape
    raise InputError(
        f"poses.found has {poses} poses of {legs} feet, which is no walk of {problem.all_cycles} cycles with "
        f"{problem.model.leg_count} feet. Solve the gait again.",
        "poses.found",
    )


def found_of(solved: PoseGait) -> FoundPoses:
    """Poses as a document keeps them."""
    bodies, feet = np.round(solved.bodies, ROUNDED), np.round(solved.feet, ROUNDED)
    headings = np.round(solved.headings, ROUNDED) if solved.problem.is_turned else None
    return FoundPoses(asked_of(solved.problem), solved.step, bodies, feet, headings)


def with_poses(gait: Gait, solved: PoseGait) -> Gait:
    """The document with the poses that were found for it; a free step or turn becomes theirs."""
    problem, found = pose_problem(gait, solved.problem.model), found_of(solved)
    if gait.poses is None or asked_of(problem) != found.answers:
        raise InputError("These poses were found for another gait.", "poses.found")
    step = gait.step
    if problem.free_turn:
        step = (0.0, 0.0, solved.turn)
    elif gait.poses.free_step:
        way = quarter_turn(-gait.quarter_turns)[:2, :2] @ problem.travel_direction() * solved.step
        step = (float(way[0]), float(way[1]), problem.turn)
    return replace(
        gait, poses=replace(gait.poses, found=found), step=step, timeline=pose_timeline(solved.problem)
    )


def pose_timeline(problem: PoseProblem) -> ContactTimeline:
    """When each foot stands, a sample a pose."""
    stance = ~problem.airborne.T
    return ContactTimeline(stance, np.zeros_like(stance), POSE_SAMPLE_TIME)


def with_pose_timeline(gait: Gait, model: RobotModel) -> Gait:
    """The document with the timeline that follows from what it asks, or from the poses that answer it."""
    found = None if gait.poses is None else gait.poses.found
    return replace(gait, timeline=pose_timeline(_divided(pose_problem(gait, model), found)))


def _divided(problem: PoseProblem, found: FoundPoses | None) -> PoseProblem:
    """The problem with as many parts of a move as known poses have; with the fewest where they do not fit."""
    for parts in problem.parts_to_try:
        divided = replace(problem, parts=parts)
        if found is not None and divided.airborne.shape == found.feet.shape[:2]:
            return divided
    return replace(problem, parts=problem.parts_to_try[0])


def drawn_poses(gait: Gait, model: RobotModel) -> PoseGait:
    """Poses for what a gait asks, drawn at once and solved by nobody: the last ones, adapted.

    Where foot order or number of cycles differ, they are drawn anew: the body goes on evenly. A free turn is
    drawn as far as it was found last. A pinned pose for whose place no rod is long enough is drawn as near to
    it as the rods allow.

    Raises:
        InputError: the gait asks for what it cannot have, or a foot is so far away that no rod is that long.
    """
    found = None if gait.poses is None else gait.poses.found
    problem = _divided(pose_problem(gait, model), found)
    usual = USUAL_STEP if found is None or found.step == 0.0 else found.step
    step = usual if problem.step is None else problem.step
    bodies, headings, feet = _adapted(problem, found, step) or _even(problem, step, found)
    for pin in problem.pinned:
        pose, place = pin.pose - 1, bodies[0, :2] + problem.pinned_place(pin, step)
        bodies[pose, :2] = _within_reach(model, feet[pose], bodies[pose], place)
    strokes = free_strokes(model, feet, BodyPose(bodies, headings))
    if np.isnan(strokes).any():
        pose, leg, _ = np.argwhere(np.isnan(strokes))[0]
        raise InputError(
            f"At pose {pose + 1} no rod is long enough for foot {leg + 1}; take a shorter "
            f"{problem.way_word}.",
            "step",
        )
    return PoseGait(problem, step, bodies, headings, feet, strokes)


def _within_reach(model: RobotModel, feet: Floats, body: Floats, place: Floats) -> Floats:
    """(2,) the point on the way of a body to a place that is nearest to it and still within reach, m."""
    shares = np.linspace(1.0, 0.0, DRAWN_SHARES)[:, None]
    bodies = np.repeat(body[None], DRAWN_SHARES, axis=0)
    bodies[:, :2] = shares * place + (1.0 - shares) * body[:2]
    pose = BodyPose(bodies, np.zeros(DRAWN_SHARES))
    strokes = free_strokes(model, np.repeat(feet[None], DRAWN_SHARES, axis=0), pose)
    reached = ~np.isnan(strokes).any(axis=(1, 2))
    return np.asarray(bodies[int(reached.argmax()), :2])


def _even(problem: PoseProblem, step: float, found: FoundPoses | None) -> _Drawn:
    """The start of the solver's search: everything goes on evenly, a free turn as far as it was found last.

    Where no rod is long enough for that turn, it is the one with which a search begins.
    """
    if problem.free_turn and found is not None and found.headings is not None:
        # The turn of a document whose poses were found is theirs, a cycle.
        drawn = _evenly_on(replace(problem, free_turn=False), step)
        bodies, headings, feet = drawn
        if not np.isnan(free_strokes(problem.model, feet, BodyPose(bodies, headings))).any():
            return drawn
    return _evenly_on(problem, step)


def _evenly_on(problem: PoseProblem, step: float) -> _Drawn:
    start = StartMotion(problem, step * MM)
    return start.bodies / MM, np.array(start.headings), np.array(start.feet) / MM


def _adapted(problem: PoseProblem, found: FoundPoses | None, step: float) -> _Drawn | None:
    """The poses that were found last for what is asked now; None where they do not fit."""
    if found is None or found.feet.shape != (*problem.airborne.shape, 3):
        return None
    if problem.free_turn:
        return _kept_turn(problem, found)
    if problem.is_turned or found.headings is not None or found.step == 0.0:
        return None
    return _stretched(problem, found, step)


def _kept_turn(problem: PoseProblem, found: FoundPoses) -> _Drawn | None:
    """A turn on the spot to the same side with the same feet in the air, each as high as is asked."""
    if found.headings is None or found.step != 0.0:
        return None
    turn = float(found.headings[-1] - found.headings[0])
    if turn * problem.turn <= 0.0 or not np.array_equal(found.feet[..., 2] > 0.0, problem.airborne):
        return None
    return found.bodies.copy(), found.headings, _with_heights(problem, found.feet)


def _with_heights(problem: PoseProblem, feet: Floats) -> Floats:
    """Feet at least as high as is asked, and on the ground where they stand, m."""
    lifted = feet.copy()
    lifted[..., 2] = np.where(problem.airborne, np.maximum(feet[..., 2], problem.floor), 0.0)
    return lifted


def _stretched(problem: PoseProblem, found: FoundPoses, step: float) -> _Drawn | None:
    """Poses of a straight gait turned and stretched to another direction and step.

    A motion that fits has its feet in the air at the same poses, by whichever quarter turn of the robot.
    """
    homes, legs = problem.model.module_centres_robot[:, :2], problem.model.leg_count
    travel = found.bodies[-1, :2] - found.bodies[0, :2]
    before = float(np.arctan2(travel[1], travel[0]))
    turn = problem.heading - before
    shift = round(turn / (2 * np.pi) * legs)
    feet = np.roll(found.feet, shift, axis=1)
    if not np.array_equal(feet[..., 2] > 0.0, problem.airborne):
        return None
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    along = problem.travel_direction()
    stretch = np.eye(2) + (step / found.step - 1.0) * np.outer(along, along)
    bodies, feet = found.bodies.copy(), feet.copy()
    bodies[:, :2] = bodies[:, :2] @ (stretch @ rotation).T
    own_homes = np.roll(homes, shift, axis=0) @ rotation.T
    feet[..., :2] = (feet[..., :2] @ rotation.T - own_homes) @ stretch.T + homes
    return bodies, np.zeros(len(bodies)), _with_heights(problem, feet)


def new_pose_gait(name: str, gait: Gait, poses: Poses, model: RobotModel) -> Gait:
    """A document with poses that takes order, direction, step and options over from another gait.

    Args:
        name: what a person calls it.
        gait: a gait of the optimiser.
        poses: what it asks beside that.
        model: its robot.
    """
    step = gait.step if any(gait.step) else heading_step(gait.orientation, USUAL_STEP)
    bare = replace(
        gait,
        name=name,
        options=replace(gait.options, merge=0.0),
        poses=poses,
        step=step,
        segment_table=None,
        recorded=None,
        provenance=None,
        sequence=(),
    )
    return with_pose_timeline(bare, model)
