"""Names that no other gait has."""

from collections.abc import Set
from itertools import count

from core.gait.gait import MOST_NAME


def free_name(name: str, taken: Set[str]) -> str:
    """The name, with the first number from 2 on that makes it one of its own.

    Args:
        name: what a gait is to be called.
        taken: the names of the others.
    """
    if name not in taken:
        return name
    numbered = (f"{name[: MOST_NAME - len(f' {number}')]} {number}" for number in count(2))
    return next(candidate for candidate in numbered if candidate not in taken)
