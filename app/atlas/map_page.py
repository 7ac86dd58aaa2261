"""One HTML page with the map of an atlas; it opens by double click, without any server."""

import shlex
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from types import MappingProxyType

import numpy as np

from app.atlas.atlas_file import AtlasFile
from app.atlas.entries import entries_with_physics
from app.atlas.front import BETTER_SMALL, BY_SIZE, UNITS, front_keys
from app.atlas.included import INCLUDED
from app.atlas.map_columns import choice_column, figure_column, number_column, range_column
from app.common.json import Json
from app.common.page_template import filled, script_json
from core.atlas.axes import ROBOT
from core.atlas.physics_row import PHYSICS_FIGURES, physics_content
from core.atlas.row import FIGURES, AtlasRow, RowStatus, results_hash
from core.atlas.space import AtlasKind
from core.data.tables import package_files
from core.robot.model import load_robot

TITLES: Mapping[str, str] = MappingProxyType(
    {
        "seconds": "Time of a cycle",
        "speed": "Speed",
        "turn_rate": "Turn rate",
        "least_margin": "Stability margin",
        "body_move": "Longest move of the body",
        "stroke_use": "Motor range used",
        "stop_seconds": "Longest time to a stop",
        "walked": "Variations that walk in physics",
        "simulated_speed": "Speed in physics",
        "simulated_turn_rate": "Turn rate in physics",
        "max_tilt": "Largest lean in physics",
        "swing_load": "Load in swings in physics",
        "slip": "Slip in physics",
        "order": "Foot order",
        "overlap": "Overlapping swings",
        "moves": "Parts of each move",
        "step_x": "Step along x",
        "step_y": "Step along y",
        "turn": "Turn of a cycle",
        "height": "Body height",
        "clearance": "Clearance",
        "margin": "Required margin",
        "stop_bound": "Stop bound",
        "lost": "Limbs held up",
    }
)
"""What a person calls a figure or a parameter; a key without a title is shown as it is."""
DECIMALS: Mapping[str, int] = MappingProxyType({"mm/s": 2, "mm": 1, "s": 2, "°/s": 2, "°": 1, "%": 0})
"""Decimals of a number with a unit."""
MOST_REASONS = 12
"""Reasons that have a row of their own, the most frequent ones."""
_SCRIPTS = ("data.js", "plot.js", "panels.js", "filters.js", "map.js")
_MID_WALK = (
    "All figures are those of one cycle in mid-walk. From the standard stance to rest a gait is slower, and "
    "its step may be shorter."
)
_ITERATION = "All figures are those of one iteration of a drawn gait, as it is planned."


@dataclass(frozen=True, eq=False)
class _Results:
    """What an atlas holds at one moment.

    Args:
        counts: gaits of each status.
        reasons: infeasible gaits of each reason.
        hash: of all rows.
        solved: rows and parameters of the solved gaits.
    """

    counts: Mapping[RowStatus, int]
    reasons: Counter[str]
    hash: str
    solved: Sequence[tuple[AtlasRow, Json]]


def map_page(atlas: AtlasFile) -> str:
    """The page: a map of all solved gaits, the front, and what is known about the others.

    Args:
        atlas: the file; it may be in the middle of a run.

    Raises:
        StorageError: the disk does not give it.
    """
    results = _results(atlas)
    script = "\n".join(_part(name) for name in _SCRIPTS)
    title = load_robot(atlas.space.robot).title
    parts = {
        "TITLE": escape(f"Atlas of {title}"),
        "COUNTS": escape(_counts_sentence(results.counts)),
        "STYLE": _part("map.css"),
        "ABOUT": _facts(atlas, results, title),
        "REASONS": _reasons(results),
        "FIGURES": escape(_MID_WALK if atlas.space.kind is AtlasKind.FAST else _ITERATION),
        "DATA": script_json(_content(atlas, results)),
        "SCRIPT": f'(() => {{\n"use strict";\n{script}}})();',
    }
    return filled(_part("map.html"), parts)


def _part(name: str) -> str:
    return package_files("app.atlas").joinpath("page", name).read_text("utf-8")


def _results(atlas: AtlasFile) -> _Results:
    """Everything in one look, so that a run that goes on meanwhile changes nothing."""
    entries = list(entries_with_physics(atlas))
    rows = [row for row, _ in entries]
    known = Counter(row.status for row in rows)
    reasons = Counter(row.reason for row in rows if row.status is RowStatus.INFEASIBLE)
    solved = [entry for entry in entries if entry[0].status is RowStatus.SOLVED]
    counts = {status: known[status] for status in RowStatus}
    return _Results(counts, reasons, results_hash(rows), solved)


def _content(atlas: AtlasFile, results: _Results) -> Json:
    """What the page's script works with: a column for each key, and how to open a gait."""
    numbers = np.array([row.number for row, _ in results.solved], dtype=float)
    has_file = not any(name.startswith(ROBOT) for name in atlas.space.axes)
    return {
        "count": len(results.solved),
        "ids": number_column(numbers, 1.0),
        "columns": _columns(atlas, results.solved) if results.solved else [],
        "open": [f"footfall atlas open {shlex.quote(_named(atlas))} ", " -o gait.json" if has_file else ""],
        "opens_as_file": has_file,
    }


def _named(atlas: AtlasFile) -> str:
    """How a command names it."""
    return next((name for name, path in INCLUDED.items() if path == atlas.path), str(atlas.path))


def _columns(atlas: AtlasFile, solved: Sequence[tuple[AtlasRow, Json]]) -> list[Json]:
    """Figures, then parameters, as rows have them; figures that no gait has are left out."""
    columns = []
    figures = [(name, [getattr(row, name) for row, _ in solved]) for name in FIGURES]
    figures += [(name, [parameters[name] for _, parameters in solved]) for name in PHYSICS_FIGURES]
    for name, found in figures:
        values = np.array([np.nan if value is None else value for value in found], dtype=float)
        if np.isfinite(values).any():
            columns.append(_key(name) | {"is_figure": True, "is_number": True} | figure_column(values))
    numbers = front_keys(atlas)
    physics = physics_content(None)
    for name in (name for name in solved[0][1] if name not in physics):
        written = [parameters[name] for _, parameters in solved]
        axis = atlas.space.axes.get(name)
        is_range = axis is not None and axis.low is not None
        column = range_column(np.array(written, dtype=float)) if is_range else choice_column(written)
        columns.append(_key(name) | {"is_figure": False, "is_number": name in numbers} | column)
    return columns


def _key(name: str) -> Json:
    """A key as the page shows it; `better` is 1 where more is better, -1 where less is, 0 for sizes."""
    unit, factor = UNITS.get(name, ("", 1.0))
    better = 0 if name in BY_SIZE else -1 if name in BETTER_SMALL else 1
    return {
        "name": name,
        "title": TITLES.get(name, name),
        "unit": unit,
        "factor": factor,
        "decimals": DECIMALS.get(unit),
        "better": better,
    }


def _counts_sentence(counts: Mapping[RowStatus, int]) -> str:
    return (
        f"{sum(counts.values()):,} gaits drawn: {counts[RowStatus.SOLVED]:,} solved, "
        f"{counts[RowStatus.INFEASIBLE]:,} infeasible, {counts[RowStatus.FAILED]:,} failed"
    )


def _facts(atlas: AtlasFile, results: _Results, title: str) -> str:
    facts = (
        ("File", atlas.path.name),
        ("Robot", f"{title} ({atlas.space.robot})"),
        ("Made by", f"Footfall Studio {atlas.version}"),
        ("Hash of the robot", atlas.robot_hash),
        ("Hash of the space", atlas.space.hash),
        ("Hash of the results", results.hash),
    )
    return "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in facts)


def _reasons(results: _Results) -> str:
    """Rows of a table: the most frequent reasons, then all others as one."""
    ranked = results.reasons.most_common()
    shown, others = ranked[:MOST_REASONS], ranked[MOST_REASONS:]
    if others:
        shown.append((f"{len(others):,} other reasons", sum(count for _, count in others)))
    if not shown:
        return '<tr><th scope="row">No gait is infeasible.</th><td>0</td></tr>'
    return "".join(
        f'<tr><th scope="row">{escape(_reason_words(reason))}</th><td>{count:,}</td></tr>'
        for reason, count in shown
    )


def _reason_words(reason: str) -> str:
    words = reason.removeprefix("Prevented by: ").removesuffix(".")
    return words[:1].upper() + words[1:]
