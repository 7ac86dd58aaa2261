"""Viser's own port, guarded: it listens on loopback, where every program and every page could reach it.

Viser makes its server of `websockets` itself and hands nothing out to check requests with. So the function
that makes such servers is replaced while Viser starts, by one that puts our check before Viser's own. A scene
whose check was not put in is closed again, so a later Viser that starts otherwise cannot be left open. In the
same way Viser gets connections on which only messages come that it can read.
"""

import contextlib
import hmac
import http
import logging
import threading
from collections.abc import Awaitable, Callable, Iterator
from typing import Any

import viser
from viser import _messages
from websockets.asyncio import server as websockets_server
from websockets.asyncio.server import ServerConnection
from websockets.frames import CloseCode
from websockets.http11 import Request, Response
from websockets.typing import Data

from app.scene.client_messages import is_camera
from core.errors import InputError, StateError

LOOPBACK = "127.0.0.1"
RELAY_HEADER = "X-Footfall-Relay"
"""Carries the secret that only the relay knows; no page can set it on a web socket."""

SHARING = (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect)
"""Messages of a client that would open the scene to the outside world."""

_Answer = Awaitable[Response | None] | Response | None
_Check = Callable[[ServerConnection, Request], _Answer]

REFUSAL = "Only the studio may talk to this port; open the address that it printed.\n"

_log = logging.getLogger(__name__)
# Whoever sends half a request would otherwise leave a traceback each time.
_log.addFilter(lambda record: record.msg != "opening handshake failed")
_replacing = threading.Lock()


def guarded_viser(label: str, secret: str) -> viser.ViserServer:
    """Starts Viser on any free port of the loopback interface, for those who show the secret.

    Args:
        label: title of Viser's panel.
        secret: wanted in `RELAY_HEADER` of every request, for a web socket or a file.

    Raises:
        StateError: the installed Viser starts in another way, so its port cannot be guarded.
    """
    with _checked_first(secret) as checked:
        server = viser.ViserServer(host=LOOPBACK, port=0, label=label, verbose=False)
    try:
        if not checked.is_set():
            raise AttributeError("it no longer starts by websockets.asyncio.server.serve")
        for kind in SHARING:
            server._websock_server.unregister_handler(kind)
    except (AttributeError, AssertionError, KeyError) as error:
        server.stop()
        raise StateError(
            f"The installed Viser {viser.__version__} cannot be kept to this studio ({error}); install the "
            "version that constraints.txt names.",
            "viser",
        ) from error
    return server


@contextlib.contextmanager
def _checked_first(secret: str) -> Iterator[threading.Event]:
    """Makes servers that are started meanwhile check for the secret; the event says that one was."""
    original = websockets_server.serve
    checked = threading.Event()

    def serve(*places: Any, process_request: _Check | None = None, **options: Any) -> Any:
        def check(connection: ServerConnection, request: Request) -> _Answer:
            if not is_from_relay(connection, request, secret):
                return connection.respond(http.HTTPStatus.FORBIDDEN, REFUSAL)
            return None if process_request is None else process_request(connection, request)

        checked.set()
        ours = {"process_request": check, "logger": _log, "create_connection": ReadableConnection}
        return original(*places, **{**options, **ours})

    with _replacing:
        websockets_server.serve = serve  # type: ignore[assignment, misc]
        try:
            yield checked
        finally:
            websockets_server.serve = original  # type: ignore[misc]


class ReadableConnection(ServerConnection):
    """A client's connection that is closed with a sentence where a message comes that Viser cannot read."""

    async def recv(self, decode: bool | None = None) -> Data:  # type: ignore[override]
        """The next message that Viser needs; others are dropped.

        Raises:
            ConnectionClosed: the connection is closed, by the client or here.
        """
        while True:
            data = await super().recv(decode)
            try:
                if is_camera(data):
                    return data
            except InputError as error:
                await self.close(CloseCode.UNSUPPORTED_DATA, error.sentence)


def is_from_relay(connection: ServerConnection, request: Request, secret: str) -> bool:
    """Whether a request to Viser's port has the relay's secret, the port's own Host and no page's Origin."""
    headers = request.headers
    shown = headers.get_all(RELAY_HEADER)
    host = f"{LOOPBACK}:{connection.local_address[1]}"
    return (
        len(shown) == 1
        and hmac.compare_digest(shown[0].encode(errors="surrogateescape"), secret.encode())
        and headers.get_all("Host") == [host]
        and not any(headers.get_all(name) for name in ("Origin", "Sec-Fetch-Site"))
    )
