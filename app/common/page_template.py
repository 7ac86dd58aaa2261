"""Pages in one file: templates with places to fill, and JSON that cannot end the script that holds it."""

import json
from collections.abc import Mapping
from typing import Any

from app.common.json import finite

_UNSAFE = {ord("<"): "\\u003c", ord(">"): "\\u003e", ord("&"): "\\u0026"}
"""Characters that could end a script within a page, as JSON writes them within texts."""


def filled(template: str, parts: Mapping[str, str]) -> str:
    """A template with its places filled; what a part holds is not looked at again.

    Args:
        template: with places such as `{{NAME}}`.
        parts: the text of each place.
    """
    pieces = template.split("{{")
    texts = [pieces[0]]
    for piece in pieces[1:]:
        key, rest = piece.split("}}", 1)
        texts += [parts[key], rest]
    return "".join(texts)


def script_json(content: Any) -> str:
    """Content as JSON for a script element of a page; null stands for numbers that are not finite."""
    text = json.dumps(finite(content), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return text.translate(_UNSAFE)
