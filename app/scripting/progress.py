"""Progress of what takes seconds: a bar in a terminal or a notebook, where tqdm is installed."""

import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


def _bar(what: str) -> Any:
    """A bar from 0 to 100 %; None where tqdm is not installed, or nobody watches."""
    try:
        with warnings.catch_warnings():
            # Without ipywidgets a notebook gets a bar of text, and nobody has to be warned of that.
            warnings.simplefilter("ignore")
            from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
    except ImportError:
        return None
    is_watched = (sys.stderr is not None and sys.stderr.isatty()) or "ipykernel" in sys.modules
    return tqdm(total=100, desc=what, unit="%", leave=False, disable=not is_watched)


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[float], bool]]:
    """Shows how far it is.

    Args:
        what: is done, such as `Physics`.

    Yields:
        A function that takes the share that is done, 0 to 1, and is always true: go on.
    """
    bars: list[Any] = []

    def tell(share: float) -> bool:
        if not bars:
            # Made when there is something to tell, so that what is said before has a line of its own.
            bars.append(_bar(what))
        if bars[0] is not None:
            bars[0].update(max(share * 100 - bars[0].n, 0.0))
        return True

    try:
        yield tell
    finally:
        for bar in bars:
            if bar is not None:
                bar.close()
