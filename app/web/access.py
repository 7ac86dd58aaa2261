"""Who may talk to the studio: Host, Origin and token, on HTTP and web sockets alike."""

import hmac
import ipaddress
from dataclasses import dataclass
from html import escape
from urllib.parse import parse_qs, parse_qsl, quote, urlencode, urlsplit

from starlette.requests import cookie_parser
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.web.foreign_sites import is_followed_link, is_foreign
from app.web.wrong_tokens import WrongTokens

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
"""Content security of every answer that has none of its own."""

HEADERS = {
    b"content-security-policy": PAGE_POLICY.encode(),
    b"x-content-type-options": b"nosniff",
    b"referrer-policy": b"no-referrer",
    b"cross-origin-resource-policy": b"same-origin",
}
"""What every answer has, refusals included."""


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
        if name in LOOPBACK_NAMES or name == self.host.lower():
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


@dataclass(frozen=True)
class Refusal:
    """Why a request is refused."""

    sentence: str
    is_guess: bool = False
    """Whether a wrong token was shown."""


class Guard:
    """ASGI middleware that refuses foreign hosts, foreign pages and missing tokens."""

    def __init__(self, app: ASGIApp, access: Access, wrong_tokens: WrongTokens | None = None) -> None:
        self._app = app
        self._access = access
        self._wrong_tokens = wrong_tokens or WrongTokens()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on, or answers it with a sentence."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = _joined(scope)
        sending = _with_headers(send)
        refusal = self._refusal(scope, headers)
        if refusal is not None:
            if refusal.is_guess:
                await self._wrong_tokens.wait()
            await _refuse(scope, receive, sending, refusal.sentence)
            return
        is_address = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        if self._access.token is not None and _query_token(scope) is not None and is_address:
            response = _without_token(scope, headers)
            name = _cookie_name(headers)
            response.set_cookie(name, self._access.token, httponly=True, samesite="strict")
            await response(scope, receive, sending)
            return
        await self._app(scope, receive, sending)

    def _refusal(self, scope: Scope, headers: dict[str, str]) -> Refusal | None:
        host = headers.get("host", "")
        if not self._access.knows_host(_host(headers)[0]):
            return Refusal(
                f"This studio does not answer for the host “{host}”. Use the address that it printed."
            )
        origin = headers.get("origin")
        if origin is not None and origin not in (f"http://{host}", f"https://{host}"):
            return Refusal(f"Requests from the page {origin} are refused. Use the studio's own page.")
        if is_foreign(scope.get("method", ""), scope["path"], headers):
            return Refusal("Requests from other sites' pages are refused. Use the studio's own page.")
        shown = _tokens(scope, headers)
        if self._access.token is None or _is_among(self._access.token, shown):
            return None
        sentence = "The token is missing or wrong. Open the address with its token, as the studio printed it."
        return Refusal(sentence, is_guess=bool(shown))


def _joined(scope: Scope) -> dict[str, str]:
    """Headers by their names in small letters; one that comes twice is neither of the two."""
    headers: dict[str, str] = {}
    for key, value in scope["headers"]:
        name, text = key.decode("latin-1").lower(), value.decode("latin-1")
        headers[name] = f"{headers[name]}; {text}" if name in headers else text
    return headers


def _host(headers: dict[str, str]) -> tuple[str, int | None]:
    """Name and port that a request is for."""
    try:
        parts = urlsplit(f"//{headers.get('host', '')}")
        return parts.hostname or "", parts.port
    except ValueError:
        return "", None


def _cookie_name(headers: dict[str, str]) -> str:
    """Browsers send a host's cookies to all its ports, so each studio has a cookie of its own."""
    return f"{COOKIE}_{_host(headers)[1] or 80}"


def _tokens(scope: Scope, headers: dict[str, str]) -> list[str]:
    """The tokens that a request shows."""
    cookies = cookie_parser(headers.get("cookie", ""))
    header, cookie = headers.get("authorization", ""), cookies.get(_cookie_name(headers))
    return [text for text in (_query_token(scope), header.removeprefix("Bearer "), cookie) if text]


def _is_among(token: str, shown: list[str]) -> bool:
    return any(hmac.compare_digest(text.encode(), token.encode()) for text in shown)


def _query_token(scope: Scope) -> str | None:
    return next(iter(parse_qs(scope["query_string"].decode("latin-1")).get("token", [])), None)


def _without_token(scope: Scope, headers: dict[str, str]) -> Response:
    """Leads to the same address of this studio, without the token."""
    query = parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)
    rest = urlencode([(name, value) for name, value in query if name != "token"])
    # Two slashes would begin the name of another host; browsers take a backslash for a slash.
    address = quote("/" + scope["path"].lstrip("/\\")) + (f"?{rest}" if rest else "")
    if not is_followed_link(headers):
        return RedirectResponse(address, status_code=303)
    # Browsers keep a strict cookie back while they follow a link of another site; here the link ends.
    return HTMLResponse(f'<meta http-equiv="refresh" content="0;url={escape(address)}">')


async def _refuse(scope: Scope, receive: Receive, send: Send, sentence: str) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": sentence[:120]})
        return
    await JSONResponse({"error": sentence, "where": "request"}, status_code=403)(scope, receive, send)


def _with_headers(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = list(message.get("headers", []))
            own = {name.lower() for name, _ in headers}
            headers += [(name, value) for name, value in HEADERS.items() if name not in own]
            message = {**message, "headers": headers}
        await send(message)

    return sending
