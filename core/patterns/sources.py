"""What a search for a pattern starts from: the two sides of a transition, limbs to walk on, or a drawing."""

from collections.abc import Sequence
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools
from core.errors import InputError
from core.gait.gait import Gait, Orientation, heading_angle
from core.patterns.limits import own_balance, shared_balance
from core.patterns.problem import (
    FREE,
    BalanceModel,
    Cells,
    PatternKind,
    PatternProblem,
    PatternRules,
    PatternWeights,
    free_cells,
    transition_cells,
    with_finished_phases,
)
from core.patterns.sides import PatternSide, locked_limbs, require_alike, still_limbs
from core.robot.model import RobotModel, load_robot

F_RULES, F_WEIGHTS = PatternRules(), PatternWeights()
"""The numbers of the footfall-pattern thesis."""

Phases = tuple[NDArray[np.intp], NDArray[np.intp]]
"""(legs,) samples that the phase at a cursor has in its own gait, and those that it lacks."""


class LimbState(StrEnum):
    """What a limb does in a gait that is asked for."""

    WALKS = "walks"
    HELD = "held"
    """In the air throughout, for another task."""
    STANDS = "stands"
    """On the ground throughout."""


def foot_sides(model: RobotModel, orientation: Orientation, direction: int = 1) -> Bools:
    """(2, legs) feet on the left and on the right of the way; those on the centre line count for both.

    Args:
        model: the robot.
        orientation: FB goes along the diagonal at direction 1, FBS along x.
        direction: 1 to 4, a quarter turn each.
    """
    heading = heading_angle(orientation) + (direction - 1) * np.pi / 2
    left = np.round(np.sin(model.azimuths - heading), 9)
    return np.array([left >= 0, left <= 0])


def transition_problem(
    first: Gait,
    at: int,
    second: Gait,
    to: int,
    samples: int,
    *,
    rules: PatternRules = F_RULES,
    weights: PatternWeights = F_WEIGHTS,
    cells: Cells | None = None,
    drawing: Bools | None = None,
    finish_phases: bool = False,
) -> PatternProblem:
    """The search for a transition between two gaits.

    Args:
        first: the gait that is left.
        at: its sample at which the transition begins, 0-based.
        second: the gait that follows.
        to: its sample at which the transition ends, 0-based.
        samples: of the transition, both boundary samples included.
        rules: what holds.
        weights: what counts as better.
        cells: (legs, samples) cells that a person has locked, free elsewhere; None for none.
        drawing: (legs, samples) stance to keep where that can be; None for none.
        finish_phases: whether phases that a cursor cuts last as long as the rules ask of whole ones, what of
            them lies in the gaits included (see `finished_phases`). F exempts them.

    Raises:
        InputError: the gaits do not fit together, a cursor lies outside, or a locked cell contradicts.
    """
    sides = (PatternSide(first, at, "from"), PatternSide(second, to, "to"))
    require_alike(first, second)
    locked = locked_limbs(first, second)
    fixed = transition_cells(sides[0].state, sides[1].state, samples, locked)
    finishing = None
    if finish_phases:
        fixed = finished_phases(fixed, *sides, rules)
        finishing = finishing_cells(*sides, rules)
    model = load_robot(first.robot)
    return PatternProblem(
        kind=PatternKind.TRANSITION,
        fixed=fixed if cells is None else with_locked_cells(fixed, cells),
        walking=~locked,
        sides=foot_sides(model, first.orientation, first.direction),
        rules=rules,
        weights=weights,
        drawing=drawing,
        balance_model=shared_balance(model, first, second),
        sample_time=first.timeline.sample_time,
        finishing=finishing,
    )


def finished_phases(fixed: Cells, first: PatternSide, second: PatternSide, rules: PatternRules) -> Cells:
    """(legs, samples) cells of a transition with those fixed that finish a phase which a cursor cuts.

    A swing that has lasted 2 samples at the first cursor goes on until it has lasted `shortest_swing`, and so
    backwards from the second one; a stance likewise, where it does not begin or end with its gait.

    Args:
        fixed: of `transition_cells`.
        first: the gait that is left.
        second: the gait that follows.
        rules: with the lengths of whole phases; a rule that is off asks for nothing.

    Raises:
        InputError: there is no room for them (see `finishing_length`).
    """
    samples, needed = fixed.shape[1], finishing_length(first, second, rules)
    if samples < needed:
        raise InputError(
            f"The transition has {samples} samples; the swings and stances that its cursors cut need "
            f"{needed} to be finished. Give it as many, or move a cursor.",
            "samples",
        )
    return with_finished_phases(fixed, finishing_cells(first, second, rules))


def finishing_cells(first: PatternSide, second: PatternSide, rules: PatternRules) -> NDArray[np.intp]:
    """(2, legs) how many cells finish the phases that the first and the second cursor cut."""
    before, after = _cut_phases(first, second, rules)
    return np.array([before[1], after[1]])


def finishing_length(first: PatternSide, second: PatternSide, rules: PatternRules) -> int:
    """Samples that a transition needs, both ends included, to finish every phase that its cursors cut.

    A limb that differs between the cursors finishes one phase and has begun another; one that is alike may
    join both into one phase.

    Args:
        first: the gait that is left.
        second: the gait that follows.
        rules: with the lengths of whole phases.

    Raises:
        InputError: the gaits do not fit together.
    """
    require_alike(first.gait, second.gait)
    (done, begun), (ahead, ending) = _cut_phases(first, second, rules)
    joined = np.maximum(np.maximum(begun - ahead, ending - done), 0)
    inner = np.where(first.state == second.state, joined, begun + ending)
    inner[locked_limbs(first.gait, second.gait)] = 0
    return 2 + int(inner.max())


def _cut_phases(first: PatternSide, second: PatternSide, rules: PatternRules) -> tuple[Phases, Phases]:
    before = first.gait.timeline.stance[:, first.at :: -1]
    after = second.gait.timeline.stance[:, second.at :]
    return _lengths(before, rules), _lengths(after, rules)


def _lengths(stance: Bools, rules: PatternRules) -> Phases:
    """Of (legs, n) stance from a cursor outwards."""
    own, lacking = [], []
    for row in stance:
        same = int(np.argmin(np.append(row == row[0], False)))
        least = (rules.shortest_stance if row[0] else rules.shortest_swing) or 0
        is_whole = bool(row[0]) and same == len(row)
        own.append(same)
        lacking.append(0 if is_whole else max(least - same, 0))
    return np.array(own), np.array(lacking)


def with_locked_cells(fixed: Cells, cells: Cells) -> Cells:
    """(legs, samples) cells with those that a person has locked.

    Raises:
        InputError: another shape, or a cell that is fixed already to the other value.
    """
    if cells.shape != fixed.shape:
        raise InputError(
            f"The locked cells are {cells.shape[0]} × {cells.shape[1]}; the pattern has {fixed.shape[0]} "
            f"limbs and {fixed.shape[1]} samples.",
            "locked",
        )
    conflict = np.argwhere((cells != FREE) & (fixed != FREE) & (cells != fixed))
    if len(conflict):
        limb, sample = conflict[0]
        here, wanted = (("swing", "stance")[int(value[limb, sample])] for value in (fixed, cells))
        raise InputError(
            f"Limb {limb + 1} is locked in {wanted} at sample {sample + 1}, but the gaits fix it in {here}. "
            "Unlock that cell, or choose another cursor.",
            "locked",
        )
    return np.where(cells == FREE, fixed, cells)


def periodic_problem(
    model: RobotModel,
    limbs: Sequence[LimbState],
    samples: int,
    *,
    orientation: Orientation,
    direction: int = 1,
    rules: PatternRules = F_RULES,
    weights: PatternWeights = F_WEIGHTS,
    drawing: Bools | None = None,
    balance: BalanceModel | None = None,
    sample_time: float = 0.4,
) -> PatternProblem:
    """The search for a gait of some of a robot's limbs (F 4.1).

    Args:
        model: the robot.
        limbs: what each limb does, limb 1 first.
        samples: of one cycle.
        orientation: which way it goes.
        direction: 1 to 4.
        rules: what holds, round the end.
        weights: what counts as better.
        drawing: (legs, samples) stance to keep where that can be; None for none.
        balance: for the rule `balance`; None for the robot's own.
        sample_time: s.

    Raises:
        InputError: not one state a limb, no limb that walks, or a number of samples that no pattern has.
    """
    if len(limbs) != model.leg_count:
        raise InputError(
            f"There are {len(limbs)} states of limbs; {model.title} has {model.leg_count} limbs.", "limbs"
        )
    walking = np.array([state is LimbState.WALKS for state in limbs])
    if not walking.any():
        raise InputError("No limb walks; choose at least one that does.", "limbs")
    fixed = free_cells(model.leg_count, samples)
    fixed[[state is LimbState.HELD for state in limbs]] = 0
    fixed[[state is LimbState.STANDS for state in limbs]] = 1
    return PatternProblem(
        kind=PatternKind.PERIODIC,
        fixed=fixed,
        walking=walking,
        sides=foot_sides(model, orientation, direction),
        rules=rules,
        weights=weights,
        drawing=drawing,
        balance_model=own_balance(model) if balance is None else balance,
        sample_time=sample_time,
    )


def completion_problem(
    gait: Gait,
    painted: Bools | None = None,
    *,
    rules: PatternRules = F_RULES,
    weights: PatternWeights = F_WEIGHTS,
) -> PatternProblem:
    """The search for the rest of a drawing: locked and painted cells stay, the others are free.

    The first and the last sample stay as well, and what is drawn elsewhere is kept where that can be.

    Args:
        gait: the document whose timeline is completed.
        painted: (legs, samples) cells that stay beside the locked ones; None for none.
        rules: what holds.
        weights: what counts as better.

    Raises:
        InputError: the gait's timeline follows from something else, or the painted cells do not fit.
    """
    require_own_timeline(gait)
    timeline = gait.timeline
    stays = timeline.locked.copy()
    if painted is not None:
        if painted.shape != stays.shape:
            raise InputError("The painted cells must be as many as the timeline's.", "painted")
        stays |= painted
    stays[:, [0, -1]] = True
    model = load_robot(gait.robot)
    whole = stays.all(axis=1) & still_limbs(gait)
    return PatternProblem(
        kind=PatternKind.TRANSITION,
        fixed=np.where(stays, timeline.stance, FREE).astype(np.int8),
        walking=~whole,
        sides=foot_sides(model, gait.orientation, gait.direction),
        rules=rules,
        weights=weights,
        drawing=timeline.stance,
        balance_model=shared_balance(model, gait),
        sample_time=timeline.sample_time,
    )


def require_own_timeline(gait: Gait) -> None:
    """A gait whose timeline may be replaced.

    Raises:
        InputError: it follows from segments, a file, other gaits or poses.
    """
    causes = {
        "made by hand from segments": gait.segment_table is not None,
        "a recorded motion": gait.recorded is not None,
        "a sequence": bool(gait.sequence),
        "made for the robot's clock": gait.poses is not None,
    }
    for words, holds in causes.items():
        if holds:
            raise InputError(
                f"“{gait.name}” is {words}, so its timeline cannot be drawn anew. Begin a new gait with "
                "such a timeline.",
                "gait",
            )


def hint_of_groups(model: RobotModel, groups: Sequence[Sequence[int]], samples: int) -> Bools:
    """(legs, samples) a drawing in which groups of feet swing in turn, each as long as the others.

    Args:
        model: the robot.
        groups: feet that swing together, counted from 1, in the order of their turns.
        samples: of one cycle.
    """
    stance: Bools = np.ones((model.leg_count, samples), dtype=np.bool_)
    edges = np.round(np.linspace(0, samples, len(groups) + 1)).astype(int)
    for group, first, after in zip(groups, edges, edges[1:], strict=False):
        stance[[foot - 1 for foot in group], first:after] = False
    return stance
