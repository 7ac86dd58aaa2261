"""The table of benchmarks: each name leads to a function that can be called without arguments."""

from __future__ import annotations

import inspect

import pytest

import app.bench
from app.bench import BENCHMARKS, BY_NAME_ONLY
from app.common.named import named


@pytest.mark.parametrize("name", BENCHMARKS)
def test_a_benchmark_is_a_function_without_needed_arguments(name: str) -> None:
    function = named(BENCHMARKS[name], app.bench.__name__)
    assert inspect.isfunction(function)
    inspect.signature(function).bind()


def test_a_benchmark_that_is_run_only_by_name_is_in_the_table() -> None:
    assert set(BENCHMARKS) > BY_NAME_ONLY
