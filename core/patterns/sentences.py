"""Sentences about patterns: rules that conflict, and what would relax them."""

from collections.abc import Mapping, Sequence

import numpy as np

from core.patterns.clause import SAMPLE_RULES, Clause
from core.patterns.numerals import counted, listed, named, only, plural, times
from core.patterns.problem import PatternKind, PatternProblem, Relaxation, Rule

MM = 1000.0
Phrase = tuple[str, str]
"""A subject and what it does."""
MOST_NAMED = 3
"""Limbs of a state that are named one by one."""


def conflict_sentence(problem: PatternProblem, clauses: Sequence[Clause], reached: int | None) -> str:
    """What conflicts, such as "Limbs 1 and 4 are locked in swing: at samples 1–9 only two feet are down, …".

    Args:
        problem: what is sought.
        clauses: a smallest set that cannot hold together.
        reached: where feet down are counted: the largest number that the other clauses leave possible.
    """
    counting = next((clause for clause in clauses if clause.rule in SAMPLE_RULES), None)
    others = [clause for clause in clauses if clause is not counting]
    if counting is None:
        premises = _premises(problem, others)
        cannot = {1: "this cannot be", 2: "both cannot hold"}.get(len(premises), "not all of this can hold")
        return _sentence(premises, f"{cannot} in {counted(problem.sample_count, 'sample')}")
    plain = counting.first == counting.last and counting.rule is not Rule.BALANCE
    if others and plain and all(clause.rule is Rule.FIXED for clause in others):
        return _seen_at_once(problem, counting)
    return _sentence(_premises(problem, others), _conclusion(problem, counting, reached or 0))


def explanation(problem: PatternProblem, sentence: str, relaxations: Sequence[Relaxation]) -> tuple[str, ...]:
    """The conflict and what to do about it.

    Args:
        problem: what is sought.
        sentence: what conflicts.
        relaxations: what would make it solvable, the mildest first.
    """
    if relaxations:
        ways = [f"with {one.words[0].lower()}{one.words[1:]}" for one in relaxations]
        return sentence, f"It works {listed(ways, ' or ')}."
    ends = failing_ends(problem)
    if problem.kind is PatternKind.TRANSITION and ends:
        states = "another state" if len(ends) == 1 else "other states"
        return sentence, f"No change of one rule mends this: choose {states} at {named('sample', ends)}."
    return sentence, "No way out was found: loosen several of these together."


def relaxation_words(problem: PatternProblem, relaxation: Relaxation) -> str:
    """A relaxation for a button, such as "2 feet down instead of 3"; with all that goes with it."""
    words = [_change_words(problem, one) for one in (relaxation, *relaxation.also)]
    return listed([words[0], *(f"{one[0].lower()}{one[1:]}" for one in words[1:])])


def _change_words(problem: PatternProblem, relaxation: Relaxation) -> str:
    if relaxation.samples is not None:
        return length_words(relaxation.samples, problem.sample_count)
    if relaxation.rule is Rule.FIXED:
        return _capital(_freed_words(problem, relaxation.cells))
    old = getattr(problem.rules, relaxation.rule.value)
    if relaxation.rule is Rule.BALANCE:
        return _balance_words(relaxation.value, old)
    return _number_words(problem, relaxation.rule, int(relaxation.value or 0), old)


def length_words(samples: int, asked: int) -> str:
    """Another length for a button: "22 samples instead of 6"."""
    return f"{counted(samples, 'sample')} instead of {asked}"


def _number_words(problem: PatternProblem, rule: Rule, value: int, old: int) -> str:
    if not value and rule is Rule.LEAST_SWING:
        return f"{_capital(plural(problem.noun, 2))} that need not swing"
    if not value and rule is Rule.FEET_DOWN_EACH_SIDE:
        return "A side without a foot down"
    samples = counted(value, "sample")
    number = {
        Rule.FEET_DOWN: f"{counted(value, 'foot')} down",
        Rule.FEET_DOWN_EACH_SIDE: f"{counted(value, 'foot')} down on each side",
        Rule.SHORTEST_SWING: f"Swings of {samples}",
        Rule.SHORTEST_STANCE: f"Stances of {samples}",
        Rule.LEAST_SWING: f"{samples} of swing a {problem.noun}",
        Rule.LIMB_CHANGES: f"{counted(value, 'change')} a {problem.noun}",
        Rule.WORKLOAD: f"Stances that differ by {samples}",
    }
    return f"{number[rule]} instead of {old}"


def _balance_words(value: float | None, old: float) -> str:
    if value is None:
        return "Balance not asked for"
    return f"Balance margin {_mm(value)} instead of {_mm(old)}"


def _mm(value: float) -> str:
    return f"{value * MM:g} mm".replace("-", "−")


def _freed_words(problem: PatternProblem, cells: Sequence[tuple[int, int]]) -> str:
    limbs = sorted({limb for limb, _ in cells})
    if not problem.walking[limbs].any():
        return f"{named(problem.noun, limbs)} free to walk"
    samples = sorted({sample for _, sample in cells})
    return f"{named(problem.noun, limbs)} free at {named('sample', samples)}"


def _sentence(premises: Sequence[Phrase], verdict: str) -> str:
    """Premises and what follows; what one subject does stands together."""
    if not premises:
        return f"{_capital(verdict)}."
    by_subject: dict[str, list[str]] = {}
    for who, does in premises:
        by_subject.setdefault(who, []).append(does)
    said = [f"{who} {listed(does)}" for who, does in by_subject.items()]
    joint = ", and " if any(len(does) > 1 for does in by_subject.values()) else " and "
    return f"{_capital(listed(said, joint))}: {verdict}."


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


def _premises(problem: PatternProblem, clauses: Sequence[Clause]) -> list[Phrase]:
    """One phrase for each rule, what is fixed first."""
    fixed = [clause for clause in clauses if clause.rule is Rule.FIXED]
    phrases = _fixed_phrases(problem, fixed)
    by_rule: dict[Rule, set[int]] = {}
    for clause in clauses:
        if clause.rule in SAMPLE_RULES:
            phrases.append(_demand(problem, clause))
        elif clause.rule is not Rule.FIXED:
            by_rule.setdefault(clause.rule, set()).update(clause.limbs)
    return phrases + [_limb_phrase(problem, rule, sorted(limbs)) for rule, limbs in by_rule.items()]


def _fixed_phrases(problem: PatternProblem, clauses: Sequence[Clause]) -> list[Phrase]:
    """Locked limbs first, then the ends and other cells."""
    locked = [limb for clause in clauses for limb in clause.limbs if not problem.walking[limb]]
    windows: dict[tuple[int, int], list[int]] = {}
    for clause in clauses:
        if problem.walking[list(clause.limbs)].any():
            windows.setdefault((clause.first, clause.last), []).extend(clause.limbs)
    return [*_locked_phrases(problem, locked), *_cell_phrases(problem, windows)]


def _locked_phrases(problem: PatternProblem, limbs: Sequence[int]) -> list[Phrase]:
    phrases = []
    for value, name in ((0, "swing"), (1, "stance")):
        held = [limb for limb in limbs if problem.fixed[limb, 0] == value]
        if held:
            phrases.append((named(problem.noun, held), f"{_are(held)} locked in {name}"))
    return phrases


def _cell_phrases(problem: PatternProblem, windows: Mapping[tuple[int, int], Sequence[int]]) -> list[Phrase]:
    """Fixed cells of walking limbs: who stands or swings when; long mixed states are only mentioned."""
    alike: dict[tuple[tuple[int, ...], int], set[int]] = {}
    mixed: list[int] = []
    for (first, last), limbs in windows.items():
        cells = problem.fixed[sorted(limbs), first : last + 1]
        both = (cells == 0).any() and (cells == 1).any()
        if both and first == last and len(limbs) > MOST_NAMED:
            mixed.append(first)
            continue
        for value in (0, 1):
            held = [limb for limb in sorted(limbs) if (problem.fixed[limb, first : last + 1] == value).any()]
            shown = first + np.nonzero((problem.fixed[held, first : last + 1] == value).any(axis=0))[0]
            if held:
                alike.setdefault((tuple(held), value), set()).update(shown.tolist())
    phrases = [
        (_who(problem, limbs), f"{_verb(problem, limbs, value)} at {named('sample', sorted(samples))}")
        for (limbs, value), samples in alike.items()
    ]
    if mixed:
        states = f"the {plural('state', len(mixed))} at {named('sample', mixed)}"
        phrases.append((states, f"{_are(mixed)} given"))
    return phrases


def _verb(problem: PatternProblem, limbs: Sequence[int], value: int) -> str:
    one = len(limbs) == 1 or _who(problem, limbs).startswith("every")
    return ("swings" if one else "swing", "stands" if one else "stand")[value]


def _are(things: Sequence[int]) -> str:
    return "is" if len(things) == 1 else "are"


def _who(problem: PatternProblem, limbs: Sequence[int]) -> str:
    """Limbs by number, or "every limb" where all of them are meant."""
    if len(limbs) == problem.leg_count:
        return f"every {problem.noun}"
    if len(limbs) > 1 and sorted(limbs) == np.nonzero(problem.walking)[0].tolist():
        return f"every walking {problem.noun}"
    return named(problem.noun, limbs)


def _limb_phrase(problem: PatternProblem, rule: Rule, limbs: Sequence[int]) -> Phrase:
    who = _who(problem, limbs)
    each = " each" if len(limbs) > 1 and not who.startswith("every") else ""
    number = int(getattr(problem.rules, rule.value) or 0)
    samples = counted(number, "sample")
    match rule:
        case Rule.SHORTEST_SWING:
            return who, f"must{each} swing at least {samples} at a time"
        case Rule.SHORTEST_STANCE:
            return who, f"must{each} rest at least {samples} at a time"
        case Rule.LEAST_SWING:
            return who, f"must{each} swing" + (f" at least {samples} in all" if number else "")
        case Rule.LIMB_CHANGES:
            return who, f"may{each} {f'change at most {times(number)}' if number else 'not change'}"
        case _:
            walkers = plural(problem.noun, 2) if who.startswith("every") else who
            differ = f"may differ by at most {samples}" if number else "must last equally long"
            return f"the stances of {walkers}", differ


def _at(problem: PatternProblem, clause: Clause) -> str:
    if clause.first == clause.last:
        return f"at sample {clause.first + 1}"
    if clause.last - clause.first + 1 == problem.sample_count:
        return "at some sample"
    return f"somewhere in samples {clause.first + 1}–{clause.last + 1}"


def _demand(problem: PatternProblem, clause: Clause) -> Phrase:
    """A rule about samples as a premise."""
    over = named("sample", range(clause.first, clause.last + 1))
    if clause.rule is Rule.BALANCE:
        margin = _mm(problem.rules.balance or 0.0)
        return "the body", f"must keep a balance margin of {margin} at {over}"
    number = int(getattr(problem.rules, clause.rule.value))
    where = " on each side" if clause.rule is Rule.FEET_DOWN_EACH_SIDE else ""
    return f"at least {counted(number, 'foot')}", f"must be down{where} at {over}"


def _conclusion(problem: PatternProblem, clause: Clause, reached: int) -> str:
    """What the premises leave of a rule about samples."""
    at = _at(problem, clause)
    if clause.rule is Rule.BALANCE:
        margin = _mm(problem.rules.balance or 0.0)
        return f"{at} the body cannot keep a balance margin of {margin}"
    number = int(getattr(problem.rules, clause.rule.value))
    if clause.rule is Rule.FEET_DOWN and number > problem.leg_count:
        limbs = counted(problem.leg_count, problem.noun)
        return f"the robot has {limbs}, and at least {number} feet must be down"
    if clause.rule is Rule.FEET_DOWN:
        return f"{at} {only(reached, 'foot')} down, and at least {number} must be"
    sides = listed([named(problem.noun, np.nonzero(side)[0].tolist()) for side in problem.sides])
    few = only(reached, "foot")
    return f"{at} {few} down on one of the sides ({sides}), and at least {number} must be"


def _seen_at_once(problem: PatternProblem, clause: Clause) -> str:
    """Too few feet down by what is fixed alone, at every sample where it is the same feet."""
    fixed, number = problem.fixed, int(getattr(problem.rules, clause.rule.value))
    sides = np.ones((1, problem.leg_count), dtype=bool)
    if clause.rule is Rule.FEET_DOWN_EACH_SIDE:
        sides = problem.sides
    down = sides.astype(int) @ (fixed[:, clause.first] != 0).astype(int)
    side = int(np.argmin(down))
    held = np.nonzero(sides[side] & (fixed[:, clause.first] == 0))[0].tolist()
    walking = [limb for limb in held if problem.walking[limb]]
    phrases = _locked_phrases(problem, [limb for limb in held if limb not in walking])
    who, verb = only(int(down[side]), "foot").rsplit(" ", 1)
    of = f" of {named(problem.noun, np.nonzero(sides[side])[0].tolist())}" if len(sides) > 1 else ""
    if walking:
        phrases += _cell_phrases(problem, {(clause.first, clause.first): walking})
        return _sentence(phrases, f"{who}{of} {verb} down there, and at least {number} must be")
    same = (fixed[sides[side]] == 0) == (fixed[sides[side], clause.first] == 0)[:, None]
    samples = np.nonzero(same.all(axis=0))[0].tolist()
    return _sentence(
        phrases, f"at {named('sample', samples)} {who}{of} {verb} down, and at least {number} must be"
    )


def failing_samples(problem: PatternProblem) -> list[int]:
    """Samples, 0-based, that what is fixed there alone keeps from having enough feet down."""
    down, rules = (problem.fixed != 0).astype(int), problem.rules
    fails = down.sum(axis=0) < (rules.feet_down or 0)
    fails |= (problem.sides.astype(int) @ down).min(axis=0) < (rules.feet_down_each_side or 0)
    return [int(sample) for sample in np.nonzero(fails)[0]]


def failing_ends(problem: PatternProblem) -> list[int]:
    """Those of the failing samples that are the first or the last one, which no other length mends."""
    return [sample for sample in failing_samples(problem) if sample in (0, problem.sample_count - 1)]
