"""The shortest length that a pattern can have."""

from core.errors import StateError
from core.patterns.problem import LEAST_SAMPLES, PatternProblem
from core.patterns.relaxation import with_samples
from solver_jobs.patterns.probe import Feasibility, Probe

WORK = 5.0
"""Of all lengths together, in the solver's deterministic seconds."""


def shortest_problem(problem: PatternProblem) -> PatternProblem:
    """The problem in the shortest length that has a pattern; as it is where none up to its own length has.

    Each shorter length is proven to have none.

    Args:
        problem: what is sought, in the longest length that is tried; only ends and whole limbs are fixed.

    Raises:
        InputError: single cells are fixed.
        StateError: of some length it could not be said whether it has a pattern.
    """
    probe = Probe(work=WORK)
    for samples in range(LEAST_SAMPLES, problem.sample_count + 1):
        shorter = with_samples(problem, samples)
        answer = probe.ask(shorter)
        if answer is Feasibility.SOLVABLE:
            return shorter
        if answer is Feasibility.UNKNOWN:
            raise StateError(
                f"It could not be told whether {samples} samples suffice, so the shortest length is not "
                "known. Choose a length.",
                "samples",
            )
    return problem
