"""The computations of a published row, each under the hash of everything that it depends on."""

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from app.common.json import Json
from app.common.version import VERSION
from app.documents.gait_json import sent_hash
from app.export.trajectory_files import read_bytes
from app.published.columns import Who
from app.published.figures import SIMULATED, Tools, physics_of
from app.published.own_figures import own_figures
from app.published.problems import walker
from app.published.reference import Reference
from app.published.reference_figures import reference_figures, reference_files
from app.simulation.problem import FORM as PHYSICS_FORM
from app.simulation.problem import physics_content
from core.errors import InputError
from core.published.gaits import published_gait
from core.published.tables import Kind, PublishedRow, PublishedTable, published_table

FORM = 2
"""Of what is kept; grows with the definitions of its figures."""


@dataclass(frozen=True, eq=False)
class Entry:
    """One computation of a row.

    Args:
        who: the origin of its figures.
        key: hash of everything that it depends on, this program's version included; rows may share it.
        compute: gives the content that is kept.
    """

    who: Who
    key: str
    compute: Callable[[Tools], Json]


def entries_of(table: PublishedTable, row: PublishedRow, reference: Reference | None) -> tuple[Entry, ...]:
    """The computations of a row: of our gait, and of each column of the published data at hand."""
    own = Entry(Who.OURS, _own_key(table.id, row.id), partial(own_figures, table, row))
    if reference is None:
        return (own,)
    files = reference_files(table, row, reference)
    return (own, *(_of_reference(table, row, who, reference, files[who]) for who in files))


def _of_reference(
    table: PublishedTable, row: PublishedRow, who: Who, reference: Reference, files: Sequence[Path]
) -> Entry:
    gait, hashes = row.gait, [_file_hash(path, reference) for path in files]
    key = _key(who, table.kind, gait.family, gait.step, gait.iterations, *hashes)
    return Entry(who, key, lambda tools: reference_figures(table, row, who, reference, tools))


@cache
def _own_key(table_id: str, row_id: str) -> str:
    table = published_table(table_id)
    row = table.row(row_id)
    return _key(Who.OURS, table.kind, row.gait.iterations, sent_hash(published_gait(table, row)))


def _key(who: Who, kind: Kind, *more: object) -> str:
    # Tables of one physics share what was simulated: their figures hold every definition.
    shared = "simulated" if kind in SIMULATED else "pace" if kind is Kind.PACE else "real"
    parts = [VERSION, FORM, PHYSICS_FORM, who, shared, walker().parameters_hash]
    parts += [physics_content(physics_of(kind)), *more]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def _file_hash(path: Path, reference: Reference) -> str:
    """Hash of a file's content; of one that cannot be read, its name and the reason."""
    try:
        state = path.stat()
        return _content_hash(path, state.st_mtime_ns, state.st_size)
    except OSError as error:
        return f"{path.relative_to(reference.folder)}: {error.strerror}"
    except InputError as error:
        return error.sentence


@cache
def _content_hash(path: Path, changed: int, size: int) -> str:
    del changed, size  # they tell one content of the file from another
    return hashlib.sha256(read_bytes(path)).hexdigest()
