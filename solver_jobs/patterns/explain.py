"""Why a problem has no pattern, and what would help."""

from dataclasses import dataclass, replace

from core.patterns.clause import Clause
from core.patterns.problem import PatternProblem, PatternResult, PatternStatus, Relaxation
from core.patterns.sentences import conflict_sentence, explanation
from solver_jobs.patterns.conflict import find_conflict
from solver_jobs.patterns.probe import Probe
from solver_jobs.patterns.relax import find_relaxations


@dataclass(frozen=True)
class Explanation:
    """Why there is no pattern.

    Args:
        clauses: a smallest set of clauses that conflict.
        sentences: the same in words, and what would help.
        relaxations: single changes that make the problem solvable, the mildest first; each was solved.
    """

    clauses: tuple[Clause, ...]
    sentences: tuple[str, ...]
    relaxations: tuple[Relaxation, ...]


def explain(problem: PatternProblem) -> Explanation:
    """Explains a problem of which it is proven that it has no pattern; the same words each time.

    Args:
        problem: an infeasible one.
    """
    conflict = find_conflict(problem, Probe())
    relaxations = find_relaxations(problem, conflict.clauses, Probe())
    sentence = conflict_sentence(problem, conflict.clauses, conflict.reached)
    return Explanation(conflict.clauses, explanation(problem, sentence, relaxations), relaxations)


def explained(problem: PatternProblem, result: PatternResult) -> PatternResult:
    """The result, with its explanation where there is proven to be no pattern.

    Args:
        problem: what was sought.
        result: how the search came out.
    """
    if result.status is not PatternStatus.INFEASIBLE:
        return result
    why = explain(problem)
    return replace(result, explanation=why.sentences, relaxations=why.relaxations)
