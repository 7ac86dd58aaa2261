"""Whether a part of a pattern's rules can hold at all; bounded in work, not in time, so that words stay."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from ortools.sat.python.cp_model import FEASIBLE, INFEASIBLE, OPTIMAL, CpSolver

from core.patterns.clause import Clause, asked_by
from core.patterns.problem import PatternProblem, Rule
from core.patterns.relaxation import with_rule
from solver_jobs.patterns.model import Active, build_model, every_rule

TRIES = ((0, 0.02), (2, 0.05), (0, 0.1))
"""Ways to answer one question: whether linear programs help (0, 2), and for how much work, in the solver's
deterministic seconds. Without them windows are told apart fast; with them what is a matter of counting."""
ALL_WORK = 0.6
"""Of all questions together."""


class Feasibility(StrEnum):
    """What is known of a question."""

    SOLVABLE = "solvable"
    """A pattern was found."""
    CONFLICT = "conflict"
    """There is none: proven."""
    UNKNOWN = "unknown"
    """The work was used up."""


_ANSWERS = {OPTIMAL: Feasibility.SOLVABLE, FEASIBLE: Feasibility.SOLVABLE, INFEASIBLE: Feasibility.CONFLICT}


@dataclass(eq=False)
class Probe:
    """Asks whether patterns exist; what it cannot say within its work counts as neither.

    Args:
        work: what is left of it, in the solver's deterministic seconds.
        asked: questions so far.
    """

    work: float = ALL_WORK
    asked: int = 0

    def conflict(self, problem: PatternProblem, clauses: Sequence[Clause]) -> bool:
        """Whether it is proven that these clauses cannot hold together."""
        if problem.rules.balance is not None and all(clause.rule is not Rule.BALANCE for clause in clauses):
            # Places of the body cost more than all else, also where nothing is asked of them.
            problem = with_rule(problem, Rule.BALANCE, None)
        return self.ask(problem, asked_by(clauses)) is Feasibility.CONFLICT

    def solvable(self, problem: PatternProblem) -> bool:
        """Whether a pattern that keeps every rule was found."""
        return self.ask(problem) is Feasibility.SOLVABLE

    def ask(self, problem: PatternProblem, active: Active = every_rule) -> Feasibility:
        """Whether a pattern keeps the rules that are active."""
        if self.work <= 0:
            return Feasibility.UNKNOWN
        self.asked += 1
        model = build_model(problem, active).model
        for linear, work in TRIES:
            solver = CpSolver()
            solver.parameters.num_workers = 1
            solver.parameters.random_seed = 0
            solver.parameters.linearization_level = linear
            solver.parameters.catch_sigint_signal = False
            solver.parameters.max_deterministic_time = work
            status = solver.solve(model)
            self.work -= solver.response_proto.deterministic_time
            if status in _ANSWERS:
                return _ANSWERS[status]
        return Feasibility.UNKNOWN
