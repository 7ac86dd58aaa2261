"""Sequence documents: gaits one after the other as one document, and what follows from its parts."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.errors import FootfallError, InputError
from core.gait.chain import Chain, Piece, TransitionMotion, chain
from core.gait.gait import MOST_TIMES, Gait, SequencePart, motion_problem, with_iterations
from core.gait.held_feet import HeldFeet
from core.gait.held_rules import require_rest
from core.gait.manual_motion import manual_motion
from core.gait.options import GaitOptions
from core.gait.transition import straight
from core.motion.contact_timeline import MAX_SAMPLES, ContactTimeline
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Boundary
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import RobotModel, load_robot

DERIVED = (
    "robot",
    "orientation",
    "direction",
    "order",
    "step",
    "iterations",
    "timeline",
    "segment_table",
    "held",
)
"""Fields of a sequence document that follow from its parts."""
MOST_APART = 1e-4
"""What the way of the solved parts may differ from the one that the document says, m and rad."""
BETWEEN_MARGIN = 0.003
"""Stability margin of steps between parts where nothing else is said, m; that of the built-in gaits."""


@dataclass(frozen=True)
class RepeatedGait:
    """What a part amounts to: a gait with all its iterations, and how often that is chained."""

    gait: Gait
    copies: int


def run_of(part: SequencePart) -> RepeatedGait:
    """How a part is repeated: as iterations that follow each other without a pause, where its gait can.

    A gait that turns the body starts each time from its new heading, so it is repeated as a whole; so is a
    recorded motion, a gait whose timeline does not divide into iterations, and a part that is to restart.

    Raises:
        InputError: it would run through more iterations than a gait may have.
    """
    gait, iterations = part.gait, part.gait.iterations * part.times
    if part.times == 1 or part.restarts or gait.step[2] != 0.0 or gait.recorded is not None:
        return RepeatedGait(gait, part.times)
    if iterations > MOST_TIMES:
        raise InputError(
            f"“{gait.name}” would run through {iterations} iterations; at most {MOST_TIMES} follow each "
            "other. Repeat it less often, add it twice, or let each repetition start from rest.",
            "times",
        )
    if gait.segment_table is not None:
        return RepeatedGait(replace(gait, iterations=iterations), 1)
    try:
        return RepeatedGait(with_iterations(gait, iterations), 1)
    except InputError:
        return RepeatedGait(gait, part.times)


def chain_runs(
    gait: Gait, model: RobotModel, motions: Sequence[Trajectory], cross: TransitionMotion
) -> Chain:
    """Chains the motions of a sequence's runs with the moves and steps between them.

    Args:
        gait: the sequence; its options say how those are made.
        model: its robot.
        motions: of the run of each part, in their order.
        cross: gives the motion of the steps between two parts.

    Raises:
        InputError: robots or sample times differ, or a foot is in the air where two parts meet.
        InfeasibleError: the body cannot move over its feet, or there is no motion of the steps.
    """
    _require_one_robot(gait)
    pieces = [
        Piece(part_name(index, part), index, motion)
        for index, (part, motion) in enumerate(zip(gait.sequence, motions, strict=True))
        for _ in range(run_of(part).copies)
    ]
    return chain(model, pieces, gait.options, cross)


def part_name(index: int, part: SequencePart) -> str:
    """What messages call a part, such as `Part 2, “Walk”`."""
    return f"Part {index + 1}, “{part.gait.name}”"


def require_own(gait: Gait, whole: Chain) -> None:
    """The document says the timeline and the way of its parts, not those of others.

    Raises:
        InputError: somebody changed the file by hand, or an older program wrote it.
    """
    dx, dy = whole.travel
    apart = np.abs(np.array([dx, dy, whole.turn]) - gait.step).max()
    if apart > MOST_APART or not np.array_equal(whole.trajectory.contact.T, gait.timeline.stance):
        raise InputError(
            "The document's timeline or step is not that of its parts. Change one of the parts, such as how "
            "often it runs, and back: then both are made anew.",
            "timeline",
        )


def part_refusal(gait: Gait) -> str | None:
    """Why a gait cannot be a part of a sequence, in a few words; None where it can, or is a sequence.

    Whether it fits the other parts, as by its sample time, is not looked at.
    """
    if gait.poses is not None:
        return "made for the robot's clock"
    if gait.recorded is None and gait.segment_table is None and not gait.sequence:
        if gait.options.boundary is Boundary.PERIODIC:
            return "a cycle, which never rests"
        try:
            require_rest(gait.timeline, gait.held, cycle=False)
        except InputError:
            return "does not begin and end at rest"
    return None


def ends_and_contact(gait: Gait, model: RobotModel) -> Trajectory:
    """When a gait's feet stand and where its motion begins and ends, without solving it.

    A gait made by hand or recorded is its own motion; of any other one only the ends and the contact mean
    something, and between them everything goes straight.

    Raises:
        InputError: the gait is a cycle, which is not at rest where it begins, or it makes no motion.
    """
    if gait.recorded is not None:
        return gait_trajectory(gait, gait.recorded, model)
    if gait.segment_table is not None:
        return manual_motion(gait, model).trajectory
    if gait.options.boundary is Boundary.PERIODIC:
        raise InputError(
            "it is a cycle, which begins and ends in motion, and a sequence chains gaits from rest to rest. "
            "Set Ends to “at rest” (boundary).",
            "boundary",
        )
    return straight(motion_problem(gait, model))


def sequence_gait(
    name: str, parts: Sequence[SequencePart], notes: str = "", options: GaitOptions | None = None
) -> Gait:
    """The document of gaits that follow each other; what it says beside its parts follows from them.

    Its step is the whole travel and turn in one iteration, its timeline that of all parts and of the moves
    between them.

    Args:
        name: what a person calls it.
        parts: at least one.
        notes: a person's words.
        options: how the body moves and feet step between parts: speeds, clearance, margin, phase lengths.

    Raises:
        InputError: parts are of different robots or sample times, or one of them makes no motion.
        InfeasibleError: two parts do not fit together.
    """
    first = _first_part(parts).gait
    model = load_robot(first.robot)
    own = GaitOptions(margin=BETWEEN_MARGIN) if options is None else options
    draft = replace(
        first,
        name=name,
        notes=notes,
        options=own,
        sequence=tuple(parts),
        direction=1,
        segment_table=None,
        recorded=None,
        provenance=None,
        held=HeldFeet(first.held.start, parts[-1].gait.held.end),
    )
    _require_one_robot(draft)
    motions = [_outline_of(index, part, model) for index, part in enumerate(parts)]
    whole = chain_runs(draft, model, motions, lambda before, piece, problem: straight(problem))
    stance = whole.trajectory.contact.T
    if stance.shape[1] > MAX_SAMPLES:
        raise InputError(
            f"The sequence has {stance.shape[1]} samples; at most {MAX_SAMPLES} are kept. Repeat a part less "
            "often, or make two sequences.",
            "sequence",
        )
    sample_time = first.timeline.sample_time
    timeline = ContactTimeline(stance, np.zeros_like(stance), sample_time)
    dx, dy = whole.travel
    return replace(draft, step=(float(dx), float(dy), whole.turn), iterations=1, timeline=timeline)


def derived(gait: Gait) -> Gait:
    """A sequence with everything that follows from its parts as it should be (see `sequence_gait`)."""
    return sequence_gait(gait.name, gait.sequence, gait.notes, gait.options)


def _first_part(parts: Sequence[SequencePart]) -> SequencePart:
    if not parts:
        raise InputError("The sequence has no part; add at least one gait.", "sequence")
    return parts[0]


def _require_one_robot(gait: Gait) -> None:
    """A sequence and all its parts are for one robot.

    Raises:
        InputError: naming the first part that is for another one.
    """
    for index, part in enumerate(gait.sequence):
        if part.gait.robot != gait.robot:
            raise InputError(
                f"{part_name(index, part)} is for the robot “{load_robot(part.gait.robot).title}”, the "
                f"sequence for “{load_robot(gait.robot).title}”; a sequence moves one robot. Take it out, or "
                "change that gait's robot.",
                "robot",
            )


def _outline_of(index: int, part: SequencePart, model: RobotModel) -> Trajectory:
    try:
        return ends_and_contact(run_of(part).gait, model)
    except FootfallError as refusal:
        raise InputError(f"{part_name(index, part)}: {refusal.sentence}", "sequence") from refusal
