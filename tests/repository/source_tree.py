"""The source code as files, folders and imports, for the tests of the architecture."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import PurePosixPath

from tests.support.studio_process import PROJECT

PARTS = ("core", "robot_description", "solver_jobs", "app")
STATIC = "app/static"
PAGE_CODE = (".js", ".css", ".html")

_JS_COMMENT = re.compile(r"^[ \t]*(?:/\*.*?\*/|//[^\n]*)|/\*\* @.*?\*/", re.MULTILINE | re.DOTALL)
"""Comments that begin a line, and types (`/** @type {…} */`) anywhere."""

_JS_IMPORT = re.compile(
    r"""^(?:import|export)\s[^;"']*?from\s*["']([^"']+)["']|^import\s*["']([^"']+)["']"""
    r"""|\bimport\(\s*["'`]([^"'`]+)["'`]""",
    re.MULTILINE,
)


def files(*suffixes: str, parts: Sequence[str] = PARTS) -> list[str]:
    """Every file of the program, or of other folders, with one of these suffixes, at any depth."""
    return sorted(
        str(path.relative_to(PROJECT))
        for part in parts
        for path in (PROJECT / part).rglob("*")
        if path.suffix in suffixes and "__pycache__" not in path.parts
    )


def folder_of(path: str) -> str:
    """The folder that a file stands in."""
    return str(PurePosixPath(path).parent)


@cache
def imports(path: str) -> tuple[str, ...]:
    """What a Python file imports, by full names; imports within functions count too."""
    return tuple(_imports((PROJECT / path).read_text()))


def _imports(text: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level:
            yield f"relative:{node.module}"
        elif isinstance(node, ast.ImportFrom):
            full = (f"{node.module}.{alias.name}" for alias in node.names)
            yield from (name if is_module(name) else str(node.module) for name in full)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            yield from (str(word.value) for word in node.args if isinstance(word, ast.Constant))


def is_module(name: str) -> bool:
    """Whether a dotted name is a file or a folder of this project."""
    place = PROJECT / name.replace(".", "/")
    return place.is_dir() or place.with_suffix(".py").is_file()


def files_imported(path: str) -> set[str]:
    """The files of this project that a Python or JavaScript file imports."""
    if path.endswith(".js"):
        return set(js_imports(path, (PROJECT / path).read_text()))
    own = [name.replace(".", "/") for name in imports(path) if name.split(".")[0] in PARTS]
    return {f"{place}/__init__.py" if (PROJECT / place).is_dir() else f"{place}.py" for place in own}


def folders_imported(path: str) -> set[str]:
    """The folders of this project that a Python or JavaScript file imports from."""
    return {folder_of(target) for target in files_imported(path)}


def circle(imported: Mapping[str, Iterable[str]]) -> list[str]:
    """Files of which each imports the next, the first once more at the end; empty if there is no circle.

    Args:
        imported: the files that each file imports.
    """
    try:
        TopologicalSorter(imported).prepare()
    except CycleError as error:
        return list(reversed(error.args[1]))
    return []


def js_imports(path: str, text: str) -> list[str]:
    """The files that a module of the page imports; types that a comment names do not count."""
    targets = [next(filter(None, found)) for found in _JS_IMPORT.findall(_JS_COMMENT.sub("", text))]
    folder = (PROJECT / path).parent
    return [str((folder / target).resolve().relative_to(PROJECT.resolve())) for target in targets]


def listed(offenders: Sequence[str]) -> str:
    """Offenders as the message of a failed test, one a line."""
    return "\n".join(("", *offenders))
