"""A pattern's search as a CP-SAT model: a truth value a limb and sample, and the rules that are asked for.

Source: F 3.2, with docs/sources.md.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

from ortools.sat.python.cp_model import CpModel, IntVar, LinearExpr

from core.patterns.problem import FREE, PatternKind, PatternProblem, Rule
from solver_jobs.patterns.balance import Balance, Place

Active = Callable[[Rule, int | None, int | None], bool]
"""Whether one instance of a rule holds: rule, limb (0-based), sample (0-based).

FIXED comes with limb and sample; FEET_DOWN, FEET_DOWN_EACH_SIDE and BALANCE with the sample alone;
SHORTEST_SWING, SHORTEST_STANCE, LIMB_CHANGES, LEAST_SWING and WORKLOAD with the limb alone (the workload of
two limbs is compared where both are active). A rule that is off in the problem is never asked for.
"""


def every_rule(rule: Rule, limb: int | None, sample: int | None) -> bool:
    """The whole problem."""
    return True


@dataclass(eq=False)
class PatternModel:
    """The model and what its variables mean.

    Args:
        problem: what is sought.
        model: of the solver.
        stance: limbs × samples, 1 where the foot stands.
        switches: limbs × gaps, 1 where the limb differs between a sample and the next one.
        changes: gaps, 1 where any limb differs.
        places: samples, where the body is; for balance.
    """

    problem: PatternProblem
    model: CpModel
    stance: list[list[IntVar]]
    switches: list[list[IntVar]] = field(default_factory=list)
    changes: list[IntVar] = field(default_factory=list)
    places: list[Place] = field(default_factory=list)

    @property
    def next_samples(self) -> list[int]:
        """The sample after each gap; a periodic pattern's last gap leads to its first sample."""
        count = self.problem.sample_count
        following = list(range(1, count))
        return [*following, 0] if self.problem.kind is PatternKind.PERIODIC else following

    def objective(self) -> LinearExpr:
        """The weighted sum of `PatternWeights`."""
        weights, drawing = self.problem.weights, self.problem.drawing
        cost = weights.sample_changes * LinearExpr.sum(self.changes)
        cost += weights.limb_changes * LinearExpr.sum([s for row in self.switches for s in row])
        if drawing is not None:
            cost += weights.drawing * LinearExpr.sum(
                [
                    1 - cell if drawing[limb, sample] else 1 * cell
                    for limb, row in enumerate(self.stance)
                    for sample, cell in enumerate(row)
                    if self.problem.fixed[limb, sample] == FREE
                ]
            )
        return cost


def build_model(problem: PatternProblem, active: Active = every_rule) -> PatternModel:
    """The model of a problem, or of a part of its rules.

    Args:
        problem: what is sought.
        active: which instances of its rules hold.
    """
    model = CpModel()
    stance = [
        [_cell(model, problem, active, limb, sample) for sample in range(problem.sample_count)]
        for limb in range(problem.leg_count)
    ]
    built = PatternModel(problem, model, stance)
    _add_switches(built)
    _add_phases(built, active)
    _add_support(built, active)
    _add_shares(built, active)
    if problem.rules.balance is not None:
        _add_balance(built, active)
    return built


def _cell(model: CpModel, problem: PatternProblem, active: Active, limb: int, sample: int) -> IntVar:
    value = int(problem.fixed[limb, sample])
    if value != FREE and active(Rule.FIXED, limb, sample):
        return model.new_constant(value)
    return model.new_bool_var(f"stance {limb} {sample}")


def _add_switches(built: PatternModel) -> None:
    model, following = built.model, built.next_samples
    built.changes = [model.new_bool_var(f"change {gap}") for gap in range(len(following))]
    for limb, row in enumerate(built.stance):
        built.switches.append([model.new_bool_var(f"switch {limb} {gap}") for gap in range(len(following))])
        for gap, after in enumerate(following):
            here, there, switch = row[gap], row[after], built.switches[limb][gap]
            model.add_bool_or(~here, there, switch)
            model.add_bool_or(here, ~there, switch)
            model.add_bool_or(here, there, ~switch)
            model.add_bool_or(~here, ~there, ~switch)
            model.add_implication(switch, built.changes[gap])
    for gap, change in enumerate(built.changes):
        model.add_bool_or([row[gap] for row in built.switches] + [~change])


def _add_phases(built: PatternModel, active: Active) -> None:
    """g2, g8, g9, g10: what each limb's own phases keep."""
    rules, model = built.problem.rules, built.model
    for limb, row in enumerate(built.stance):
        if rules.shortest_swing is not None and active(Rule.SHORTEST_SWING, limb, None):
            _hold(built, limb, rules.shortest_swing, stands=False)
        if rules.shortest_stance is not None and active(Rule.SHORTEST_STANCE, limb, None):
            _hold(built, limb, rules.shortest_stance, stands=True)
        if rules.limb_changes is not None and active(Rule.LIMB_CHANGES, limb, None):
            model.add(LinearExpr.sum(built.switches[limb]) <= rules.limb_changes)
        if built.problem.walking[limb] and active(Rule.LEAST_SWING, limb, None):
            if rules.least_swing is not None:
                model.add(LinearExpr.sum(row) <= built.problem.sample_count - rules.least_swing)
            if built.problem.kind is PatternKind.PERIODIC:
                model.add_bool_or(built.switches[limb])


def _hold(built: PatternModel, limb: int, least: int, *, stands: bool) -> None:
    """A phase that has begun lasts; what the window's end cuts off is not asked for."""
    row, count = built.stance[limb], built.problem.sample_count
    cells = row if stands else [~cell for cell in row]
    cyclic = built.problem.kind is PatternKind.PERIODIC
    for gap, first in enumerate(built.next_samples):
        for later in range(1, min(least, count)):
            if cyclic or first + later < count:
                built.model.add_bool_or(cells[gap], ~cells[first], cells[(first + later) % count])


def _add_support(built: PatternModel, active: Active) -> None:
    """g3, g4, g5: how many feet stand at each sample."""
    problem, model = built.problem, built.model
    rules = problem.rules
    for sample in range(problem.sample_count):
        column = [row[sample] for row in built.stance]
        if rules.feet_down is not None and active(Rule.FEET_DOWN, None, sample):
            model.add(LinearExpr.sum(column) >= rules.feet_down)
        if rules.feet_down_each_side is not None and active(Rule.FEET_DOWN_EACH_SIDE, None, sample):
            for side in problem.sides:
                feet = [cell for cell, counts in zip(column, side, strict=True) if counts]
                model.add(LinearExpr.sum(feet) >= rules.feet_down_each_side)


def _add_shares(built: PatternModel, active: Active) -> None:
    """g6, g7: the stances of walking limbs are nearly equal."""
    problem, most = built.problem, built.problem.rules.workload
    if most is None:
        return
    compared = [limb for limb in range(problem.leg_count) if problem.walking[limb]]
    compared = [limb for limb in compared if active(Rule.WORKLOAD, limb, None)]
    if len(compared) < 2:
        return
    least = built.model.new_int_var(0, problem.sample_count, "least stance")
    for limb in compared:
        built.model.add(LinearExpr.sum(built.stance[limb]) >= least)
        built.model.add(LinearExpr.sum(built.stance[limb]) <= least + most)


def _add_balance(built: PatternModel, active: Active) -> None:
    """A balanced place for the body at each sample, and ways between them."""
    balance, count = Balance(built.problem, built.model), built.problem.sample_count
    holds = [active(Rule.BALANCE, None, sample) for sample in range(count)]
    built.places = [balance.place() for _ in range(count)]
    for sample, standing in enumerate(zip(*built.stance, strict=True)):
        if holds[sample]:
            balance.keep_inside([built.places[sample]], list(standing))
    for sample, after in enumerate(built.next_samples):
        if holds[sample] and holds[after]:
            balance.keep_near(built.places[sample], built.places[after], 1)
