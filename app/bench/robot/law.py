"""The law of the robot's time: fitted to the emulated board anew, and how well the program's law agrees."""

from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, fields, replace
from functools import partial

import numpy as np

from app.bench.common.measure import Row
from app.bench.robot.random_moves import KINDS, is_length, random_waypoints
from app.bench.robot.timed_board import TimedMoves, timed_moves
from app.bench.robot.walk import live_motion
from app.emulator.profiles import ProfileName
from core.arrays import Floats
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.robot.model import load_robot
from core.wire.robot_time import ARRIVAL_THRESHOLD, LAWS, TimeLaw, far_motors, move_estimates, ramp_time
from core.wire.waypoint_merging import plan_waypoints
from core.wire.waypoints import Waypoints

SHORT_MM = (0.5, 1.2, *np.arange(1.5, 8.1, 0.5).tolist(), 10.0, 12.0)
LONG_MM = (15.0, 19.0)
"""Move lengths; the body over standing feet has room for the short ones."""
MOVES = 100
"""Random moves of each kind and length."""

GAITS = ("walk", "amble", "s-gait", "c-gait", "rotate", "walk-order-3", "amble-order-3", "quadruped-wave-1")
MANUAL_GAITS = ("walk-manual-0", "amble-manual-0", "s-gait-manual-0", "s-gait-manual-2")
"""Gaits of the library, with their own merging and stop bound."""

STEPS = (0.05, 0.3e-3, 0.3e-3, 0.3e-3)
"""First steps of the search: of the share `often`, and of the lengths between which it changes, m."""
LAST_STEP = 1 / 64
"""The search ends at this share of its first steps."""


@dataclass(frozen=True, eq=False)
class Sample:
    """Moves that the board made, and how their time is computed from a law.

    Args:
        kind: of the moves; `gait` for a gait.
        name: a length or the gait's name.
        seconds: that the board took for all of them.
        estimate: seconds by a law.
    """

    kind: str
    name: str
    seconds: float
    estimate: Callable[[TimeLaw], float]

    def error(self, law: TimeLaw) -> float:
        """Relative error of a law's time."""
        return self.estimate(law) / self.seconds - 1.0


def bench_law(moves: int = MOVES) -> list[Row]:
    """Fits the law of each timing to random moves and library gaits on the emulated board.

    Args:
        moves: how many random moves of each kind and length.
    """
    gaits = {name: gait_waypoints(name) for name in (*GAITS, *MANUAL_GAITS)}
    rows: list[Row] = []
    for profile in ProfileName:
        timed = random_samples(profile, moves)
        # Whether a move within the threshold is made depends on the moves before it.
        samples = [sample for sample, made in timed if made.moves.max() > ARRIVAL_THRESHOLD]
        samples += [gait_sample(profile, *gait) for gait in gaits.items()]
        law = LAWS[profile.value]
        refitted = fitted(law, [made for _, made in timed], samples)
        rows += [_law_row("in use", law), _law_row("fitted now", refitted)]
        rows += [_error_row(law, kind, samples) for kind in (*KINDS, "gait")]
    return rows


def random_samples(profile: ProfileName, count: int) -> list[tuple[Sample, TimedMoves]]:
    """Random moves of every kind and length.

    Args:
        profile: timing of the board.
        count: moves of each kind and length.
    """
    samples = []
    for kind in KINDS:
        for length_mm in SHORT_MM if kind == "body" else SHORT_MM + LONG_MM:
            timed = random_moves(profile, kind, length_mm / 1000.0, count)
            estimate = partial(_random_seconds, moves=timed.moves)
            sample = Sample(kind, f"{length_mm:g} mm", float(timed.seconds.sum()), estimate)
            samples.append((sample, timed))
    return samples


def random_moves(profile: ProfileName, kind: str, length: float, count: int) -> TimedMoves:
    """Random moves of one kind and length, one after the other.

    Args:
        profile: timing of the board.
        kind: of the moves, one of `KINDS`.
        length: largest distance of any motor, m.
        count: how many moves.
    """
    timed = timed_moves(profile, random_waypoints(kind, length, count))
    kept = is_length(timed.moves, length)
    return TimedMoves(timed.moves[kept], timed.seconds[kept], timed.ramps[kept])


def _random_seconds(law: TimeLaw, moves: Floats) -> float:
    return float(law.move_seconds(moves.max(axis=1), far_motors(moves)).sum())


def gait_sample(profile: ProfileName, name: str, waypoints: Waypoints) -> Sample:
    """A gait on the board, from where it stands at the first waypoint.

    Args:
        profile: timing of the board.
        name: of the gait.
        waypoints: exactly what is sent.
    """
    seconds = float(timed_moves(profile, waypoints.strokes).seconds.sum())
    return Sample("gait", name, seconds, lambda law: float(move_estimates(waypoints, law)[1:].sum()))


def gait_waypoints(name: str) -> Waypoints:
    """What is sent of a gait of the library, with its own merging and stop bound."""
    model, gait = load_robot("deltawalker"), library()[name].gait
    motion = manual_motion(gait, model).trajectory if name in MANUAL_GAITS else live_motion(model, gait)
    return plan_waypoints(model, motion, gait.options.merge, gait.options.stop_bound).waypoints


def fitted(law: TimeLaw, timed: Sequence[TimedMoves], samples: Sequence[Sample]) -> TimeLaw:
    """A law with constants of its own.

    Messages and second ramps cost the means of moves with no, one and two ramps. The share of second ramps
    has the least sum of squares of the samples' relative errors (compass search from a law).

    Args:
        law: where the search begins.
        timed: moves that tell one ramp from two.
        samples: moves and gaits whose time shall be met.
    """
    seconds = np.concatenate([moves.seconds for moves in timed])
    ramps = np.concatenate([moves.ramps for moves in timed])
    distances = np.concatenate([moves.moves.max(axis=1) for moves in timed])
    beyond = seconds - np.where(ramps > 0, [ramp_time(d) for d in distances], 0.0)
    is_real = distances > ARRIVAL_THRESHOLD
    none = float(beyond[ramps == 0].mean())
    one, two = (float(beyond[is_real & (ramps == count)].mean()) for count in (1, 2))
    return _searched(replace(law, arrived=none, message=one, second_ramp=two - one), samples)


def _searched(law: TimeLaw, samples: Sequence[Sample]) -> TimeLaw:
    scale, cost = 1.0, _cost(law, samples)
    while scale > LAST_STEP:
        tried = [_shifted(law, index, way * scale) for index in range(len(STEPS)) for way in (-1.0, 1.0)]
        costs = [_cost(one, samples) for one in tried]
        best = int(np.argmin(costs))
        if costs[best] < cost:
            law, cost = tried[best], costs[best]
        else:
            scale /= 2.0
    return law


def _shifted(law: TimeLaw, index: int, steps: float) -> TimeLaw:
    name = ("often", "often_from", "often_until", "never_from")[index]
    return replace(law, **{name: getattr(law, name) + steps * STEPS[index]})


def _cost(law: TimeLaw, samples: Sequence[Sample]) -> float:
    is_law = 0.0 < law.often < 1.0 and ARRIVAL_THRESHOLD < law.often_from < law.often_until < law.never_from
    return sum(sample.error(law) ** 2 for sample in samples) if is_law else float("inf")


def _law_row(which: str, law: TimeLaw) -> Row:
    constants = dict(zip((field.name for field in fields(law)), astuple(law), strict=True))
    numbers = {key: round(value, 5) for key, value in constants.items() if key != "name"}
    return {"law": law.name, "constants": which, **numbers}


def _error_row(law: TimeLaw, kind: str, samples: Sequence[Sample]) -> Row:
    errors = {sample.name: sample.error(law) for sample in samples if sample.kind == kind}
    worst = max(errors, key=lambda name: abs(errors[name]))
    values = np.array(list(errors.values()))
    return {
        "law": law.name,
        "moves": kind,
        "samples": len(errors),
        "mean_error_percent": round(100 * float(values.mean()), 1),
        "rms_error_percent": round(100 * float(np.sqrt((values**2).mean())), 1),
        "worst_error_percent": round(100 * errors[worst], 1),
        "worst": worst,
    }
