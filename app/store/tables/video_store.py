"""Videos in the database; the files themselves are in the data folder."""

import json
from dataclasses import dataclass
from pathlib import PurePath

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import VIDEO
from app.store.tables.shapes import MOMENT, Maybe, ShapeError, Stored, text
from app.store.tables.table import Selection, Table, TableKind, json_of, key_of


@dataclass(frozen=True)
class VideoRow:
    """A video as it is kept, and when it was deleted, s of the folder's time (see `FolderTime`)."""

    id: str
    run: str
    content: Json
    deleted: float | None

    def __post_init__(self) -> None:
        key_of(self, self.content, "id", "run")
        file = self.content["file"]
        if file in ("", ".", "..") or PurePath(file).name != file:
            raise ShapeError("content.file", "names no file of the folder videos")

    @property
    def view(self) -> Json:
        """The content, and whether the video is deleted."""
        return {**self.content, "deleted": self.deleted is not None}


VIDEOS = TableKind(
    "video",
    "video",
    ("id",),
    {"id": text, "run": text, "content": Stored(VIDEO), "deleted": Maybe(MOMENT)},
    VideoRow,
)


@dataclass(frozen=True)
class TrackedTrial:
    """A trial whose feet were seen in a video."""

    id: str
    video: str
    name: str


def _tracked(**columns: str) -> TrackedTrial:
    video, name = (columns[json_of(path)] for path in ("$.sight.source.video", "$.name"))
    return TrackedTrial(columns["id"], video, name)


_TRACKED = TableKind(
    "trial",
    "trial",
    ("id",),
    {"id": text, json_of("$.sight.source.video"): text, json_of("$.name"): text},
    _tracked,
)


class VideoStore:
    """What is known of each video.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._table, self._tracked = Table(database, VIDEOS), Table(database, _TRACKED)

    def listed(self, run: str = "", *, is_deleted: bool = False) -> Selection[VideoRow]:
        """Videos, the newest first.

        Args:
            run: those of one run; empty for all.
            is_deleted: the deleted ones instead.
        """
        which = "NOT NULL" if is_deleted else "NULL"
        return self._table.select(
            f"WHERE deleted IS {which} AND (?='' OR run=?) ORDER BY rowid DESC", run, run
        )

    def get(self, video: str) -> VideoRow | None:
        """One video, also a deleted one; None where there is none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        return self._table.first("WHERE id=?", video)

    def trials(self, video: str = "") -> dict[str, list[dict[str, str]]]:
        """The trials that are not deleted, by the video that their feet were seen in, the newest first.

        Args:
            video: those of one video; empty for all.

        Returns:
            Id and name of each trial, under the video's id.
        """
        source = json_of("$.sight.source.video")
        selection = self._tracked.select(
            f"WHERE deleted IS NULL AND typeof({source})='text' AND {source}<>'' "
            f"AND (?='' OR {source}=?) ORDER BY rowid DESC",
            video,
            video,
        )
        found: dict[str, list[dict[str, str]]] = {}
        for trial in selection.rows:
            found.setdefault(trial.video, []).append({"id": trial.id, "name": trial.name})
        return found

    def put(self, content: Json) -> None:
        """Stores what is known of a video now; whether it is deleted stays as it is."""
        kept = {key: value for key, value in content.items() if key != "deleted"}
        text = json.dumps(kept, allow_nan=False)
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO video(id, made, run, content) VALUES(?,?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["made"], content["run"], text),
            )

    def put_deleted(self, video: str, deleted: float | None) -> bool:
        """Takes a video out of every list at a folder's time, or brings it back with None; its file stays."""
        return self._table.put_deleted(deleted, id=video)
