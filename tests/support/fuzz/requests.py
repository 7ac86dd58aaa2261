"""Requests for every operation: valid, nearly valid, and hostile ones, each the same for the same seed."""

from __future__ import annotations

import gzip
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any
from urllib.parse import quote

from tests.support.fuzz import values
from tests.support.fuzz.operations import Examples, Operation, Parameter
from tests.support.fuzz.stock import OWN, Stock, path_of

JSON = "application/json"
KINDS = (
    "text/csv",
    "image/png",
    "multipart/form-data; boundary=x",
    "text/plain",
    JSON + "; charset=utf-16",
    "x",
    "",
)
METHODS = ("GET", "PUT", "POST", "DELETE", "PATCH", "HEAD", "OPTIONS", "TRACE", "BREW", "get")
LARGE = 33_000_000
"""Bytes that no request may have."""


@dataclass(frozen=True)
class Asked:
    """A request.

    Args:
        number: which one of the seed's it is.
        operation: method and path as they are described.
        way: what was done to it, in a word.
        method: as it goes over the wire.
        target: path and query, escaped.
        headers: beside Host and Content-Length.
        body: its bytes.
        length: what Content-Length says; None for the body's own, -1 for none.
        is_whole: whether all of it is sent; else the connection ends after the half.
    """

    number: int
    operation: str
    way: str
    method: str
    target: str
    headers: tuple[tuple[str, str], ...] = ()
    body: bytes = b""
    length: int | None = None
    is_whole: bool = True

    @property
    def is_http(self) -> bool:
        """Whether its head is one that a server takes; beyond 64 kB it need not say what is wrong in JSON."""
        return self.way != "wire" and len(self.target) < 60_000

    @property
    def may_be_cut(self) -> bool:
        """Whether the server may end the connection without an answer to it."""
        is_framed = self.is_whole and self.length is None and len(self.target) < 60_000
        return not is_framed or len(self.body) >= LARGE

    def wire(self, host: str) -> bytes:
        """The request as it is sent."""
        length = len(self.body) if self.length is None else self.length
        lines = [f"{self.method} {self.target} HTTP/1.1", *(f"{key}: {text}" for key, text in self.headers)]
        if not any(key.lower() == "host" for key, _ in self.headers):
            lines.append(f"Host: {host}")
        if length >= 0 and (self.body or length or self.method not in ("GET", "HEAD")):
            lines.append(f"Content-Length: {length}")
        head = "\r\n".join([*lines, "", ""]).encode("latin-1", errors="replace")
        return head + self.body if self.is_whole else (head + self.body)[: (len(head) + len(self.body)) // 2]


class Requests:
    """The requests of a seed.

    Args:
        operations: what can be asked.
        schemas: that their bodies refer to.
        stock: what the studio holds.
        seed: of everything that is chosen.
    """

    def __init__(
        self, operations: Sequence[Operation], schemas: Mapping[str, Any], stock: Stock, seed: int
    ) -> None:
        self._operations = operations
        self._examples = Examples(schemas)
        self._stock = stock
        self._seed = seed

    def request(self, number: int) -> Asked:
        """One of them; every operation has its turn."""
        operation = self._operations[number % len(self._operations)]
        rng = Random(f"{self._seed} {number}")
        way = rng.choices(("valid", "near", "address", "hostile", "wire"), (25, 45, 12, 13, 5))[0]
        asked = self._valid(number, operation, rng, way)
        if way == "hostile":
            return _with_hostile_body(asked, rng)
        return _on_a_hostile_wire(asked, rng) if way == "wire" else asked

    def _valid(self, number: int, operation: Operation, rng: Random, way: str) -> Asked:
        """A request whose address or body may be bent as its way says."""
        content, headers = self._body(operation, rng, bent=way == "near" and rng.random() < 0.9)
        takes_body = bool(content)
        bent = 0.4 if way == "address" or (way == "near" and not takes_body) else 0.02
        target = self._target(operation, rng, bent)
        return Asked(number, operation.name, way, operation.method, target, headers, content)

    def _body(
        self, operation: Operation, rng: Random, *, bent: bool
    ) -> tuple[bytes, tuple[tuple[str, str], ...]]:
        known = self._stock.bodies.get(operation.name)
        if known:
            value = rng.choice(known)
        elif operation.body is not None:
            value = self._examples.of(operation.body, rng)
        else:
            return b"", ()
        if isinstance(value, bytes):
            return (damaged(value, rng) if bent else value), (("Content-Type", "application/octet-stream"),)
        shown = values.mutated(value, rng) if bent else value
        return values.encoded(shown).encode(), (("Content-Type", JSON),)

    def _target(self, operation: Operation, rng: Random, bent: float) -> str:
        inside = {one.name: self._word(one, rng, bent) for one in operation.parameters if one.place == "path"}
        behind = []
        for one in operation.parameters:
            if one.place == "query" and (one.required or rng.random() < 0.4) and rng.random() > bent / 8:
                behind += [(one.name, self._word(one, rng, bent)) for _ in range(rng.choice((1, 1, 1, 1, 2)))]
        query = "&".join(f"{name}={_quoted(word)}" for name, word in behind)
        return path_of(operation.path, inside) + (f"?{query}" if query else "")

    def _word(self, parameter: Parameter, rng: Random, bent: float) -> str:
        if rng.random() < bent:
            if rng.random() < 0.25:
                return rng.choice(rng.choice(list(self._stock.ids.values())))
            return values.hostile_text(rng, is_number=parameter.is_number)
        known = self._stock.ids.get(parameter.name)
        if known:
            return rng.choice(known)
        value = self._examples.of(parameter.schema, rng)
        return value if isinstance(value, str) else json.dumps(value)


def _with_hostile_body(asked: Asked, rng: Random) -> Asked:
    body, kind = hostile_body(asked.body, rng)
    method = asked.method if rng.random() < 0.9 else rng.choice(METHODS)
    headers = [("Content-Type", kind)] if kind else []
    if body.startswith(b"\x1f\x8b"):
        headers.append(("Content-Encoding", "gzip"))
    return replace(asked, method=method, headers=tuple(headers), body=body)


def hostile_body(body: bytes, rng: Random) -> tuple[bytes, str]:
    """What is no body for this request, and how it is called."""
    chosen = rng.randrange(12)
    kind = rng.choice(KINDS) if rng.random() < 0.4 else JSON
    if chosen == 0:
        return b"", kind
    if chosen == 1:
        return body[: rng.randrange(len(body) + 1)], kind
    if chosen == 2:
        return rng.randbytes(rng.choice((1, 40, 4000, 100_000))), kind
    if chosen == 3:
        return gzip.compress(b"0" * 10_000_000), kind
    if chosen == 4:
        part = b'--x\r\nContent-Disposition: form-data; name="file"; filename="../../x\0"\r\n\r\n'
        return part * rng.choice((1, 500)) + body + rng.choice((b"", b"\r\n--x--")), KINDS[2]
    if chosen == 5:
        return b"\xff\xfe" + body.decode(errors="replace")[:4000].encode("utf-16-le"), kind
    if chosen == 6:
        return body + body, kind
    if chosen == 7 and rng.random() < 0.03:
        return b'{"name": "' + b"x" * LARGE + b'"}', kind
    value = values.hostile(rng)
    return values.encoded(value).encode(), kind


def damaged(content: bytes, rng: Random) -> bytes:
    """A file that was cut, overwritten, or claims to be enormous."""
    chosen = rng.randrange(6)
    if chosen == 0:
        return content[: rng.randrange(len(content) + 1)]
    if chosen == 1:
        return content[: rng.randrange(min(200, len(content)))]
    if chosen == 2:
        return content + content
    changed = bytearray(content)
    near = len(changed) if chosen == 3 else min(600, len(changed))
    for _ in range(rng.choice((1, 4, 40))):
        at, size = rng.randrange(near), rng.choice((1, 2, 4))
        changed[at : at + size] = rng.choice((b"\xff", b"\0", b"\x7f", rng.randbytes(1))) * size
    return bytes(changed)


def _on_a_hostile_wire(asked: Asked, rng: Random) -> Asked:
    """The request with headers, lengths or a method that it should not have."""
    chosen = rng.randrange(10)
    page = rng.choice((OWN, "a b", "x" * 65, "\xff", "../x", "0"))
    name = rng.choice(("Ada", "%00", "%ff%fe", "%E2%80%8B", "x" * 81, "%F0%9F%92%A5" * 30, "\xe9", "=1+1"))
    more = (("X-Footfall-Page", page), ("X-Footfall-Name", name))
    if chosen < 4:
        return replace(asked, headers=(*asked.headers, *more))
    if chosen == 4:
        return replace(asked, length=rng.choice((0, 1, len(asked.body) + 50, 10**9, 2**70)), is_whole=True)
    if chosen == 5:
        return replace(asked, is_whole=False)
    if chosen == 6:
        return replace(asked, headers=(*asked.headers, ("Transfer-Encoding", "chunked")), length=-1)
    if chosen == 7:
        return replace(
            asked, headers=(*asked.headers, ("X-Long", "y" * rng.choice((60_000, 200_000)))), length=-1
        )
    if chosen == 8:
        return replace(
            asked,
            headers=(*asked.headers, ("Range", "bytes=" + ",".join(["0-1"] * 2000)), ("Accept", "x/\xff")),
        )
    return replace(
        asked, method=rng.choice(METHODS), headers=(*asked.headers, ("X-HTTP-Method-Override", "DELETE"))
    )


def _quoted(word: str) -> str:
    return quote(word.encode(errors="surrogatepass"), safe="")
