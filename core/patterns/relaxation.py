"""Relaxing a pattern's problem in one place."""

from dataclasses import replace
from typing import Any

import numpy as np

from core.errors import InputError
from core.patterns.problem import (
    FREE,
    PatternKind,
    PatternProblem,
    Relaxation,
    Rule,
    free_cells,
    with_finished_phases,
)


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
    """The problem in another length, where only ends, whole limbs and what finishes cut phases are fixed.

    Args:
        problem: what is sought; its drawing goes, for it belongs to the old length.
        samples: the new length; no shorter than what finishes cut phases needs.

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
        if problem.finishing is not None:
            fixed = with_finished_phases(fixed, problem.finishing)
    held = ~problem.walking
    fixed[held] = problem.fixed[held, :1]
    return replace(problem, fixed=fixed, drawing=None)


def has_fixed_cells(problem: PatternProblem) -> bool:
    """Whether walking limbs have fixed cells besides a transition's ends and what finishes cut phases."""
    given = free_cells(problem.leg_count, problem.sample_count)
    if problem.kind is PatternKind.TRANSITION:
        given[:, 0], given[:, -1] = problem.fixed[:, 0], problem.fixed[:, -1]
        if problem.finishing is not None:
            given = with_finished_phases(given, problem.finishing)
    drawn = (problem.fixed != FREE) & (given == FREE)
    return bool(drawn[problem.walking].any())


def _freed(problem: PatternProblem, cells: tuple[tuple[int, int], ...]) -> PatternProblem:
    fixed, walking = np.array(problem.fixed), np.array(problem.walking)
    finishing = None if problem.finishing is None else np.array(problem.finishing)
    for limb, sample in cells:
        if not (0 <= limb < problem.leg_count and 0 <= sample < problem.sample_count):
            raise InputError(f"Limb {limb + 1} at sample {sample + 1} lies outside the pattern.", "cells")
        fixed[limb, sample] = FREE
        walking[limb] = True
        if finishing is not None:
            # What is left of its cut phases is fixed like cells that were drawn.
            finishing[:, limb] = 0
    return replace(problem, fixed=fixed, walking=walking, finishing=finishing)
