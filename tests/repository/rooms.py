"""The folders of the program in their order, and the rules that they keep.

A folder may import the folders that stand before it in its part of `ORDER`, and no others. A new
folder needs a place in `ORDER`, a sentence (the docstring of its `__init__.py`), and a row with both in
`docs/architecture.md`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Mapping

from tests.repository.source_tree import PAGE_CODE, STATIC, folder_of
from tests.support.studio_process import PROJECT

ORDER: dict[str, tuple[str, ...]] = {
    "core": (
        "core",
        "core/text",
        "core/data",
        "core/robot",
        "core/motion",
        "core/problem",
        "core/segments",
        "core/wire",
        "core/gait",
        "core/pose_gaits",
        "core/physics",
        "core/checks",
        "core/recorded",
        "core/patterns",
        "core/library",
        "core/published",
        "core/atlas",
        "core/jog",
        "core/runs",
        "core/vision",
        "core/trials",
        "core/identification",
    ),
    "robot_description": ("robot_description",),
    "solver_jobs": (
        "solver_jobs/results",
        "solver_jobs/nlp",
        "solver_jobs/pose_gaits",
        "solver_jobs/live",
        "solver_jobs/tiers",
        "solver_jobs/remedies",
        "solver_jobs/patterns",
        "solver_jobs/physics",
        "solver_jobs/atlas",
        "solver_jobs/workers",
        "solver_jobs",
    ),
    "app": (
        "app/common",
        "app/session",
        "app/documents",
        "app/undo",
        "app/bridge",
        "app/emulator",
        "app/store",
        "app/store/tables",
        "app/plans",
        "app/gaits",
        "app/jobs",
        "app/fastest",
        "app/atlas/page",
        "app/atlas",
        "app/simulation",
        "app/pattern_search",
        "app/remedies",
        "app/runs",
        "app/robot",
        "app/vision",
        "app/cameras",
        "app/trials",
        "app/videos",
        "app/learning",
        "app/export",
        "app/export/page",
        "app/trials/report",
        "app/published",
        "app/scene",
        "app/studio",
        "app/web",
        "app/routes/gaits",
        "app/routes/patterns",
        "app/routes/robot",
        "app/routes/lab",
        "app/routes",
        "app/server",
        "app/bench/common",
        "app/bench/solvers",
        "app/bench/patterns",
        "app/bench/robot",
        "app/bench/physics",
        "app/bench/page",
        "app/bench",
        "app/cli/common",
        "app/cli/atlas",
        "app/cli",
        "app/scripting",
        "app",
    ),
    "app/static": (
        "app/static/lib",
        "app/static/api",
        "app/static/document",
        "app/static/state",
        "app/static/shell",
        "app/static/steps",
        "app/static/timeline",
        "app/static/plots",
        "app/static/optimise",
        "app/static/segments",
        "app/static/sequence",
        "app/static/patterns",
        "app/static/check",
        "app/static/robot",
        "app/static/preview",
        "app/static/stage",
        "app/static/trials",
        "app/static/pictures",
        "app/static/cameras",
        "app/static/runs",
        "app/static/videos",
        "app/static/learning",
        "app/static/fastest",
        "app/static/atlas",
        "app/static/published",
        "app/static/lab",
        "app/static/first_steps",
        "app/static",
    ),
}
"""The folders of each part, the lowest first."""

ROOMS = tuple(room for rooms in ORDER.values() for room in rooms)
PAGE_ROOMS = frozenset({*ORDER[STATIC], "app/export/page", "app/atlas/page"})
"""Folders of JavaScript, CSS and HTML; all others hold Python."""

MOST_FILES = 25
MOST_ON_OWN_LEVEL = {"core": 6, "solver_jobs": 3, "app": 4, STATIC: 6}
"""Files of code that a folder may hold, `__init__.py` not counted."""
MOST_LINES = 400
"""Lines that a file of code may have."""

DOCUMENT = "docs/architecture.md"
ROW = re.compile(r"^\| `([\w/]+)/` \| (.+) \|$", re.MULTILINE)


def why_out_of_order(folder: str, imported: str) -> str | None:
    """Why files of one folder may not import from another; None where they may."""
    rooms = next((rooms for rooms in ORDER.values() if folder in rooms), ())
    if folder == imported or imported not in rooms:  # between parts the table of test_architecture.py decides
        return None
    if rooms.index(imported) < rooms.index(folder):
        return None
    return f"{imported} stands above {folder}; move what both need into a lower folder, or pass it in"


def why_misplaced(path: str) -> str | None:
    """Why a file of code may not stand where it does; None where it may."""
    folder = folder_of(path)
    if folder not in ROOMS:
        return f"{folder} is not a known folder; put the file into one that is, or add the folder to ORDER"
    if path.endswith(PAGE_CODE) != (folder in PAGE_ROOMS):
        return f"{folder} is not a folder for such files; the page's are in {STATIC}, Python is elsewhere"
    return None


def overfull(paths: Collection[str]) -> list[str]:
    """The folders with too many files."""
    count: dict[str, int] = {}
    for path in paths:
        if not path.endswith("/__init__.py"):
            count[folder_of(path)] = count.get(folder_of(path), 0) + 1
    most = {folder: MOST_ON_OWN_LEVEL.get(folder, MOST_FILES) for folder in count}
    return [
        f"{folder} holds {count[folder]} files of code, at most {most[folder]}; split it by subject"
        for folder in count
        if count[folder] > most[folder]
    ]


def overlong(lines: Mapping[str, int]) -> list[str]:
    """The files with too many lines.

    Args:
        lines: how many each file has.
    """
    return [
        f"{path} has {count} lines, at most {MOST_LINES}; split it by subject"
        for path, count in lines.items()
        if count > MOST_LINES
    ]


def sentence(text: str | None) -> str | None:
    """The sentence of a folder: the first line of its docstring; None where that is not one sentence."""
    first = (text or "").strip().split("\n")[0]
    return first if re.fullmatch(r"[A-Z][^.!?]*(?:\.\w[^.!?]*)*\.", first) else None


def python_sentences() -> dict[str, str | None]:
    """The sentence of every folder of Python."""
    texts = {room: PROJECT / room / "__init__.py" for room in ROOMS if room not in PAGE_ROOMS}
    return {room: sentence(ast.get_docstring(ast.parse(path.read_text()))) for room, path in texts.items()}


def undocumented(rows: Mapping[str, str], sentences: Mapping[str, str | None]) -> list[str]:
    """How the rows of the document differ from the folders and their sentences."""
    lines = [f"{room} has no row in {DOCUMENT}" for room in ROOMS if room not in rows]
    lines += [f"{DOCUMENT} names {room}, which is not a folder of code" for room in rows if room not in ROOMS]
    lines += [
        f"{room}: {DOCUMENT} says “{rows[room]}”, its docstring “{text}”"
        for room, text in sentences.items()
        if room in rows and rows[room] != text
    ]
    return lines + [
        f"{room}: “{text}” is not one sentence" for room, text in rows.items() if not sentence(text)
    ]
