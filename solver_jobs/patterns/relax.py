"""Relaxations: the mildest change of each conflicting rule that makes a problem solvable."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from core.patterns.clause import Clause
from core.patterns.problem import FREE, MOST_SAMPLES, PatternKind, PatternProblem, Relaxation, Rule
from core.patterns.relaxation import has_fixed_cells, relaxed, with_rule, with_samples
from core.patterns.sentences import failing_ends, failing_samples, relaxation_words
from solver_jobs.patterns.conflict import find_conflict
from solver_jobs.patterns.probe import Feasibility, Probe

MOST_OFFERED = 6
MOST_ADDED = 40
"""Samples that are added at most."""
LONGER_WORK = 2.0
"""What the search for a longer pattern may use, in the solver's deterministic seconds."""
DROPS_A_FOOT = (Rule.FEET_DOWN, Rule.FEET_DOWN_EACH_SIDE)
"""Rules without which a robot may tip."""
FREEING = 2
"""A freed limb or cell counts as this many steps of a number, where changes are put in order."""
SWITCHED_OFF = 10
"""So does a rule that must go altogether."""
MARGIN_STEP = 0.001
"""Between balance margins that are tried, m."""
LEAST_MARGIN = -0.05

Step = tuple[int, Relaxation]
"""How far a change goes, and the change."""


def find_relaxations(
    problem: PatternProblem, clauses: Sequence[Clause], probe: Probe
) -> tuple[Relaxation, ...]:
    """Changes each of which makes the problem solvable, the mildest first.

    Args:
        problem: one without a pattern.
        clauses: a set of its clauses that conflict; only what stands there is changed.
        probe: answers whether a changed problem has a pattern.

    Returns:
        Single changes; where none suffices, changes of two rules, unless an end's own state breaks a rule.
        A longer pattern, which keeps every rule, comes first; what lets a foot go comes last.
    """
    found = _single_changes(problem, clauses, probe)
    if not found and not failing_samples(problem):
        found = _double_changes(problem, clauses, probe)
    ranked = sorted(found, key=_rank)[:MOST_OFFERED]
    return tuple(_worded(problem, one) for _, one in ranked)


def _rank(step: Step) -> tuple[bool, bool, int]:
    steps, one = step
    drops = any(change.rule in DROPS_A_FOOT for change in (one, *one.also))
    return drops, one.samples is None, steps


def _worded(problem: PatternProblem, one: Relaxation) -> Relaxation:
    also = tuple(_worded(problem, further) for further in one.also)
    return replace(one, words=relaxation_words(problem, one), also=also)


def _single_changes(problem: PatternProblem, clauses: Sequence[Clause], probe: Probe) -> list[Step]:
    changes = [_rule_change(problem, rule, probe) for rule in _rules_of(clauses)]
    freed, longer = _freed(problem, clauses, probe), _longer(problem)
    return [*filter(None, changes), *freed, *filter(None, [longer])]


def _double_changes(problem: PatternProblem, clauses: Sequence[Clause], probe: Probe) -> list[Step]:
    """A rule of the conflict relaxed, with a change of the conflict left then; the first rule that helps."""
    for rule in _rules_of(clauses):
        without = with_rule(problem, rule, None if rule is Rule.BALANCE else _mildest(problem, rule))
        conflict = find_conflict(without, probe)
        found = []
        for steps, second in _single_changes(without, conflict.clauses, probe):
            first = _rule_change(relaxed(problem, second), rule, probe)
            if first is not None:
                found.append((steps + first[0], replace(first[1], also=(second,))))
        if found:
            return found
    return []


def _rules_of(clauses: Sequence[Clause]) -> Iterable[Rule]:
    return dict.fromkeys(clause.rule for clause in clauses if clause.rule is not Rule.FIXED)


def _rule_change(problem: PatternProblem, rule: Rule, probe: Probe) -> Step | None:
    return _balance(problem, probe) if rule is Rule.BALANCE else _number(problem, rule, probe)


def _number(problem: PatternProblem, rule: Rule, probe: Probe) -> Step | None:
    """The mildest number of a rule, found by halving: what a number allows, every milder one does."""
    now, mildest = getattr(problem.rules, rule.value), _mildest(problem, rule)
    if now is None or now == mildest:
        return None
    step = 1 if mildest > now else -1

    def change(steps: int) -> Relaxation:
        return Relaxation(rule, now + step * steps, (), "")

    steps = _fewest(abs(mildest - now), lambda steps: probe.solvable(relaxed(problem, change(steps))))
    return None if steps is None else (steps, change(steps))


def _mildest(problem: PatternProblem, rule: Rule) -> int:
    """The number with which a rule forbids nothing."""
    if rule in (Rule.WORKLOAD, Rule.LIMB_CHANGES):
        return max(problem.sample_count, getattr(problem.rules, rule.value) or 0)
    return 1 if rule in (Rule.SHORTEST_SWING, Rule.SHORTEST_STANCE) else 0


def _fewest(most: int, works: Callable[[int], bool]) -> int | None:
    """The smallest number of steps from 1 to `most` that works; None where not even `most` does."""
    if most < 1 or not works(most):
        return None
    low, high = 1, most
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if works(middle) else (middle + 1, high)
    return high


def _balance(problem: PatternProblem, probe: Probe) -> Step | None:
    """A smaller margin in whole millimetres, or no balance at all."""
    now = problem.rules.balance
    if now is None:
        return None

    def change(steps: int) -> Relaxation:
        return Relaxation(Rule.BALANCE, round(now - steps * MARGIN_STEP, 6), (), "")

    most = int((now - LEAST_MARGIN) / MARGIN_STEP + 1e-9)
    steps = _fewest(most, lambda steps: probe.solvable(relaxed(problem, change(steps))))
    if steps is not None:
        return steps, change(steps)
    off = Relaxation(Rule.BALANCE, None, (), "")
    return (SWITCHED_OFF, off) if probe.solvable(relaxed(problem, off)) else None


def _freed(problem: PatternProblem, clauses: Sequence[Clause], probe: Probe) -> Iterator[Step]:
    """Limbs that are unlocked and cells that are freed: one clause each, or as few together as suffice."""
    freed = [cells for clause in clauses if (cells := _inner_cells(problem, clause))]

    def change(first: int, after: int) -> Relaxation:
        cells = tuple(cell for part in freed[first:after] for cell in part)
        return Relaxation(Rule.FIXED, None, cells, "")

    alone = [change(one, one + 1) for one in range(len(freed))]
    alone = [one for one in alone if probe.solvable(relaxed(problem, one))]
    yield from ((FREEING, one) for one in alone)
    if len(freed) > 1 and not alone:
        count = _fewest(len(freed), lambda count: probe.solvable(relaxed(problem, change(0, count))))
        if count is not None:
            yield FREEING * count, change(0, count)


def _inner_cells(problem: PatternProblem, clause: Clause) -> tuple[tuple[int, int], ...]:
    """What can be freed of a clause: not a transition's ends."""
    inner = range(problem.sample_count)
    if problem.kind is PatternKind.TRANSITION:
        inner = inner[1:-1]
    return tuple(
        (limb, sample)
        for limb in clause.limbs
        for sample in range(clause.first, clause.last + 1)
        if clause.rule is Rule.FIXED and sample in inner and problem.fixed[limb, sample] != FREE
    )


def _longer(problem: PatternProblem) -> Step | None:
    """The fewest samples that suffice, where no single cells are fixed; with work of its own.

    Where it is proven that even the longest one has no pattern, the others are not tried.
    """
    if has_fixed_cells(problem) or failing_ends(problem):
        return None
    probe, now = Probe(work=LONGER_WORK), problem.sample_count
    longest = min(now + MOST_ADDED, MOST_SAMPLES)
    if longest <= now or probe.ask(with_samples(problem, longest)) is Feasibility.CONFLICT:
        return None
    for samples in range(now + 1, longest + 1):
        answer = probe.ask(with_samples(problem, samples))
        if answer is Feasibility.SOLVABLE:
            return samples - now, Relaxation(Rule.FIXED, None, (), "", samples)
        if answer is Feasibility.UNKNOWN:
            return None
    return None
