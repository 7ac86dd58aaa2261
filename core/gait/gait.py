"""The gait: the document that a person edits, saves, optimises and sends."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.gait.foot_roles import ring_roles
from core.gait.held_feet import HeldFeet, held_height
from core.gait.held_rules import require_feet, require_repeatable, require_rest
from core.gait.options import GaitOptions
from core.gait.poses import Poses
from core.gait.provenance import Provenance
from core.gait.recording import Recording
from core.gait.step import require_step
from core.motion.contact_timeline import ContactTimeline, drawn_samples, timeline_from_order
from core.motion.heading_profile import HeadingProfile, heading_profile, return_knots
from core.motion.trajectory import quarter_turn
from core.names import is_visible
from core.problem.motion_problem import (
    Boundary,
    MotionProblem,
    RestPose,
    maps_onto_itself,
    standing_pose,
)
from core.problem.resting_pose import resting_body
from core.robot.model import RobotModel
from core.segments.segment_table import SegmentTable

MOST_TIMES = 20
"""How often a part of a sequence may run."""
MOST_PARTS = 40
"""How many parts a sequence may have."""
MOST_NAME, MOST_NOTES = 120, 20_000
"""Characters that a gait's name and notes may have."""


class Orientation(StrEnum):
    """Which way the robot's feet are seen (thesis 3.2)."""

    FB = "FB"
    """Front and back pairs; moves along the diagonals."""
    FBS = "FBS"
    """Front, sides, back; moves along the axes."""


_ROLES = {Orientation.FB: ("FR", "FL", "BL", "BR"), Orientation.FBS: ("F", "L", "B", "R")}


@dataclass(frozen=True)
class Gait:
    """The document.

    Args:
        name: what a person calls it.
        robot: name of the robot's parameters file.
        orientation: FB or FBS.
        direction: 1 to 4 (thesis Table 3.1).
        order: feet in the order of their steps at direction 1, counted from 1.
        step: (dx, dy, yaw) of the body an iteration in world axes at direction 1, m, m, rad.
        iterations: how often every foot steps.
        timeline: contact of the robot's own feet, all iterations and the closing stance.
        segment_table: of one iteration at direction 1, where the gait is made by hand; else None.
        options: what the optimiser is asked.
        notes: a person's words.
        recorded: the motion of a file, which is then the gait's motion; None where it is computed.
        provenance: of the last computed result, for whichever version of the gait; None where there is none.
        sequence: the gaits that it chains; then order, step, iterations and timeline follow from them (see
            `core.library.sequence`). Empty for a gait of its own.
        poses: of a gait for the robot's clock; then the timeline follows from order, iterations and poses, a
            sample a pose. None for every other gait.
        held: feet that are in the air at the first or the last sample on purpose; every other one stands.
    """

    name: str
    robot: str
    orientation: Orientation
    direction: int
    order: tuple[int, ...]
    step: tuple[float, float, float]
    iterations: int
    timeline: ContactTimeline
    segment_table: SegmentTable | None = None
    options: GaitOptions = field(default_factory=GaitOptions)
    notes: str = ""
    recorded: Recording | None = None
    provenance: Provenance | None = None
    sequence: tuple[SequencePart, ...] = ()
    held: HeldFeet = field(default_factory=HeldFeet)
    poses: Poses | None = None

    def __post_init__(self) -> None:
        _require_text("name", self.name, MOST_NAME)
        _require_text("notes", self.notes, MOST_NOTES)
        if not is_visible(self.name):
            raise InputError("The gait has no name; give it one.", "name")
        if self.direction not in (1, 2, 3, 4):
            raise InputError(f"direction is {self.direction}; it must be 1, 2, 3 or 4.", "direction")
        if not 1 <= self.iterations <= 20:
            raise InputError(f"iterations is {self.iterations}; it must lie between 1 and 20.", "iterations")
        if len(self.sequence) > MOST_PARTS:
            raise InputError(
                f"The sequence has {len(self.sequence)} parts; at most {MOST_PARTS} are chained. Repeat a "
                "part, or make two sequences.",
                "sequence",
            )
        parts = sum(part.times * part.gait.iterations for part in self.sequence)
        require_step(self.step, parts or None)
        if sorted(self.order) != list(range(1, self.timeline.leg_count + 1)):
            raise InputError(
                f"order is {list(self.order)}; it must name each foot 1 to {self.timeline.leg_count} once.",
                "order",
            )
        require_feet(self.held, self.timeline.leg_count)
        if self.poses is not None and (self.segment_table or self.recorded or self.sequence):
            raise InputError(
                "A gait for the robot's clock has no segment table, no recorded motion and no parts; take "
                "them or its poses out of the document.",
                "poses",
            )

    def with_options(self, **changes: Any) -> Gait:
        """The gait with some of its options changed; its timeline stays as it is."""
        return replace(self, options=replace(self.options, **changes))

    @property
    def quarter_turns(self) -> int:
        """How far the gait is turned from direction 1, in steps of 90°."""
        return self.direction - 1

    @property
    def step_world(self) -> Floats:
        """(2,) the body's displacement an iteration in the world, m."""
        return np.asarray(quarter_turn(self.quarter_turns)[:2, :2] @ np.array(self.step[:2]))

    @property
    def roles(self) -> tuple[str, ...]:
        """Each foot's role, foot 1 first (thesis Table 3.1).

        Where it has not four, sides are counted from the front; nothing where a sequence's parts differ.
        """
        legs = self.timeline.leg_count
        if self.sequence:
            shared = {part.gait.roles for part in self.sequence}
            return shared.pop() if len(shared) == 1 else ("",) * legs
        if legs != 4:
            return ring_roles(legs, heading_angle(self.orientation) + self.quarter_turns * np.pi / 2)
        names = _ROLES[self.orientation]
        return tuple(names[(foot - self.quarter_turns) % 4] for foot in range(4))


@dataclass(frozen=True)
class SequencePart:
    """A gait and how often it runs.

    Args:
        gait: a copy of it, so that the sequence is complete by itself.
        times: how often it runs.
        source: id of the gait that it was copied from; None where that is not known.
        restarts: whether each repetition is the whole gait with its own motion, from rest to rest; else its
            iterations follow each other without a pause where they can.
    """

    gait: Gait
    times: int = 1
    source: str | None = None
    restarts: bool = False

    def __post_init__(self) -> None:
        if not 1 <= self.times <= MOST_TIMES:
            raise InputError(
                f"“{self.gait.name}” runs {self.times} times in the sequence; it must be 1 to {MOST_TIMES}.",
                "times",
            )
        if self.gait.poses is not None:
            raise InputError(
                f"“{self.gait.name}” is made for the robot's clock, whose samples are not evenly apart; a "
                "sequence cannot have it as a part yet.",
                "sequence",
            )
        if self.gait.sequence:
            raise InputError(
                f"“{self.gait.name}” is a sequence; a part must be a single gait. Add its parts instead.",
                "sequence",
            )


def _require_text(field_name: str, text: str, most: int) -> None:
    if len(text) > most:
        raise InputError(f"{field_name} has {len(text)} characters; at most {most} are kept.", field_name)
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise InputError(
            f"{field_name} holds half a character at {error.start}; type it again.", field_name
        ) from error


def heading_angle(orientation: Orientation) -> float:
    """Which way a gait goes at direction 1, rad from x: FB along the diagonal, FBS along x."""
    return np.pi / 4 if orientation is Orientation.FB else 0.0


def heading_step(orientation: Orientation, step: float) -> tuple[float, float, float]:
    """A step along the gait's heading at direction 1: FB along the diagonal, FBS along x.

    Args:
        orientation: of the gait.
        step: body displacement an iteration, m.
    """
    if orientation is Orientation.FB:
        along = step / float(np.sqrt(2.0))
        return (along, along, 0.0)
    return (step, 0.0, 0.0)


def drawn_timeline(gait: Gait) -> ContactTimeline:
    """The timeline of a gait's foot order, phase lengths, iterations and direction.

    Feet that are held up at both ends are in the air throughout, and the others take turns.
    """
    legs = gait.timeline.leg_count
    shift = gait.quarter_turns * legs // 4
    held = gait.held.turned(-shift, legs).both
    walking = [foot for foot in range(1, legs + 1) if foot not in held]
    drawn = timeline_from_order(
        len(walking),
        [walking.index(foot) + 1 for foot in gait.order if foot not in held],
        phase_knots=gait.options.phase_knots,
        closing_knots=gait.options.closing_knots,
        iterations=gait.iterations,
        sample_time=gait.timeline.sample_time,
    )
    if held:
        stance = np.zeros((legs, drawn.sample_count), dtype=np.bool_)
        stance[[foot - 1 for foot in walking]] = drawn.stance
        drawn = ContactTimeline(stance, np.zeros_like(stance), drawn.sample_time)
    return drawn.turned(gait.quarter_turns)


def is_drawn(gait: Gait) -> bool:
    """Whether the timeline is the one that the gait's order, phases, iterations and direction draw."""
    legs, options = gait.timeline.leg_count, gait.options
    walking = legs - len(gait.held.both)
    samples = drawn_samples(walking, options.phase_knots, options.closing_knots, gait.iterations)
    if samples != gait.timeline.sample_count:  # it may also be too long to be drawn
        return False
    return np.array_equal(gait.timeline.stance, drawn_timeline(gait).stance)


def with_return(gait: Gait, model: RobotModel) -> Gait:
    """The gait redrawn with a closing stance in which its body can turn back over its feet.

    Args:
        gait: whose body turns after its steps; others are given back as they are.
        model: its robot, for the motors' speed.
    """
    yaw = gait.step[2]
    if gait.options.turning is not HeadingProfile.RETURN or yaw == 0.0:
        return gait
    least, sample_time = GaitOptions.closing_knots, gait.timeline.sample_time
    knots = return_knots(model, yaw, gait.options.plane_height, sample_time, least)
    changed = replace(gait, options=replace(gait.options, closing_knots=knots))
    return replace(changed, timeline=drawn_timeline(changed))


def with_iterations(gait: Gait, iterations: int) -> Gait:
    """The gait run through another number of times, its closing stance once at the end.

    A timeline of foot order and phase lengths is drawn anew; any other one is repeated as it stands.

    Raises:
        InputError: the timeline does not divide into the iterations that it is said to hold, or it does not
            end with the same feet held up as it begins.
    """
    if iterations > 1:
        require_repeatable(gait.held)
    changed = replace(gait, iterations=iterations)
    drawn = is_drawn(gait)
    if drawn or gait.segment_table is not None:
        return replace(changed, timeline=drawn_timeline(changed)) if drawn else changed
    stance, locked = gait.timeline.stance, gait.timeline.locked
    moving = np.nonzero(~stance[stance.any(axis=1)].all(axis=0))[0]
    resting = stance.shape[1] - 1 - int(moving.max(initial=-1))
    length, rest = divmod(stance.shape[1] - min(resting, gait.options.closing_knots), gait.iterations)
    if rest:
        raise InputError(
            f"The timeline's {gait.iterations} iterations are not equally long, so it cannot be repeated. "
            "Draw one iteration first.",
            "iterations",
        )

    def repeated(cells: Bools) -> Bools:
        again = np.tile(cells[:, :length], (1, iterations))
        return np.concatenate([again, cells[:, length * gait.iterations :]], axis=1)

    timeline = replace(gait.timeline, stance=repeated(stance), locked=repeated(locked))
    return replace(changed, timeline=timeline)


def resting_poses(gait: Gait, model: RobotModel) -> tuple[RestPose, RestPose]:
    """Where a gait begins and ends at rest: at the origin, and all iterations further on.

    Feet that are held up rest under their module, in the air. Where the other feet would not carry the body
    in their middle, body and held feet rest a little aside.
    """
    options, held = gait.options, gait.held
    dx, dy = gait.step_world * gait.iterations
    end_height = options.plane_height if options.end_plane_height is None else options.end_plane_height
    start = standing_pose(model, options.plane_height, (0.0, 0.0))
    goal = standing_pose(model, end_height, (float(dx), float(dy)), gait.step[2] * gait.iterations)
    return (
        resting_body(start.raised(held.start, held_height(options.clearance)), held.start, options.margin),
        resting_body(goal.raised(held.end, held_height(options.clearance)), held.end, options.margin),
    )


def travel_world(gait: Gait, model: RobotModel) -> Floats:
    """(2,) how far the body goes in the world from its gait's first sample to the last, m.

    In a curve of a gait for the robot's clock each cycle goes along its own heading.
    """
    if gait.poses is not None:
        x, y = gait.step_world
        steps = complex(x, y) * np.exp(1j * gait.step[2] * np.arange(gait.iterations))
        return np.array([steps.sum().real, steps.sum().imag])
    is_computed = gait.recorded is None and gait.segment_table is None and not gait.sequence
    if not (is_computed and gait.held.any):
        return gait.step_world * gait.iterations
    start, goal = resting_poses(gait, model)
    return np.asarray((goal.body_world - start.body_world)[:2])


def motion_problem(gait: Gait, model: RobotModel) -> MotionProblem:
    """The optimisation problem of a gait, from one resting pose to the other (see `resting_poses`).

    Raises:
        InputError: a foot neither stands at the last sample nor is held up, its body has no time to turn, or
            it is a sequence.
    """
    if gait.sequence:
        raise InputError(
            f"“{gait.name}” is a sequence: its parts have motions of their own. Optimise the gait that a "
            "part comes from, and update the part.",
            "sequence",
        )
    if gait.poses is not None:
        raise InputError(
            f"“{gait.name}” is made for the robot's clock, and no trajectory is optimised for it; "
            "`footfall fastest` looks for its poses.",
            "poses",
        )
    require_rest(gait.timeline, gait.held, cycle=gait.options.boundary is Boundary.PERIODIC)
    options = gait.options
    start, goal = resting_poses(gait, model)
    yaw = gait.step[2]
    profile = heading_profile(gait.timeline, yaw, gait.iterations, options.turning) if yaw else None
    return MotionProblem(
        model=model,
        timeline=gait.timeline,
        start=start,
        goal=goal,
        limits=options.motion_limits(),
        cost=options.cost,
        quarter_turns=gait.quarter_turns if maps_onto_itself(model.leg_count, gait.quarter_turns) else 0,
        boundary=options.boundary,
        heading_profile=profile,
    )
