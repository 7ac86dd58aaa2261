"""The independent check of a pose gait, by forward kinematics along every move.

It shares the leg's geometry with the solvers and nothing else: what a solver says about body and feet within
a move is not looked at. Between two poses the strokes mix evenly; forward kinematics gives every foot in the
body's frame, and the body is where its standing feet are as near to their footholds as they can be.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, first_highest, first_lowest, first_place
from core.pose_gaits.motion_in_move import SAMPLES, MotionInMove, motions_in_moves
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import MOST_TURN, REST_HEIGHT, SWING_SHARE, PoseProblem
from core.problem.motion_problem import standing_pose
from core.robot.kinematics import BodyPose, UnreachableError, walker_strokes
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs
from core.wire.robot_time import stop_seconds

HEADING_TOLERANCE = 0.002
"""A heading may leave an even turn by this much more than asked, rad, besides what slip lets it."""
NEAR_GROUND = 0.0005
"""A swinging foot that is lower than this drags, m."""
HEIGHT_TOLERANCE = 0.00015
"""Between the fractions at which a solver holds its rows, a swing may be this much lower than asked, m."""
TOLERANCE = 0.00005
"""The same for margin, slip and distance of shoes, m: half of what the wire's four decimals and the slack of
the rows between their fractions amount to."""
POSE_TOLERANCE = 1e-7
"""Of strokes against poses, footholds and ends, m."""


@dataclass(frozen=True)
class PoseFinding:
    """A limit that a pose gait does not keep.

    Args:
        limit: which, as the option is called.
        move: in which move, counted from 1; None where it is about a pose or the whole gait.
        foot: which foot, counted from 1, or None.
        amount: by how much, m, s or rad.
        sentence: all of this, for a person.
    """

    limit: str
    move: int | None
    foot: int | None
    amount: float
    sentence: str


@dataclass(frozen=True)
class PoseFigures:
    """Figures of a pose gait over all moves; lengths in m.

    Args:
        margin: least static stability margin.
        slip: farthest that a standing foot is from its foothold, horizontally.
        slip_height: the same, vertically.
        half_way_height: least height of a swinging foot in the middle of a move, over the standing feet.
        drag: farthest that a foot lower than `NEAR_GROUND` is from where it stood or will stand.
        shoe_distance: least distance between the middles of two feet.
        arm_distance: least room between the arms of neighbouring legs; below 0 they are in one another.
        stroke_least: smallest stroke.
        stroke_most: largest stroke.
        largest_move: largest move of a motor.
        stop_seconds: longest time until the robot hears a stop, s.
    """

    margin: float
    slip: float
    slip_height: float
    half_way_height: float
    drag: float
    shoe_distance: float
    arm_distance: float
    stroke_least: float
    stroke_most: float
    largest_move: float
    stop_seconds: float


@dataclass(frozen=True)
class PoseCheck:
    """What the check found.

    Args:
        figures: of the gait.
        findings: limits that it does not keep; empty where it is confirmed.
    """

    figures: PoseFigures
    findings: tuple[PoseFinding, ...]

    @property
    def confirmed(self) -> bool:
        """Whether every limit is kept."""
        return not self.findings


def check_poses(gait: PoseGait, samples: int = SAMPLES) -> PoseCheck:
    """Checks a pose gait densely along all moves, from its strokes alone.

    Args:
        gait: poses, strokes and problem.
        samples: places along each move.
    """
    motions = motions_in_moves(gait, samples)
    findings = [*_end_findings(gait), *_stroke_findings(gait)]
    for move, motion in enumerate(motions):
        findings += _move_findings(gait.problem, move, motion)
        findings += _sway_findings(gait, move, motion)
    return PoseCheck(_figures(gait, motions), tuple(findings))


def _figures(gait: PoseGait, motions: list[MotionInMove]) -> PoseFigures:
    largest = float(gait.moves.max())
    return PoseFigures(
        margin=min(float(motion.margins.min()) for motion in motions),
        slip=max(float(np.abs(motion.slips[..., :2]).max()) for motion in motions),
        slip_height=max(float(np.abs(motion.slips[..., 2]).max()) for motion in motions),
        half_way_height=min(_half_way_height(motion) for motion in motions),
        drag=max(_drag(gait, move, motion) for move, motion in enumerate(motions)),
        shoe_distance=min(float(_foot_distances(motion.feet).min()) for motion in motions),
        arm_distance=min(float(motion.arms.min()) for motion in motions),
        stroke_least=float(gait.strokes.min()),
        stroke_most=float(gait.strokes.max()),
        largest_move=largest,
        stop_seconds=stop_seconds(largest),
    )


def _half_way_height(motion: MotionInMove) -> float:
    heights = motion.heights[len(motion.shares) // 2, ~motion.standing]
    return float(heights.min(initial=np.inf))


def _drag(gait: PoseGait, move: int, motion: MotionInMove) -> float:
    """Farthest that a low swinging foot is from where it stood, or where it will stand, m."""
    farthest = 0.0
    for foot in np.nonzero(~motion.standing)[0]:
        lifts = not gait.problem.airborne[move, foot]
        foothold = gait.feet[move if lifts else move + 1, foot, :2]
        low = motion.heights[:, foot] < NEAR_GROUND
        if low.any():
            away = np.linalg.norm(motion.feet[low, foot, :2] - foothold, axis=1)
            farthest = max(farthest, float(away.max()))
    return farthest


def _foot_distances(feet: Floats) -> Floats:
    """(n, pairs) horizontal distances between the middles of any two feet, m."""
    first, second = np.triu_indices(feet.shape[1], 1)
    return np.asarray(np.linalg.norm(feet[:, first, :2] - feet[:, second, :2], axis=-1))


def _move_findings(problem: PoseProblem, move: int, motion: MotionInMove) -> Iterator[PoseFinding]:
    bounds = problem.bounds
    where = f"in move {move + 1}"
    short = bounds.margin - float(motion.margins.min())
    if short > TOLERANCE:
        yield _finding("margin", move, None, short, f"The margin {where} is {{}} below {_mm(bounds.margin)}.")
    slips = np.abs(motion.slips)
    for foot in np.nonzero(motion.standing)[0]:
        over = max(slips[:, foot, :2].max() - bounds.slip, slips[:, foot, 2].max() - bounds.slip / 2)
        if over > TOLERANCE:
            sentence = (
                f"Foot {foot + 1}, which stands {where}, is {{}} farther than allowed off its foothold."
            )
            yield _finding("slip", move, int(foot), over, sentence)
    for foot in np.nonzero(~motion.standing)[0]:
        floor = problem.floor[move : move + 2, foot]
        required = SWING_SHARE * ((1 - motion.shares) * floor[0] + motion.shares * floor[1])
        required[[0, -1]] = floor
        low = float((required - motion.heights[:, foot]).max())
        if low > HEIGHT_TOLERANCE:
            sentence = f"Foot {foot + 1}, which swings {where}, is {{}} lower than asked."
            yield _finding("clearance", move, int(foot), low, sentence)
    distances = _foot_distances(motion.feet)
    near = bounds.shoe_distance - float(distances.min())
    if near > TOLERANCE:
        first, second = np.triu_indices(problem.model.leg_count, 1)
        pair = int(first_lowest(distances.min(axis=0)))
        sentence = (
            f"Feet {first[pair] + 1} and {second[pair] + 1} come {{}} nearer to each other {where} than "
            f"{_mm(bounds.shoe_distance)}."
        )
        yield _finding("shoe distance", move, int(first[pair]), near, sentence)
    near = bounds.arm_distance - float(motion.arms.min())
    if bounds.arm_distance > 0.0 and near > TOLERANCE:
        one, other = sorted(neighbour_pairs(problem.model.leg_count)[int(first_lowest(motion.arms))].tolist())
        sentence = (
            f"The arms of legs {one + 1} and {other + 1} come {{}} nearer to each other {where} than "
            f"{_mm(bounds.arm_distance)}."
        )
        yield _finding("arm distance", move, one, near, sentence)


def _sway_findings(gait: PoseGait, move: int, motion: MotionInMove) -> Iterator[PoseFinding]:
    """The heading is nowhere farther from an even turn than asked."""
    problem = gait.problem
    room = HEADING_TOLERANCE + (problem.bounds.slip / problem.model.radius if problem.is_turned else 0.0)
    whole = gait.turn * problem.all_cycles
    even = whole * (move + motion.shares) / problem.move_count
    over = float(np.abs(motion.heading - even).max()) - problem.sway
    if over > room:
        sentence = (
            f"The heading in move {move + 1} is {np.degrees(over):.2f}° farther from an even turn than the "
            f"{np.degrees(problem.sway):g}° that are asked."
        )
        yield PoseFinding("sway", move + 1, None, over, sentence)


def _stroke_findings(gait: PoseGait) -> Iterator[PoseFinding]:
    """Strokes within the motors' range, moves within the stop bound, and motors that share an actuator."""
    problem = gait.problem
    limits = problem.model.stroke
    over = np.maximum(limits.lower - gait.strokes, gait.strokes - limits.upper)
    pose, foot, motor = first_place(over)
    if over.max() > POSE_TOLERANCE:
        sentence = f"Motor {motor + 1} of foot {foot + 1} is {{}} beyond its range at pose {pose + 1}."
        yield _finding("stroke", None, foot, float(over.max()), sentence)
    long = float(gait.moves.max()) - problem.largest_move
    if long > POSE_TOLERANCE:
        move = int(first_highest(gait.moves))
        sentence = (
            f"Move {move + 1} is {{}} longer than the {_mm(problem.largest_move)} that a stop bound of "
            f"{problem.bounds.stop_bound:g} s allows."
        )
        yield _finding("stop bound", move, None, long, sentence)
    coupling = problem.model.coupling
    flat = gait.strokes.reshape(len(gait.strokes), -1)
    off = np.abs(flat - flat @ np.linalg.pinv(coupling).T @ coupling.T).max()
    if off > POSE_TOLERANCE:
        yield _finding("coupling", None, None, float(off), "Motors that share an actuator differ by {}.")


def _end_findings(gait: PoseGait) -> Iterator[PoseFinding]:
    """Poses and strokes agree, standing feet stay, and the ends are what the problem asks for."""
    problem, model = gait.problem, gait.problem.model
    try:
        strokes = walker_strokes(model, gait.feet, BodyPose(gait.bodies, gait.headings))
    except UnreachableError as error:
        yield PoseFinding("poses", None, error.foot + 1, error.distance, error.sentence)
        return
    off = float(np.abs(strokes - gait.strokes).max())
    if off > POSE_TOLERANCE:
        yield _finding("poses", None, None, off, "Strokes and poses differ by {}.")
    still = ~problem.moving[..., None]
    off = float(np.abs(np.where(still, np.diff(gait.feet, axis=0), 0.0)).max())
    off = max(off, float(np.abs(np.where(problem.airborne, 0.0, gait.feet[..., 2])).max()))
    if off > POSE_TOLERANCE:
        yield _finding("footholds", None, None, off, "A standing foot is {} off its foothold at a pose.")
    low, high = problem.bounds.plane_height
    off = float(np.maximum(low - gait.bodies[:, 2], gait.bodies[:, 2] - high).max())
    if off > POSE_TOLERANCE:
        yield _finding("body height", None, None, off, "The body is {} outside its range of heights.")
    off = 0.0 if problem.step is None else abs(gait.step - problem.step)
    if off > POSE_TOLERANCE:
        yield _finding("step", None, None, off, "The step is {} off what was asked.")
    yield from _turn_findings(gait)
    off = float(np.abs(gait.bodies[-1, :2] - gait.bodies[0, :2] - _asked_travel(gait)).max())
    if off > POSE_TOLERANCE:
        yield _finding("step", None, None, off, "The body ends {} off where it should.")
    for pin in problem.pinned:
        away = gait.bodies[pin.pose - 1, :2] - gait.bodies[0, :2] - problem.pinned_place(pin, gait.step)
        off = float(np.abs(away).max())
        if off > POSE_TOLERANCE:
            words = f"The body is {{}} off the place to which pose {pin.pose} is pinned."
            yield _finding("pinned pose", None, None, off, words)
    off = _end_distance(gait)
    if off > POSE_TOLERANCE:
        ends = "The first and the last pose differ" if problem.cycles is None else "An end is off the stance"
        yield _finding("ends", None, None, off, f"{ends} by {{}}.")


def _turn_findings(gait: PoseGait) -> Iterator[PoseFinding]:
    """The body turns as far as asked, to the side that was asked, and a walk begins with the heading 0."""
    problem = gait.problem
    off = abs(gait.turn - problem.turn)
    if problem.free_turn:
        is_side = gait.turn * problem.turn > 0.0
        off = max(abs(gait.turn) - MOST_TURN, 0.0) if is_side else abs(gait.turn)
        off = off if is_side or off else POSE_TOLERANCE * 2.0
    if off > POSE_TOLERANCE:
        yield PoseFinding("turn", None, None, off, f"The body turns {np.degrees(off):.2f}° a cycle off.")
    begins = 0.0 if problem.cycles is None else abs(float(gait.headings[0]))
    if begins > POSE_TOLERANCE:
        sentence = f"The body is turned by {np.degrees(begins):.2f}° where the walk begins."
        yield PoseFinding("ends", None, None, begins, sentence)


def _asked_travel(gait: PoseGait) -> Floats:
    """(2,) from the first place of the body to the last: every cycle along its own heading, m."""
    return np.asarray(gait.step * gait.problem.whole_travel())


def _end_distance(gait: PoseGait) -> float:
    """How far the ends are from being the same stance, or from the standard one, m."""
    problem = gait.problem
    if problem.cycles is None:
        return float(np.abs(gait.strokes[-1] - gait.strokes[0]).max())
    return float(np.abs(gait.strokes[[0, -1]] - rest_strokes(problem.model)).max())


def rest_strokes(model: RobotModel) -> Floats:
    """(legs, 3) strokes of the standard stance, m."""
    stance = standing_pose(model, REST_HEIGHT, (0.0, 0.0))
    plane = stance.body_world - np.array([0.0, 0.0, model.com_height])
    return walker_strokes(model, stance.feet_world, BodyPose(plane, np.zeros(())))


def _finding(limit: str, move: int | None, foot: int | None, amount: float, sentence: str) -> PoseFinding:
    return PoseFinding(
        limit,
        None if move is None else move + 1,
        None if foot is None else foot + 1,
        amount,
        sentence.format(_mm(amount)),
    )


def _mm(metres: float) -> str:
    return f"{metres * 1000:.2f} mm"
