"""The page's own files, out of memory: a page is many small modules, and each should cost next to nothing."""

import gzip
import hashlib
import mimetypes
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from starlette.requests import Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from app.web.page import STYLES, VERSION_MARK, ModulePage, Stamp, stamp_of

REVALIDATED = {"cache-control": "no-cache"}
"""Browsers ask whether a file changed before they use their copy."""
KEPT = {"cache-control": "private, max-age=31536000, immutable"}
"""Browsers use their copy for a year without asking: other contents have another address."""
_PACKED = ("text/", "image/svg", "application/javascript")
_LEAST_PACKED = 600
"""Bytes; a smaller file goes in one packet as it is."""


@dataclass(frozen=True)
class Asset:
    """A file as it was read, and the same packed by gzip where that is worth it."""

    stamp: Stamp
    body: bytes
    packed: bytes | None
    kind: str
    tag: str


class Assets:
    """ASGI application that serves a folder: each file by its name, and by the name under the page's version.

    Args:
        folder: with the files; one that changed is read again.
        page: knows the version; what is asked for under it need not be asked for again.
    """

    def __init__(self, folder: Path, page: ModulePage) -> None:
        self._folder = folder.resolve()
        self._page = page
        self._read: dict[Path, Asset] = {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers a request for a file."""
        request = Request(scope)
        below = scope["path"].removeprefix(scope.get("root_path", "")).lstrip("/")
        version, _, name = below.partition("/") if below.startswith(VERSION_MARK) else ("", "", below)
        found = self._found(name) if request.method == "GET" else None
        if found is None:
            response = Response("There is no such file.", status_code=404)
        else:
            asset, is_of_page = found
            # A page from before a change asks under its old version, which must not keep what is new.
            is_kept = is_of_page and version == VERSION_MARK + self._page.last().version
            response = _answer(request, asset, KEPT if is_kept else REVALIDATED)
        await response(scope, receive, send)

    def _found(self, name: str) -> tuple[Asset, bool] | None:
        """The file, and whether it is what the page was made with."""
        page = self._page.last()
        if name == STYLES and page.styles:
            stamp = (int(page.version, 16), len(page.styles))
            return self._kept(self._folder / STYLES, stamp, lambda: page.styles), True
        try:
            path = (self._folder / name).resolve()
            if not path.is_relative_to(self._folder) or not path.is_file():
                return None
            stamp = stamp_of(path)
        except (OSError, ValueError):  # no name of a file: too long, or with a NUL
            return None
        return self._kept(path, stamp, path.read_bytes), page.stamps.get(path) == stamp

    def _kept(self, path: Path, stamp: Stamp, read: Callable[[], bytes]) -> Asset:
        kept = self._read.get(path)
        if kept is None or kept.stamp != stamp:
            kept = self._read[path] = _asset(path.name, stamp, read())
        return kept


def _asset(name: str, stamp: Stamp, body: bytes) -> Asset:
    kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
    packed = gzip.compress(body, mtime=0) if kind.startswith(_PACKED) and len(body) >= _LEAST_PACKED else None
    return Asset(stamp, body, packed, kind, hashlib.sha256(body).hexdigest()[:24])


def _answer(request: Request, asset: Asset, caching: dict[str, str]) -> Response:
    packs = asset.packed is not None and "gzip" in request.headers.get("accept-encoding", "")
    body = asset.packed if packs and asset.packed is not None else asset.body
    tag = f'"{asset.tag}{"-gzip" if packs else ""}"'
    headers = {**caching, "etag": tag, "vary": "accept-encoding"}
    if request.headers.get("if-none-match") == tag:
        return Response(status_code=304, headers=headers)
    if packs:
        headers["content-encoding"] = "gzip"
    return Response(body, media_type=asset.kind, headers=headers)
