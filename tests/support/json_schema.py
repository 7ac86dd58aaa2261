"""A small judge of JSON Schema (2020-12): enough words for the published schema, and no other word passes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

TYPES: dict[str, type | tuple[type, ...]] = {
    "object": dict,
    "array": list,
    "string": str,
    "integer": int,
    "number": (int, float),
    "boolean": bool,
    "null": type(None),
}
WORDS = frozenset({"$schema", "$defs", "title", "description", "default"})
"""Words that allow everything."""


def violations(schema: dict[str, Any], value: Any, root: dict[str, Any], at: str = "") -> Iterator[str]:
    """What of a value a schema does not allow; one that it cannot judge is a KeyError.

    Args:
        schema: the schema.
        value: what is to be judged.
        root: the whole schema, for `$ref`.
        at: place of the value, for the sentences.
    """
    for word, rule in schema.items():
        if word in _JUDGES:
            yield from (f"{at}: {what}" for what in _JUDGES[word](rule, value))
        elif word not in WORDS:
            yield from _PARTS[word](rule, value, schema, root, at)


def _type(rule: str, value: Any) -> Iterator[str]:
    is_bool = isinstance(value, bool) and rule != "boolean"
    if is_bool or not isinstance(value, TYPES[rule]):
        yield f"{value!r:.40} is no {rule}"


def _one_of(rule: list[Any], value: Any) -> Iterator[str]:
    if value not in rule:
        yield f"{value!r:.40} is none of {rule}"


def _required(rule: list[str], value: Any) -> Iterator[str]:
    if isinstance(value, dict):
        yield from (f"lacks {name}" for name in rule if name not in value)


def _length(sign: int, rule: int, value: Any) -> Iterator[str]:
    if isinstance(value, list | str | dict) and sign * len(value) < sign * rule:
        yield f"has the length {len(value)}"


def _bound(sign: int, rule: float, value: Any) -> Iterator[str]:
    if isinstance(value, (int, float)) and sign * value < sign * rule:
        yield f"{value} is beyond {rule}"


_JUDGES: dict[str, Callable[[Any, Any], Iterator[str]]] = {
    "type": _type,
    "enum": _one_of,
    "const": lambda rule, value: _one_of([rule], value),
    "required": _required,
    "minItems": lambda rule, value: _length(1, rule, value),
    "maxItems": lambda rule, value: _length(-1, rule, value),
    "maxLength": lambda rule, value: _length(-1, rule, value),
    "maxProperties": lambda rule, value: _length(-1, rule, value),
    "minimum": lambda rule, value: _bound(1, rule, value),
    "maximum": lambda rule, value: _bound(-1, rule, value),
}


def _ref(rule: str, value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    yield from violations(root["$defs"][rule.removeprefix("#/$defs/")], value, root, at)


def _any_of(rule: list[Any], value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    found = [list(violations(one, value, root, at)) for one in rule]
    if all(found):
        yield from found[0]


def _properties(rule: dict[str, Any], value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    if isinstance(value, dict):
        for name in rule.keys() & value.keys():
            yield from violations(rule[name], value[name], root, f"{at}.{name}")


def _additional(rule: Any, value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    others = value.keys() - schema.get("properties", {}).keys() if isinstance(value, dict) else ()
    for name in others:
        if rule is False:
            yield f"{at}: {name} is no field"
        else:
            yield from violations(rule, value[name], root, f"{at}.{name}")


def _items(rule: Any, value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    if isinstance(value, list):
        for index, item in enumerate(value):
            yield from violations(rule, item, root, f"{at}.{index}")


def _prefix_items(rule: list[Any], value: Any, schema: Any, root: Any, at: str) -> Iterator[str]:
    if isinstance(value, list):
        for index, (one, item) in enumerate(zip(rule, value, strict=False)):
            yield from violations(one, item, root, f"{at}.{index}")


_PARTS: dict[str, Callable[[Any, Any, Any, Any, str], Iterator[str]]] = {
    "$ref": _ref,
    "anyOf": _any_of,
    "properties": _properties,
    "additionalProperties": _additional,
    "items": _items,
    "prefixItems": _prefix_items,
}
