"""The operations that the studio describes, and values that its description allows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from random import Random
from typing import Any

METHODS = ("get", "post", "put", "delete", "patch")


@dataclass(frozen=True)
class Parameter:
    """A parameter of an operation.

    Args:
        name: as it stands in the address.
        place: `path` or `query`.
        schema: of its value.
        required: whether it has to be given.
    """

    name: str
    place: str
    schema: Mapping[str, Any]
    required: bool

    @property
    def is_number(self) -> bool:
        """Whether it may be a number."""
        choices = (self.schema, *self.schema.get("anyOf", ()))
        return any(choice.get("type") in ("integer", "number") for choice in choices)


@dataclass(frozen=True)
class Operation:
    """One thing that can be asked of the studio.

    Args:
        method: in capitals.
        path: with its parameters in braces.
        parameters: of path and address.
        body: the schema of its JSON; None where it takes none.
        kinds: content types that it takes.
    """

    method: str
    path: str
    parameters: tuple[Parameter, ...]
    body: Mapping[str, Any] | None
    kinds: tuple[str, ...]

    @property
    def name(self) -> str:
        """Method and path."""
        return f"{self.method} {self.path}"


def operations_of(description: Mapping[str, Any]) -> tuple[Operation, ...]:
    """Every operation of an OpenAPI document."""
    return tuple(
        _operation(method.upper(), path, operation)
        for path, methods in description["paths"].items()
        for method, operation in methods.items()
        if method in METHODS
    )


def _operation(method: str, path: str, content: Mapping[str, Any]) -> Operation:
    parameters = tuple(
        Parameter(one["name"], one["in"], one.get("schema", {}), one.get("required", False))
        for one in content.get("parameters", ())
    )
    kinds = content.get("requestBody", {}).get("content", {})
    body = kinds.get("application/json", {}).get("schema")
    return Operation(method, path, parameters, body, tuple(kinds))


@dataclass(frozen=True)
class Examples:
    """Makes values that a schema allows.

    Args:
        schemas: those that others refer to, by name.
    """

    schemas: Mapping[str, Mapping[str, Any]]

    def of(self, schema: Mapping[str, Any], rng: Random) -> Any:
        """A value, at a boundary as often as not."""
        if "$ref" in schema:
            return self.of(self.schemas.get(str(schema["$ref"]).rsplit("/", 1)[-1], {}), rng)
        for choice in ("anyOf", "oneOf"):
            if choice in schema:
                return self.of(rng.choice(schema[choice]), rng)
        if "enum" in schema or "const" in schema:
            return rng.choice(schema.get("enum", [schema.get("const")]))
        kind = schema.get("type")
        if kind == "object":
            return self._object(schema, rng)
        if kind == "array":
            return self._array(schema, rng)
        return _simple(kind, schema, rng)

    def _object(self, schema: Mapping[str, Any], rng: Random) -> dict[str, Any]:
        required = schema.get("required", ())
        properties = schema.get("properties", {})
        chosen = [key for key in properties if key in required or rng.random() < 0.5]
        return {key: self.of(properties[key], rng) for key in chosen}

    def _array(self, schema: Mapping[str, Any], rng: Random) -> list[Any]:
        if "prefixItems" in schema:
            return [self.of(one, rng) for one in schema["prefixItems"]]
        least = schema.get("minItems", 0)
        count = rng.choice((least, least + 1, min(least + 3, schema.get("maxItems", 9))))
        return [self.of(schema.get("items", {}), rng) for _ in range(count)]


def _simple(kind: str | None, schema: Mapping[str, Any], rng: Random) -> Any:
    if kind in ("integer", "number"):
        least = schema.get("minimum", schema.get("exclusiveMinimum", -3))
        most = schema.get("maximum", schema.get("exclusiveMaximum", least + 9))
        value = rng.choice((least, most, rng.uniform(least, most), schema.get("default", least + 1)))
        return int(value) if kind == "integer" else value
    if kind == "boolean":
        return rng.random() < 0.5
    if kind == "string":
        return "x" * rng.choice((schema.get("minLength", 1), 8, min(schema.get("maxLength", 8), 4000)))
    return None if kind == "null" else {}
