"""Prices of options: those that come with the program, and what a search adds to them."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace
from itertools import pairwise

import pytest

from app.fastest.price_table import priced_requests, solved
from app.fastest.prices import Price, Prices, price_key, stored_prices
from app.fastest.request import FastestRequest
from solver_jobs import FastestSearch, PoseResult, SolveStatus, TriedGait

ASKED = FastestRequest()


def outcome(status: SolveStatus) -> TriedGait:
    result = PoseResult(status, None, None, False, ("There is none.",), 0.0, 0.0)
    return TriedGait(replace(ASKED, step=0.0111).problem(), result)


def test_every_usual_question_has_its_price() -> None:
    keys = {price_key(request.problem()) for request in priced_requests()}
    assert keys == set(stored_prices())


def test_more_margin_and_an_earlier_stop_never_make_the_fastest_gait_faster() -> None:
    """Of a search that finds local optima: within a few percent."""
    prices = Prices()

    def pace(request: FastestRequest) -> float:
        price = prices.known(request.problem())
        assert price is not None
        return price.pace or 0.0

    for order, heading in (((1, 2, 3, 4), 0.0), ((1, 3, 2, 4), 0.0)):
        asked = replace(ASKED, order=order, heading=heading)
        for bound in (1.0, 1.2, 1.5, 2.0):
            by_margin = [
                pace(replace(asked, margin=m, stop_bound=bound)) for m in (0.003, 0.006, 0.008, 0.010)
            ]
            assert all(more <= 1.05 * less for less, more in pairwise(by_margin))


def test_what_a_search_finds_is_a_price_and_a_cancelled_one_is_none() -> None:
    prices = Prices()
    assert prices.keep(outcome(SolveStatus.CANCELLED)) is None
    assert prices.known(outcome(SolveStatus.CANCELLED).problem) is None
    assert prices.keep(outcome(SolveStatus.INFEASIBLE)) == Price()
    assert prices.known(outcome(SolveStatus.INFEASIBLE).problem) == Price()


@pytest.mark.soak
def test_stored_prices_are_found_again() -> None:
    requests = [
        ASKED,
        replace(ASKED, stop_bound=1.0),
        replace(ASKED, margin=0.008),
        replace(ASKED, step=0.03),
    ]
    with closing(FastestSearch()) as search:
        found = solved(search, requests)
    for request in requests:
        key = price_key(request.problem())
        stored, again = stored_prices()[key].pace, found[key].pace
        assert stored is not None
        assert again == pytest.approx(stored, rel=0.02)
