"""Conflicts: a minimal unsatisfiable subset of the clauses, which explains why there is no pattern.

Each clause of the set is needed: without any one of them the others can hold together. It is found by asking
again and again with clauses left out: first whole rules, then the limbs of each, then windows of samples.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from core.patterns.clause import SAMPLE_RULES, Clause
from core.patterns.problem import FREE, PatternKind, PatternProblem, Rule
from core.patterns.relaxation import with_rule
from solver_jobs.patterns.probe import Probe

MOST_NAMED = 3
"""Limbs that are named for one rule; where more are needed, the rule stands for every limb."""

PLAIN_FIRST = (
    Rule.FEET_DOWN,
    Rule.FEET_DOWN_EACH_SIDE,
    Rule.LEAST_SWING,
    Rule.SHORTEST_SWING,
    Rule.SHORTEST_STANCE,
    Rule.LIMB_CHANGES,
    Rule.WORKLOAD,
    Rule.BALANCE,
)
"""Rules as they are looked for: those that are seen in the drawing at once come first."""


@dataclass(frozen=True)
class Conflict:
    """A smallest set of clauses that cannot hold together.

    Args:
        clauses: what conflicts; each one is needed.
        reached: where feet down are counted: the largest number that the other clauses leave possible.
    """

    clauses: tuple[Clause, ...]
    reached: int | None


def find_conflict(problem: PatternProblem, probe: Probe) -> Conflict:
    """A smallest set of clauses that conflict.

    Args:
        problem: one of which it is proven that it has no pattern.
        probe: answers whether clauses can hold together.
    """
    rules, fixed = _rule_clauses(problem), _fixed_clauses(problem)
    rules = _conflicting_rules(problem, probe, rules, fixed)
    groups = [*_dropped(problem, probe, rules, fixed), *([r] for r in rules)]
    for place, group in enumerate(groups):
        others = [clause for other in (*groups[:place], *groups[place + 1 :]) for clause in other]
        groups[place] = _narrowed(problem, probe, group, others)
    clauses = tuple(clause for group in groups for clause in group)
    return Conflict(clauses, _reached(problem, probe, clauses))


def _rule_clauses(problem: PatternProblem) -> list[Clause]:
    """One clause for each rule that is on, the plainest first."""
    limbs, last = tuple(range(problem.leg_count)), problem.sample_count - 1
    walking = tuple(limb for limb in limbs if problem.walking[limb])
    concerned = {Rule.WORKLOAD: walking, Rule.LEAST_SWING: walking, **dict.fromkeys(SAMPLE_RULES, ())}
    found = []
    for rule in PLAIN_FIRST:
        cyclic_swing = rule is Rule.LEAST_SWING and problem.kind is PatternKind.PERIODIC
        if getattr(problem.rules, rule.value) is not None or cyclic_swing:
            found.append(Clause(rule, concerned.get(rule, limbs), 0, last))
    return found


def _fixed_clauses(problem: PatternProblem) -> list[Clause]:
    """What is fixed: limbs that are locked, a transition's first and last sample, other cells."""
    last = problem.sample_count - 1
    walking = tuple(limb for limb in range(problem.leg_count) if problem.walking[limb])
    locked = (limb for limb in range(problem.leg_count) if not problem.walking[limb])
    found = [Clause(Rule.FIXED, (limb,), 0, last) for limb in locked]
    inner = (0, last)
    if problem.kind is PatternKind.TRANSITION:
        inner = (1, last - 1)
        found += [Clause(Rule.FIXED, walking, end, end) for end in (0, last) if walking]
    for limb in walking:
        if (problem.fixed[limb, inner[0] : inner[1] + 1] != FREE).any():
            found.append(Clause(Rule.FIXED, (limb,), *inner))
    return found


def _conflicting_rules(
    problem: PatternProblem, probe: Probe, rules: list[Clause], fixed: list[Clause]
) -> list[Clause]:
    """The plainest rule that conflicts with what is fixed, or rules none of which can be left out."""
    for rule in rules:
        if probe.conflict(problem, [rule, *fixed]):
            return [rule]
    kept = list(rules)
    for rule in reversed(rules):
        fewer = [other for other in kept if other is not rule]
        if probe.conflict(problem, [*fewer, *fixed]):
            kept = fewer
    return kept


def _dropped(
    problem: PatternProblem, probe: Probe, rules: list[Clause], fixed: list[Clause]
) -> list[list[Clause]]:
    """What of the fixed cells is needed: single cells go first, then the ends, then locked limbs."""
    kept = list(fixed)
    for clause in reversed(fixed):
        fewer = [other for other in kept if other is not clause]
        if probe.conflict(problem, [*rules, *fewer]):
            kept = fewer
    return [[clause] for clause in kept]


def _narrowed(
    problem: PatternProblem, probe: Probe, group: list[Clause], others: list[Clause]
) -> list[Clause]:
    """A group of one clause, asked of as few limbs and samples as still conflict."""
    (clause,) = group
    if len(clause.limbs) > 1:
        return _fewer_limbs(problem, probe, clause, others)
    whole_limb = clause.rule is Rule.FIXED and not problem.walking[clause.limbs[0]]
    if clause.rule in SAMPLE_RULES or (clause.rule is Rule.FIXED and not whole_limb):
        return [_shorter(problem, probe, clause, others)]
    return group


def _fewer_limbs(problem: PatternProblem, probe: Probe, clause: Clause, others: list[Clause]) -> list[Clause]:
    """Up to `MOST_NAMED` single limbs that suffice; otherwise the clause as it is.

    The limb that ends the shortest list with which the conflict begins is needed; then the list before it is
    searched for the next one.
    """
    needed: list[Clause] = []
    candidates = [replace(clause, limbs=(limb,)) for limb in clause.limbs]
    while not probe.conflict(problem, [*others, *needed]):
        if len(needed) == MOST_NAMED or not candidates:
            return [clause]
        low, high = 1, len(candidates)
        while low < high:
            middle = (low + high) // 2
            if probe.conflict(problem, [*others, *needed, *candidates[:middle]]):
                high = middle
            else:
                low = middle + 1
        needed.append(candidates[low - 1])
        candidates = candidates[: low - 1]
    return sorted(needed, key=lambda one: one.limbs)


def _shorter(problem: PatternProblem, probe: Probe, clause: Clause, others: list[Clause]) -> Clause:
    """The clause over a window of samples neither end of which can be left out, unless that is long."""

    def conflicts(first: int, last: int) -> bool:
        return probe.conflict(problem, [*others, replace(clause, first=first, last=last)])

    first, low, high = clause.first, clause.first, clause.last
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if conflicts(first, middle) else (middle + 1, high)
    last, low, high = high, clause.first, high
    while low < high:
        middle = (low + high + 1) // 2
        low, high = (middle, high) if conflicts(middle, last) else (low, middle - 1)
    long = 2 * (last - low + 1) > clause.last - clause.first + 1
    return clause if long else replace(clause, first=low, last=last)


def _reached(problem: PatternProblem, probe: Probe, clauses: Sequence[Clause]) -> int | None:
    """The largest number of feet down that the other clauses leave possible; None where that is not asked."""
    for rule in (Rule.FEET_DOWN, Rule.FEET_DOWN_EACH_SIDE):
        if any(clause.rule is rule for clause in clauses):
            number = int(getattr(problem.rules, rule.value)) - 1
            while number > 0 and probe.conflict(with_rule(problem, rule, number), clauses):
                number -= 1
            return number
    return None
