"""From older versions of the gait document to the present one, a step a version."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from app.common.json import Json
from core.errors import InputError

VERSION = 1
"""The version that this program writes."""

Step = Callable[[Json], Json]
"""Takes a document of one version and gives it back as the next one; `version` is set for it."""

STEPS: Mapping[int, Step] = MappingProxyType({})
"""Step by the version that it takes. There is no version before 1, so that there is none yet."""


def migrated(content: Json, where: str, steps: Mapping[int, Step] = STEPS, version: int = VERSION) -> Json:
    """A document in the present version; what was handed in stays as it is.

    Args:
        content: the parsed document of any version.
        where: file name or field, for messages.
        steps: by the version that each takes.
        version: the present one.

    Raises:
        InputError: no chain of steps leads from the document's version to the present one.
    """
    found = content.get("version")
    known = range(_first(steps, version), version + 1)
    if not isinstance(found, int) or isinstance(found, bool) or found not in known:
        raise InputError(
            f"{where} has version {found!r}; this program reads {_readable(steps, version)}. "
            "Open it with the program that wrote it.",
            f"{where}.version",
        )
    for number in range(found, version):
        content = {**steps[number](dict(content)), "version": number + 1}
    return filled(content)


def filled(content: Json) -> Json:
    """What version 1 gained with time, where it is not as the schema's defaults say.

    A recorded motion of before merging is sent as it stands, one waypoint a sample.
    """
    if content.get("recorded") is None or not isinstance(content.get("options", {}), dict):
        return content
    return {**content, "options": {"merge": 0.0, "stop_bound": None, **content.get("options", {})}}


def _first(steps: Mapping[int, Step], version: int) -> int:
    """The oldest version with an unbroken chain to the present one."""
    while version - 1 in steps:
        version -= 1
    return version


def _readable(steps: Mapping[int, Step], version: int) -> str:
    """`version 1`, or `versions 2 to 3`."""
    first = _first(steps, version)
    return f"version {version}" if first == version else f"versions {first} to {version}"
