"""Relaxing a pattern's problem in one place."""

from dataclasses import replace
from typing import Any

import numpy as np

from core.errors import InputError
from core.patterns.problem import FREE, PatternKind, PatternProblem, Relaxation, Rule, free_cells


def relaxed(problem: PatternProblem, relaxation: Relaxation) -> PatternProblem:
    """The problem with one relaxation applied, and those that go with it.

    Args:
        problem: what is sought.
        relaxation: samples that are added before the last one, cells that are freed, or a rule's new number.

    Raises:
        InputError: cells outside the pattern.
    """
    changed = _changed(problem, relaxation)
    for further in relaxation.also:
        changed = relaxed(changed, further)
    return changed


def _changed(problem: PatternProblem, relaxation: Relaxation) -> PatternProblem:
    if relaxation.samples is not None:
        return with_samples(problem, relaxation.samples)
    if relaxation.rule is Rule.FIXED:
        return _freed(problem, relaxation.cells)
    value = relaxation.value
    if relaxation.rule is Rule.BALANCE or value is None:
        return with_rule(problem, relaxation.rule, value)
    return with_rule(problem, relaxation.rule, int(value))


def with_rule(problem: PatternProblem, rule: Rule, value: float | None) -> PatternProblem:
    """The problem with another number for one rule; None switches it off."""
    number: dict[str, Any] = {rule.value: value}
    return replace(problem, rules=replace(problem.rules, **number))


def with_samples(problem: PatternProblem, samples: int) -> PatternProblem:
    """The problem in another length, where only boundary states and whole limbs are fixed.

    Args:
        problem: what is sought; its drawing goes, for it belongs to the old length.
        samples: the new length.

    Raises:
        InputError: single cells are fixed, which have no place in another length.
    """
    if has_fixed_cells(problem):
        raise InputError(
            "Cells between the ends are fixed, so the number of samples cannot change. Free them.", "samples"
        )
    fixed = free_cells(problem.leg_count, samples)
    if problem.kind is PatternKind.TRANSITION:
        fixed[:, 0], fixed[:, -1] = problem.fixed[:, 0], problem.fixed[:, -1]
    held = ~problem.walking
    fixed[held] = problem.fixed[held, :1]
    return replace(problem, fixed=fixed, drawing=None)


def has_fixed_cells(problem: PatternProblem) -> bool:
    """Whether cells of walking limbs are fixed elsewhere than in a transition's first and last sample."""
    inside = slice(1, -1) if problem.kind is PatternKind.TRANSITION else slice(None)
    return bool((problem.fixed[problem.walking, inside] != FREE).any())


def _freed(problem: PatternProblem, cells: tuple[tuple[int, int], ...]) -> PatternProblem:
    fixed, walking = np.array(problem.fixed), np.array(problem.walking)
    for limb, sample in cells:
        if not (0 <= limb < problem.leg_count and 0 <= sample < problem.sample_count):
            raise InputError(f"Limb {limb + 1} at sample {sample + 1} lies outside the pattern.", "cells")
        fixed[limb, sample] = FREE
        walking[limb] = True
    return replace(problem, fixed=fixed, walking=walking)
