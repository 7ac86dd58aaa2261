"""Transitions between gaits: beside joint interpolation (F Table 4.1), and how many of them walk.

Table 4.1. Both methods go from one gait to another of the hexapod in the same time, between the same samples
of both gaits, once from each quarter of the cycle to the same quarter; speeds are means over these four,
margins the smallest, falls their sum.
- Interpolation: see `core.patterns.baseline`. The cyclic motions are those of the live optimiser for one
  cycle with a sample of standing, whose last knot is its first one moved on.
- Optimised: F's rules with those of `walking_rules`, phases finished; the motion is the live optimiser's for
  three iterations of the first gait, the transition in the third, and five of the second. Its speed is the
  body's own between the transition's first and last sample, its margin that of the centre of mass.
Gait “4” is F's: the front pair up. On a ring of six feet it cannot balance, so its motions may have the body
up to `LEAN` outside its feet and `QUICK` fast, in both methods, and they tip; “4m” has the middle pair up.

Shares. Two gaits of the library for one robot and orientation, both cursors anywhere, 20 to 40 samples, all
at random. A motion counts where the live optimiser solves it with a margin of `MARGIN` and the checker
confirms it; it is that of the whole document, both gaits included.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from app.bench.common.measure import Row
from app.plans.verified_result import VerifiedResult, verify
from core.arrays import Floats
from core.gait.gait import Gait, heading_angle, motion_problem
from core.library.library import Group, group_ids, library, library_patterns
from core.library.patterns import LibraryPattern
from core.motion.support_polygon import stability_margins
from core.patterns.baseline import TransitionFigures, blended_strokes, figures, figures_of_strokes, resting
from core.patterns.limits import walking_rules
from core.patterns.problem import PatternProblem, PatternResult, PatternRules, PatternStatus
from core.patterns.sources import transition_problem
from core.patterns.to_gait import joined_columns, periodic_gait, transition_gait
from core.problem.motion_problem import Boundary
from core.robot.model import load_robot
from solver_jobs import LiveSolver, PatternSolver, SolveStatus

PUBLISHED = {
    ("4", "5"): (6.4, 6.4),
    ("4", "6"): (6.4, 6.2),
    ("5", "4"): (0.08, 5.9),
    ("5", "6"): (5.2, 5.9),
    ("6", "4"): (-4.0, 5.2),
    ("6", "5"): (4.8, 6.0),
}
"""F Table 4.1: speed by interpolation and optimised, cm/s, of a robot many times as large and fast."""

GAITS = {"4": "hexapod-front-up", "4m": "hexapod-middle-up", "5": "hexapod-five", "6": "hexapod-tripod"}
"""F's names of gaits, by how many limbs walk."""

SAMPLES, QUARTERS = 20, 4
"""Of a transition, and cursors a cycle."""

BEFORE, AFTER = 3, 5
"""Iterations of the first and of the second gait in an optimised motion."""

LEAN, QUICK = 0.012, 0.030
"""What a gait that cannot balance may do, m and m/s."""

SECONDS = 60.0
"""Longest wait for an answer, s."""

COUNT, SEED = 40, 7
"""Random transitions a robot, and what they are drawn by."""

SHORTEST, LONGEST = 20, 40
"""Samples of a random transition."""

MARGIN = 0.003
"""How far inside the support polygon a motion that counts has to stay, m."""

NOT_DRAWN = ("rotate", "hexapod-front-up")
"""Gaits that are no side of a random transition: one turns on the spot, one has no motion itself."""


class RuleSet(StrEnum):
    """Under which rules a random transition is sought."""

    F = "F's alone"
    FEET = "and the feet's"
    """Swings long enough for the step, also where a cursor cuts them."""
    BALANCE = "and balance"


@dataclass(frozen=True, eq=False)
class Solvers:
    """The two processes that answer."""

    patterns: PatternSolver
    live: LiveSolver

    def pattern(self, problem: PatternProblem) -> PatternResult:
        """The best pattern."""
        return self.patterns.solve(problem, seconds=SECONDS)

    def motion(self, gait: Gait) -> VerifiedResult:
        """The live optimiser's motion, as the checker sees it."""
        problem = motion_problem(gait, load_robot(gait.robot))
        if gait.options.body_speed == QUICK:  # it cannot balance, and may lean instead
            problem = replace(problem, limits=replace(problem.limits, margin=-LEAN))
        return verify(problem, self.live.solve(problem, SECONDS))


@contextmanager
def solvers() -> Iterator[Solvers]:
    """Both processes, ended afterwards."""
    walk = library()["walk"].gait
    found = Solvers(PatternSolver(), LiveSolver(warm_up=motion_problem(walk, load_robot(walk.robot))))
    try:
        yield found
    finally:
        found.patterns.close()
        found.live.close()


def bench_transitions(count: int = COUNT, seed: int = SEED) -> list[Row]:
    """Table 4.1 by both methods, and the shares of random transitions that walk.

    Args:
        count: random transitions a robot.
        seed: what they are drawn by.
    """
    pairs = [*PUBLISHED, *((_middle(a), _middle(b)) for a, b in PUBLISHED if "4" in (a, b))]
    with solvers() as both:
        rows = [compared(first, second, both) for first, second in pairs]
        for robot in ("deltawalker", "hexapod", "dodecapod"):
            rows += [share(robot, rules, count, seed, both) for rules in RuleSet]
    return rows


def _middle(name: str) -> str:
    return "4m" if name == "4" else name


def _pattern(name: str) -> LibraryPattern:
    """A gait of F's table; one that cannot balance may lean and hurry."""
    pattern = library_patterns()[GAITS[name]]
    if name != "4":
        return pattern
    options = replace(pattern.use.options, margin=0.0, body_speed=QUICK)
    return replace(pattern, use=replace(pattern.use, options=options))


def compared(first: str, second: str, both: Solvers) -> Row:
    """A line of F Table 4.1, and F's own numbers beside it.

    Args:
        first: F's name of the gait that is left, one of `GAITS`.
        second: of the gait that follows.
        both: solvers.
    """
    one, other = _pattern(first), _pattern(second)
    cycles = [_cycle(pattern, both) for pattern in (one, other)]
    blends, optimised, confirmed = [], [], 0
    for quarter in range(QUARTERS):
        cursors = [quarter * pattern.stance.shape[1] // QUARTERS for pattern in (one, other)]
        blend = blended_strokes(cycles[0], cursors[0] + 1, cycles[1], cursors[1] + 1, SAMPLES)
        heading = heading_angle(one.use.orientation)
        blends.append(figures_of_strokes(one.model, blend, one.use.sample_time, heading))
        found, is_confirmed = _optimised(one, cursors[0], other, cursors[1], both)
        optimised += [found] if found is not None else []
        confirmed += is_confirmed
    published = PUBLISHED.get((first, second), (None, None))
    return {
        "transition": f"{first}→{second}",
        "F interpolation cm/s": published[0],
        "F optimised cm/s": published[1],
        "interpolation cm/s": _speed(blends, 100.0),
        "optimised cm/s": _speed(optimised, 100.0),
        "interpolation mm/s": _speed(blends, 1000.0),
        "optimised mm/s": _speed(optimised, 1000.0),
        "interpolation margin mm": _margin(blends),
        "optimised margin mm": _margin(optimised),
        "interpolation tilt °": _tilt(blends),
        "optimised tilt °": _tilt(optimised),
        "interpolation falls": sum(found.falls for found in blends),
        "optimised falls": sum(found.falls for found in optimised),
        "solved": f"{len(optimised)} of {QUARTERS}",
        "confirmed": f"{confirmed} of {QUARTERS}",
    }


def _speed(found: list[TransitionFigures], unit: float) -> float | None:
    return (
        round(float(np.mean([one.speed for one in found])) * unit, 3 if unit < 1000 else 2) if found else None
    )


def _margin(found: list[TransitionFigures]) -> float | None:
    return round(min(one.margin for one in found) * 1000, 1) if found else None


def _tilt(found: list[TransitionFigures]) -> float | None:
    return round(float(np.degrees(max(one.tilt for one in found))), 1) if found else None


def _cycle(pattern: LibraryPattern, both: Solvers) -> Floats:
    """(m + 1, legs, 3) strokes of one cycle from the sample of standing on, m."""
    options = replace(pattern.use.options, boundary=Boundary.PERIODIC, closing_knots=1)
    gait = periodic_gait(pattern.stance, pattern.model, replace(pattern.use, options=options))
    return both.motion(gait).trajectory.strokes(pattern.model)[:-1]


def _optimised(
    one: LibraryPattern, at: int, other: LibraryPattern, to: int, both: Solvers
) -> tuple[TransitionFigures | None, bool]:
    """The figures of an optimised transition, none where there is none, and whether it is confirmed."""
    first, second = one.used(BEFORE), other.used(AFTER)
    at += first.options.closing_knots + (BEFORE - 1) * one.stance.shape[1]
    to += second.options.closing_knots
    margin = min(first.options.margin, second.options.margin)
    rules = replace(walking_rules(first, second), balance=margin if margin > 0 else None)
    problem = transition_problem(first, at, second, to, SAMPLES, rules=rules, finish_phases=True)
    result = both.pattern(problem)
    if not result.patterns:
        return None, False
    stance = result.patterns[0].stance
    speed = max(first.options.body_speed, second.options.body_speed)
    gait = transition_gait(first, at, second, to, stance).with_options(margin=margin, body_speed=speed)
    verified = both.motion(gait)
    if verified.result.status is not SolveStatus.SOLVED:
        return None, False
    t, columns = verified.trajectory, joined_columns(first, at, second, to, stance)
    window = slice(columns.first, columns.last + 1)
    body = t.body_world[window, :2]
    feet = t.feet_world[window]
    margins = stability_margins(body, feet, t.contact[window])
    tilt = resting(feet - np.concatenate([body, np.zeros((len(body), 1))], axis=1)[:, None]).tilt
    heading = heading_angle(one.use.orientation)
    found = figures(body[-1] - body[0], margins, tilt, one.use.sample_time, heading)
    return found, verified.status is SolveStatus.SOLVED


@dataclass(frozen=True, eq=False)
class Draw:
    """A random transition."""

    first: Gait
    at: int
    second: Gait
    to: int
    samples: int

    def problem(self, rules: RuleSet) -> PatternProblem:
        """Its search under some rules."""
        own = walking_rules(self.first, self.second)
        numbers = {
            RuleSet.F: PatternRules(),
            RuleSet.FEET: replace(own, balance=None),
            RuleSet.BALANCE: replace(own, balance=MARGIN),
        }
        return transition_problem(
            self.first,
            self.at,
            self.second,
            self.to,
            self.samples,
            rules=numbers[rules],
            finish_phases=rules is not RuleSet.F,
        )


def random_transitions(robot: str, count: int, seed: int) -> Iterator[Draw]:
    """Transitions between gaits of the library, the same ones for the same seed.

    Args:
        robot: name of its parameters file.
        count: how many.
        seed: what they are drawn by.
    """
    random = np.random.default_rng(seed)
    ids = [*group_ids(Group.OPTIMISED), *group_ids(Group.PATTERNS)]
    known = [library()[gait_id].gait for gait_id in ids if gait_id not in NOT_DRAWN]
    gaits = [gait.with_options(margin=MARGIN) for gait in known if gait.robot == robot]
    for _ in range(count):
        first = gaits[int(random.integers(len(gaits)))]
        fitting = [gait for gait in gaits if gait.orientation is first.orientation]
        second = fitting[int(random.integers(len(fitting)))]
        at, to = (int(random.integers(gait.timeline.sample_count)) for gait in (first, second))
        yield Draw(first, at, second, to, int(random.integers(SHORTEST, LONGEST + 1)))


def share(robot: str, rules: RuleSet, count: int, seed: int, both: Solvers) -> Row:
    """How many of a robot's random transitions are feasible, and how many of those walk.

    Args:
        robot: name of its parameters file.
        rules: under which they are sought.
        count: how many.
        seed: what they are drawn by.
        both: solvers.
    """
    feasible, open_, walks = 0, 0, 0
    for draw in random_transitions(robot, count, seed):
        result = both.pattern(draw.problem(rules))
        open_ += result.status is PatternStatus.CANCELLED
        if result.patterns:
            feasible += 1
            stance = result.patterns[0].stance
            verified = both.motion(transition_gait(draw.first, draw.at, draw.second, draw.to, stance))
            walks += verified.status is SolveStatus.SOLVED
    return {
        "robot": robot,
        "rules": rules.value,
        "transitions": count,
        "infeasible": count - feasible - open_,
        "no answer": open_,
        "feasible": feasible,
        "walk": walks,
        "share %": round(100.0 * walks / feasible, 1) if feasible else None,
    }
