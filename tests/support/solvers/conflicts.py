"""Problems that no pattern solves, one for each way in which rules conflict."""

from __future__ import annotations

import numpy as np

from core.patterns.problem import (
    FREE,
    PatternKind,
    PatternProblem,
    PatternRules,
    index_halves,
    transition_cells,
)

F_RULES = PatternRules()
WORKLOAD_ALONE = PatternRules(None, None, None, 2, None, None, None)


def transition(
    start: str,
    end: str,
    samples: int,
    locked: tuple[int, ...] = (),
    rules: PatternRules = F_RULES,
) -> PatternProblem:
    """A transition of states such as "1101"; locked limbs count from 1."""
    states = [np.array([bit == "1" for bit in bits]) for bits in (start, end)]
    held = np.isin(np.arange(1, len(start) + 1), locked)
    cells = transition_cells(states[0], states[1], samples, held)
    sides = index_halves(len(start))
    return PatternProblem(PatternKind.TRANSITION, cells, ~held, sides, rules)


def periodic(legs: int, samples: int, locked: dict[int, int] | None = None) -> PatternProblem:
    """A gait with some limbs, counting from 1, locked in swing (0) or stance (1)."""
    cells = np.full((legs, samples), FREE, dtype=np.int8)
    walking = np.ones(legs, dtype=bool)
    for limb, value in (locked or {}).items():
        cells[limb - 1], walking[limb - 1] = value, False
    return PatternProblem(PatternKind.PERIODIC, cells, walking, index_halves(legs))


def drawn(problem: PatternProblem, limb: int, samples: range, value: int) -> PatternProblem:
    """The problem with cells fixed; limb and samples count from 1."""
    cells = np.array(problem.fixed)
    cells[limb - 1, samples.start - 1 : samples.stop - 1] = value
    return PatternProblem(problem.kind, cells, problem.walking, problem.sides, problem.rules)


CONFLICTS = {
    "locked limbs leave two feet": transition("0110", "0110", 20, (1, 4)),
    "no foot at the start": transition("0000", "1111", 20),
    "the start lifts a side": transition("000111", "111111", 20),
    "both ends lift a side": transition("111000", "000111", 4),
    "four limbs have no room to swing": transition("1111", "1111", 9),
    "six limbs have no room to swing": transition("111111", "111111", 4),
    "twelve limbs have no room to swing": transition("1" * 12, "1" * 12, 5),
    "a locked limb lets no other swing": transition("1101", "1101", 12, (3,)),
    "no change is allowed": transition("011111", "111111", 20, rules=PatternRules(limb_changes=0)),
    "more feet than there are": transition("111111", "111111", 20, rules=PatternRules(feet_down=7)),
    "a drawn swing is too short": drawn(
        drawn(drawn(transition("1111", "1111", 20), 2, range(5, 6), 0), 2, range(4, 5), 1), 2, range(6, 7), 1
    ),
    "a drawn stance is too short": drawn(
        drawn(
            drawn(transition("111111", "111111", 20, rules=PatternRules(limb_changes=4)), 2, range(6, 8), 0),
            2,
            range(8, 9),
            1,
        ),
        2,
        range(9, 11),
        0,
    ),
    "two limbs drawn in swing": drawn(
        drawn(transition("1111", "1111", 20), 1, range(6, 9), 0), 2, range(8, 12), 0
    ),
    "unequal stance": drawn(
        drawn(transition("111111", "111111", 12, rules=WORKLOAD_ALONE), 3, range(2, 12), 1),
        5,
        range(4, 10),
        0,
    ),
    "a gait has no room": periodic(4, 6),
    "a gait with one limb up": periodic(4, 16, {1: 0, 2: 1}),
    "a gait of four limbs has no room": periodic(6, 6, {1: 0, 4: 0}),
    "ten limbs up": periodic(12, 40, dict.fromkeys(range(1, 11), 0)),
}
"""Name → problem."""
