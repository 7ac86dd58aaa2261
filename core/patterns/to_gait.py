"""A pattern becomes a gait: the document that is optimised, checked and played."""

from dataclasses import dataclass, field, replace

import numpy as np

from core.arrays import Bools, Floats, first_lowest
from core.errors import InputError
from core.gait.gait import MOST_NAME, Gait, Orientation
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.motion.contact_timeline import ContactTimeline
from core.motion.heading_profile import HeadingProfile
from core.patterns.sides import PatternSide, require_alike
from core.patterns.sources import require_own_timeline
from core.problem.motion_problem import Boundary, Workspace
from core.robot.model import RobotModel


@dataclass(frozen=True, eq=False)
class Joined:
    """The columns of a transition's document, and which gait each is of.

    Args:
        stance: (legs, n) the first gait up to its cursor, the transition, the second one from its cursor on.
        share: (n,) 0 in the first gait, 1 in the second one, 1/2 between the cursors.
        first: column of the transition's first sample, which is that of the first gait's cursor.
        last: column of its last sample.
    """

    stance: Bools
    share: Floats
    first: int
    last: int


def joined_columns(first: Gait, at: int, second: Gait, to: int, transition: Bools) -> Joined:
    """The columns of two gaits with a transition between their cursors.

    Where a cursor is at a gait's end and a foot is in the air there for that one sample, it comes twice.

    Args:
        first: the gait that is left.
        at: its sample at which the transition begins, 0-based.
        second: the gait that follows.
        to: its sample at which the transition ends, 0-based.
        transition: (legs, samples) whose first and last sample are those of the cursors.

    Raises:
        InputError: the gaits do not fit together, or the pattern does not begin and end as they do.
    """
    require_alike(first, second)
    sides = (PatternSide(first, at, "from"), PatternSide(second, to, "to"))
    for side, column in zip(sides, (0, -1), strict=True):
        if not np.array_equal(transition[:, column], side.state):
            where = "begin" if column == 0 else "end"
            raise InputError(
                f"The pattern does not {where} as “{side.gait.name}” is at sample {side.at + 1}. Solve it "
                "again for this cursor.",
                side.name,
            )
    # A foot that is held at an end cannot leave or reach that place within one sample: the end is held on.
    waits = [
        bool((~transition[:, end] & transition[:, beside]).any()) and is_end
        for end, beside, is_end in ((0, 1, at == 0), (-1, -2, to == second.timeline.sample_count - 1))
    ]
    before = transition[:, :1] if waits[0] else first.timeline.stance[:, :at]
    after = transition[:, -1:] if waits[1] else second.timeline.stance[:, to + 1 :]
    start, samples = before.shape[1], transition.shape[1]
    share = np.repeat([0.0, 0.5, 1.0], [start, samples, after.shape[1]])
    share[[start, start + samples - 1]] = 0.0, 1.0
    return Joined(np.concatenate([before, transition, after], axis=1), share, start, start + samples - 1)


def transition_gait(first: Gait, at: int, second: Gait, to: int, transition: Bools) -> Gait:
    """One gait with a transition: the first gait's columns, the transition's, the second gait's.

    Its step is as long as the foot that swings least can carry it: see `shared_step`. What both gaits ask of
    a motion holds, the stricter number of each; heights are those of the first gait at the start and of the
    second one at the end.

    Args:
        first: the gait that is left.
        at: its sample at which the transition begins, 0-based.
        second: the gait that follows.
        to: its sample at which the transition ends, 0-based.
        transition: (legs, samples) whose first and last sample are those of the cursors.

    Raises:
        InputError: the gaits do not fit together, or the pattern does not begin and end as they do.
    """
    columns = joined_columns(first, at, second, to, transition)
    names = [_shortened(gait.name, MOST_NAME // 2 - 3) for gait in (first, second)]
    return replace(
        first,
        name=f"{names[0]} to {names[1]}",
        order=order_of(columns.stance, first.quarter_turns),
        step=shared_step(first, second, columns),
        iterations=1,
        timeline=_plain(columns.stance, first.timeline.sample_time),
        segment_table=None,
        options=shared_options(first.options, second.options),
        notes=(
            f"From “{names[0]}” at sample {at + 1} to “{names[1]}” at sample {to + 1} by a transition of "
            f"{transition.shape[1]} samples, {columns.first + 1} to {columns.last + 1} of this gait."
        ),
        recorded=None,
        provenance=None,
        held=HeldFeet(first.held.start, second.held.end),
    )


def shared_step(first: Gait, second: Gait, columns: Joined) -> tuple[float, float, float]:
    """The travel of a document with a transition: as far as the foot that swings least can carry it.

    In its own gait a foot travels step · iterations / swings with each swing. Here a swing counts with the
    mean of that over its samples, those between the cursors with half of each gait's; a foot travels the sum
    over its swings, and the step is the shortest of these sums. Feet that begin or end in the air are carried
    by the body and left out, as long as another foot swings.

    Args:
        first: the gait that is left.
        second: the gait that follows.
        columns: of the document.

    Returns:
        (dx, dy, yaw) at direction 1, m, m, rad.
    """
    own = [swing_travel(gait) for gait in (first, second)]
    swings = _plain(columns.stance, 1.0).swings()
    sums = np.zeros((len(columns.stance), 3))
    for swing in swings:
        share = float(columns.share[swing.first : swing.last + 1].mean())
        sums[swing.foot] += (1 - share) * own[0][swing.foot] + share * own[1][swing.foot]
    carried = ~(columns.stance[:, 0] & columns.stance[:, -1])
    feet = np.nonzero(~carried if (~carried).any() else carried)[0]
    lengths = np.linalg.norm(sums[feet], axis=1)
    dx, dy, yaw = sums[feet[int(first_lowest(lengths))]]
    return (float(dx), float(dy), float(yaw))


def swing_travel(gait: Gait) -> Floats:
    """(legs, 3) how far each swing carries a foot on: step · iterations / swings, m, m, rad.

    Of a foot that never swings, or is in the air all along, it is the mean of the others.
    """
    counts = np.bincount([swing.foot for swing in gait.timeline.swings()], minlength=gait.timeline.leg_count)
    whole = np.array(gait.step) * gait.iterations
    walks = (counts > 0) & gait.timeline.stance.any(axis=1)
    if not walks.any():
        return np.tile(whole, (len(counts), 1))
    shares = np.where(walks, 1.0 / np.maximum(counts, 1), 0.0)
    shares[~walks] = shares[walks].mean()
    return np.outer(shares, whole)


def shared_options(first: GaitOptions, second: GaitOptions) -> GaitOptions:
    """What two gaits ask of a motion together: the stricter number of each."""

    def stricter(a: float | None, b: float | None) -> float | None:
        known = [value for value in (a, b) if value is not None]
        return min(known) if known else None

    end = second.plane_height if second.end_plane_height is None else second.end_plane_height
    is_cylinder = Workspace.CYLINDER in (first.workspace, second.workspace)
    return replace(
        first,
        clearance=max(first.clearance, second.clearance),
        margin=max(first.margin, second.margin),
        body_speed=min(first.body_speed, second.body_speed),
        foot_speed=min(first.foot_speed, second.foot_speed),
        workspace=Workspace.CYLINDER if is_cylinder else Workspace.STROKE,
        closing_knots=second.closing_knots,
        end_plane_height=None if end == first.plane_height else end,
        friction=stricter(first.friction, second.friction),
        motor_speed=stricter(first.motor_speed, second.motor_speed),
        motor_acceleration=stricter(first.motor_acceleration, second.motor_acceleration),
        boundary=Boundary.REST,
        turning=HeadingProfile.STEADY,
    )


def walking_limbs(stance: Bools) -> Bools:
    """(legs,) limbs of a cycle that both stand and swing."""
    return np.asarray(stance.any(axis=1) & ~stance.all(axis=1))


def cycle_view(stance: Bools) -> Bools:
    """(legs, samples) the same cycle, begun where the fewest swings are cut and the most feet stand."""
    walking = walking_limbs(stance)
    before = np.roll(stance, 1, axis=1)
    cut = (~stance & ~before)[walking].sum(axis=0)
    seam = int(np.lexsort((-stance.sum(axis=0), cut))[0])
    return np.asarray(np.roll(stance, -seam, axis=1))


def unrolled(stance: Bools, iterations: int, stand: int) -> Bools:
    """(legs, n) a cycle a number of times, from standing to standing.

    Every walking foot stands for the opening samples. A swing across the seam of `cycle_view` is left out of
    the first cycle and completed after the last one, so that each foot has one swing a cycle; the feet stand
    again for the closing samples. Limbs that do not walk are up, or stand, all along.

    Args:
        stance: (legs, samples) one cycle.
        iterations: how often.
        stand: samples of the opening and of the closing stance.
    """
    cycle = cycle_view(stance)
    walking = walking_limbs(cycle)
    # Samples of the seam's swings after the seam; such a swing is in the air at the last sample before it.
    wraps = walking & ~cycle[:, -1]
    tail = np.logical_and.accumulate(~cycle, axis=1) & wraps[:, None]
    body = np.tile(cycle, (1, iterations))
    body[:, : cycle.shape[1]] |= tail
    rest = int(tail.any(axis=0).sum())
    still = np.where(walking, True, cycle[:, 0])[:, None]
    end = np.where(tail[:, :rest], False, still)
    edge = np.repeat(still, stand, axis=1)
    return np.concatenate([edge, body, end, edge], axis=1)


@dataclass(frozen=True)
class CycleUse:
    """How a periodic pattern is walked.

    Args:
        name: of the gait.
        orientation: which way it goes.
        step: (dx, dy, yaw) an iteration at direction 1, m, m, rad.
        direction: 1 to 4; the pattern's feet are the robot's own.
        iterations: how often the cycle runs.
        sample_time: s.
        options: what the optimiser is asked; closing_knots is the length of the opening and closing stance.
        notes: a person's words.
    """

    name: str
    orientation: Orientation
    step: tuple[float, float, float]
    direction: int = 1
    iterations: int = 1
    sample_time: float = 0.4
    options: GaitOptions = field(default_factory=GaitOptions)
    notes: str = ""


def periodic_gait(stance: Bools, model: RobotModel, use: CycleUse) -> Gait:
    """A gait from one cycle: from standing to standing, with at least one sample at either end.

    Args:
        stance: (legs, samples) one cycle; a limb that is up all along is held up.
        model: the robot.
        use: how it is walked.

    Raises:
        InputError: the robot has another number of legs, or the gait would be too long.
    """
    if len(stance) != model.leg_count:
        raise InputError(
            f"The pattern has {len(stance)} limbs; {model.title} has {model.leg_count}.", "robot"
        )
    columns = unrolled(stance, use.iterations, max(use.options.closing_knots, 1))
    up = tuple(int(foot) + 1 for foot in np.nonzero(~stance.any(axis=1))[0])
    return Gait(
        name=use.name,
        robot=model.name,
        orientation=use.orientation,
        direction=use.direction,
        order=order_of(columns, use.direction - 1),
        step=use.step,
        iterations=use.iterations,
        timeline=_plain(columns, use.sample_time),
        options=use.options,
        notes=use.notes,
        held=HeldFeet(up, up),
    )


def completed_gait(gait: Gait, stance: Bools) -> Gait:
    """The same document with its drawing completed; locked cells stay locked.

    Args:
        gait: whose timeline is drawn.
        stance: (legs, samples) of the whole timeline.

    Raises:
        InputError: the timeline follows from something else, has another shape, or a locked cell differs.
    """
    require_own_timeline(gait)
    timeline = gait.timeline
    if stance.shape != timeline.stance.shape:
        raise InputError(
            f"The pattern is {stance.shape[0]} × {stance.shape[1]}, the timeline "
            f"{timeline.leg_count} × {timeline.sample_count}. Solve it again for this timeline.",
            "timeline",
        )
    changed = np.argwhere(timeline.locked & (stance != timeline.stance))
    if len(changed):
        foot, sample = changed[0]
        raise InputError(
            f"The pattern changes foot {foot + 1} at sample {sample + 1}, which is locked. Solve it again.",
            "timeline",
        )
    return replace(gait, timeline=replace(timeline, stance=stance))


def order_of(stance: Bools, quarter_turns: int) -> tuple[int, ...]:
    """Feet in the order of their first swings at direction 1, counted from 1; those without one come last.

    Args:
        stance: (legs, n) of the robot's own feet.
        quarter_turns: how far the gait is turned from direction 1.
    """
    legs, samples = stance.shape
    lifts = (~stance[:, 1:] & stance[:, :-1]) if samples > 1 else np.zeros((legs, 0), dtype=np.bool_)
    first = np.where(lifts.any(axis=1), lifts.argmax(axis=1) if samples > 1 else 0, samples)
    shift = quarter_turns * legs // 4
    at_direction_1 = np.roll(first, -shift)
    return tuple(int(foot) + 1 for foot in np.argsort(at_direction_1, kind="stable"))


def _plain(stance: Bools, sample_time: float) -> ContactTimeline:
    return ContactTimeline(stance, np.zeros_like(stance), sample_time)


def _shortened(name: str, most: int) -> str:
    return name if len(name) <= most else name[: most - 1] + "…"
