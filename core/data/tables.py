"""The files that come with the program, and its parameters read as tables."""

import tomllib
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any

_ROOT = __name__.removesuffix("core.data.tables")
"""What stands before the names of the program's packages where they are parts of another one."""


def package_files(package: str) -> Traversable:
    """The files of one of the program's packages, such as `robot_description`."""
    return resources.files(f"{_ROOT}{package}")


def data_table(name: str) -> dict[str, Any]:
    """Content of a parameters file of this program, by the file's name."""
    return tomllib.loads(package_files("core.data").joinpath(name).read_text("utf-8"))
