"""Summaries of atlas files: each is kept for as long as its file and what stands beside it are the same."""

import os
import threading
import time
from bisect import bisect_left
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path

from app.atlas.atlas_file import AtlasFile
from app.atlas.included import INCLUDED
from app.common.json import Json
from core.atlas.row import RowStatus
from core.errors import FootfallError, InputError

LIST_SECONDS = 0.6
"""How long one list looks at files that changed; a look that has begun is ended."""
MOST_KEPT = 10_000
"""Summaries."""
_FRESH_NS = 2_000_000_000
"""A file that was written so short a time ago may be written again at what its clock calls the same time."""
_BESIDE = ("", "-journal", "-wal", "-shm")
_NOT_YET = "This atlas is not looked at yet, since others took long. Open the list again."

_State = tuple[tuple[int, ...] | None, ...]


class AtlasSummaries:
    """Summaries by the names of atlases; any thread may ask.

    Args:
        list_seconds: how long one list looks at files that changed.
    """

    def __init__(self, list_seconds: float = LIST_SECONDS) -> None:
        self._list_seconds = list_seconds
        self._lock = threading.Lock()
        self._known: dict[str, tuple[_State, Json]] = {}
        self._next = ""

    def summary(self, name: str, path: Path) -> Json:
        """The summary of an atlas, m/s; of one that cannot be read, why not.

        Args:
            name: of the atlas.
            path: its file.
        """
        return self._kept(name, _state(path)) or self._looked_at(name, path)

    def summaries(self, paths: Mapping[str, Path]) -> list[Json]:
        """One for each atlas, in their order.

        Where the time of a list is over, the next list begins with the file at which this one ended.

        Args:
            paths: all files of the folder by name, in the order of their names.
        """
        with self._lock:
            for name in self._known.keys() - paths.keys() - INCLUDED.keys():
                del self._known[name]
        found = {name: self._kept(name, _state(path)) for name, path in paths.items()}
        changed = [name for name, summary in found.items() if summary is None]
        start, end = bisect_left(changed, self._next), time.monotonic() + self._list_seconds
        self._next = ""
        for count, name in enumerate((*changed[start:], *changed[:start])):
            if count and time.monotonic() > end:
                self._next = name
                break
            found[name] = self._looked_at(name, paths[name])
        return [summary or _trouble(name, _NOT_YET) for name, summary in found.items()]

    def _kept(self, name: str, state: _State) -> Json | None:
        with self._lock:
            known, summary = self._known.get(name, (None, {}))
        return dict(summary) if known == state else None

    def _looked_at(self, name: str, path: Path) -> Json:
        state, now = _state(path), time.time_ns()
        try:
            summary = _read(name, path)
        except InputError as error:
            summary = _trouble(name, error.sentence)
        except FootfallError as error:  # of the moment, such as a busy file
            return _trouble(name, error.sentence)
        is_fresh = any(abs(now - one[-1]) < _FRESH_NS for one in state if one is not None)
        with self._lock:
            if not is_fresh and (name in self._known or len(self._known) < MOST_KEPT):
                self._known[name] = state, dict(summary)
        return summary


def _read(name: str, path: Path) -> Json:
    with closing(AtlasFile(path, follows_link=name in INCLUDED)) as atlas:
        (counts, fastest), space = atlas.summary(), atlas.space
        return {
            "name": name,
            "included": name in INCLUDED,
            "robot": space.robot,
            "kind": space.kind.value,
            "seed": space.seed,
            "gaits": sum(counts.values()),
            **{status.value: counts[status] for status in RowStatus},
            "fastest": fastest,
            "program": atlas.version,
            "robot_hash": atlas.robot_hash,
            "robot_changed": atlas.robot_hash != space.robot_hash,
            "space_hash": space.hash,
            "bytes": atlas.size,
        }


def _trouble(name: str, sentence: str) -> Json:
    return {"name": name, "included": name in INCLUDED, "trouble": sentence}


def _state(path: Path) -> _State:
    """Of a file and of each that SQLite keeps beside it what changes with it, last the time of writing."""
    return tuple(_file_state(f"{path}{end}") for end in _BESIDE)


def _file_state(path: str) -> tuple[int, ...] | None:
    try:
        state = os.lstat(path)
    except OSError:
        return None
    # The right to read a file changes nothing but the time of its entry.
    return state.st_dev, state.st_ino, state.st_size, state.st_ctime_ns, state.st_mtime_ns
