"""How long the search for the fastest walk takes over random problems, and whether answers are confirmed."""

from collections.abc import Iterable, Sequence

import numpy as np

from app.bench.common.measure import Row
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import load_robot
from solver_jobs import PoseResult, SolveStatus, solve_poses

MID_WALK, FROM_REST = 200, 20
"""Problems that are tried: in mid-walk, and from the standard stance to rest."""
SEED = 20261123
SAMPLES = 81
"""Places along each move at which an answer is looked at once more; the search itself looks at 41."""


def random_problems(count: int, seed: int, cycles: Sequence[int | None]) -> Iterable[PoseProblem]:
    """Walks of the four-legged robot in any foot order and direction, with random steps and limits.

    Args:
        count: how many.
        seed: of the random numbers.
        cycles: from which each one's number of cycles is drawn; None in mid-walk.
    """
    dice = np.random.default_rng(seed)
    model = load_robot("deltawalker")
    for _ in range(count):
        order = tuple(int(foot) for foot in dice.permutation(4) + 1)
        bounds = PoseBounds(
            margin=float(dice.uniform(0.0, 0.012)),
            clearance=float(dice.uniform(0.001, 0.006)),
            stop_bound=float(dice.choice([1.1, 1.3, 1.5, 2.0, 2.5])),
        )
        step = None if dice.random() < 0.4 else float(dice.uniform(0.005, 0.07))
        heading = float(dice.choice(4)) * np.pi / 4
        chosen = cycles[int(dice.integers(len(cycles)))]
        yield PoseProblem(model, order, heading, step, cycles=chosen, bounds=bounds)


def solve_times(mid_walk: int = MID_WALK, from_rest: int = FROM_REST, seed: int = SEED) -> list[Row]:
    """Searches for the fastest walks of random problems.

    Args:
        mid_walk: problems in mid-walk.
        from_rest: problems of one to three cycles from the standard stance to rest.
        seed: of the random numbers.
    """
    asked = {
        "random, mid-walk": random_problems(mid_walk, seed, (None,)),
        "random, stance to rest, 1 to 3 cycles": random_problems(from_rest, seed + 1, (1, 2, 3)),
    }
    return [
        row for name, problems in asked.items() for row in _rows(name, [solve_poses(one) for one in problems])
    ]


def _rows(name: str, results: list[PoseResult]) -> list[Row]:
    yes = [result for result in results if result.status is SolveStatus.SOLVED]
    no = [result for result in results if result.status is not SolveStatus.SOLVED]
    refused = sum(
        result.gait is None or not check_poses(result.gait, samples=SAMPLES).confirmed for result in yes
    )
    return [
        {
            "asked": name,
            "answer": answer,
            "problems": len(group),
            "refused_by_check": refused if group is yes else None,
            **_seconds("", [result.seconds for result in group]),
            **_seconds("ipopt_", [result.solve_seconds for result in group]),
        }
        for answer, group in (("solved", yes), ("no", no))
    ]


def _seconds(name: str, seconds: list[float]) -> Row:
    if not seconds:
        return {f"{name}{figure}_s": None for figure in ("median", "p95", "most")}
    figures = np.percentile(seconds, [50, 95, 100])
    keys = (f"{name}median_s", f"{name}p95_s", f"{name}most_s")
    return {key: round(float(value), 2) for key, value in zip(keys, figures, strict=True)}
