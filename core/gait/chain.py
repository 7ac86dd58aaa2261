"""Motions one after the other: each begins where the one before has ended, and both share that knot."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.arrays import Floats
from core.errors import InfeasibleError, InputError
from core.gait.options import GaitOptions
from core.gait.transition import feet_transition
from core.motion.contact_timeline import SAME_INTERVAL
from core.motion.trajectory import Trajectory
from core.problem.body_move import BodyPlace, body_move
from core.problem.motion_problem import MotionProblem, raised_feet
from core.problem.start_footholds import placed_on
from core.robot.model import RobotModel

SAMPLE_TIMES = "sample_time"
"""What the refusal of motions with different sample times is about."""
SAME_POSE = 1e-6
"""Bodies that differ by less are at the same place, m and rad; the solvers' own tolerance."""


@dataclass(frozen=True, eq=False)
class Piece:
    """One motion of a chain.

    Args:
        name: for messages, such as `Part 2, “Walk”`.
        part: which part of the sequence it belongs to, 0-based.
        motion: from rest to rest, in its own world.
    """

    name: str
    part: int
    motion: Trajectory


@dataclass(frozen=True)
class Span:
    """A stretch of a chained motion.

    Args:
        part: which part of the sequence it is, or leads to, 0-based.
        first: its first knot, 0-based.
        last: its last knot, which is also the first one of what follows.
        is_transition: whether it leads from one part to the next.
    """

    part: int
    first: int
    last: int
    is_transition: bool


@dataclass(frozen=True, eq=False)
class Chain:
    """Motions that were put together, and which knots came from where."""

    trajectory: Trajectory
    spans: tuple[Span, ...]

    def clipped(self, parts: Sequence[Floats | None]) -> Floats | None:
        """How far strokes of its parts were clipped, at its own samples.

        Args:
            parts: (n, legs, 3) of each part, m; None where none were.

        Returns:
            (n, legs, 3) m; None where none were.
        """
        if all(part is None for part in parts):
            return None
        whole = np.zeros((self.trajectory.knot_count, self.trajectory.leg_count, 3))
        for span in self.spans:
            own = None if span.is_transition else parts[span.part]
            if own is not None:
                whole[span.first : span.last + 1] = own
        return whole

    @property
    def travel(self) -> Floats:
        """(2,) how far the body goes, m."""
        body = self.trajectory.body_world
        return np.asarray(body[-1, :2] - body[0, :2])

    @property
    def turn(self) -> float:
        """How far the body turns, rad; turns add up beyond 180°."""
        return float(self.trajectory.heading[-1] - self.trajectory.heading[0])


TransitionMotion = Callable[[Piece, Piece, MotionProblem], Trajectory]
"""Gives the motion of the steps between two pieces, from the place where the first one ends."""


def chain(model: RobotModel, pieces: Sequence[Piece], options: GaitOptions, cross: TransitionMotion) -> Chain:
    """Puts motions together: each is turned and shifted so that its feet begin where they stand.

    Where only the body has to be elsewhere, it moves slowly over its standing feet in between; where feet
    have to, they step there one after the other, come down or are lifted.

    Args:
        model: the robot.
        pieces: at least one.
        options: how those moves and steps are made.
        cross: gives the motion of the steps.

    Raises:
        InputError: sample times differ, or a foot is in the air where two motions meet.
        InfeasibleError: the body cannot move over its feet, or there is no motion of the steps.
    """
    if not pieces:
        raise InputError("The sequence has no part; add at least one gait.", "sequence")
    sample_time = _sample_time(pieces)
    for piece in pieces if len(pieces) > 1 else ():
        _require_rest(piece)
    motions, spans = [pieces[0].motion], [Span(pieces[0].part, 0, pieces[0].motion.knot_count - 1, False)]
    for before, piece in pairwise(pieces):
        then = placed_on(motions[-1], piece.motion)
        if then.stays.all():
            between = _body_move(model, motions[-1], then.motion, options, f"{before.name} and {piece.name}")
        else:
            way = feet_transition(model, motions[-1], then, options)
            between = way.placement.motion(cross(before, piece, way.problem))
        for motion, is_transition in [(between, True), (then.motion, False)]:
            if motion is not None:
                motions.append(motion)
                first = spans[-1].last
                spans.append(Span(piece.part, first, first + motion.knot_count - 1, is_transition))
    return Chain(_joined(motions, sample_time), tuple(spans))


def _sample_time(pieces: Sequence[Piece]) -> float:
    """The sample time that all share."""
    own = [float(piece.motion.times[1] - piece.motion.times[0]) for piece in pieces]
    for piece, seconds in zip(pieces, own, strict=True):
        if abs(seconds - own[0]) > 2 * SAME_INTERVAL * own[0]:
            raise InputError(
                f"{piece.name} has a sample every {seconds:g} s, {pieces[0].name} every {own[0]:g} s; a "
                "sequence has one sample time. Resample the parts, or change that gait's sample time.",
                SAMPLE_TIMES,
            )
    return own[0]


def _require_rest(piece: Piece) -> None:
    """Every foot rests where a piece begins and ends: it stands, or is held still in the air."""
    motion = piece.motion
    for where, knot in (("begins", 0), ("ends", -1)):
        speeds: Floats = np.zeros(motion.leg_count)
        if motion.feet_velocity is not None:
            speeds = np.asarray(np.linalg.norm(motion.feet_velocity[knot], axis=-1))
        raised = raised_feet(motion.feet_world[knot]) & (motion.contact[knot] | (speeds > SAME_POSE))
        if raised.any():
            foot = int(raised.argmax())
            height_mm = motion.feet_world[knot, foot, 2] * 1000
            raise InputError(
                f"{piece.name} {where} with foot {foot + 1} {height_mm:.1f} mm above the ground, and on its "
                "way; in a sequence every foot stands or is held up where two gaits meet. Let it come down "
                "there, or hold it up.",
                "sequence",
            )


def _body_move(
    model: RobotModel, standing: Trajectory, then: Trajectory, options: GaitOptions, names: str
) -> Trajectory | None:
    """The body's move over its standing feet; None where it is where it has to be."""
    start = BodyPlace(standing.body_world[-1], float(standing.heading[-1]))
    goal = BodyPlace(then.body_world[0], float(then.heading[0]))
    gap = max(float(np.abs(goal.body_world - start.body_world).max()), abs(goal.heading - start.heading))
    if gap <= SAME_POSE:
        return None
    sample_time = float(standing.times[1] - standing.times[0])
    limits = options.motion_limits()
    try:
        return body_move(model, start, goal, standing.feet_world[-1], limits, sample_time)
    except InfeasibleError as refusal:
        raise InfeasibleError(f"Between {names}: {refusal.sentence}", "sequence") from refusal


def _joined(motions: Sequence[Trajectory], sample_time: float) -> Trajectory:
    """One motion; where two meet, the place is the earlier one's, the speed and force the later one's."""
    if len(motions) == 1:
        return motions[0]

    def places(name: str) -> Floats:
        rest = [getattr(motion, name)[1:] for motion in motions[1:]]
        return np.concatenate([getattr(motions[0], name), *rest])

    def rates(name: str) -> Floats | None:
        known = [getattr(motion, name) for motion in motions]
        if any(values is None for values in known):
            return None
        return np.concatenate([*(values[:-1] for values in known[:-1]), known[-1]])

    contact, feet = places("contact").astype(np.bool_), places("feet_world")
    # Where two meet every foot on the ground stands, though a sample that ends or begins one may be said to
    # swing.
    for knot in np.cumsum([motion.knot_count - 1 for motion in motions[:-1]]):
        contact[knot] = ~raised_feet(feet[knot])
    return Trajectory(
        times=np.asarray(np.arange(len(contact)) * sample_time, dtype=np.float64),
        body_world=places("body_world"),
        heading=places("heading"),
        feet_world=feet,
        contact=contact,
        body_velocity=rates("body_velocity"),
        feet_velocity=rates("feet_velocity"),
        contact_forces=rates("contact_forces"),
    )
