"""JSON knows no infinities: numbers that are none become null."""

import math
from typing import Any


def finite(content: Any) -> Any:
    """The same content with null for every number that is not finite."""
    if isinstance(content, float):
        return content if math.isfinite(content) else None
    if isinstance(content, dict):
        return {key: finite(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [finite(value) for value in content]
    return content
