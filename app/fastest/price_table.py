"""Finds the prices that come with the program: `python -m app.fastest.price_table`.

It writes core/data/prices.toml anew, in a quarter of an hour on two cores; a test solves some of them again.
"""

import sys
from collections.abc import Iterable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from app.fastest.prices import Price, price_key, price_of
from app.fastest.question import FastestQuestion, options
from core.pose_gaits.front import MARGINS, STOP_BOUNDS
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import FastestSearch, SearchStep, TriedGait

FILE = Path(__file__).resolve().parents[2] / "core" / "data" / "prices.toml"
HEAD = "# Written by app/fastest/price_table.py; SI. By the hash of what is asked.\n"


def priced_questions() -> list[FastestQuestion]:
    """The questions with a price: every foot order with each value of its options; ways of the first one.

    Margin and stop bound change together, since a person weighs one against the other.
    """
    base = FastestQuestion()
    first = options(base)
    orders = [option.question for option in first if option.group == "order"]
    bounds = [
        replace(asked, margin=margin, stop_bound=bound)
        for asked in orders
        for margin in MARGINS
        for bound in STOP_BOUNDS
    ]
    others = [
        option.question
        for asked in orders
        for option in options(asked)
        if option.group in ("step", "clearance", "sway")
    ]
    chosen = [*bounds, *others, *(option.question for option in first if option.group == "way")]
    by_key = {price_key(question.problem()): question for question in [*orders, *chosen]}
    return list(by_key.values())


def solved(search: FastestSearch, questions: Iterable[FastestQuestion]) -> dict[str, Price]:
    """Prices by their keys; each gait is looked for beside the first one of its foot order."""
    found: dict[str, Price] = {}
    firsts: dict[tuple[object, ...], FastestQuestion] = {}
    for question in questions:
        firsts.setdefault(_kind(question), question)
    first = search.solve([question.problem() for question in firsts.values()], _say)
    near: dict[tuple[object, ...], PoseGait | None] = {
        kind: tried.result.gait for kind, tried in zip(firsts, first, strict=True)
    }
    others = [question for question in questions if question not in firsts.values()]
    problems: list[PoseProblem] = [question.problem() for question in others]
    beside = [near[_kind(question)] for question in others]
    for tried in (*first, *search.solve(problems, _say, beside)):
        found |= _entry(tried)
    return found


def _kind(question: FastestQuestion) -> tuple[object, ...]:
    """Questions of one kind have the same moves in the same direction."""
    return (question.choice, question.way, question.turn, question.sway)


def _entry(tried: TriedGait) -> dict[str, Price]:
    price = price_of(tried)
    return {} if price is None else {price_key(tried.problem): price}


def _say(step: SearchStep) -> None:
    sys.stdout.write(f"{step.done} of {step.count}: {step.newest.pace:.6f}\n")
    sys.stdout.flush()


def main() -> int:
    """Solves every problem and writes the file."""
    with closing(FastestSearch()) as search:
        found = solved(search, priced_questions())
    FILE.write_text(HEAD + "".join(_table(key, price) for key, price in sorted(found.items())))
    return 0


def _table(key: str, price: Price) -> str:
    values = "".join(f"{name} = {value!r}\n" for name, value in vars(price).items() if value is not None)
    return f"\n[{key}]\n{values}"


if __name__ == "__main__":
    sys.exit(main())
