"""Looks for the prices of a request's options that are not known yet."""

import threading
from collections.abc import Callable
from dataclasses import dataclass, field

from app.common.json import Json
from app.fastest.prices import Prices, price_content, price_key
from app.fastest.request import FastestRequest, Option, options
from core.errors import InputError
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import FastestSearch, SearchStep, SolveStatus

NEAR = frozenset({"stop_bound", "margin", "step", "clearance"})
"""Options whose gaits are looked for beside the requested one."""


@dataclass(eq=False)
class PricedOption:
    """A value of an option, and its price once it is known.

    Args:
        option: which value.
        problem: the gait with it; None where there can be none.
        sentence: why there is no price.
    """

    option: Option
    problem: PoseProblem | None
    sentence: str = ""
    key: str = field(init=False)

    def __post_init__(self) -> None:
        self.key = "" if self.problem is None else price_key(self.problem)


class PriceSearch:
    """The options of a request, and the search for their prices.

    Args:
        request: the gait that is requested.
        prices: those that are known.
        ending: set by another thread to cancel the search.

    Raises:
        InputError: the request asks for what such a gait cannot have.
    """

    def __init__(self, request: FastestRequest, prices: Prices, ending: threading.Event) -> None:
        self._requested = request.problem()
        self._listed = [_priced(option) for option in options(request)]
        self._prices = prices
        self._ending = ending

    @property
    def is_complete(self) -> bool:
        """Whether no price is left to be looked for."""
        return not self._open()

    def content(self) -> list[Json]:
        """Every option with its price as far as it is known, as JSON content."""
        return [self._content(one) for one in self._listed]

    def run(self, search: FastestSearch, show: Callable[[Json], object]) -> None:
        """Solves what has no price yet: the requested gait first, then what may begin beside it.

        Args:
            search: the processes.
            show: called with the options of each new price, from this thread.

        Raises:
            StateError: a process ended twice.
        """

        def report(step: SearchStep) -> None:
            self._prices.keep(step.newest)
            key, result = price_key(step.newest.problem), step.newest.result
            answered = [number for number, one in enumerate(self._listed) if one.key == key]
            if result.gait is None and result.status is not SolveStatus.CANCELLED:
                for number in answered:
                    self._listed[number].sentence = " ".join(result.explanation) or "No gait was found."
            show({"prices": [{"number": n, **self._content(self._listed[n])} for n in answered]})

        near: PoseGait | None = None
        if any(one.option.group in NEAR or one.key == price_key(self._requested) for one in self._open()):
            [tried] = search.solve([self._requested], report, ending=self._ending)
            near = tried.result.gait
        rest = self._open()
        problems = [one.problem for one in rest if one.problem is not None]
        beside = [near if one.option.group in NEAR else None for one in rest]
        search.solve(problems, report, beside, self._ending)

    def _open(self) -> list[PricedOption]:
        """One option of each price that is neither known nor was looked for in vain."""
        by_key: dict[str, PricedOption] = {}
        for one in self._listed:
            if one.problem is not None and not one.sentence and self._prices.known(one.problem) is None:
                by_key.setdefault(one.key, one)
        return list(by_key.values())

    def _content(self, one: PricedOption) -> Json:
        price = None if one.problem is None else self._prices.known(one.problem)
        return {
            "group": one.option.group,
            "value": one.option.value,
            "name": one.option.name,
            "sentence": one.sentence,
            "price": None if price is None or one.problem is None else price_content(price, one.problem),
        }


def _priced(option: Option) -> PricedOption:
    try:
        return PricedOption(option, option.request.problem())
    except InputError as error:
        return PricedOption(option, None, error.sentence)
