"""From a question to a pattern's problem, and from its answer to a gait."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from app.documents.gait_json import gait_from_content
from app.routes.patterns.schema import DrawingBody, LimbsBody, TransitionBody
from core.arrays import Bools
from core.errors import InputError
from core.gait.gait import Gait
from core.motion.contact_timeline import bits_from_rows
from core.patterns.limits import balance_model, walkable
from core.patterns.problem import (
    FREE,
    LEAST_SAMPLES,
    Cells,
    PatternProblem,
    PatternRules,
    PatternWeights,
    Relaxation,
    Rule,
)
from core.patterns.relaxation import relaxed
from core.patterns.sides import PatternSide
from core.patterns.sources import (
    LimbState,
    completion_problem,
    finishing_length,
    periodic_problem,
    transition_problem,
    with_locked_cells,
)
from core.patterns.to_gait import CycleUse, completed_gait, periodic_gait, transition_gait
from core.robot.model import load_robot

AnyQuestion = TransitionBody | LimbsBody | DrawingBody

LEAST_TRANSITION, MOST_TRANSITION = 3, 60
"""Samples between which the shortest transition is sought, boundary samples included."""

_STATES = {
    "walks": LimbState.WALKS,
    "held": LimbState.HELD,
    "broken": LimbState.HELD,
    "stands": LimbState.STANDS,
}
_NOUN = "foot"


@dataclass(frozen=True, eq=False)
class Posed:
    """A question with the gaits that it is about.

    Args:
        question: as it came.
        first: the gait that is left, or the one whose robot or drawing it is about.
        second: the gait that follows; None where there is none.
    """

    question: AnyQuestion
    first: Gait
    second: Gait | None

    @property
    def lengths(self) -> range | None:
        """Lengths to be tried one after the other; None where the question gives one that is long enough."""
        asked = self.question
        if not isinstance(asked, TransitionBody) or (asked.samples is not None and self.too_few is None):
            return None
        beyond_cells = max((sample + 2 for _, sample, _ in asked.cells), default=LEAST_TRANSITION)
        first = max(LEAST_TRANSITION, beyond_cells, self._finishing_length(asked))
        return range(first, max(MOST_TRANSITION, first) + 1)

    @property
    def too_few(self) -> int | None:
        """The length that is asked for, where what the cursors cut cannot be finished in it."""
        asked = self.question
        if not isinstance(asked, TransitionBody) or asked.samples is None:
            return None
        return asked.samples if LEAST_SAMPLES <= asked.samples < self._finishing_length(asked) else None

    def _finishing_length(self, asked: TransitionBody) -> int:
        """Samples below which what the cursors cut could not be finished."""
        if self.second is None or not asked.walkable:
            return LEAST_TRANSITION
        sides = PatternSide(self.first, asked.sample, "from"), PatternSide(self.second, asked.to_sample, "to")
        rules = walkable(PatternRules(**asked.rules.model_dump()), self.first, self.second)
        return finishing_length(*sides, rules)

    def problem(self, samples: int | None = None) -> PatternProblem:
        """The problem that is solved.

        Args:
            samples: the length, where the question leaves it open.

        Raises:
            InputError: naming what does not fit.
        """
        asked = self.question
        problem = self._kind_problem(samples)
        if asked.freed:
            free = Relaxation(Rule.FIXED, None, tuple(asked.freed), "")
            problem = relaxed(problem, free)
        return replace(problem, noun=_NOUN, once_an_order=asked.once_an_order)

    def _kind_problem(self, samples: int | None) -> PatternProblem:
        asked = self.question
        rules = PatternRules(**asked.rules.model_dump())
        weights = PatternWeights(**asked.weights.model_dump())
        if isinstance(asked, TransitionBody):
            return self._transition(asked, rules, weights, samples or asked.samples or LEAST_TRANSITION)
        if isinstance(asked, LimbsBody):
            return self._cycle(asked, rules, weights)
        problem = completion_problem(self.first, _painted(self.first, asked), rules=rules, weights=weights)
        return _with_cells(problem, asked)

    def _transition(
        self, asked: TransitionBody, rules: PatternRules, weights: PatternWeights, samples: int
    ) -> PatternProblem:
        if self.second is None:
            raise InputError("A transition leads to a second gait; name it.", "to")
        problem = transition_problem(
            self.first,
            asked.sample,
            self.second,
            asked.to_sample,
            samples,
            rules=walkable(rules, self.first, self.second) if asked.walkable else rules,
            weights=weights,
            drawing=_drawing(asked, self.first, samples),
            finish_phases=asked.walkable,
        )
        return _with_cells(_with_locked(problem, asked.locked), asked)

    def _cycle(self, asked: LimbsBody, rules: PatternRules, weights: PatternWeights) -> PatternProblem:
        gait = self.first
        model = load_robot(gait.robot)
        travel = float(np.hypot(*gait.step[:2]))
        problem = periodic_problem(
            model,
            [_STATES[limb] for limb in asked.limbs],
            asked.samples,
            orientation=gait.orientation,
            direction=gait.direction,
            rules=rules,
            weights=weights,
            drawing=_drawing(asked, gait, asked.samples),
            balance=balance_model(model, gait.options.plane_height, gait.options.body_speed, travel),
            sample_time=gait.timeline.sample_time,
        )
        return _with_cells(problem, asked)

    def gait(self, feet: list[str], name: str | None) -> Gait:
        """The gait that a pattern makes; a drawing that is completed stays the gait that it was.

        Raises:
            InputError: the pattern does not fit the question.
        """
        asked, stance = self.question, _stance(feet, self.first)
        if isinstance(asked, TransitionBody):
            if self.second is None:
                raise InputError("A transition leads to a second gait; name it.", "to")
            made = transition_gait(self.first, asked.sample, self.second, asked.to_sample, stance)
        elif isinstance(asked, LimbsBody):
            made = periodic_gait(stance, load_robot(self.first.robot), self._use(asked))
        else:
            made = completed_gait(self.first, stance)
        return made if name is None else replace(made, name=name)

    def _use(self, asked: LimbsBody) -> CycleUse:
        gait = self.first
        walking = [str(limb + 1) for limb, state in enumerate(asked.limbs) if state == "walks"]
        return CycleUse(
            name=f"{len(walking)} limbs of {len(asked.limbs)}",
            orientation=gait.orientation,
            step=(*gait.step[:2], 0.0),
            direction=gait.direction,
            iterations=1,
            sample_time=gait.timeline.sample_time,
            options=gait.options,
            notes=_limb_notes(asked),
        )


def posed(question: AnyQuestion, document: Callable[[str], Gait]) -> Posed:
    """A question with its gaits.

    Args:
        question: as it came.
        document: gives a gait by its id.

    Raises:
        InputError: there is no such gait, or the document that stands for one cannot be read.
    """
    first, second = document(question.gait), None
    if isinstance(question, DrawingBody) and question.document is not None:
        first = gait_from_content(question.document, "document")
    if isinstance(question, TransitionBody):
        second = document(question.to)
    return Posed(question, first, second)


def _stance(rows: list[str], gait: Gait) -> Bools:
    legs = gait.timeline.leg_count
    if len(rows) != legs or not rows[0]:
        raise InputError(f"The pattern has {len(rows)} rows; “{gait.name}” has {legs} feet.", "feet")
    return bits_from_rows(rows, "feet")


def _drawing(asked: AnyQuestion, gait: Gait, samples: int) -> Bools | None:
    """What is to be kept; where the length is sought a drawing counts for its own length alone."""
    if asked.drawing is None:
        return None
    drawing = _stance(asked.drawing, gait)
    if drawing.shape[1] == samples:
        return drawing
    if isinstance(asked, TransitionBody) and asked.samples is None:
        return None
    raise InputError(
        f"The drawing to keep has {drawing.shape[1]} samples; the pattern has {samples}. Leave it out.",
        "drawing",
    )


def _painted(gait: Gait, asked: DrawingBody) -> Bools | None:
    return ~gait.timeline.stance if asked.painted else None


def _with_locked(problem: PatternProblem, limbs: list[int]) -> PatternProblem:
    """The problem in which some limbs keep the value that they have at both ends."""
    fixed, walking = np.array(problem.fixed), np.array(problem.walking)
    for limb in limbs:
        if limb >= problem.leg_count:
            raise InputError(f"There is no limb {limb + 1} to lock.", "locked")
        if fixed[limb, 0] != fixed[limb, -1]:
            raise InputError(
                f"Limb {limb + 1} is locked, but stands at one end and swings at the other. Unlock it, or "
                "move a cursor.",
                "locked",
            )
        fixed[limb], walking[limb] = fixed[limb, 0], False
    return replace(problem, fixed=fixed, walking=walking)


def _with_cells(problem: PatternProblem, asked: AnyQuestion) -> PatternProblem:
    """The problem with the cells that were drawn."""
    cells: Cells = np.full(problem.fixed.shape, FREE, dtype=np.int8)
    for limb, sample, value in asked.cells:
        if limb >= problem.leg_count or sample >= problem.sample_count:
            raise InputError(
                f"A cell is drawn for limb {limb + 1} at sample {sample + 1}; the pattern has "
                f"{problem.leg_count} limbs and {problem.sample_count} samples. Free that cell.",
                "cells",
            )
        cells[limb, sample] = value
    return replace(problem, fixed=with_locked_cells(problem.fixed, cells))


def _limb_notes(asked: LimbsBody) -> str:
    """Which limbs do not walk, and why: "Limbs 1 and 2 are held up."."""
    words = {"held": "held up", "broken": "broken", "stands": "standing"}
    parts = []
    for state, what in words.items():
        limbs = [str(limb + 1) for limb, own in enumerate(asked.limbs) if own == state]
        if limbs:
            parts.append(f"{'limbs' if len(limbs) > 1 else 'limb'} {', '.join(limbs)} {what}")
    sentence = "; ".join(parts)
    return f"{sentence[0].upper()}{sentence[1:]}; the others walk." if sentence else "All limbs walk."
