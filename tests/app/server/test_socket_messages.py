"""Messages that no page sends: each web socket refuses or ignores them, and nothing lands in the log."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
import pytest
import viser
from hypothesis import given
from hypothesis import strategies as st
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from tests.support.client_camera import CAMERA
from tests.support.studio_process import ANSWER_SECONDS, StudioProcess, running_studio

FIRST_LINE = "Only this computer can reach it"
"""Begins what every studio writes."""


@dataclass(frozen=True)
class Message:
    """A message as it goes over the wire; a text need not be UTF-8."""

    content: bytes
    is_text: bool = True


@dataclass(frozen=True)
class Route:
    """A web socket, with a last message that it always closes on, and the code of that."""

    path: str
    last: Message
    code: int


EVENTS = Route("api/events", Message(b"x" * 5000), 1009)
POSES = Route("viser/poses", Message(b"["), 1003)
RELAY = Route("viser/ws", Message(b"no MessagePack"), 1003)
ROUTES = {route.path: route for route in (EVENTS, POSES, RELAY)}

KINDS = [
    "ViewerCameraMessage",
    "GuiUpdateMessage",
    "TransformControlsDragStartMessage",
    "SceneNodeDragMessage",
]

TEXTS = [
    b"",
    b"\0",
    b"\xff\xfe",
    b"\xed\xa0\x80",
    b"[" * 100_000,
    b"[" * 900 + b"]" * 900,
    b'{"a":' * 300,
    b"9" * 5000,
    b"[1e400]",
    b"[NaN]",
    b"[null]",
    b'["\\ud800"]',
    b'{"/robot": 1}',
    b'"/robot"',
    b"null",
    "\ufeff[]".encode(),
    "stop \0€".encode() * 20,
]
BINARIES = [
    b"",
    b"\0",
    b"\0" * 28,
    struct.pack("<7f", *[float("nan")] * 7),
    struct.pack("<7f", *[3e38] * 7),
    b"\xc1",
    b"\x91" * 100_000,
    b"\xdf\xff\xff\xff\xff",
    b"\x81\xa4type\x93",
    b"\x81\xa4type\xa2\xff\xfe",
    *(msgspec.msgpack.encode({**CAMERA, field: "x"}) for field in CAMERA),
    *(msgspec.msgpack.encode({"type": kind, "name": [1], "owner": {}}) for kind in KINDS),
]
CASES = [*map(Message, TEXTS), *(Message(content, is_text=False) for content in BINARIES)]

_LEAVES = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5)
_JSON = st.recursive(_LEAVES, lambda inner: st.lists(inner) | st.dictionaries(st.text(max_size=5), inner))
_PACKED_LEAVES = st.none() | st.integers(-(2**63), 2**63) | st.floats() | st.sampled_from(["", "x", [], {}])
_PACKED = st.fixed_dictionaries(
    {"type": st.sampled_from(KINDS)}, optional={key: _PACKED_LEAVES for key in CAMERA if key != "type"}
)
MESSAGES = (
    _JSON.map(lambda content: Message(json.dumps(content).encode()))
    | _PACKED.map(lambda content: Message(msgspec.msgpack.encode(content), is_text=False))
    | st.builds(Message, st.binary(max_size=60), st.booleans())
)


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A studio of this file's own: its log holds back what another test has had written already."""
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def log_of(studio: StudioProcess) -> str:
    """All that a studio wrote to standard error after its first line."""
    text = studio.said.read_text() if studio.said is not None else ""
    return "\n".join(line for line in text.splitlines() if not line.startswith(FIRST_LINE))


def closing_code(studio: StudioProcess, route: Route, *messages: Message) -> int:
    """Sends messages and the route's last one; the code that the studio closed with after them."""
    protocol = Subprotocol(f"viser-v{viser.__version__}") if route is RELAY else None
    address = studio.url.replace("http", "ws") + route.path
    with connect(address, subprotocols=[protocol] if protocol else None, max_size=None) as socket:
        try:
            for message in (*messages, route.last):
                socket.send(message.content, text=message.is_text)
            while True:
                socket.recv(ANSWER_SECONDS)
        except ConnectionClosed:
            pass
        return socket.close_code or 0


@pytest.mark.parametrize("path", ROUTES)
def test_no_message_leaves_a_line_in_the_log(studio: StudioProcess, path: str) -> None:
    for case in CASES:
        assert closing_code(studio, ROUTES[path], case) in (1003, 1007, 1009)
    assert log_of(studio) == ""


@pytest.mark.heavy
@pytest.mark.parametrize("path", ROUTES)
@given(messages=st.lists(MESSAGES, max_size=4))
def test_neither_do_any_others(studio: StudioProcess, path: str, messages: list[Message]) -> None:
    # The line is cut where the client sends on after a text that is no UTF-8: no code arrives then.
    closing_code(studio, ROUTES[path], *messages)
    assert log_of(studio) == ""


@pytest.mark.parametrize("path", ROUTES)
def test_what_the_page_sends_is_taken(studio: StudioProcess, path: str) -> None:
    names, pose = Message(b'["/robot", "/\xe2\x82\xac"]'), Message(b"\0" * 56, is_text=False)
    messages = {
        EVENTS.path: [Message(b"here"), Message(b"stop Ada")],
        POSES.path: [names, pose, pose],
        RELAY.path: [Message(msgspec.msgpack.encode(CAMERA), is_text=False)] * 3,
    }
    assert closing_code(studio, ROUTES[path], *messages[path]) == ROUTES[path].code
    assert log_of(studio) == ""
