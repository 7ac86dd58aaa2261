"""Parts of the program by their names, loaded when they are first needed."""

from importlib import import_module
from typing import Any


def named(name: str, package: str | None) -> Any:
    """Loads a module and returns one of its parts.

    Args:
        name: `module:part`; the module's name is relative to the package.
        package: the caller's `__package__`, which begins with `footfall.` in scripts.
    """
    module, _, part = name.partition(":")
    return getattr(import_module(f".{module}", package), part)
