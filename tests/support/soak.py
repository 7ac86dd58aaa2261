"""How long a soak is: its full length under `python -m tests --soak`, a tenth of it elsewhere."""

from __future__ import annotations

import os

VARIABLE = "FOOTFALL_SOAK"
"""Set in the environment of a full soak."""

SHARE = 10
"""A short soak is the full one divided by this."""


def is_soak() -> bool:
    """Whether this run soaks at full length."""
    return VARIABLE in os.environ


def soaked(full: int, variable: str | None = None) -> int:
    """How many rounds, requests or the like a soak has in this run.

    Args:
        full: at full length.
        variable: of the environment, which gives another number where it is set.
    """
    given = None if variable is None else os.environ.get(variable)
    if given:
        return int(given)
    return full if is_soak() else max(1, full // SHARE)
