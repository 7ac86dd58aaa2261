"""A pattern told by its events: K times at which limbs switch, and the K + 1 columns between them.

With K fixed the model needs no truth value a sample, so its size does not grow with the samples, and the
proof that no pattern has only K events is quick. A periodic pattern has K events and K columns in a ring.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from ortools.sat.python.cp_model import CpModel, IntVar, LinearExpr, LinearExprT, LiteralT

from core.arrays import Bools
from core.patterns.problem import FREE, PatternKind, PatternProblem
from solver_jobs.patterns.balance import Place


@dataclass(eq=False)
class EventModel:
    """The model of a problem with a given number of events.

    Args:
        problem: what is sought.
        events: K.
        model: of the solver.
        starts: columns, the first sample of each.
        lengths: columns, how many samples each lasts.
        stance: limbs × columns, 1 where the foot stands.
        switches: limbs × events, 1 where the limb switches.
        costs: what the drawing adds to the objective.
        places: columns, where the body is at the first and at the last sample of each; for balance.
    """

    problem: PatternProblem
    events: int
    model: CpModel
    starts: list[IntVar]
    lengths: list[LinearExprT]
    stance: list[list[IntVar]]
    switches: list[list[IntVar]] = field(default_factory=list)
    costs: list[LinearExprT] = field(default_factory=list)
    places: list[tuple[Place, Place]] = field(default_factory=list)
    _begun: dict[tuple[int, int], IntVar] = field(default_factory=dict)

    @property
    def columns(self) -> int:
        """How many columns there are."""
        return len(self.starts)

    @property
    def is_ring(self) -> bool:
        """Whether the first column follows the last one."""
        return self.problem.kind is PatternKind.PERIODIC

    def begun(self, column: int, sample: int) -> IntVar:
        """Truth value of: the column has begun at this sample, or before it."""
        key = (column, sample)
        if key not in self._begun:
            literal = self.model.new_bool_var(f"begun {column} {sample}")
            self.model.add(self.starts[column] <= sample).only_enforce_if(literal)
            self.model.add(self.starts[column] > sample).only_enforce_if(~literal)
            self._begun[key] = literal
        return self._begun[key]

    def not_in(self, column: int, sample: int) -> list[LiteralT]:
        """A clause's part that is true where the sample lies outside the column."""
        first, last = ~self.begun(column, sample), column == self.columns - 1
        if not last:
            return [first, self.begun(column + 1, sample)]
        if not self.is_ring:
            return [first]
        # The ring's last column goes on until the first one begins: in it is who is past it or before that.
        wraps = self.model.new_bool_var("")
        self.model.add_bool_or(wraps, ~self.begun(column, sample))
        self.model.add_bool_or(wraps, self.begun(0, sample))
        return [~wraps]

    def objective(self) -> LinearExprT:
        """The weighted sum of `PatternWeights`."""
        weights = self.problem.weights
        switches = [switch for row in self.switches for switch in row]
        return weights.sample_changes * self.events + LinearExpr.sum(
            [weights.limb_changes * LinearExpr.sum(switches), *self.costs]
        )


def turns_freely(problem: PatternProblem) -> bool:
    """Whether every rotation of a periodic pattern is as good as the pattern: nothing pins it to a sample."""
    if problem.kind is not PatternKind.PERIODIC:
        return False
    pinned = (problem.fixed[problem.walking] != FREE).any()
    return not pinned and problem.drawing is None


def event_model(problem: PatternProblem, events: int) -> EventModel:
    """Times, columns and switches, before any rule.

    Args:
        problem: what is sought.
        events: K; a periodic pattern has none or at least two.
    """
    model = CpModel()
    starts = _starts(model, problem, events)
    count = problem.sample_count
    lengths: list[LinearExprT] = [after - begin for begin, after in pairwise(starts)]
    last = count - starts[-1]
    lengths.append(last + starts[0] if problem.kind is PatternKind.PERIODIC else last)
    stance = [
        [_cell(model, problem, limb, column, events) for column in range(len(starts))]
        for limb in range(problem.leg_count)
    ]
    built = EventModel(problem, events, model, starts, lengths, stance)
    _add_times(built)
    _add_switches(built)
    return built


def _starts(model: CpModel, problem: PatternProblem, events: int) -> list[IntVar]:
    last = problem.sample_count
    if problem.kind is PatternKind.TRANSITION or not events:
        times = [model.new_int_var(k, last - events + k - 1, f"time {k}") for k in range(1, events + 1)]
        return [model.new_constant(0), *times]
    times = [model.new_int_var(k, last - events + k, f"time {k}") for k in range(events)]
    return [model.new_constant(0), *times[1:]] if turns_freely(problem) else times


def _cell(model: CpModel, problem: PatternProblem, limb: int, column: int, events: int) -> IntVar:
    fixed = problem.fixed[limb]
    if not problem.walking[limb]:
        return model.new_constant(int(fixed[0]))
    if problem.kind is PatternKind.TRANSITION and column == 0:
        return model.new_constant(int(fixed[0]))
    if problem.kind is PatternKind.TRANSITION and column == events:
        return model.new_constant(int(fixed[-1]))
    return model.new_bool_var(f"stance {limb} {column}")


def _add_times(built: EventModel) -> None:
    for begin, after in pairwise(built.starts):
        built.model.add(after >= begin + 1)
    if turns_freely(built.problem):
        for length in built.lengths[1:]:
            built.model.add(built.lengths[0] >= length)


def _add_switches(built: EventModel) -> None:
    """Every event is one: at least one limb switches."""
    model = built.model
    gaps = [(k, (k + 1) % built.columns) for k in range(built.events)]
    for row in built.stance:
        switches = []
        for here, there in ((row[a], row[b]) for a, b in gaps):
            switch = model.new_bool_var("")
            model.add_bool_or(~here, there, switch)
            model.add_bool_or(here, ~there, switch)
            model.add_bool_or(here, there, ~switch)
            model.add_bool_or(~here, ~there, ~switch)
            switches.append(switch)
        built.switches.append(switches)
    for event in range(built.events):
        model.add_bool_or([row[event] for row in built.switches])
    if built.events == 0 and built.problem.kind is PatternKind.TRANSITION:
        fixed = built.problem.fixed
        if (fixed[:, 0] != fixed[:, -1]).any():
            model.add_bool_or([])


def forbid(built: EventModel, stance: Bools) -> None:
    """Excludes a pattern, and where nothing pins a periodic one, all its rotations.

    Where the problem wants each order once, the same changes at other samples are excluded too.

    Args:
        built: a model of as many events as the pattern has.
        stance: (legs, samples).
    """
    rotations = [stance]
    if turns_freely(built.problem) and built.events:
        rotations = [np.roll(stance, -int(begin), axis=1) for begin in event_times(stance, ring=True)]
    for rotation in rotations:
        begins = [int(begin) for begin in event_times(rotation, ring=built.is_ring)]
        if not built.is_ring or not begins:
            begins = [0, *begins]
        differs: list[LiteralT] = []
        for begin, start in () if built.problem.once_an_order else zip(begins, built.starts, strict=True):
            literal = built.model.new_bool_var("")
            built.model.add(start != begin).only_enforce_if(literal)
            differs.append(literal)
        for row, cells in zip(rotation, built.stance, strict=True):
            differs += [~cell if row[begin] else cell for begin, cell in zip(begins, cells, strict=True)]
        built.model.add_bool_or(differs)


def event_times(stance: Bools, *, ring: bool) -> list[int]:
    """Samples at which any limb differs from the sample before."""
    changed = (stance != np.roll(stance, 1, axis=1)).any(axis=0)
    changed[0] &= ring
    return [int(sample) for sample in np.nonzero(changed)[0]]
