"""The price of an option: how fast the fastest gait with it is."""

import threading
from dataclasses import dataclass
from functools import cache

from app.common.json import Json
from core.data.tables import data_table
from core.pose_gaits.gait_poses import asked_of
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import SolveStatus, TriedGait

MOST_KEPT = 5000
"""Prices in memory beside those that come with the program."""
KEY_LENGTH = 16
"""Digits of a hash by which a price is kept."""


@dataclass(frozen=True)
class Price:
    """How fast the fastest gait of a problem is in mid-walk; all None where there is no gait.

    Args:
        pace: speed, m/s; on the spot the turn rate, rad/s.
        step: travel a cycle, m.
        turn: turn a cycle, rad.
        moves: of a cycle.
        seconds: robot seconds of a cycle.
    """

    pace: float | None = None
    step: float | None = None
    turn: float | None = None
    moves: int | None = None
    seconds: float | None = None


def price_key(problem: PoseProblem) -> str:
    """The key under which a problem's price is kept."""
    return asked_of(problem)[:KEY_LENGTH]


def price_of(tried: TriedGait) -> Price | None:
    """The price that a search has found; None where it was cancelled or broke off."""
    gait = tried.result.gait
    if gait is None:
        return Price() if tried.result.status is SolveStatus.INFEASIBLE else None
    return Price(gait.pace, gait.step, gait.turn, gait.problem.move_count, gait.seconds)


def price_content(price: Price, problem: PoseProblem) -> Json:
    """A price as JSON content, SI."""
    return {**vars(price), "on_the_spot": problem.on_the_spot}


@cache
def stored_prices() -> dict[str, Price]:
    """Prices that come with the program, as `python -m app.fastest.price_table` found them."""
    return {key: Price(**values) for key, values in data_table("prices.toml").items()}


class Prices:
    """Prices that are known. Thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._found: dict[str, Price] = {}

    def known(self, problem: PoseProblem) -> Price | None:
        """A problem's price, if it is known."""
        key = price_key(problem)
        with self._lock:
            return self._found.get(key) or stored_prices().get(key)

    def keep(self, tried: TriedGait) -> Price | None:
        """Takes over what a search has found, and gives its price."""
        price = price_of(tried)
        if price is not None:
            with self._lock:
                if len(self._found) >= MOST_KEPT:
                    self._found.clear()
                self._found[price_key(tried.problem)] = price
        return price
