"""How long a soak is: its full length under `python -m tests --soak`, a short one elsewhere."""

from __future__ import annotations

import os
import secrets

VARIABLE = "FOOTFALL_SOAK"
"""Set in the environment of a full soak."""


def is_soak() -> bool:
    """Whether this run soaks at full length."""
    return VARIABLE in os.environ


def soaked(full: int, short: int, variable: str | None = None) -> int:
    """How many rounds, requests or the like a soak has in this run.

    Args:
        full: at full length.
        short: in every other run.
        variable: of the environment, which gives another number where it is set.
    """
    given = None if variable is None else os.environ.get(variable)
    if given:
        return int(given)
    return full if is_soak() else short


def seed_of(variable: str) -> int:
    """The seed of what is drawn: that of the environment's variable, or another one for each soak."""
    given = os.environ.get(variable)
    if given:
        return int(given)
    return secrets.randbelow(10**6) if is_soak() else 1
