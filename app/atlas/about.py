"""The table of an atlas file with its space, its robot and the program that made it."""

import json
import re
import sqlite3
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from app.atlas.guarded_connection import MOST_SPACE
from app.atlas.stored_values import StoredValues
from app.common.version import VERSION
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import FootfallError, InputError
from core.text.documents import json_content

FORMAT, FORMAT_VERSION = "footfall-atlas", 1
_HASH = "[0-9a-f]{64}"
_FORMS: Mapping[str, str] = MappingProxyType(
    {
        "format": FORMAT,
        "version": "[0-9]{1,9}",
        "program": "[0-9A-Za-z.+-]{1,40}",
        "space": "(?s:.*)",
        "space_hash": _HASH,
        "robot_hash": _HASH,
    }
)
"""Every key, and the form of its value."""


def about_content(space: AtlasSpace) -> Mapping[str, str]:
    """The table of a new atlas, whose gaits are drawn from a space.

    Raises:
        InputError: the space is too long.
    """
    text = json.dumps(space.content(), sort_keys=True)
    if len(text) > MOST_SPACE:
        raise InputError(
            f"The space has {len(text):,} characters; an atlas keeps {MOST_SPACE:,}. Write fewer choices, or "
            "ranges.",
            "vary",
        )
    return {
        "format": FORMAT,
        "version": str(FORMAT_VERSION),
        "program": VERSION,
        "space": text,
        "space_hash": space.hash,
        "robot_hash": space.robot_hash,
    }


def read_about(connection: sqlite3.Connection, path: Path) -> Mapping[str, str]:
    """The table of a file.

    Raises:
        InputError: it lacks a key, or a value cannot be one of an atlas.
    """
    query = f"SELECT key, value FROM about LIMIT {len(_FORMS) + 1}"
    about = dict(connection.execute(query).fetchall())
    if about.get("format") != FORMAT or about.keys() != _FORMS.keys():
        raise InputError(f"{path} is no atlas. Choose another file.", str(path))
    for name, form in _FORMS.items():
        value = about[name]
        if not isinstance(value, str) or re.fullmatch(form, value, re.ASCII) is None:
            raise StoredValues(path).fault(f"its {name} cannot be one of an atlas", value)
    return about


def fitting_space(about: Mapping[str, str], space: AtlasSpace | None, path: Path) -> AtlasSpace:
    """The space of a file that this program can go on with.

    Args:
        about: the table.
        space: that the file has to hold; None for any.
        path: the file.

    Raises:
        InputError: it cannot.
    """
    if about["version"] != str(FORMAT_VERSION):
        raise InputError(
            f"{path} is an atlas of format {about['version']}, and this program reads {FORMAT_VERSION}. "
            "Update the program, or choose another file.",
            str(path),
        )
    try:
        own = space_from_table(json_content(about["space"], "its space"), "its space")
    except FootfallError as error:
        words = error.sentence.rstrip(".")
        raise StoredValues(path).fault(f"its space does not fit ({words})") from error
    if space is None:
        return own
    if space.hash != about["space_hash"]:
        raise InputError(
            f"{path} is an atlas of another space. Choose another file, or give the space that it was made "
            "of.",
            str(path),
        )
    if space.robot_hash != about["robot_hash"]:
        raise InputError(
            f"{path} was made with other parameters of {space.robot}. Choose another file.", str(path)
        )
    if about["program"] != VERSION:
        raise InputError(
            f"{path} was made by version {about['program']} of this program, which may solve gaits otherwise "
            f"than {VERSION}. Choose another file.",
            str(path),
        )
    return own
