"""What JSON can say: its objects, and null for numbers that are not finite."""

import math
from typing import Any

Json = dict[str, Any]
"""A JSON object; its values are what `json.loads` gives."""


def finite(content: Any) -> Any:
    """The same content with null for every number that is not finite."""
    if isinstance(content, float):
        return content if math.isfinite(content) else None
    if isinstance(content, dict):
        return {key: finite(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [finite(value) for value in content]
    return content
