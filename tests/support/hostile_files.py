"""A data folder full of files that somebody else put there: damaged, absurd, or no files at all."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from app.documents.gait_json import gait_content
from app.store.gait_files import MOST_FILE_BYTES
from core.library.library import library

Put = Callable[[Path], object]
SPARSE = 10_000_000_000
"""Bytes of a file that is all hole."""


def _sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(SPARSE)


def _socket(path: Path) -> None:
    # The path of a socket is short; that of a test's folder is not.
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(f"/proc/self/fd/{folder}/{path.name}")
    finally:
        os.close(folder)


def _unreadable(path: Path) -> None:
    path.write_text("{}")
    path.chmod(0)


def _link(target: str, path: Path) -> None:
    path.symlink_to(path.name if target == "itself" else target)


NO_FILES: dict[str, Put] = {
    "folder": Path.mkdir,
    "pipe": os.mkfifo,
    "socket": _socket,
    "unreadable": _unreadable,
    "sparse": _sparse,
    "empty": Path.touch,
    "dangling": partial(_link, "nowhere"),
    "loop": partial(_link, "itself"),
    "device": partial(_link, "/dev/zero"),
}
"""What may stand where a file is looked for, by a name."""

CHANGES: dict[str, tuple[tuple[str | int, ...], Any]] = {
    "step-tiny": (("step",), [1e-300, 0.0, 0.0]),
    "step-huge": (("step", 0), 1e308),
    "turn-tiny": (("step", 2), 1e-300),
    "turn-huge": (("step", 2), 1e6),
    "name-empty": (("name",), ""),
    "name-number": (("name",), 7),
    "name-half": (("name",), "\ud800"),
    "name-long": (("name",), "x" * 1_000_000),
    "robot-path": (("robot",), "../../etc/passwd"),
    "robot-null": (("robot",), None),
    "direction-huge": (("direction",), 10**400),
    "iterations-negative": (("iterations",), -1),
    "iterations-huge": (("iterations",), 2**63),
    "order-empty": (("order",), []),
    "order-twice": (("order",), [1, 1, 2, 3]),
    "order-long": (("order",), [1] * 100_000),
    "timeline-empty": (("timeline", "feet"), ["", "", "", ""]),
    "timeline-long": (("timeline", "feet"), ["1" * 100_000] * 4),
    "timeline-letters": (("timeline", "feet"), ["1x"] * 4),
    "time-tiny": (("timeline", "sample_time"), 1e-300),
    "time-huge": (("timeline", "sample_time"), 1e308),
    "clearance-negative": (("options", "clearance"), -0.001),
    "speed-zero": (("options", "body_speed"), 0.0),
    "knots-text": (("options", "phase_knots"), "5"),
    "options-list": (("options",), []),
    "unknown-key": (("Name",), "other case"),
    "sequence-text": (("sequence",), "walk"),
    "poses-list": (("poses",), []),
    "held-all": (("held",), {"start": [1, 2, 3, 4], "end": []}),
    "notes-list": (("notes",), [[]]),
    "version-huge": (("version",), 1e308),
}
"""A gait's document with one value changed, by a name: which, and to what."""

POSE_CHANGES: dict[str, tuple[tuple[str | int, ...], Any]] = {
    "poses-far": (("poses", "found", "bodies", 0, 0), 1e308),
    "poses-nested": (("poses", "found", "feet", 0), [[[]]]),
    "poses-step": (("poses", "found", "step"), -1e-300),
    "poses-turned": (("poses", "found", "headings"), [1e308] * 27),
    "poses-none": (("poses", "found", "bodies"), []),
    "poses-answers": (("poses", "found", "answers"), "0" * 10_000),
    "poses-slip": (("poses", "slip"), 1e308),
    "poses-pinned": (("poses", "pinned"), [{"pose": 5, "along": 1e308, "sideways": 0}]),
}
"""The same of a gait for the robot's clock."""

TEXTS: dict[str, bytes] = {
    "no-json": b"{ damaged",
    "no-object": b"[1]",
    "zeros": b"\0" * 100,
    "utf-16": '{"format": "footfall-gait"}'.encode("utf-16"),
    "latin-1": b'{"format": "footfall-gait", "name": "\xe9"}',
    "nested": b"[" * 200_000,
    "nan": b'{"format": "footfall-gait", "step": [NaN, 0, 0]}',
    "twice": b'{"format": "footfall-gait", "format": "footfall-gait"}',
    "digits": b'{"format": "footfall-gait", "version": ' + b"9" * 100_000 + b"}",
    "large": b" " * (MOST_FILE_BYTES + 1),
}
"""Texts that are no documents at all."""


def changed(content: Any, path: tuple[str | int, ...], value: Any) -> Any:
    """JSON content with one value changed, or added."""
    copy = json.loads(json.dumps(content))
    place = copy
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return copy


def hostile_gaits() -> Iterator[tuple[str, bytes]]:
    """Names and contents of gait files that are no gaits, or absurd ones."""
    for gait, changes in (("walk", CHANGES), ("fast-turn", POSE_CHANGES)):
        content = gait_content(library()[gait].gait)
        for name, (path, value) in changes.items():
            yield name, json.dumps(changed(content, path, value)).encode()
    yield from TEXTS.items()


def put_hostile_gaits(data: Path) -> list[str]:
    """Puts them among the gaits of a data folder, beside what is no file; their ids."""
    (data / "gaits").mkdir(parents=True)
    ids = []
    for name, content in hostile_gaits():
        (data / "gaits" / f"{name}.json").write_bytes(content)
        ids.append(name)
    for name, put in NO_FILES.items():
        put(data / "gaits" / f"{name}.json")
        ids.append(name)
    for misnamed in (b"\xff\xfe.json", b"A B.json", b".json", b"..json", b".hidden.json"):
        (data / "gaits" / os.fsdecode(misnamed)).write_text("{}")
    return ids


PLACES = (
    "robot.json",
    "running/a-run.journal",
    "trash/.order",
    "trash/gone.json",
    "trash/No Id.json",
    "gaits/.half.1.99999999999999999999.partial",
    "gaits/.half.partial",
    "videos/.half.partial",
    "videos/a.mp4",
    "backups/studio-1-daily-99999999999999999999.sqlite3",
    "backups/.half.partial",
    "atlases/an-atlas.sqlite",
    "atlases/gone.sqlite.deleted",
    "trial-photos/a.jpg",
)
"""Where the studio looks for a file of its own."""


def put_no_files(data: Path, kind: str) -> None:
    """Puts what is no file, of one kind, wherever the studio looks for a file of its own."""
    for place in PLACES:
        (data / place).parent.mkdir(parents=True, exist_ok=True)
        NO_FILES[kind](data / place)
