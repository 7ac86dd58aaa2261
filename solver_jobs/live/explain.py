"""Explains infeasibility in sentences: which phase and foot violate a limit, and by how much."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.arrays import Bools, Floats
from core.gait.held_feet import feet_words
from core.problem.footholds import are_footholds_given
from core.problem.initial_guess import Indices, closed_contact, problem_swings
from core.problem.motion_problem import MotionProblem
from core.robot.shoes import least_distance
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.live.rows import NOBODY, Rows
from solver_jobs.nlp.constraint import Family
from solver_jobs.nlp.diagnosis import knot_ranges
from solver_jobs.nlp.presolve import low_swings
from solver_jobs.results.motion import Evidence, Lack

NOTABLE = 0.005
"""Misses (mm, mm/s) that are worth a sentence."""

DECIMALS = 2
"""Decimals to which misses (mm, mm/s) are compared and shown: solvers agree to 0.0004 mm only."""

MOST_LACKS = 6
"""Sentences that a person reads."""

PROVEN = "This is proven: no motion of the model can do it."
PROVEN_EVENLY = "Proven for evenly spread footholds, at every body height."


def lacks_of(
    linearisation: Linearisation, rows: Sequence[Rows], misses: Sequence[Floats], x: Floats
) -> tuple[Lack, ...]:
    """The misses by family, phase and feet, the worst first; without sentences.

    Args:
        linearisation: the known part.
        rows: every family.
        misses: of each family, a number a group.
        x: the unknowns of the nearest motion; the row of a group that it breaks most names foot or edge.
    """
    first, last = phase_bounds(linearisation.contact)
    worst: dict[tuple[str, int, tuple[int, ...]], Lack] = {}
    for one, amounts in zip(rows, misses, strict=True):
        excess = one.excess(x)
        for group in np.nonzero(amounts > NOTABLE)[0]:
            members = np.nonzero(one.group == group)[0]
            member = int(members[np.round(excess[members], DECIMALS).argmax()])
            knot, amount = int(one.knot[member]), float(amounts[group])
            feet = tuple(int(f) for f in one.feet[member] if f != NOBODY)
            key = (one.family.value, int(first[knot]), feet)
            if key not in worst or _shown(amount) > _shown(worst[key].amount):
                worst[key] = Lack(key[0], amount, one.unit, key[1], int(last[knot]), feet, "")
    return tuple(sorted(worst.values(), key=_rank)[:MOST_LACKS])


def _rank(lack: Lack) -> tuple[float, int, tuple[int, ...], str]:
    """The largest amount first; of those that read the same the earliest, then by feet and family."""
    return -_shown(lack.amount), lack.first, lack.feet, lack.family


def _shown(amount: float) -> float:
    """An amount as a sentence shows it."""
    return float(_amount_text(amount))


def _amount_text(amount: float) -> str:
    return f"{amount:.{DECIMALS}f}" if amount < 1 else f"{amount:.1f}"


def phase_bounds(contact: Bools) -> tuple[Indices, Indices]:
    """First and last knot of the phase, a run with the same feet down, that each knot lies in."""
    begins = np.append(True, (contact[1:] != contact[:-1]).any(axis=1))
    number = np.cumsum(begins) - 1
    starts = np.nonzero(begins)[0]
    ends = np.append(starts[1:] - 1, len(contact) - 1)
    return starts[number], ends[number]


def sentences(
    problem: MotionProblem, lacks: tuple[Lack, ...], evidence: Evidence | None, body_height: Floats
) -> tuple[tuple[str, ...], tuple[Lack, ...]]:
    """The explanation, and the lacks with their sentences, in the problem's own direction.

    Args:
        problem: what was asked.
        lacks: what is missed.
        evidence: how sure it is.
        body_height: (n,) of the centre of mass in the model, m.
    """
    contact = closed_contact(problem)
    told = tuple(replace(lack, sentence=_sentence(problem, contact, lack)) for lack in lacks)
    plane = (body_height - problem.model.com_height) * MM
    closing = _closing(problem, float(plane.min()), float(plane.max()), evidence)
    shown = [lack.sentence for lack in told[:3]]
    more = ("Other limits are missed too.",) if len(told) > 3 else ()
    return (*shown, *more, closing), told


def low_lacks(problem: MotionProblem) -> tuple[Lack, ...]:
    """The rise that swings lack which are too short for the clearance."""
    found = []
    for swing, highest in low_swings(problem, problem_swings(problem)):
        amount = (problem.limits.clearance - highest) * MM
        sentence = (
            f"Rise is {amount:.1f} mm short at {knot_ranges(tuple(swing.samples))}: the swing of foot "
            f"{swing.foot + 1} is too short for the clearance."
        )
        family = Family.CLEARANCE.value
        found.append(Lack(family, amount, "mm", swing.first, swing.last, (swing.foot,), sentence))
    return tuple(found)


def _sentence(problem: MotionProblem, contact: Bools, lack: Lack) -> str:
    floating = tuple(int(foot) + 1 for foot in np.nonzero(~contact[lack.first])[0])
    phase = f"with {feet_words(floating)} in the air" if floating else "with every foot down"
    where = f"{phase} ({knot_ranges(tuple(range(lack.first, lack.last + 1)))})"
    size = _amount_text(lack.amount)
    whose = f"foot {lack.feet[0] + 1}" if lack.feet else "the body"
    limits = problem.limits
    ends = sorted({foot + 1 for foot in lack.feet})
    edge = (
        f"the edge between feet {' and '.join(map(str, ends))}"
        if len(ends) > 1
        else f"foot {ends[0] if ends else ''}"
    )
    crossed = (
        f"comes nearer to {edge} than {limits.margin * MM:g} mm" if limits.margin > 0 else f"leaves {edge}"
    )
    words = {
        Family.BODY_TORQUE: f"Balance is {size} mm short {where}: the centre of pressure {crossed}.",
        Family.WORKSPACE: f"Reach is {size} mm short {where}: {whose} is outside its workspace.",
        Family.FOOT_SPEED: f"Speed is {size} mm/s short {where}: {whose} would have to be faster than "
        f"{limits.foot_speed * MM:g} mm/s.",
        Family.BODY_SPEED: f"Speed is {size} mm/s short {where}: the body would have to be faster than "
        f"{limits.body_speed * MM:g} mm/s.",
        Family.BODY_HEIGHT: f"Height is {size} mm off {where}: the actuator plane must stay between "
        f"{limits.plane_height[0] * MM:g} and {limits.plane_height[1] * MM:g} mm.",
        Family.CLEARANCE: f"Rise is {size} mm short {where}: {whose} would have to rise to "
        f"{limits.clearance * MM:.3g} mm in its middle.",
        Family.FRICTION: f"Grip is {size} mm short {where}: the body accelerates too fast for the friction.",
        Family.MOTOR_SPEED: f"A motor of {whose} would have to be {size} mm/s faster than allowed {where}.",
        Family.MOTOR_ACCELERATION: f"A motor of {whose} would have to change its speed by {size} mm/s more "
        f"from sample to sample than allowed {where}.",
        Family.SHOE_DISTANCE: f"Shoes need {size} mm more room {where}: feet {' and '.join(map(str, ends))} "
        f"come nearer to each other than {(least_distance(problem.model) or 0.0) * MM:g} mm.",
    }
    return words[Family(lack.family)]


def _closing(problem: MotionProblem, lowest: float, highest: float, evidence: Evidence | None) -> str:
    """How sure the answer is, and what it takes as given."""
    if evidence is Evidence.PROVEN:
        return PROVEN if are_footholds_given(problem) else PROVEN_EVENLY
    height = (
        f"stays at {lowest:.4g}" if highest - lowest < NOTABLE else f"is at {lowest:.4g} to {highest:.4g}"
    )
    model = (
        f"feet step to evenly spread footholds, the actuator plane {height} mm, and a swing rises to "
        f"{problem.limits.clearance * MM:g} mm in its middle"
    )
    return f"Diagnosed, not proven, in the model in which {model}."
