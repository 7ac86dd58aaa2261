"""Why no pose gait was found: the largest step that works, or the limits that would have to give way."""

from collections.abc import Callable, Iterator

import numpy as np

from core.pose_gaits.motion_in_move import least_arm_distance
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import LEAST_CLEARANCE, PoseProblem
from core.pose_gaits.start_motion import MM
from core.wire.robot_time import deaf_seconds
from solver_jobs.pose_gaits.pose_program import LEVER, PoseProgram, asked_reach
from solver_jobs.pose_gaits.program import Attempt, Row
from solver_jobs.pose_gaits.weights import SLACKS, Weights

FARTHEST = Weights(time=1e-3, reach=1.0)
LOOSEST = Weights(time=1e-3, slack=10.0)
NOTICED = 0.01
"""Slack below this is what rounding leaves, mm."""
PRESSURE = 1e-3
"""Multipliers below this hold nothing back."""
ALIKE = 1e-3
"""Multipliers that differ by a smaller share are equal."""
ROUNDING = 1e-3
"""Share of the last decimal by which IPOPT may miss a round number."""
LONGER_MOVES = 12.0
"""Moves are made longer by at most this to see whether that helps, mm."""

_OPTIONS = {
    "margin": "the margin (--margin)",
    "clearance": "the clearance (--clearance)",
    "shoe distance": "the distance of shoes (--shoe-distance)",
    "stop bound": "the stop bound (--stop-bound)",
    "stroke": "the motors' range",
    "slip": "the slip of standing feet (--slip)",
    "coupling": "motors that share an actuator",
}

NOT_PROVEN = "This is the result of a search, not a proof."

Run = Callable[..., Attempt]
"""Calls IPOPT (see `solve_poses`)."""


def explained(
    problem: PoseProblem, program: PoseProgram, run: Run, longest: tuple[PoseProgram, Attempt] | None
) -> tuple[str, ...]:
    """Sentences for a problem for which no start led to a gait.

    Args:
        problem: what was asked.
        program: of the problem, whose search begins with a short step.
        run: calls IPOPT.
        longest: the longest step that was found, with its program; None where none was looked for or found.
    """
    if not problem.is_free and longest is not None:
        of, farthest = longest
        reach = float(farthest.values[of.reach_place])
        if reach < asked_reach(problem):
            held = f"The limits that prevent more: {_holding_back(of, farthest)}."
            return (f"{_too_far(problem, reach)} {held}", NOT_PROVEN)
    sentences = tuple(_helpful(problem, program, run))
    if not sentences:
        return ("No gait was found. Loosening one limit alone does not help.", NOT_PROVEN)
    return (*sentences, NOT_PROVEN)


def _too_far(problem: PoseProblem, reach: float) -> str:
    """That the step or the turn is too long, and the longest that was found, as a way in mm."""
    if problem.on_the_spot:
        asked, most = (np.degrees(way / LEVER) for way in (asked_reach(problem), reach))
        return (
            f"A turn of {asked:.4g}° a cycle (--turn) is too far: with these limits the farthest that was "
            f"found is {_floored(most):.1f}°."
        )
    return (
        f"A step of {asked_reach(problem):.4g} mm a cycle (--step) is too long: with these limits the "
        f"longest that was found is {_floored(reach):.1f} mm."
    )


def _floored(value: float) -> float:
    """A value that is still possible, to one decimal."""
    return float(np.floor(value * 10 + ROUNDING) / 10)


def arms_explained(gait: PoseGait) -> tuple[str, ...]:
    """Sentences for a gait that was found and whose arms cannot be kept apart."""
    problem, least = gait.problem, least_arm_distance(gait) * MM
    near = f"come within {least:.1f} mm" if least >= 0.0 else f"would be {-least:.1f} mm in one another"
    less = "Turn less (--turn)" if problem.on_the_spot else "Shorten the step (--step)"
    return (
        f"The gait that was found lets the arms of neighbouring legs come too near: they {near}, and "
        f"{problem.bounds.arm_distance * MM:g} mm are asked (--arm-distance). {less}, or ask for less room.",
        NOT_PROVEN,
    )


def _helpful(problem: PoseProblem, program: PoseProgram, run: Run) -> Iterator[str]:
    """For each limit by itself how far it would have to give way."""
    bounds = problem.bounds
    reach = None if problem.is_free else (asked_reach(problem), asked_reach(problem))
    most = {
        "margin": bounds.margin * MM,
        "clearance": (bounds.clearance - LEAST_CLEARANCE) * MM,
        "shoe distance": bounds.shoe_distance * MM,
        "stop bound": LONGER_MOVES,
    }
    for name, room in most.items():
        loosest = run(program.program.start, LOOSEST, reach=reach, slack={name: room})
        slack = float(loosest.values[SLACKS.index(name)])
        if loosest.converged and slack > NOTICED:
            yield f"{_loosened(problem, name, slack)} It is tight for {_holding_back(program, loosest)}."


def _loosened(problem: PoseProblem, name: str, slack: float) -> str:
    """What would help: a limit that gives way by some millimetres."""
    bounds = problem.bounds
    given = {"margin": bounds.margin, "clearance": bounds.clearance, "shoe distance": bounds.shoe_distance}
    if name in given:
        asked = given[name] * MM
        possible = max(_floored(asked - slack), 0.0)
        words = _OPTIONS[name]
        return (
            f"{words[0].upper()}{words[1:]} is {asked:.4g} mm, {slack:.1f} mm too much; with "
            f"{possible:.1f} mm a gait was found."
        )
    longest = (problem.largest_move * MM + slack) / MM
    seconds = np.ceil(deaf_seconds(longest) * 100 - ROUNDING) / 100
    return (
        f"The stop bound is {bounds.stop_bound:g} s (--stop-bound), which allows moves of "
        f"{problem.largest_move * MM:.1f} mm; with {seconds:.2f} s, which allows {longest * MM:.1f} mm, a "
        "gait was found."
    )


def _holding_back(program: PoseProgram, attempt: Attempt) -> str:
    """The limits with the largest multipliers, each with the foot and the move where it presses most."""
    strongest: dict[str, tuple[float, Row]] = {}
    for row, pressure in zip(program.program.rows, np.abs(attempt.pressures), strict=True):
        # Of feet and moves that press alike the first is named.
        least = (1.0 + ALIKE) * strongest.get(row.limit, (0.0, row))[0]
        if row.limit and pressure > max(PRESSURE, least):
            strongest[row.limit] = (float(pressure), row)
    ordered = sorted(strongest.items(), key=lambda item: -float(f"{item[1][0]:.2g}"))[:3]
    return ", ".join(_place(limit, row) for limit, (_, row) in ordered) or "no single limit"


def _place(limit: str, row: Row) -> str:
    where = [] if row.foot is None else [f"foot {row.foot + 1}"]
    where += [] if row.move is None else [f"move {row.move + 1}"]
    return _OPTIONS.get(limit, limit) + (f" ({', '.join(where)})" if where else "")
