"""A part of a pattern's rules: which rule, for which limbs, at which samples."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from core.patterns.problem import Rule

SAMPLE_RULES = (Rule.FEET_DOWN, Rule.FEET_DOWN_EACH_SIDE, Rule.BALANCE)
"""Rules about all feet at one sample; the other ones are about limbs."""


@dataclass(frozen=True)
class Clause:
    """A rule for some limbs over some samples; a conflict is a set of these that cannot hold together.

    Args:
        rule: which.
        limbs: limbs that it is asked of, 0-based; empty for `SAMPLE_RULES`.
        first: first sample at which it is asked, 0-based; limbs' rules but FIXED are asked of all samples.
        last: the last one.
    """

    rule: Rule
    limbs: tuple[int, ...]
    first: int
    last: int

    def asks(self, limb: int | None, sample: int | None) -> bool:
        """Whether an instance of its rule is a part of it."""
        return (limb is None or limb in self.limbs) and (sample is None or self.first <= sample <= self.last)


def asked_by(clauses: Iterable[Clause]) -> Callable[[Rule, int | None, int | None], bool]:
    """The predicate of a model that holds these clauses alone: rule, limb, sample."""
    by_rule: dict[Rule, list[Clause]] = {}
    for clause in clauses:
        by_rule.setdefault(clause.rule, []).append(clause)

    def active(rule: Rule, limb: int | None, sample: int | None) -> bool:
        return any(clause.asks(limb, sample) for clause in by_rule.get(rule, ()))

    return active
