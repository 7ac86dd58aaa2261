"""The page: it names all modules that its scripts lead to, and the version of its folder in each address.

Its style sheets come as one: scripts wait for every sheet of the head, and each request has its price. The
version is a folder's name in the address, `/static/~VERSION/editor.js`, so that what a module imports by a
relative name is of the same version. It changes whenever a file does.
"""

import hashlib
import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

VERSION_MARK = "~"
"""Begins the part of an address that is a version."""

STYLES = "page.css"
"""Name of all style sheets in one."""

LATER = "later-modules"
"""Id of the template that holds the preloads of the second wave; `boot.js` takes them out."""

Stamp = tuple[int, int]
"""When a file was changed, ns, and its bytes."""

_KINDS = (".html", ".js", ".css", ".svg")
_SHEET = re.compile(r"""<link rel="stylesheet" href="/static/([^"]+)">\s*""")
_PRELOAD = re.compile(r"""<link rel="modulepreload" href="/static/([^"]+)">\s*""")
_SCRIPT = re.compile(r"""<script type="module"(?: async)? src="/static/([^"]+)">""")
_IMPORT = re.compile(r"""^(?:import|export)\b[^;]*?from\s+["'](\.[^"']+)["']""", re.MULTILINE)


def stamp_of(path: Path) -> Stamp:
    """The file's stamp.

    Raises:
        OSError: there is no such file.
    """
    state = path.stat()
    return state.st_mtime_ns, state.st_size


@dataclass(frozen=True)
class PageState:
    """The page as one state of its folder gives it."""

    version: str
    stamps: dict[Path, Stamp]
    text: str
    styles: bytes


class ModulePage:
    """The page, made anew where a file of its folder changed.

    What the scripts import comes at once. What the modules import that the HTML names as a preload stands in
    a template, out of which the page takes it when what is seen first is drawn: read earlier, those modules
    take the processor from it. What else is imported by `import()` waits until asked for.

    Args:
        folder: with `index.html` and the modules; it is served as /static.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._state: PageState | None = None

    def now(self) -> PageState:
        """The page after a look at every file; as HTML and style sheet."""
        paths = sorted(path for path in self._folder.rglob("*") if path.suffix in _KINDS)
        stamps = {path: stamp_of(path) for path in paths}
        if self._state is None or stamps != self._state.stamps:
            self._state = self._made(stamps)
        return self._state

    def last(self) -> PageState:
        """The page that was given out last."""
        return self._state or self.now()

    def _made(self, stamps: dict[Path, Stamp]) -> PageState:
        contents = (f"{path} {hashlib.sha256(path.read_bytes()).hexdigest()}" for path in stamps)
        version = hashlib.sha256("\n".join(contents).encode()).hexdigest()[:12]
        source = (self._folder / "index.html").read_text("utf-8")
        sheets = _SHEET.findall(source)
        styles = b"".join((self._folder / name).read_bytes() for name in sheets)
        links = [f'<link rel="stylesheet" href="/static/{STYLES}">'] if sheets else []
        links += self._preloads(_SCRIPT.findall(source), _PRELOAD.findall(source))
        text = _PRELOAD.sub("", _SHEET.sub("", source))
        text = text.replace("</title>", "\n  ".join(["</title>", *links]), 1)
        text = text.replace('"/static/', f'"/static/{VERSION_MARK}{version}/')
        return PageState(version, stamps, text, styles)

    def _preloads(self, scripts: list[str], entries: list[str]) -> list[str]:
        first = self._reached(scripts, ())
        later: list[Path] = []
        for entry in entries:
            later += self._reached([entry], {*first, *later})
        return [*self._links(first), f'<template id="{LATER}">', *self._links(later), "</template>"]

    def _links(self, modules: list[Path]) -> list[str]:
        names = (module.relative_to(self._folder).as_posix() for module in modules)
        return [f'<link rel="modulepreload" href="/static/{name}">' for name in names]

    def _reached(self, names: list[str], known: Collection[Path]) -> list[Path]:
        """The modules and all that they import, without those that are known."""
        found = [self._folder / name for name in names if self._folder / name not in known]
        for module in found:
            found += [path for path in _imported(module) if path not in known and path not in found]
        return found


def _imported(module: Path) -> dict[Path, None]:
    """The modules that a module imports before it runs, each once, in its order."""
    names = _IMPORT.findall(module.read_text("utf-8"))
    return dict.fromkeys((module.parent / name).resolve() for name in names)
