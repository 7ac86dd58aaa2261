"""The pattern search as the page and scripts see it, as JSON content; limbs and samples count from 0."""

from app.common.json import Json
from core.motion.contact_timeline import rows_from_bits
from core.patterns.problem import FREE, Pattern, PatternProblem, PatternProgress, PatternResult, Relaxation

_FREE_MARK = "."


def result_content(problem: PatternProblem, result: PatternResult) -> Json:
    """An answer with its problem's fixed cells.

    Args:
        problem: what was sought, of the length that was found.
        result: how it came out.
    """
    return {
        "status": result.status.value,
        "samples": problem.sample_count,
        "fixed": [
            "".join(_FREE_MARK if c == FREE else str(c) for c in row) for row in problem.fixed.tolist()
        ],
        "walking": problem.walking.tolist(),
        "patterns": [pattern_content(problem, pattern) for pattern in result.patterns],
        "bound": result.bound,
        "seconds": result.solve_seconds,
        "explanation": list(result.explanation),
        "relaxations": [_relaxation_content(one) for one in result.relaxations],
    }


def pattern_content(problem: PatternProblem, pattern: Pattern) -> Json:
    """A pattern with its weighted sum."""
    weights = problem.weights
    score = weights.sample_changes * pattern.sample_changes + weights.limb_changes * pattern.limb_changes
    return {
        "feet": list(rows_from_bits(pattern.stance)),
        "sample_changes": pattern.sample_changes,
        "limb_changes": pattern.limb_changes,
        "redrawn": pattern.redrawn,
        "score": score + weights.drawing * pattern.redrawn,
        "body_xy": None if pattern.body_xy is None else pattern.body_xy.tolist(),
    }


def progress_content(problem: PatternProblem, progress: PatternProgress) -> Json:
    """What is known in the middle of a search; a bound below any pattern's sum is 0."""
    return {
        "seconds": progress.seconds,
        "objective": progress.objective,
        "bound": max(progress.bound, 0.0),
        "pattern": None if progress.pattern is None else pattern_content(problem, progress.pattern),
    }


def _relaxation_content(relaxation: Relaxation) -> Json:
    return {
        "rule": relaxation.rule.value,
        "value": relaxation.value,
        "cells": [list(cell) for cell in relaxation.cells],
        "samples": relaxation.samples,
        "words": relaxation.words,
        "also": [_relaxation_content(further) for further in relaxation.also],
    }
