"""Finds the prices that come with the program: `python -m app.fastest.price_table`.

It writes core/data/prices.toml anew, in a quarter of an hour on two cores; a test solves some of them again.
"""

import sys
from collections.abc import Iterable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from app.fastest.prices import Price, price_key, price_of
from app.fastest.request import FastestRequest, options
from core.pose_gaits.front import MARGINS, STOP_BOUNDS
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import FastestSearch, SearchStep, TriedGait

FILE = Path(__file__).resolve().parents[2] / "core" / "data" / "prices.toml"
HEAD = "# Written by app/fastest/price_table.py; SI. By the hash of what is asked.\n"


def priced_requests() -> list[FastestRequest]:
    """The requests with a price: every foot order with each value of its options; ways of the first one.

    Margin and stop bound change together, since a person weighs one against the other.
    """
    base = FastestRequest()
    first = options(base)
    orders = [option.request for option in first if option.group == "order"]
    bounds = [
        replace(asked, margin=margin, stop_bound=bound)
        for asked in orders
        for margin in MARGINS
        for bound in STOP_BOUNDS
    ]
    others = [
        option.request
        for asked in orders
        for option in options(asked)
        if option.group in ("step", "clearance", "sway")
    ]
    chosen = [*bounds, *others, *(option.request for option in first if option.group == "course")]
    by_key = {price_key(request.problem()): request for request in [*orders, *chosen]}
    return list(by_key.values())


def solved(search: FastestSearch, requests: Iterable[FastestRequest]) -> dict[str, Price]:
    """Prices by their keys; each gait is looked for beside the first one of its foot order."""
    found: dict[str, Price] = {}
    firsts: dict[tuple[object, ...], FastestRequest] = {}
    for request in requests:
        firsts.setdefault(_kind(request), request)
    first = search.solve([request.problem() for request in firsts.values()], _say)
    near: dict[tuple[object, ...], PoseGait | None] = {
        kind: tried.result.gait for kind, tried in zip(firsts, first, strict=True)
    }
    others = [request for request in requests if request not in firsts.values()]
    problems: list[PoseProblem] = [request.problem() for request in others]
    beside = [near[_kind(request)] for request in others]
    for tried in (*first, *search.solve(problems, _say, beside)):
        found |= _entry(tried)
    return found


def _kind(request: FastestRequest) -> tuple[object, ...]:
    """Questions of one kind have the same moves in the same direction."""
    return (request.choice, request.course, request.turn, request.sway)


def _entry(tried: TriedGait) -> dict[str, Price]:
    price = price_of(tried)
    return {} if price is None else {price_key(tried.problem): price}


def _say(step: SearchStep) -> None:
    sys.stdout.write(f"{step.done} of {step.count}: {step.newest.pace:.6f}\n")
    sys.stdout.flush()


def main() -> int:
    """Solves every problem and writes the file."""
    with closing(FastestSearch()) as search:
        found = solved(search, priced_requests())
    FILE.write_text(HEAD + "".join(_table(key, price) for key, price in sorted(found.items())))
    return 0


def _table(key: str, price: Price) -> str:
    values = "".join(f"{name} = {value!r}\n" for name, value in vars(price).items() if value is not None)
    return f"\n[{key}]\n{values}"


if __name__ == "__main__":
    sys.exit(main())
