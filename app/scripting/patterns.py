"""Footfall patterns for scripts: proven best by the solver, and confirmed by the checker."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.cli.commands_pattern import pattern_content, pattern_failure, solved_pattern
from app.cli.pattern_text import drawn_pattern
from app.pattern_search.service import next_length
from app.scripting.gaits import Gait, gait
from app.scripting.html import paragraph
from app.scripting.options import command_options
from core.arrays import Bools
from core.errors import InfeasibleError, InputError
from core.gait.gait import Gait as Document
from core.gait.gait import Orientation, heading_step
from core.gait.options import GaitOptions
from core.library.new_gait import DEFAULT_STEP, SAMPLE_TIME
from core.patterns.limits import walking_rules
from core.patterns.problem import PatternProblem, PatternResult
from core.patterns.sides import PatternSide
from core.patterns.sources import finishing_length, transition_problem
from core.patterns.to_gait import CycleUse, periodic_gait, transition_gait
from core.problem.motion_problem import Cost
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot
from solver_jobs import solve_pattern

MOST_TRANSITION = 60
"""Samples up to which the shortest transition is sought."""


@dataclass(frozen=True, eq=False, repr=False)
class Pattern:
    """A footfall pattern, or why there is none. `footfall.pattern` and `footfall.transition` give one.

    Args:
        status: `optimal`, `feasible`, `infeasible` or `failed`.
        explanation: sentences on why there is none; empty where there is one.
        figures: what `footfall pattern --json` prints; counts of samples, times in s.
        is_cyclic: whether the first sample follows the last.
        document: of two gaits with the transition between them; None of other patterns.

    Raises:
        InfeasibleError: `stance` and `gait`, where there is no pattern.

    Example:
        >>> import footfall as ff
        >>> found = ff.pattern(legs=4, samples=12, periodic=True)
        >>> found.status, found.stance.shape
        ('optimal', (4, 12))
    """

    status: str
    explanation: tuple[str, ...]
    figures: dict[str, Any]
    is_cyclic: bool
    document: Document | None = None

    @property
    def pattern(self) -> list[str]:
        """A text a foot: 1 for stance, 0 for swing, a sample a character; empty where there is none."""
        return list(self.figures["pattern"])

    @property
    def objective(self) -> int | None:
        """Number of samples at which feet change; None where there is no pattern."""
        value: int | None = self.figures["objective"]
        return value

    @property
    def stance(self) -> Bools:
        """(legs, samples) which feet stand."""
        if not self.pattern:
            raise InfeasibleError(f"There is no pattern: {' '.join(self.explanation)}", "pattern")
        return np.array([[cell == "1" for cell in row] for row in self.pattern])

    def gait(self, name: str | None = None, *, robot: str | None = None, **options: Any) -> Gait:
        """The gait that walks the pattern: a cycle from standing to standing, or two gaits with a transition.

        Args:
            name: what it is called.
            robot: of a cycle; the first one with as many legs where None.
            options: those of `footfall optimise`, in SI: step (m an iteration), margin (m) and others.

        Returns:
            A gait, to be optimised; feet that never stand are held up.

        Raises:
            InfeasibleError: there is no pattern.
            InputError: the pattern leads from one state to another, of which no gait is known; or the robot
                or an option does not fit.

        Example:
            >>> import footfall as ff
            >>> ff.pattern(legs=6, samples=18, periodic=True, locked="3:swing").gait(step=0.008).robot
            'hexapod'
        """
        stance = self.stance
        if self.document is not None:
            return Gait(self.document).changed(name=name, robot=robot, **options)
        if not self.is_cyclic:
            raise InputError(
                "This pattern leads from one state to another. footfall.transition joins two gaits to one.",
                "pattern",
            )
        model = load_robot(robot or _robot_with(len(stance)))
        return Gait(periodic_gait(stance, model, _use(model, name))).changed(**options)

    def __repr__(self) -> str:
        if not self.pattern:
            return f"Pattern: {self.status}. {' '.join(self.explanation)}"
        marks = [str(foot + 1) for foot in range(len(self.pattern))]
        return "\n".join(
            [f"Pattern: {self.status}", *drawn_pattern(self.stance, marks, cyclic=self.is_cyclic)]
        )

    def _repr_html_(self) -> str:
        if not self.pattern:
            return paragraph([f"{self.status.capitalize()}.", *self.explanation])
        return f"<pre>{self!r}</pre>"


def pattern(
    *, legs: int, samples: int, start: str | None = None, end: str | None = None, **options: Any
) -> Pattern:
    """The best footfall pattern: a transition between two states, or a periodic gait.

    Args:
        legs: number of legs, in a ring.
        samples: how many, both ends of a transition included.
        start: first state of a transition, foot 1 first: 1 for stance, 0 for swing.
        end: last state of a transition.
        options: those of `footfall pattern`: periodic, locked, shortest, best and the rules; no units but
            seconds, s.

    Returns:
        The pattern; `status` says whether it is proven the best.

    Raises:
        InputError: there is no such option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.pattern(legs=6, samples=20, start="111001", end="011011").objective
        3
    """
    asked = command_options(
        "pattern", [], legs=legs, samples=samples, **{"from": start, "to": end, **options}
    )
    problem, result, failure = solved_pattern(asked)
    content = pattern_content(problem, result, failure, [])
    return Pattern(content["status"], tuple(content["explanation"]), content, bool(asked.periodic))


def _robot_with(legs: int) -> str:
    for name in ROBOT_NAMES:
        if load_robot(name).leg_count == legs:
            return name
    raise InputError(f"No robot has {legs} legs.", "robot")


def _use(model: RobotModel, name: str | None) -> CycleUse:
    """A cycle as a new gait is asked for."""
    return CycleUse(
        name=name or "Pattern",
        orientation=Orientation.FB,
        step=heading_step(Orientation.FB, DEFAULT_STEP),
        sample_time=SAMPLE_TIME,
        options=GaitOptions(margin=model.margin, cost=Cost.GENTLE),
    )


def transition(
    first: str | Path | Gait,
    second: str | Path | Gait,
    *,
    start: int,
    end: int,
    samples: int | None = None,
    seconds: float = 30.0,
) -> Pattern:
    """The best way from a sample of one gait to a sample of another, by swings that the feet can do.

    Args:
        first: the gait that is left, as for `footfall.gait`.
        second: the gait that follows, of the same robot and orientation.
        start: sample of the first gait at which the transition begins, from 0.
        end: sample of the second gait at which it ends, from 0.
        samples: how many, both ends included; the fewest that work where None.
        seconds: longest search of one length, s.

    Returns:
        The pattern; its `gait()` is the first gait up to the transition, and the second one from there on.

    Raises:
        InputError: there is no such gait or sample, or the gaits do not fit together.

    Example:
        >>> import footfall as ff
        >>> found = ff.transition("walk", "amble", start=8, end=8)
        >>> found.status, found.gait().robot
        ('optimal', 'deltawalker')
    """
    sides = PatternSide(gait(first).document, start, "from"), PatternSide(gait(second).document, end, "to")
    problem, result = _joined(*sides, samples, seconds)
    failure = pattern_failure(problem, result, seconds)
    content = pattern_content(problem, result, failure, [])
    found = Pattern(content["status"], tuple(content["explanation"]), content, False)
    if not found.pattern:
        return found
    document = transition_gait(sides[0].gait, start, sides[1].gait, end, found.stance)
    return Pattern(found.status, found.explanation, content, False, document)


def _joined(
    first: PatternSide, second: PatternSide, samples: int | None, seconds: float
) -> tuple[PatternProblem, PatternResult]:
    """The answer of the length that is given, or of the shortest that has one."""
    rules = walking_rules(first.gait, second.gait)
    least = finishing_length(first, second, rules)
    lengths = None if samples is not None else range(least, max(MOST_TRANSITION, least) + 1)
    length: int | None = least if samples is None else samples
    while length is not None:
        problem = transition_problem(
            first.gait, first.at, second.gait, second.at, length, rules=rules, finish_phases=True
        )
        result = solve_pattern(problem, seconds=seconds)
        length = next_length(problem, result, lengths)
    return problem, result
