"""The computations of a published row, each under the hash of everything that it depends on."""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from app.common.json import Json
from app.common.version import VERSION
from app.documents.gait_json import sent_hash
from app.export.trajectory_files import read_text
from app.published.figures import SIMULATED, Tools, physics_of
from app.published.own_figures import own_figures
from app.published.problems import walker
from app.published.reference import Reference
from app.published.reference_figures import reference_figures, reference_files
from app.simulation.problem import FORM as PHYSICS_FORM
from app.simulation.problem import physics_content
from core.published.gaits import published_gait
from core.published.tables import Kind, PublishedRow, PublishedTable, published_table

FORM = 1
"""Of what is kept; grows with the definitions of its figures."""


@dataclass(frozen=True, eq=False)
class Entry:
    """One computation of a row.

    Args:
        key: hash of everything that it depends on, this program's version included; rows may share it.
        compute: does it, and gives the content that is kept.
    """

    key: str
    compute: Callable[[Tools], Json]


def entries_of(table: PublishedTable, row: PublishedRow, reference: Reference | None) -> tuple[Entry, ...]:
    """The computations of a row: of our gait, and of the published data where there is any at hand.

    Raises:
        InputError: a published file cannot be read.
    """
    own = Entry(_own_key(table.id, row.id), partial(own_figures, table, row))
    files = () if reference is None else reference_files(table, row, reference)
    if reference is None or not files:
        return (own,)
    key = _key("reference", table.kind, row.gait.iterations, *map(_file_hash, files))
    return (own, Entry(key, partial(_of_reference, table, row, reference)))


def _of_reference(table: PublishedTable, row: PublishedRow, reference: Reference, tools: Tools) -> Json:
    return reference_figures(table, row, reference, tools)


@cache
def _own_key(table_id: str, row_id: str) -> str:
    table = published_table(table_id)
    row = table.row(row_id)
    return _key("own", table.kind, row.gait.iterations, sent_hash(published_gait(table, row)))


def _key(what: str, kind: Kind, *more: object) -> str:
    # Tables of one physics share what was simulated: their figures hold every definition.
    shared = "simulated" if kind in SIMULATED else "pace" if kind is Kind.PACE else "real"
    parts = [VERSION, FORM, PHYSICS_FORM, what, shared, walker().parameters_hash]
    parts += [physics_content(physics_of(kind)), *more]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def _file_hash(path: Path) -> str:
    state = path.stat()
    return _text_hash(path, state.st_mtime_ns, state.st_size)


@cache
def _text_hash(path: Path, changed: int, size: int) -> str:
    del changed, size  # they tell one content of the file from another
    return hashlib.sha256(read_text(path).encode()).hexdigest()
