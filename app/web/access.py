"""Who may talk to the studio: Host, Origin and token, on HTTP and web sockets alike."""

import hmac
import ipaddress
from dataclasses import dataclass
from http.cookies import SimpleCookie
from urllib.parse import parse_qs, urlsplit

from starlette.responses import JSONResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

COOKIE = "footfall_token"
LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
PAGE_POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "frame-src 'self'",
        "font-src 'self'",
        "manifest-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    ]
)
"""Content security of everything but the embedded Viser client and the API's page."""
_OWN_POLICY = ("/viser/", "/docs", "/redoc", "/static-offline-docs")


@dataclass(frozen=True)
class Access:
    """What is demanded of a request.

    Args:
        host: the address that the server listens on.
        token: must be shown where it is not None.
    """

    host: str
    token: str | None

    def knows_host(self, name: str) -> bool:
        """Whether a request for this host name is meant for us."""
        if name in LOOPBACK_NAMES or name == self.host:
            return True
        if self.host in ("0.0.0.0", "::"):
            # Listening everywhere: any address literal is ours; a name could be rebound by a foreign site.
            return _is_address(name)
        return False


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


class Guard:
    """ASGI middleware that refuses foreign hosts, foreign origins and missing tokens."""

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self._app = app
        self._access = access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on, or answers it with a sentence."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = {key.decode("latin-1").lower(): value.decode("latin-1") for key, value in scope["headers"]}
        refusal = self._refusal(scope, headers)
        if refusal is not None:
            await _refuse(scope, receive, send, refusal)
            return
        is_address = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        if self._access.token is not None and _query_token(scope) is not None and is_address:
            response = RedirectResponse(scope["path"], status_code=303)
            response.set_cookie(COOKIE, self._access.token, httponly=True, samesite="strict")
            await response(scope, receive, send)
            return
        await self._app(scope, receive, _with_policy(scope, send))

    def _refusal(self, scope: Scope, headers: dict[str, str]) -> str | None:
        host = headers.get("host", "")
        try:
            name = urlsplit(f"//{host}").hostname or ""
        except ValueError:
            name = host
        if not self._access.knows_host(name):
            return f"This studio does not answer for the host “{name}”. Use the address that it printed."
        origin = headers.get("origin")
        if origin is not None and origin not in (f"http://{host}", f"https://{host}"):
            return f"Requests from the page {origin} are refused. Use the studio's own page."
        if self._access.token is not None and not self._has_token(scope, headers):
            return "The token is missing or wrong. Open the address with its token, as the studio printed it."
        return None

    def _has_token(self, scope: Scope, headers: dict[str, str]) -> bool:
        cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        bearer = headers.get("authorization", "").removeprefix("Bearer ")
        shown = (_query_token(scope), cookie.value if cookie else None, bearer or None)
        wanted = (self._access.token or "").encode()
        return any(text is not None and hmac.compare_digest(text.encode(), wanted) for text in shown)


def _query_token(scope: Scope) -> str | None:
    return next(iter(parse_qs(scope["query_string"].decode("latin-1")).get("token", [])), None)


async def _refuse(scope: Scope, receive: Receive, send: Send, sentence: str) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": sentence[:120]})
        return
    await JSONResponse({"error": sentence, "where": "request"}, status_code=403)(scope, receive, send)


def _with_policy(scope: Scope, send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start" and not scope["path"].startswith(_OWN_POLICY):
            headers = list(message.get("headers", []))
            headers.append((b"content-security-policy", PAGE_POLICY.encode()))
            headers.append((b"x-content-type-options", b"nosniff"))
            headers.append((b"referrer-policy", b"no-referrer"))
            message = {**message, "headers": headers}
        await send(message)

    return sending
