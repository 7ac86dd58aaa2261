"""The parameters files that come with the program, read as tables."""

import tomllib
from importlib import resources
from typing import Any


def data_table(name: str) -> dict[str, Any]:
    """Content of a parameters file of this program, by the file's name."""
    return tomllib.loads(resources.files("core.data").joinpath(name).read_text("utf-8"))
