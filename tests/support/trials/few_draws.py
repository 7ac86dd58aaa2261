"""Fewer draws for tests, whose robots need none so fine."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from core.identification import bayes_fit as fit

FEW = 4000


@pytest.fixture(scope="module", autouse=True)
def few_draws() -> Iterator[None]:
    """Every fit of a file takes a quarter of the time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fit, "DRAWS", FEW)
        fit.prior_draws.cache_clear()
        yield
    fit.prior_draws.cache_clear()
