"""Coroutines in tests, also where a browser's loop already runs in the test's thread."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

Result = TypeVar("Result")


def run_apart(coroutine: Coroutine[Any, Any, Result], name: str = "apart") -> Result:
    """Runs a coroutine in a thread of a name, with a loop of its own."""
    with ThreadPoolExecutor(1, name) as thread:
        return thread.submit(asyncio.run, coroutine).result()  # noqa: TID251 - the place for it
